// Profiles that cycles name by blocks, read before a translation takes the program apart.
#pragma once

#include "ir/program.h"
#include "machine/profile.h"

namespace cnctrans::translator {

/// Puts the contour of every cycle with a profile into its words, or why it can't be read.
void read_contours(ir::Program& program, const machine::Profile& source_machine);

}  // namespace cnctrans::translator
