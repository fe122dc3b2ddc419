// Motion codes where the text has another one than the function in force, at the borders of routines.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// The motion function that a called routine, or its caller behind it, goes by is said where the text has another.
void say_motion_codes(Program& program, const LegaliseContext& context);
/// Moves without a code whose motion function differs between the ways that lead to them are written once for the way
/// from above and once for the jumps, for a target that says it in every block.
void separate_first_moves(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
