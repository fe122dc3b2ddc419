// Blocks with several skip levels for a target that takes one a block.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// `/1/2 X5` is left out when one of its switches is on: jumps under a level each stand before it.
void split_skip_levels(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
