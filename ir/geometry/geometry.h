// Plane geometry of arcs and corners, for the interpreter and the passes. Coordinates (u, v) of the plane in mm; angles
// turn from u toward v.
#pragma once

#include <optional>
#include <string>

namespace cnctrans::ir::geometry {

struct Vec {
  double u = 0, v = 0;
  friend Vec operator+(Vec a, Vec b) { return {a.u + b.u, a.v + b.v}; }
  friend Vec operator-(Vec a, Vec b) { return {a.u - b.u, a.v - b.v}; }
  friend Vec operator*(double k, Vec a) { return {k * a.u, k * a.v}; }
};
double dot(Vec a, Vec b);
double cross(Vec a, Vec b);
double length(Vec a);
Vec left_of(Vec a);     ///< turned by +90 degrees
Vec normalised(Vec a);  ///< zero stays zero
Vec turned(Vec a, Vec about, double degrees);

/// Points closer than this are one point.
inline constexpr double same_point = 1e-6;

/// Centre of the arc through two points with `radius` (negative: the arc over 180 degrees). A chord that is longer than
/// the diameter by at most `tolerance` gives the half circle. False and a text otherwise.
bool centre_by_radius(Vec p0, Vec p1, double radius, bool ccw, double tolerance, Vec& centre, std::string& error);
/// The same for callers that have a text of their own.
std::optional<Vec> centre_by_radius(Vec p0, Vec p1, double radius, bool ccw, double tolerance);
/// Through p0, `middle`, p1. False when they lie on a line.
bool centre_by_three_points(Vec p0, Vec middle, Vec p1, Vec& centre, bool& ccw);
/// Leaves p0 in direction `tangent` and ends in p1. False when that is a straight line.
bool centre_by_tangent(Vec p0, Vec tangent, Vec p1, Vec& centre, bool& ccw);
/// Angle in degrees that the arc from p0 to p1 turns through: (0, 360]; 360 when the points are the same.
double swept_angle(Vec p0, Vec p1, Vec centre, bool ccw);

/// An arc of less than a turn, from `from` about `centre` to the direction of `to`.
struct PlaneArc {
  Vec from, to, centre;
};
/// The greatest distance between two arcs of one sense, each looked at after equal parts of its way. A short arc of a
/// large radius hardly moves where its centre does: 15 um of 14 mm leave an arc of 2 degrees where it was.
double apart(const PlaneArc& a, const PlaneArc& b, bool ccw);

/// A path element in the plane.
struct Element {
  bool arc = false;
  Vec a, b;  ///< start, end
  Vec c;     ///< centre
  bool ccw = false;

  [[nodiscard]] Vec start_direction() const;
  [[nodiscard]] Vec end_direction() const;
  /// Part of the element (0..1) at a point on it.
  [[nodiscard]] double part_at(Vec p) const;
};

/// Circle of `radius` that touches both elements near their common point. False and a text when it does not fit.
struct Fillet {
  Vec from, to, centre;
  bool ccw = false;
  bool none = false;  ///< the elements meet without a corner
};
bool fillet(const Element& a, const Element& b, double radius, Fillet& out, std::string& error);
/// Cuts both lines back by `leg`.
bool chamfer(const Element& a, const Element& b, double leg, Fillet& out, std::string& error);
/// As chamfer(), also at arcs: `leg` is cut off each element along the element, and the points are joined by a line.
bool chamfer_along(const Element& a, const Element& b, double leg, Fillet& out, std::string& error);
/// Angle between the elements inside the corner, degrees (180: no corner).
double interior_angle(const Element& a, const Element& b);
/// The straight line a is led into a circle of `radius` that touches b at its start: line a.a -> out.from, arc out.from
/// -> out.to
/// (= b.a).
bool tangential_entry(const Element& a, const Element& b, double radius, Fillet& out, std::string& error);
/// The other way round in time: arc out.from (= a.b) -> out.to, line out.to -> b.b.
bool tangential_exit(const Element& a, const Element& b, double radius, Fillet& out, std::string& error);

}  // namespace cnctrans::ir::geometry
