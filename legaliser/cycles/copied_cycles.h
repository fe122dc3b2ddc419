// Cycles that are copied for another machine with the same control.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Refuses those whose moves follow from options that the two machine profiles set differently.
void refuse_other_moves(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
