// Limits of the spindle's speed by two words, in programs that call each other.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Warns where one program limits the speed by another word than the programs before it (TRN-640).
void check_spindle_limits(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
