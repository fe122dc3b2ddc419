// An archive as one job: one map of names for all its programs, each translated and proved by the batch, and the
// results put together in one folder that loads into the control.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "translator/batch/batch.h"
#include "translator/project/config.h"

namespace cnctrans::translator {

struct ProjectOptions {
  std::string folder;  ///< with cnctrans.json
  unsigned jobs = 1, timeout = 300;
  bool reports = false;  ///< a page about each program
  bool again = false;    ///< what an earlier run has done is done again
  bool status = false;   ///< nothing is translated: what is there is looked at
};

/// A program of the archive.
struct ProjectProgram {
  std::string path;                  ///< below the programs
  std::string state;                 ///< of the batch, or "new", "source changed", "changed by hand", "name taken"
  std::string detail;                ///< why
  std::vector<std::string> outputs;  ///< below the output folder
  std::vector<std::pair<std::string, std::string>> diffs;  ///< of an output that was changed by hand: to a new one
  std::size_t lines = 0;
  std::uint64_t moves = 0;
  std::map<std::string, std::size_t> errors, warnings;  ///< by code
  std::string report;                                   ///< of the page about it, below the project's folder
};

struct ProjectResult {
  std::string error;  ///< usage: nothing was done
  std::vector<ProjectProgram> programs;
  std::vector<std::string> written;  ///< files of the output folder that are new or other than before
  std::size_t translated = 0, reused = 0;
};

ProjectResult project(const ProjectOptions& options, const std::function<void(const BatchProgress&)>& progress);

std::string project_html(const ProjectResult& r, const ProjectConfig& config);
std::string project_csv(const ProjectResult& r);

/// Lines that differ: "-old", "+new", with one line around each. Empty: none.
std::string line_diff(std::string_view before, std::string_view after);

}  // namespace cnctrans::translator
