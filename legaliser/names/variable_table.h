// The table of variables at the head of a translation.
#pragma once

#include <string>
#include <vector>

#include "ir/program.h"

namespace cnctrans::ir::passes {

/// Comments with the entries ("R5=P105"), and assignments of 0 to `zero_first`, before the first block of the main
/// program.
void put_variable_table(Program& program, const std::vector<std::string>& entries,
                        const std::vector<VarRef>& zero_first);

}  // namespace cnctrans::ir::passes
