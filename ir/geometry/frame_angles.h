// Angles of frames: two solid angles as turns about the axes.
#pragma once

#include <array>

#include "ir/axis.h"

namespace cnctrans::ir {

/// Turns about X, Y, Z in degrees (carried out about Z, then the new Y, then the new X).
using Turns = std::array<double, 3>;

/// Turns of the rotation whose columns are `x`, `y`, `z`: X and Z -180..180, Y -90..90 degrees. Where Z and X turn
/// about the same line, all of it is given to Z.
Turns turns_of(const std::array<double, 3>& x, const std::array<double, 3>& y, const std::array<double, 3>& z);

/// The plane inclined by the solid angles `angle_a` about axis `a` and `angle_b` about axis `b` (two different ones of
/// X, Y, Z; degrees, below 90 either way): axis b turned about a and axis a turned about b span it; the first of the
/// two in the order X Y, Y Z, Z X stays in its old plane and is an axis of the new system.
Turns solid_angles(AxisId a, double angle_a, AxisId b, double angle_b);

}  // namespace cnctrans::ir
