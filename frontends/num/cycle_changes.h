// Changes of the words of an active cycle: were they joined with the right one?
#pragma once

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::frontends::num {

/// NUM-048 at each change whose cycle is not the one above in the text on every way (numbers the statements).
void judge_cycle_changes(ir::Program& program, const ir::ModalState& power_on, Diagnostics& diagnostics);

}  // namespace cnctrans::frontends::num
