// Jumps into structured statements, which the control refuses (reference 13.1, 13.9).
#pragma once

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::frontends::num {

/// NUM-056 at each G79 with a fixed target inside of an IF, WHILE, REPEAT or FOR that the jump stands outside of.
void judge_jumps(const ir::Program& program, Diagnostics& diagnostics);

}  // namespace cnctrans::frontends::num
