// X on the face of a turning part (TRANSMIT).
#pragma once

#include "base/diagnostics.h"
#include "ir/program.h"
#include "machine/profile.h"

namespace cnctrans::frontends::sinumerik {

/// Under TRANSMIT X is a radius whatever DIAMON says (motion reference 9.2): words and shifts of X that are not a
/// radius or a diameter by themselves become radii. SIN-041 as an error where the path decides whether TRANSMIT holds.
void face_radius(ir::Program& program, const machine::Profile& profile, Diagnostics& diagnostics);

}  // namespace cnctrans::frontends::sinumerik
