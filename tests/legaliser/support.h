// Programs in textual IR through passes, three invented targets, and replay before and after.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "interpreter/program/interpreter.h"
#include "ir/text/text.h"
#include "legaliser/legalise.h"

namespace cnctrans::test {

/// Jumps only, one relation, one chain from left to right, shared numbered variables, no arguments.
ir::Capabilities chain_target();
/// Jumps, full expressions, levels of local parameters by letter, no expressions in words.
ir::Capabilities letters_target();
/// Structured statements, named local variables, formal parameters, per-word distance, chained frames, modal cycles by
/// call.
ir::Capabilities structured_target();

machine::Profile profile(const std::string& name);

struct Passed {
  ir::Program program;
  Diagnostics diagnostics;
  ir::LegaliseReport report;
  bool good = false;
  std::string text;  ///< printed afterwards
};
ir::Program read(const std::string& text);
Passed run_pass(const std::string& pass, const std::string& text, const ir::Capabilities& target,
                const std::string& source = "fagor-mill", const std::string& target_machine = "fagor-mill");
Passed legalise(const std::string& text, const ir::Capabilities& target, const std::string& source = "fagor-mill",
                const std::string& target_machine = "fagor-mill");
bool has_code(const Diagnostics& diagnostics, const std::string& code);
std::string all(const Diagnostics& diagnostics);

/// The trace as lines: kind and numbers, without source places; positions rounded to 1e-6.
std::vector<std::string> trace(const ir::Program& program, const machine::Profile& machine);
/// Legalises and compares both traces; the difference, or what was refused, as text ("" = equal).
std::string difference(const std::string& text, const ir::Capabilities& target,
                       const std::string& source = "fagor-mill", const std::string& target_machine = "fagor-mill");

/// Spaces as the sources of these tests have them: P (levels 0-25, 100-299), v (named locals), R.
inline const std::string letters_source = "space P \"P\" segment 0 25 level forgotten segment 100 299\n";
inline const std::string named_source = "space R \"R\" segment 0 99\nspace v \"\" scope routine starts_at_zero\n";
inline const std::string shared_source =
    "space L \"L\" starts_at_zero segment 0 19 forgotten segment 100 199 forgotten\n";

}  // namespace cnctrans::test
