// Motion codes where the text has another one than the function in force, at the borders of routines.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// The motion function that a called routine, or its caller behind it, goes by is said where the text has another.
void say_motion_codes(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
