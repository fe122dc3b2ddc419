// Motion functions and depths under a drilling cycle: what the control refuses (reference 11.1, 26.6).
#pragma once

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::frontends::num {

/// NUM-026 at each block with a motion function, or a word of the cycle's axis, to which every way brings an active
/// cycle (numbers the statements).
void judge_cycle_moves(ir::Program& program, const ir::ModalState& power_on, Diagnostics& diagnostics);

}  // namespace cnctrans::frontends::num
