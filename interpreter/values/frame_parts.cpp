#include "interpreter/values/frame_parts.h"

#include <cmath>

#include "ir/geometry/frame_angles.h"

namespace cnctrans::interpreter {

namespace {

using Vector = std::array<double, 3>;

Vector column(const Frame& f, std::size_t j) {
  return {f.m[0][j], f.m[1][j], f.m[2][j]};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector unit(Vector a) {
  const double n = std::sqrt(dot(a, a));
  for (auto& x : a) x = n > 0 ? x / n : 0;
  return a;
}
/// Turn of the axis `about`.
Frame about_axis(ir::AxisId about, double degrees) {
  return rotation(static_cast<ir::AxisId>((about + 1) % 3), static_cast<ir::AxisId>((about + 2) % 3), degrees);
}

}  // namespace

Frame turn_frame(double about_x, double about_y, double about_z) {
  Frame f = about_axis(ir::axis::z, about_z);
  f = compose(f, about_axis(ir::axis::y, about_y));
  return compose(f, about_axis(ir::axis::x, about_x));
}

FrameParts parts_of(const Frame& f) {
  FrameParts p;
  p.shift = f.t;
  for (std::size_t i = 3; i < f.d.size(); ++i) {
    p.scale[i] = std::abs(f.d[i]);
    p.mirrored[i] = f.d[i] < 0;
  }
  std::array<Vector, 3> c{column(f, 0), column(f, 1), column(f, 2)};
  for (std::size_t j = 0; j < 3; ++j) {
    const double s = std::sqrt(dot(c[j], c[j]));
    p.scale[j] = std::abs(s - 1) < 1e-14 ? 1 : s;
    c[j] = unit(c[j]);
  }
  if (dot(cross(c[0], c[1]), c[2]) < 0) {
    std::size_t axis = 0;
    for (std::size_t j = 1; j < 3; ++j) {
      if (c[j][j] < c[axis][axis]) axis = j;
    }
    p.mirrored[axis] = true;
    for (auto& x : c[axis]) x = -x;
  }
  p.turn = ir::turns_of(c[0], c[1], c[2]);
  return p;
}

Frame frame_of(const FrameParts& p) {
  Frame f = turn_frame(p.turn[0], p.turn[1], p.turn[2]);
  for (std::size_t j = 0; j < 3; ++j) {
    const double s = p.mirrored[j] ? -p.scale[j] : p.scale[j];
    for (std::size_t i = 0; i < 3; ++i) f.m[i][j] *= s;
  }
  for (std::size_t i = 3; i < f.d.size(); ++i) f.d[i] = p.mirrored[i] ? -p.scale[i] : p.scale[i];
  f.t = p.shift;
  return f;
}

double part_of(const Frame& f, ir::AxisId axis, ir::FramePart part) {
  const FrameParts p = parts_of(f);
  switch (part) {
    case ir::FramePart::shift: return p.shift[axis];
    case ir::FramePart::fine: return 0;
    case ir::FramePart::turn: return axis < 3 ? p.turn[axis] : 0;
    case ir::FramePart::scale: return p.scale[axis];
    case ir::FramePart::mirror: return p.mirrored[axis] ? 1 : 0;
  }
  return 0;
}

Frame with_part(const Frame& f, ir::AxisId axis, ir::FramePart part, double value) {
  Frame out = f;
  if (part == ir::FramePart::shift) {
    out.t[axis] = value;
    return out;
  }
  if (part == ir::FramePart::fine) {
    out.t[axis] += value;
    return out;
  }
  FrameParts p = parts_of(f);
  if (part == ir::FramePart::turn && axis < 3) p.turn[axis] = value;
  if (part == ir::FramePart::scale) p.scale[axis] = value;
  if (part == ir::FramePart::mirror) p.mirrored[axis] = value != 0;
  return frame_of(p);
}

Frame solid_turn(ir::AxisId a, double angle_a, ir::AxisId b, double angle_b) {
  const auto turn = ir::solid_angles(a, angle_a, b, angle_b);
  return turn_frame(turn[0], turn[1], turn[2]);
}

}  // namespace cnctrans::interpreter
