#include "ir/passes/arc_geometry.h"

#include <cmath>
#include <numbers>

namespace cnctrans::ir::passes {

namespace {
constexpr double degrees = 180.0 / std::numbers::pi;
}

std::optional<Point> center_by_radius(Point from, Point to, double r, bool ccw) {
  const double du = to.u - from.u, dv = to.v - from.v;
  const double d = std::hypot(du, dv);
  if (d == 0) return std::nullopt;
  const double h2 = r * r - d * d / 4;
  if (h2 < -0.01 * d) return std::nullopt;
  const double h = h2 > 0 ? std::sqrt(h2) : 0;
  const double side = ccw == (r > 0) ? 1 : -1;  // left of the chord for the short arc counter-clockwise
  return Point{(from.u + to.u) / 2 - side * h * dv / d, (from.v + to.v) / 2 + side * h * du / d};
}

double swept(Point from, Point to, Point center, bool ccw) {
  if (std::hypot(to.u - from.u, to.v - from.v) < 1e-9) return 360;
  const double a0 = std::atan2(from.v - center.v, from.u - center.u) * degrees;
  const double a1 = std::atan2(to.v - center.v, to.u - center.u) * degrees;
  double sweep = ccw ? a1 - a0 : a0 - a1;
  while (sweep <= 1e-9) sweep += 360;
  while (sweep > 360 + 1e-9) sweep -= 360;
  return sweep;
}

std::optional<Point> circumcentre(Point a, Point b, Point c) {
  const double bu = b.u - a.u, bv = b.v - a.v, cu = c.u - a.u, cv = c.v - a.v;
  const double d = 2 * (bu * cv - bv * cu);
  if (std::fabs(d) < 1e-9) return std::nullopt;
  const double b2 = bu * bu + bv * bv, c2 = cu * cu + cv * cv;
  return Point{a.u + (cv * b2 - bv * c2) / d, a.v + (bu * c2 - cu * b2) / d};
}

bool turns_left(Point a, Point b, Point c) {
  return (b.u - a.u) * (c.v - b.v) - (b.v - a.v) * (c.u - b.u) > 0;
}

Point rotated(Point p, Point about, double angle) {
  const double c = std::cos(angle / degrees), s = std::sin(angle / degrees);
  const double u = p.u - about.u, v = p.v - about.v;
  return {about.u + c * u - s * v, about.v + s * u + c * v};
}

}  // namespace cnctrans::ir::passes
