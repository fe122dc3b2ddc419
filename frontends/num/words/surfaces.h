// Work with the C axis (G20, G21, G22): was it read with the function in force?
#pragma once

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::frontends::num {

/// NUM-050 at each block with X or Y that is reached under another of these functions than the text says, and at an arc
/// or radius compensation outside of the plane of the face (G17) or the cylinder (G19).
void judge_surfaces(ir::Program& program, const ir::ModalState& power_on, Diagnostics& diagnostics);

}  // namespace cnctrans::frontends::num
