// The spindle that cycles turn where they are written out as moves.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Cycles turn the spindle that is chosen (MasterSpindle), and their moves are made for spindle 1: they get its number.
/// Where the program does not tell which one is chosen it is refused (TRN-330).
void name_cycle_spindles(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
