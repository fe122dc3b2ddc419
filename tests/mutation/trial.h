// A translation that verifies, and what becomes of a fault in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "interpreter/trace/cycle_runs.h"
#include "interpreter/trace/trace.h"
#include "machine/world.h"
#include "tests/mutation/faults.h"
#include "tests/splice/programs.h"

namespace cnctrans::mutation {

/// What a program does on its machine, in the world of the proof's second replay when there is one.
struct Trace {
  std::vector<interpreter::Event> events;
  std::vector<interpreter::CycleRun> cycles;
  interpreter::Position start;
  bool ran = false;  ///< read without an error and run to its end
};

struct Translated {
  splice::Program source;
  std::string to, machine;  ///< language and machine of the target
  std::string file;
  Lines lines;
  std::optional<machine::World> world;
  std::vector<std::string> read_first;  ///< variables that the translation reads before it writes them
  Trace source_trace, trace;
};
/// nullopt: it is refused, or not verified, or the verifier says otherwise of the two texts alone.
std::optional<Translated> translated(const splice::Program& source, const std::string& to);

enum class Fate { no_place, nothing, no_run, caught, documented, undocumented };

struct Outcome {
  Fate fate = Fate::no_place;
  std::string said;                  ///< by the verifier
  std::string what;                  ///< the first difference of the two traces that nobody may pass over
  std::vector<std::string> aspects;  ///< of a documented one: what differs, as in documented.h
};
Outcome tried(const Translated& t, const Fault& fault);

std::string text_of(const Lines& lines);
/// The command that shows it, with the two texts.
std::string command(const Translated& t);

}  // namespace cnctrans::mutation
