// Plane geometry of arcs in millimetres (or inches) and degrees; u, v are abscissa and ordinate of the plane.
#pragma once

#include <optional>

namespace cnctrans::ir::passes {

struct Point {
  double u = 0, v = 0;
};

/// Centre of the arc of radius |r| from `from` to `to`; r < 0: the arc over 180 degrees. nullopt: the points are too
/// far apart, or the same.
std::optional<Point> center_by_radius(Point from, Point to, double r, bool ccw);
/// Angle swept from `from` to `to` about `center` in the arc's direction: (0, 360]; same points: 360.
double swept(Point from, Point to, Point center, bool ccw);
/// Centre of the circle through three points; nullopt: they are in line.
std::optional<Point> circumcentre(Point a, Point b, Point c);
/// True when a, b, c turn counter-clockwise.
bool turns_left(Point a, Point b, Point c);
Point rotated(Point p, Point about, double degrees);

}  // namespace cnctrans::ir::passes
