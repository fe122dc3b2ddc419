// What became of one program in one direction.
#pragma once

#include <set>
#include <string>

#include "tests/splice/programs.h"

namespace cnctrans::splice {

enum class Fate {
  invalid,       ///< the source is no program, does not run to its end or moves nothing
  refused,       ///< the translation is refused
  not_replayed,  ///< nothing to compare
  equal,
  foretold,  ///< differs, and a warning at its line says so
  silent     ///< differs, or stops, and nothing said so
};

struct Outcome {
  Fate fate = Fate::invalid;
  std::string kind;             ///< what differs, without its numbers
  std::string said;             ///< the verdict
  std::set<std::string> codes;  ///< of the warnings that foretell it
};

/// The source is a program that runs to its end by itself and moves something.
bool valid(const Program& p);
/// Translates a valid program and replays both: as written, with every block-skip switch on, and with other inputs.
Outcome prove(const Program& p, const std::string& to);
/// The command that shows what `prove` has found.
std::string command(const Program& p, const std::string& to);

}  // namespace cnctrans::splice
