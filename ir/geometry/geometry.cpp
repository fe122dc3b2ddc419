#include "ir/geometry/geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/text.h"

namespace cnctrans::ir::geometry {

namespace {
constexpr double degrees = 180 / std::numbers::pi;
std::string mm(double x) {
  return rounded(x, 4) + " mm";
}
}  // namespace

double dot(Vec a, Vec b) {
  return a.u * b.u + a.v * b.v;
}
double cross(Vec a, Vec b) {
  return a.u * b.v - a.v * b.u;
}
double length(Vec a) {
  return std::hypot(a.u, a.v);
}
Vec left_of(Vec a) {
  return {-a.v, a.u};
}
Vec normalised(Vec a) {
  const double l = length(a);
  return l == 0 ? Vec{} : (1 / l) * a;
}
Vec turned(Vec a, Vec about, double angle) {
  const double c = std::cos(angle / degrees), s = std::sin(angle / degrees);
  const Vec d = a - about;
  return about + Vec{c * d.u - s * d.v, s * d.u + c * d.v};
}

bool centre_by_radius(Vec p0, Vec p1, double radius, bool ccw, double tolerance, Vec& centre, std::string& error) {
  const Vec chord = p1 - p0;
  const double d = length(chord);
  const double r = std::abs(radius);
  if (r < same_point) {
    error = "the radius of the arc is zero";
    return false;
  }
  if (d < same_point) {
    error = "an arc by its radius cannot end where it starts";
    return false;
  }
  if (d > 2 * r + tolerance) {
    error = "the end of the arc is " + mm(d) + " away, more than twice the radius of " + mm(r);
    return false;
  }
  const double h = std::sqrt(std::max(0.0, r * r - d * d / 4));
  const double side = (radius > 0) == ccw ? 1 : -1;
  centre = 0.5 * (p0 + p1) + (side * h / d) * left_of(chord);
  return true;
}

std::optional<Vec> centre_by_radius(Vec p0, Vec p1, double radius, bool ccw, double tolerance) {
  Vec centre;
  std::string error;
  return centre_by_radius(p0, p1, radius, ccw, tolerance, centre, error) ? std::optional(centre) : std::nullopt;
}

bool centre_by_three_points(Vec p0, Vec middle, Vec p1, Vec& centre, bool& ccw) {
  const Vec a = middle - p0, b = p1 - p0;
  const double area = 2 * cross(a, b);
  if (std::abs(area) < 1e-9 * std::max(1.0, length(a) * length(b))) return false;
  const double aa = dot(a, a), bb = dot(b, b);
  centre = p0 + Vec{(b.v * aa - a.v * bb) / area, (a.u * bb - b.u * aa) / area};
  ccw = area > 0;
  return true;
}

bool centre_by_tangent(Vec p0, Vec tangent, Vec p1, Vec& centre, bool& ccw) {
  const Vec t = normalised(tangent), w = p1 - p0, n = left_of(t);
  const double k = dot(w, n);
  if (length(w) < same_point || std::abs(k) < 1e-9 * length(w)) return false;
  const double rho = dot(w, w) / (2 * k);
  centre = p0 + rho * n;
  ccw = rho > 0;
  return true;
}

double swept_angle(Vec p0, Vec p1, Vec centre, bool ccw) {
  if (length(p1 - p0) < same_point) return 360;
  const Vec a = p0 - centre, b = p1 - centre;
  double angle = std::atan2(cross(a, b), dot(a, b)) * degrees;
  if (!ccw) angle = -angle;
  return angle <= 0 ? angle + 360 : angle;
}

double apart(const PlaneArc& a, const PlaneArc& b, bool ccw) {
  const auto at = [ccw](const PlaneArc& arc, double part) {
    const double angle = part * swept_angle(arc.from, arc.to, arc.centre, ccw);
    return turned(arc.from, arc.centre, ccw ? angle : -angle);
  };
  double most = 0;
  constexpr int parts = 8;
  for (int i = 0; i <= parts; ++i) {
    const double part = static_cast<double>(i) / parts;
    most = std::max(most, length(at(a, part) - at(b, part)));
  }
  return most;
}

Vec Element::start_direction() const {
  if (!arc) return normalised(b - a);
  const Vec n = left_of(normalised(a - c));
  return ccw ? n : -1.0 * n;
}

Vec Element::end_direction() const {
  if (!arc) return normalised(b - a);
  const Vec n = left_of(normalised(b - c));
  return ccw ? n : -1.0 * n;
}

double Element::part_at(Vec p) const {
  if (!arc) return dot(p - a, b - a) / dot(b - a, b - a);
  if (length(p - a) < same_point) return 0;
  return swept_angle(a, p, c, ccw) / swept_angle(a, b, c, ccw);
}

namespace {

/// A line or circle beside an element, on which the centres of touching circles lie.
struct Offset {
  bool circle = false;
  Vec point, direction;  ///< line
  Vec centre;
  double radius = 0;
};

/// `side` +1: to the left. Radius below zero: there is none.
Offset offset_of(const Element& e, double side, double distance, Vec corner_direction) {
  Offset o;
  if (!e.arc) {
    o.point = e.a + (side * distance) * left_of(corner_direction);
    o.direction = corner_direction;
    return o;
  }
  o.circle = true;
  o.centre = e.c;
  const bool inward = (side > 0) == e.ccw;
  o.radius = length(e.a - e.c) + (inward ? -distance : distance);
  return o;
}

using Points = std::array<Vec, 2>;

int line_circle(const Offset& l, const Offset& c, Points& out) {
  const Vec f = l.point - c.centre;
  const double b = dot(f, l.direction), q = b * b - dot(f, f) + c.radius * c.radius;
  if (q < -1e-12) return 0;
  const double root = std::sqrt(std::max(0.0, q));
  out = {l.point + (-b - root) * l.direction, l.point + (-b + root) * l.direction};
  return 2;
}

int circle_circle(const Offset& a, const Offset& b, Points& out) {
  const Vec w = b.centre - a.centre;
  const double d = length(w);
  if (d < same_point) return 0;
  const double x = (d * d + a.radius * a.radius - b.radius * b.radius) / (2 * d);
  const double q = a.radius * a.radius - x * x;
  if (q < -1e-12) return 0;
  const double y = std::sqrt(std::max(0.0, q));
  const Vec e = normalised(w);
  out = {a.centre + x * e + y * left_of(e), a.centre + x * e - y * left_of(e)};
  return 2;
}

int intersections(const Offset& a, const Offset& b, Points& out) {
  if (a.circle && a.radius < 0) return 0;
  if (b.circle && b.radius < 0) return 0;
  if (a.circle && b.circle) return circle_circle(a, b, out);
  if (a.circle) return line_circle(b, a, out);
  if (b.circle) return line_circle(a, b, out);
  const double k = cross(a.direction, b.direction);
  if (std::abs(k) < 1e-12) return 0;
  out[0] = a.point + (cross(b.point - a.point, b.direction) / k) * a.direction;
  return 1;
}

Vec touching_point(const Element& e, Vec centre, Vec direction) {
  if (!e.arc) return e.a + dot(centre - e.a, direction) * direction;
  const double r = length(e.a - e.c);
  Vec away = normalised(centre - e.c);
  return e.c + r * away;
}

bool on_element(double part) {
  return part > -1e-9 && part < 1 + 1e-9;
}

}  // namespace

double interior_angle(const Element& a, const Element& b) {
  const Vec t = a.end_direction(), s = b.start_direction();
  return 180 - std::abs(std::atan2(cross(t, s), dot(t, s))) * degrees;
}

namespace {

/// The circle on one side of both elements that touches them nearest to their corner. False: there is none.
bool fillet_on(double side, const Element& a, const Element& b, double radius, Fillet& out) {
  const Vec t = a.end_direction(), s = b.start_direction();
  Points points{};
  const int n = intersections(offset_of(a, side, radius, t), offset_of(b, side, radius, s), points);
  double nearest = -1;
  for (int i = 0; i < n; ++i) {
    const Vec c = points[static_cast<std::size_t>(i)];
    const Vec from = touching_point(a, c, t), to = touching_point(b, c, s);
    if (!on_element(a.part_at(from)) || !on_element(b.part_at(to))) continue;
    const double distance = length(c - a.b);
    if (nearest >= 0 && distance >= nearest) continue;
    nearest = distance;
    out.from = from;
    out.to = to;
    out.centre = c;
  }
  if (nearest >= 0) out.ccw = side > 0;
  return nearest >= 0;
}

}  // namespace

bool fillet(const Element& a, const Element& b, double radius, Fillet& out, std::string& error) {
  const Vec t = a.end_direction(), s = b.start_direction();
  const double turn = std::atan2(cross(t, s), dot(t, s)) * degrees;
  out.none = std::abs(turn) < 1e-4;
  if (out.none) return true;
  if (std::abs(turn) >
      180 - 1e-4) {  // two arcs that touch from outside: their bends say on which side the path goes on
    if (fillet_on(1, a, b, radius, out) != fillet_on(-1, a, b, radius, out)) return true;
    error = "the path turns back on itself";
    return false;
  }
  if (fillet_on(turn > 0 ? 1 : -1, a, b, radius, out)) return true;
  error = "a radius of " + mm(radius) + " does not fit between the two elements";
  return false;
}

namespace {
/// The point `way` along the element from its start, or before its end.
Vec point_along(const Element& e, double way, bool from_end) {
  const Vec p = from_end ? e.b : e.a;
  if (!e.arc) return from_end ? p - way * e.end_direction() : p + way * e.start_direction();
  const double radius = length(p - e.c);
  if (radius < same_point) return p;
  return turned(p, e.c, (e.ccw == from_end ? -1 : 1) * way / radius * degrees);
}
double way_of(const Element& e) {
  if (!e.arc) return length(e.b - e.a);
  return swept_angle(e.a, e.b, e.c, e.ccw) / degrees * length(e.a - e.c);
}
}  // namespace

bool chamfer_along(const Element& a, const Element& b, double leg, Fillet& out, std::string& error) {
  out.none = interior_angle(a, b) > 180 - 1e-4;
  if (out.none) return true;
  out.from = point_along(a, leg, true);
  out.to = point_along(b, leg, false);
  if (leg < way_of(a) + same_point && leg < way_of(b) + same_point) return true;
  error = "a chamfer of " + mm(leg) + " is longer than one of the two elements";
  return false;
}

bool chamfer(const Element& a, const Element& b, double leg, Fillet& out, std::string& error) {
  if (a.arc || b.arc) {
    error = "a chamfer needs two straight lines";
    return false;
  }
  out.none = interior_angle(a, b) > 180 - 1e-4;
  if (out.none) return true;
  out.from = a.b - leg * a.end_direction();
  out.to = b.a + leg * b.start_direction();
  if (on_element(a.part_at(out.from)) && on_element(b.part_at(out.to))) return true;
  error = "a chamfer of " + mm(leg) + " is longer than one of the two elements";
  return false;
}

namespace {

/// Circle of `radius` touching direction `t` at `p` on the side of `s`; point on it where the line from `s` touches so
/// that the arc from there leads to `p` in direction `t`.
bool touch(Vec s, Vec p, Vec t, double radius, Fillet& out, std::string& error) {
  const Vec n = left_of(t);
  const double side = dot(s - p, n) >= 0 ? 1 : -1;
  out.centre = p + (side * radius) * n;
  const Vec to_centre = out.centre - s;
  const double d = length(to_centre);
  if (d <= radius + same_point) {
    error = "the start of the move lies inside the circle of " + mm(radius) + " that should lead it in";
    return false;
  }
  const double beta = std::asin(radius / d);
  const double angle = std::atan2(to_centre.v, to_centre.u) - side * beta;
  const double l = std::sqrt(d * d - radius * radius);
  out.from = s + l * Vec{std::cos(angle), std::sin(angle)};
  out.to = p;
  out.ccw = side > 0;
  out.none = length(out.from - p) <= same_point;  // straight on: the circle is touched where it is left
  return true;
}

}  // namespace

bool tangential_entry(const Element& a, const Element& b, double radius, Fillet& out, std::string& error) {
  if (a.arc) {
    error = "a tangential entry needs a straight move";
    return false;
  }
  return touch(a.a, a.b, b.start_direction(), radius, out, error);
}

bool tangential_exit(const Element& a, const Element& b, double radius, Fillet& out, std::string& error) {
  if (b.arc) {
    error = "a tangential exit needs a straight move after it";
    return false;
  }
  Fillet back;
  if (!touch(b.b, a.b, -1.0 * a.end_direction(), radius, back, error)) return false;
  if (back.none) {
    error = "the move after a tangential exit is the straight extension of the contour";
    return false;
  }
  out.from = back.to;
  out.to = back.from;
  out.centre = back.centre;
  out.ccw = !back.ccw;
  return true;
}

}  // namespace cnctrans::ir::geometry
