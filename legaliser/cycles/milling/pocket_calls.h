// Pockets whose operations stand in blocks of their own: the call becomes these blocks.
#pragma once

#include "ir/modal.h"
#include "ir/program.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// In the place of each call its operations, one after the other, and what the call leaves in force; the blocks that
/// nothing but calls leads to become remarks. A call whose blocks can't be found stays, for the cycle pass to refuse.
/// Gives the statements new ids.
void write_out_pocket_calls(Program& program, const ModalState& power_on);

/// What is left of pockets before the cycles are written: drillings get the places where the roughing goes in, calls
/// and operations by themselves are refused.
void settle_pockets(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
