// Shifts of a target that counts their words by the distance mode.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Where a shift is set and whether words are absolute is not known, absolute words are said before it, if on every way
/// behind it the program says its own mode before anything depends on it.
void say_shift_modes(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
