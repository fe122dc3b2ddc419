// Runs a program on a machine and yields a trace. Knows no dialect.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "interpreter/trace/cycle_runs.h"
#include "interpreter/trace/standing.h"
#include "interpreter/trace/trace.h"
#include "ir/program.h"
#include "machine/profile.h"
#include "machine/world.h"

namespace cnctrans::interpreter {

/// Blocks that stand behind a line of the main program and are not in it: those of a long file that are alike.
class LinesBehind {
 public:
  LinesBehind() = default;
  LinesBehind(const LinesBehind&) = delete;
  LinesBehind& operator=(const LinesBehind&) = delete;
  virtual ~LinesBehind() = default;
  [[nodiscard]] virtual bool any(const Span& line) const = 0;
  /// Gives them one by one, until `take` says no. False: they can't be had.
  virtual bool each(const Span& line, const std::function<bool(const ir::Statement&)>& take) = 0;
};

struct Options {
  std::uint64_t max_events = 50'000'000;
  std::uint64_t max_steps = 500'000'000;  ///< statements carried out
  /// Statements in a row without an event: an endless loop that does nothing ends here (as a step limit).
  std::uint64_t max_silent_steps = 10'000'000;
  std::uint16_t skip_mask = 0;                           ///< block-skip switches that are on
  std::vector<std::pair<std::string, std::string>> set;  ///< NAME=VALUE of --set
  bool optional_stops = false;
  std::optional<machine::World> world{};  ///< the machine is put there; none: zeros and points are those of the profile
  /// Finds a routine that the program itself does not have (library); null when there is none. The program returned
  /// stays alive as long as the callback does; its spaces are matched to the main program's by prefix.
  std::function<const ir::Program*(const ir::RoutineName&)> library;
  /// Reads a program that the run itself has written; null, and why: it can't be run.
  std::function<const ir::Program*(const std::string& name, const std::string& text, std::string& why)> read_written;
  /// The error that reading gave for one of these lines; null: none. A statement there is not carried out.
  std::function<const Diagnostic*(FileId file, std::uint32_t first_line, std::uint32_t last_line)> fault;
  LinesBehind* behind = nullptr;  ///< null: the program is whole
  /// Gets the cycles of a lathe that are carried out, in order; null: nobody asks.
  std::vector<CycleRun>* cycles = nullptr;
  /// Sees what holds before each statement; empty: nobody asks.
  Witness witness;
};

/// A file of the control that the run has written.
struct WrittenFile {
  std::string name;   ///< as the program says it
  std::string text;   ///< its lines
  bool more = false;  ///< there may be lines before these: it was not begun by this run
};

struct Result {
  EndReason reason = EndReason::program_end;
  std::string error_code;  ///< with EndReason::error
  std::string error_text;
  Span error_span;
  std::uint64_t steps = 0;
  std::uint64_t blocks = 0;
  std::uint64_t events = 0;
  /// Final values of every variable that was ever set, for --vars: name as in the contract -> JSON text of the value.
  std::vector<std::pair<std::string, std::string>> variables;
  /// Statements carried out at least once, by Statement::id (for coverage).
  std::vector<bool> covered;
  /// What conditions came to, by Statement::id: `held`, `failed`, both, or 0 where none was asked.
  std::vector<std::uint8_t> outcomes;
  static constexpr std::uint8_t held = 1, failed = 2;
  std::vector<WrittenFile> written;
  /// Variables that were read before anything gave them a value, though a control may have kept one: names as of --set.
  std::vector<std::string> read_first;
  bool writes_zeros = false;  ///< the program writes tables of offsets or frames
  /// Radii of tools that nobody gives, mm, and the first milling cycle that ran with each.
  std::vector<std::pair<Span, double>> assumed_radii;
};

/// Runs the main routine of `program`. Statically wrong programs (unknown label, unknown subprogram) are refused before
/// anything moves: diagnostics, and a single `end` event.
Result run(const ir::Program& program, const machine::Profile& profile, const Options& options, TraceSink& sink,
           Diagnostics& diagnostics);

/// Straight-line execution for streams: blocks come one after the other, nothing is kept.
class BlockRunner {
 public:
  BlockRunner(const machine::Profile& profile, const Options& options, TraceSink& sink, Diagnostics& diagnostics);
  ~BlockRunner();
  BlockRunner(const BlockRunner&) = delete;
  BlockRunner& operator=(const BlockRunner&) = delete;
  /// False when the run has ended (error, limit): see result().
  bool step(const ir::Statement& block);
  /// Program end reached at `where`.
  Result finish(const Span& where);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Statements that the reader has given an error for: the first that is reached is the reason why nothing is run, or
/// none is told of again.
enum class Faults : std::uint8_t { first, told };
/// Statically visible faults: jumps and ranges to labels that are not there, calls of unknown routines, bad nesting.
/// The routines that are called and that nobody has: one error each, at the first call.
std::vector<ir::RoutineName> check_program(const ir::Program& program, const Options& options, Diagnostics& diagnostics,
                                           Faults faults = Faults::first);

}  // namespace cnctrans::interpreter
