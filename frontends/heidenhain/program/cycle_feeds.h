// The feed of a hole cycle (Q206) counts in the cycle alone. Other controls have one F for everything: where the feed
// in force is known, the cycle gets its own as F before it, and the one before comes back where it is needed next.
#pragma once

#include "ir/modal.h"
#include "ir/program.h"

namespace cnctrans::frontends::heidenhain {

/// Numbers the statements. `alone`: no program calls this one. True: if one did, it would find the F of a cycle in
/// force.
bool feeds_before_cycles(ir::Program& program, const ir::ModalState& power_on, bool alone);

}  // namespace cnctrans::frontends::heidenhain
