// Many programs at once: every part program below a folder is translated and verified, one process each, so that none
// of them can stop the others. What was done stays beside the translations and is not done again.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "translator/pipeline.h"

namespace cnctrans::translator {

struct BatchOptions {
  TranslateOptions translate;      ///< for each program
  std::string in, out;             ///< folders
  unsigned jobs = 1;               ///< processes side by side, 1..
  unsigned shard = 1, shards = 1;  ///< this run takes every `shards`-th program, from number `shard` on (1..shards)
  unsigned timeout = 300;          ///< seconds for one program
  bool again = false;              ///< results that are there already are not taken over
  bool force = false;              ///< outputs that were changed by hand are replaced
  std::vector<std::string> only;   ///< these programs below `in`; empty: all
  /// Stands for the map of names in what a result depends on: a name that is added does not make the others old. Empty:
  /// the names themselves.
  std::string names_key;
  bool reports = false;       ///< a page about each program, beside its outputs
  bool collect_only = false;  ///< nothing is translated; the summary of what is there is written
};

/// What became of one program. Written as JSON beside its outputs; see docs/batch.md.
struct BatchRecord {
  std::string program;      ///< path below the input folder, '/' between folders
  std::string status;       ///< one of batch_statuses()
  std::string detail;       ///< why it was not proved, first difference or first error, one line
  double max_length = 0;    ///< mm: the greatest distance of two end points that were taken as equal
  std::uint64_t moves = 0;  ///< compared
  std::uint64_t lines = 0;  ///< of the source
  std::map<std::string, std::size_t> errors, warnings;  ///< by code
  std::vector<std::string> outputs;                     ///< names below the program's own folder
  std::string report;                                   ///< likewise, of the page about it; empty: none was asked for
  std::map<std::string, std::string> read;              ///< every file that was read, with a sum of its bytes
  std::string job;                                      ///< sum of the options and the version
};

/// The statuses in the order of the summary: "verified", "within tolerance", "written" (without a proof: none was asked
/// for, or the target can't be read back), "no motion", "not replayable", "differs", "refused", "unreadable",
/// "crashed", "timed out", "left alone" (somebody has changed an output, or it would take the place of another file).
const std::vector<std::string>& batch_statuses();

struct BatchProgress {
  std::size_t done = 0, total = 0;
  double per_second = 0, seconds_left = 0;
};

struct BatchResult {
  std::size_t programs = 0;          ///< of this shard
  std::size_t reused = 0;            ///< of them: done by an earlier run
  std::size_t all = 0;               ///< below the folder
  std::vector<BatchRecord> records;  ///< of all shards, as far as they are there, in order
  std::string error;                 ///< could not even start (folder missing)
};

/// The programs below the folder, sorted.
std::vector<std::string> batch_programs(const BatchOptions& options);
/// Those that have no result of these files and options yet, or all with `again`; not those that are left alone.
std::vector<std::string> batch_open(const BatchOptions& options);

/// Runs the shard and writes `out`/summary.html, summary.csv and programs.csv for all results that are there. Not to be
/// called while other threads run (it forks).
BatchResult batch(const BatchOptions& options, const std::function<void(const BatchProgress&)>& progress);

}  // namespace cnctrans::translator
