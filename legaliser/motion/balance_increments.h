#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Increments with more decimals than the target writes: in a row of blocks each takes up what the rounding of those
/// before it has left.
void balance_rows(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
