// Programs that are named by a number.
#pragma once

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::ir::passes {

/// A called program whose name is all digits becomes the subprogram of that number, or of a free one where another
/// subprogram has it; its calls follow. `all_calls`: so do calls of programs that are not at hand.
void number_programs(Program& program, Diagnostics& diagnostics, bool all_calls);

}  // namespace cnctrans::ir::passes
