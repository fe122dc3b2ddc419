#include "ir/geometry/frame_angles.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace cnctrans::ir {

namespace {

using Vector = std::array<double, 3>;

constexpr double degree = std::numbers::pi / 180;

double degrees_of(double y, double x) {
  return std::abs(y) < 1e-15 && x > 0 ? 0 : std::atan2(y, x) / degree;
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector unit(Vector a) {
  const double n = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  for (auto& x : a) x = n > 0 ? x / n : 0;
  return a;
}
/// The unit vector of axis `of`, turned about axis `about`.
Vector turned(AxisId of, AxisId about, double angle) {
  Vector v{};
  const bool next = (about + 1) % 3 == of;  // turns toward the axis behind it
  const auto other = static_cast<std::size_t>(3 - of - about);
  v[of] = std::cos(angle * degree);
  v[other] = (next ? 1 : -1) * std::sin(angle * degree);
  return v;
}

}  // namespace

Turns turns_of(const Vector& x, const Vector& y, const Vector& z) {
  const double sine = -x[2];
  if (std::abs(sine) < 1 - 1e-12)
    return {degrees_of(y[2], z[2]), degrees_of(sine, std::hypot(x[0], x[1])), degrees_of(x[1], x[0])};
  return {0, sine > 0 ? 90.0 : -90.0, degrees_of(-y[0], y[1])};
}

Turns solid_angles(AxisId a, double angle_a, AxisId b, double angle_b) {
  if ((a + 1) % 3 != b) {
    std::swap(a, b);
    std::swap(angle_a, angle_b);
  }
  const auto third = static_cast<AxisId>((b + 1) % 3);
  const Vector first = turned(a, b, angle_b);
  const Vector normal = unit(cross(first, turned(b, a, angle_a)));
  std::array<Vector, 3> column;
  column[a] = first;
  column[third] = normal;
  column[b] = cross(normal, first);
  return turns_of(column[0], column[1], column[2]);
}

}  // namespace cnctrans::ir
