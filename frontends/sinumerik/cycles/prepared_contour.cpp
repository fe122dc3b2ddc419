#include "frontends/sinumerik/state/prepared_contour.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frontends/sinumerik/values/angles.h"

namespace cnctrans::sinumerik {

namespace {

constexpr double nearly = 1e-9;

struct Vector {
  double u = 0, v = 0;
};
Vector from_to(const ContourPoint& a, const ContourPoint& b) {
  return {*b.u.number - *a.u.number, *b.v.number - *a.v.number};
}
double length(const Vector& d) {
  return std::hypot(d.u, d.v);
}
double clean(double value) {  // what only rounding leaves
  constexpr double fine = 1e10;
  return std::round(value * fine) / fine;
}

/// Directions at the ends of an arc, degrees, the second one counted on from the first: up for G3, down for G2.
std::pair<double, double> directions(const ContourElement& e) {
  const double turn = e.code == 3 ? 90 : -90;
  const auto at = [&](const ContourPoint& p) {
    return clean(degrees * std::atan2(*p.v.number - e.centre_v, *p.u.number - e.centre_u)) + turn;
  };
  const double first = at(e.start);
  double last = at(e.end);
  if (e.code == 3) {
    while (last <= first + nearly) last += 360;
  } else {
    while (last >= first - nearly) last -= 360;
  }
  return {first, last};
}

/// -1, 0 or 1: which way a coordinate goes along the element; 2: it can't be told, or it turns back.
int way(const ContourElement& e, bool ordinate) {
  const ContourCoordinate& a = ordinate ? e.start.v : e.start.u;
  const ContourCoordinate& b = ordinate ? e.end.v : e.end.u;
  if (a.expr == b.expr && !e.arc()) return 0;
  if (!a.number || !b.number) return 2;
  if (e.arc()) {
    const auto [first, last] = directions(e);
    const double quarter = std::floor((std::min(first, last) + nearly) / 90);
    if (std::max(first, last) > (quarter + 1) * 90 + nearly) return 2;
  }
  const double d = *b.number - *a.number;
  return std::abs(d) < nearly ? 0 : d < 0 ? -1 : 1;
}

}  // namespace

ContourPoint contour_point(double u, double v) {
  ContourPoint out;
  out.u.number = clean(u);
  out.v.number = clean(v);
  out.u.expr = ir::number(*out.u.number);
  out.v.expr = ir::number(*out.v.number);
  return out;
}

bool cut_corners(std::vector<ContourElement>& elements) {
  using Corner = ContourElement::Corner;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (elements[i].corner == Corner::none) continue;
    if (i + 1 == elements.size()) return false;
    ContourElement& a = elements[i];
    ContourElement& b = elements[i + 1];
    if (a.arc() || b.arc() || !a.start.known() || !a.end.known() || !b.end.known()) return false;
    const Vector in = from_to(a.start, a.end), out = from_to(b.start, b.end);
    const double before = length(in), behind = length(out);
    const double cross = in.u * out.v - in.v * out.u;
    const double turn = std::atan2(cross, in.u * out.u + in.v * out.v);  // at the corner
    if (before < nearly || behind < nearly || std::abs(turn) < nearly) return false;
    const double half = std::abs(turn) / 2;
    const double cut = a.corner == Corner::round ? a.size * std::tan(half)
                       : a.corner == Corner::leg ? a.size
                                                 : a.size / 2 / std::cos(half);
    if (cut > before || cut > behind) return false;
    const double u = *a.end.u.number, v = *a.end.v.number;
    ContourElement corner;
    corner.start = contour_point(u - in.u / before * cut, v - in.v / before * cut);
    corner.end = contour_point(u + out.u / behind * cut, v + out.v / behind * cut);
    if (a.corner == Corner::round) {
      const double side = turn > 0 ? a.size : -a.size;
      corner.code = turn > 0 ? 3 : 2;
      corner.centre_u = clean(*corner.start.u.number - in.v / before * side);
      corner.centre_v = clean(*corner.start.v.number + in.u / before * side);
    }
    a.end = corner.start;
    b.start = corner.end;
    a.corner = Corner::none;
    elements.insert(elements.begin() + static_cast<std::ptrdiff_t>(i) + 1, corner);
    ++i;
  }
  return true;
}

bool is_one_flank(const std::vector<ContourElement>& elements, bool falls) {
  int along = 0;
  for (std::size_t i = 1; i < elements.size(); ++i) {
    const int u = way(elements[i], false), v = way(elements[i], true);
    if (u == 2 || v == 2 || (v != 0 && v != (falls ? -1 : 1))) return false;
    if (u != 0 && along != 0 && u != along) return false;
    if (u != 0) along = u;
  }
  return true;
}

ir::ExprPtr greatest_angle(const ContourElement& e) {
  const auto folded = [](double angle) { return angle - 180 * std::floor((angle + nearly) / 180); };
  if (e.arc()) {
    const auto [first, last] = directions(e);
    if (e.code == 3) {  // the angle grows; past 180 it begins at 0 again
      const double from = folded(first);
      return ir::number(clean(std::min(from + last - first, 180.0)));
    }
    double from = folded(first);
    if (from < nearly) from = 180;
    return ir::number(clean(from + last - first < -nearly ? 180.0 : from));
  }
  if (e.start.known() && e.end.known()) {
    const Vector d = from_to(e.start, e.end);
    return ir::number(clean(std::max(0.0, folded(degrees * std::atan2(d.v, d.u)))));
  }
  const auto difference = [](const ContourCoordinate& a, const ContourCoordinate& b) {
    return ir::binary(ir::BinaryOp::subtract, b.expr, a.expr);
  };
  const auto angle = ir::call(ir::Function::atan2, {difference(e.start.v, e.end.v), difference(e.start.u, e.end.u)});
  const auto turns = ir::call(ir::Function::floor, {ir::binary(ir::BinaryOp::divide, angle, ir::number(180))});
  return ir::binary(ir::BinaryOp::subtract, angle, ir::binary(ir::BinaryOp::multiply, turns, ir::number(180)));
}

}  // namespace cnctrans::sinumerik
