// A frame taken apart into the components that a program can name, and put together again.
#pragma once

#include <array>

#include "interpreter/values/frame.h"
#include "ir/expr.h"

namespace cnctrans::interpreter {

/// p' = shift + R . S . M . p: mirror and scale first, then the turn, then the shift.
struct FrameParts {
  Axes shift{};
  std::array<double, 3> turn{};  ///< degrees about X, Y, Z: about Z first, then the new Y, then the new X
  Axes scale;                    ///< above 0
  std::array<bool, ir::axis::count_max> mirrored{};

  FrameParts() { scale.fill(1); }
};

/// X turns -180..180, Y -90..90, Z -180..180 degrees. An odd number of mirrors is taken as one, on the axis that leaves
/// the smallest turn.
FrameParts parts_of(const Frame& f);
Frame frame_of(const FrameParts& p);
/// One component; a fine shift is part of the shift and reads 0.
double part_of(const Frame& f, ir::AxisId axis, ir::FramePart part);
/// The frame with one component replaced; `fine` is added to the shift.
Frame with_part(const Frame& f, ir::AxisId axis, ir::FramePart part, double value);

/// Turns about Z, then the new Y, then the new X.
Frame turn_frame(double about_x, double about_y, double about_z);
/// Two solid angles: words about axes `a` and `b` (0..2); the plane is inclined so that it holds both turned axes.
Frame solid_turn(ir::AxisId a, double angle_a, ir::AxisId b, double angle_b);

}  // namespace cnctrans::interpreter
