// Which lines of a program a run has carried out: a verification proves those and no others.
#pragma once

#include <string>
#include <vector>

#include "ir/program.h"
#include "verifier/compare.h"

namespace cnctrans::translator {

/// Lines that hold a block, an assignment, a jump, a call or a message, and how many of them `covered` (by
/// Statement::id, from interpreter::Result) knows. Marks, declarations and program ends do not count. `also`: inputs of
/// a second replay.
verifier::Coverage coverage_of(const ir::Program& program, const std::vector<bool>& covered, std::string also = {});

/// What the comparison of a run with these lines and this trace leaves aside (docs/verify.md).
verifier::LeftOut left_out_of(const ir::Program& program, const std::vector<bool>& covered,
                              const std::vector<interpreter::Event>& trace);

}  // namespace cnctrans::translator
