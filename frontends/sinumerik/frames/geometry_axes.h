// GEOAX: the axis that a geometry axis stands for.
#pragma once

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::frontends::sinumerik {

/// The words of an exchanged geometry axis become those of the axis that moves. What is not settled under an exchange
/// (arcs, cycles, turned frames, data of the axis) is kept as text.
void resolve_geometry_axes(ir::Program& program, Diagnostics& diagnostics);

}  // namespace cnctrans::frontends::sinumerik
