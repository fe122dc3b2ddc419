// The public C++ interface of cnctrans: translate, verify, run and check part programs of CNC controls.
// Needs the standard library only. docs/library.md shows how to build against it; cnctrans.h is the same for C.
//
// No function throws; what can't be done comes back as a status with diagnostics. Functions may be called from several
// threads at a time. Texts are UTF-8 but for part programs, which keep their bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cnctrans/export.h"

namespace cnctrans::api {

/// Version of the library, as "0.2.0".
CNCTRANS_API std::string version();

/// A part-program language.
struct Dialect {
  std::string name;   ///< for `from`, `to` and `dialect`: "fagor", "num", "sinumerik", ...
  std::string title;  ///< "Fagor 8055"
  bool read = false;  ///< programs can be read from it; false: written only
  std::vector<std::string> mill_extensions, lathe_extensions;  ///< of files, lower case, without the dot
};
CNCTRANS_API std::vector<Dialect> dialects();
/// Names of the machine profiles that are built in. Everywhere a machine is named, a profile's file may stand too.
CNCTRANS_API std::vector<std::string> machines();

/// A program to work on. A text has no folder: what it calls comes from `programs` and `libraries` alone. A file's own
/// folder is searched between the two.
struct Program {
  std::string name;                  ///< path of a file; of a text the name that diagnostics and translations use
  std::optional<std::string> bytes;  ///< of a text
};
inline Program file(std::string path) {
  return {std::move(path), std::nullopt};
}
/// The extension of `name` tells lathe from mill where no machine is given ("part.pit").
inline Program text(std::string name, std::string bytes) {
  return {std::move(name), std::move(bytes)};
}

enum class Severity : std::uint8_t { note, warning, error };

/// A place in a program; line 0: nowhere in particular. Lines and columns count from 1, columns in bytes; `end_column`
/// is the one behind the last.
struct Place {
  std::string file;
  std::uint32_t line = 0, column = 0, end_line = 0, end_column = 0;
};

/// One finding. The code is stable ("TRN-205") and explained in docs/diagnostics.
struct Diagnostic {
  std::string code;
  Severity severity = Severity::error;
  Place place;
  std::string message;  ///< what is the matter, and what happens because of it
  std::string hint;     ///< what to do; may be empty
  std::string shown;    ///< as the command prints it: place, message, the line with carets, hint
};

/// The exit statuses of the command (docs/trace.md).
enum class Status : std::uint8_t {
  ok = 0,
  refused = 1,  ///< errors: nothing was written, or the program stopped with an error
  usage = 2,    ///< an option, a dialect, a machine or a file that does not exist: `error` says which
  differs = 3   ///< not verified, or stopped by a limit
};

/// How programs are found and replayed.
struct Options {
  std::string machine;                                   ///< of the source; empty: chosen by extension and content
  std::vector<std::string> libraries;                    ///< folders and definition files for what is called
  std::vector<Program> programs;                         ///< programs that may be called, before every folder
  std::vector<std::pair<std::string, std::string>> set;  ///< initial values: {"P100", "12.5"}
  std::vector<unsigned> skip;                            ///< block-skip switches that are on, 0 to 15
  std::uint64_t max_events = 0;                          ///< of a replay; 0: 2 million, of `run` 50 million
};

enum class Unsupported : std::uint8_t { error, warn, comment };  ///< what becomes of what the target can't say
enum class Numbering : std::uint8_t { keep, none, renumber };    ///< of blocks
enum class Cycles : std::uint8_t { native, exact, explode };     ///< docs/cycles.md
enum class Encoding : std::uint8_t { as_source, utf8, windows1252 };
enum class LineEnd : std::uint8_t { as_source, lf, crlf, cr };

struct TranslateOptions : Options {
  std::string from, to;        ///< names of dialects
  std::string target_machine;  ///< empty: the target's mill or lathe, as the source's
  Unsupported unsupported = Unsupported::error;
  Numbering numbering = Numbering::keep;
  int number_step = 10;  ///< of `renumber`, 1 and up
  Cycles cycles = Cycles::native;
  bool raise_structure = false;  ///< jumps become structures where that is provably the same
  bool annotate = false;         ///< each line gets its source line as a comment
  bool origin = false;           ///< a remark at the head names the source's file and control
  /// Replay both and compare: as written, with the block-skip switches on, and shortly with other inputs. What differs
  /// gets Status::differs; what can't be replayed is `ok`, and the verdict says "not proved: " and why.
  bool prove = true;
  bool verify = false;    ///< prove, and what can't be replayed gets Status::refused (its outputs are there)
  unsigned explore = 0;   ///< as `verify`, with so many replays at most with other inputs
  bool one_file = false;  ///< called programs come in the main program's file
  Encoding encoding = Encoding::as_source;
  LineEnd line_end = LineEnd::as_source;
};

/// One program file of a translation.
struct Output {
  std::string name;     ///< as the target's control wants the file to be called
  std::string program;  ///< the control's own name of a main program where that is not the file's ("%12"); else empty
  std::string bytes;
  bool main = false;
  std::vector<Place> lines;  ///< where line n+1 comes from; line 0: from nowhere
};

/// What a comparison of two replays came to.
struct Verdict {
  enum class Result : std::uint8_t { verified, within_tolerance, differs, nothing_to_compare, not_replayable };
  Result result = Result::nothing_to_compare;
  std::uint64_t events = 0, moves = 0;   ///< that were compared
  double max_length = 0;                 ///< largest difference of an end point, mm
  std::size_t blocks = 0, replayed = 0;  ///< of the source, that do something, and that the replay came to
  /// As the command prints it: "verified: ...", "not verified: ...", "not proved: ...".
  std::string text;
  [[nodiscard]] bool good() const { return result == Result::verified || result == Result::within_tolerance; }
};

struct Translation {
  Status status = Status::usage;
  std::string error;            ///< with Status::usage
  std::vector<Output> outputs;  ///< the main program first. There also where the verdict is bad: not to be cut with
  std::vector<Diagnostic> diagnostics;
  std::optional<Verdict> verdict;  ///< empty: no proof was asked for
  std::string source_machine, target_machine;
};
CNCTRANS_API Translation translate(const Program& program, const TranslateOptions& options);

struct Comparison {
  Status status = Status::usage;
  std::string error;
  Verdict verdict;
  std::vector<Diagnostic> diagnostics;
};
/// Compares a program with a translation that anyone has made: its main program first, then what it calls.
CNCTRANS_API Comparison verify(const Program& source, const std::vector<Program>& translation,
                               const TranslateOptions& options);

struct RunOptions : Options {
  std::string dialect;
};
/// Gets one event as a JSON object in one line without its line end (docs/trace.md); the view lasts for the call.
using EventSink = std::function<void(std::string_view json)>;

struct Run {
  Status status = Status::usage;
  std::string error;
  std::string reason;  ///< "program_end", "error", "event_limit", "step_limit"
  std::uint64_t blocks = 0, events = 0;
  std::vector<std::pair<std::string, std::string>> variables;  ///< every one that was set: name, value as JSON
  std::vector<Diagnostic> diagnostics;
};
/// Carries a program out on its machine. `sink` may be empty.
CNCTRANS_API Run run(const Program& program, const RunOptions& options, const EventSink& sink = {});

struct Check {
  Status status = Status::usage;
  std::string error;
  std::uint64_t lines = 0, blocks = 0, blocks_read = 0;
  std::vector<Diagnostic> diagnostics;
};
/// Reads a program and says what is not right in it.
CNCTRANS_API Check check(const Program& program, const RunOptions& options);

}  // namespace cnctrans::api
