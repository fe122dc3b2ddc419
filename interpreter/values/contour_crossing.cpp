#include "interpreter/values/contour_crossing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/trace/run_codes.h"

namespace cnctrans::interpreter {

namespace {

constexpr double near = 1e-6;  // mm

struct Point {
  double u = 0, v = 0;
};
Point operator-(Point a, Point b) {
  return {a.u - b.u, a.v - b.v};
}
double length(Point d) {
  return std::hypot(d.u, d.v);
}
double cross(Point a, Point b) {
  return a.u * b.v - a.v * b.u;
}
double dot(Point a, Point b) {
  return a.u * b.u + a.v * b.v;
}

struct CrossedElement {
  Point start, end, centre;
  bool arc = false, clockwise = false;
  double radius = 0;

  explicit CrossedElement(std::span<const double, element_values> v)
      : start{v[1], v[2]}, end{v[3], v[4]}, centre{v[5], v[6]} {
    constexpr double tens = 10;
    const double code = std::fmod(std::abs(std::round(v[0])), tens);
    arc = code == 2 || code == 3;
    clockwise = code == 2;
    radius = arc ? length(start - centre) : 0;
  }
  [[nodiscard]] bool empty() const { return arc ? radius < near : length(end - start) < near; }
  /// `p` lies on the whole line or circle already: is it between the ends?
  [[nodiscard]] bool holds(Point p) const {
    if (length(p - start) < near || length(p - end) < near) return true;
    if (!arc) return dot(p - start, end - start) > 0 && dot(p - end, start - end) > 0;
    const auto angle = [&](Point q) { return std::atan2(q.v - centre.v, q.u - centre.u); };
    const auto way = [&](Point q) {
      double a = clockwise ? angle(start) - angle(q) : angle(q) - angle(start);
      while (a < 0) a += 2 * std::numbers::pi;
      return a;
    };
    const double all = length(end - start) < near ? 2 * std::numbers::pi : way(end);
    return way(p) <= all;
  }
};

using Points = std::vector<Point>;

Points line_line(const CrossedElement& a, const CrossedElement& b) {
  const Point p = a.end - a.start, q = b.end - b.start;
  const double turn = cross(p, q);
  if (std::abs(turn) > near * length(p) * length(q)) {
    const double t = cross(b.start - a.start, q) / turn;
    return {Point{a.start.u + t * p.u, a.start.v + t * p.v}};
  }
  if (std::abs(cross(b.start - a.start, p)) > near * length(p)) return {};  // side by side
  return {a.start, a.end, b.start, b.end};
}

Points line_circle(const CrossedElement& line, const CrossedElement& circle) {
  const Point d = line.end - line.start;
  const double l = length(d);
  const double along = dot(circle.centre - line.start, d) / l;
  const double apart = std::abs(cross(circle.centre - line.start, d)) / l;
  if (apart > circle.radius + near) return {};
  const double half =
      apart >= circle.radius - near * near ? 0 : std::sqrt(circle.radius * circle.radius - apart * apart);
  const auto at = [&](double s) { return Point{line.start.u + s * d.u / l, line.start.v + s * d.v / l}; };
  if (half < near) return {at(along)};
  return {at(along - half), at(along + half)};
}

Points circle_circle(const CrossedElement& a, const CrossedElement& b) {
  const Point d = b.centre - a.centre;
  const double l = length(d);
  if (l < near) {
    if (std::abs(a.radius - b.radius) > near) return {};
    return {a.start, a.end, b.start, b.end};
  }
  if (l > a.radius + b.radius + near || l < std::abs(a.radius - b.radius) - near) return {};
  const double along = (l * l + a.radius * a.radius - b.radius * b.radius) / (2 * l);
  const double square = a.radius * a.radius - along * along;
  const double half = square > near * near ? std::sqrt(square) : 0;
  const auto at = [&](double side) {
    return Point{a.centre.u + (along * d.u - side * d.v) / l, a.centre.v + (along * d.v + side * d.u) / l};
  };
  if (half == 0) return {at(0)};
  return {at(-half), at(half)};
}

}  // namespace

std::vector<std::pair<double, double>> crossings(std::span<const double, element_values> a,
                                                 std::span<const double, element_values> b) {
  const CrossedElement first(a), second(b);
  std::vector<std::pair<double, double>> out;
  if (first.empty() || second.empty()) return out;
  const Points found = !first.arc && !second.arc ? line_line(first, second)
                       : first.arc && second.arc ? circle_circle(first, second)
                       : first.arc               ? line_circle(second, first)
                                                 : line_circle(first, second);
  for (const Point p : found) {
    const bool known = std::any_of(out.begin(), out.end(), [&](const auto& q) {
      return length(p - Point{q.first, q.second}) < near;
    });
    if (!known && first.holds(p) && second.holds(p)) out.emplace_back(p.u, p.v);
  }
  return out;
}

bool crossing(std::span<const double> args, Failure& failure, double& out) {
  const auto found = crossings(args.subspan<2, element_values>(), args.subspan<2 + element_values, element_values>());
  if (found.size() > 1)
    return failure.fail(code::not_carried, "two elements of contours that have more than one point in common");
  if (args[1] == 0)
    out = found.empty() ? 0 : 1;
  else
    out = found.empty() ? args.back() : args[1] == 1 ? found.front().first : found.front().second;
  return true;
}

}  // namespace cnctrans::interpreter
