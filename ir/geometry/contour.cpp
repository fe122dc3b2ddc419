// A search: what follows from the data without choice is filled in; where two points fit, both ways are tried.
#include "ir/geometry/contour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnctrans::ir::contour {

using geometry::cross;
using geometry::dot;
using geometry::left_of;
using geometry::length;

namespace {

constexpr double same = 1e-9;  ///< mm

Point unit(Point a) {
  const double l = length(a);
  return l < same ? Point{} : (1 / l) * a;
}
Point direction(double degrees) {
  const double quarter = degrees / 90;
  if (quarter == std::floor(quarter)) {  // exact along the axes
    switch (static_cast<int>(std::fmod(std::fmod(quarter, 4) + 4, 4))) {
      case 0: return {1, 0};
      case 1: return {0, 1};
      case 2: return {-1, 0};
      default: return {0, -1};
    }
  }
  const double a = degrees * std::numbers::pi / 180;
  return {std::cos(a), std::sin(a)};
}

/// What a point lies on: a line (a point and a unit direction) or a circle.
struct Locus {
  bool circle = false;
  Point at, along;
  double radius = 0;
};
std::vector<Point> cut_line_circle(const Locus& line, const Locus& circle, double tolerance) {
  const Point foot = line.at + dot(circle.at - line.at, line.along) * line.along;
  const double d = length(foot - circle.at);
  if (d > circle.radius + tolerance) return {};
  const double rest = circle.radius * circle.radius - d * d;
  if (rest <= tolerance * tolerance) return {foot};
  const double h = std::sqrt(rest);
  return {foot - h * line.along, foot + h * line.along};
}
std::vector<Point> cut(const Locus& a, const Locus& b, double tolerance) {
  if (a.circle && !b.circle) return cut_line_circle(b, a, tolerance);
  if (!a.circle && b.circle) return cut_line_circle(a, b, tolerance);
  if (!a.circle) {
    const double s = cross(a.along, b.along);
    if (std::fabs(s) < 1e-9) return {};
    return {a.at + (cross(b.at - a.at, b.along) / s) * a.along};
  }
  const double d = length(b.at - a.at);
  if (d < same || d > a.radius + b.radius + tolerance || d < std::fabs(a.radius - b.radius) - tolerance) return {};
  const double x = (a.radius * a.radius - b.radius * b.radius + d * d) / (2 * d);
  const Point e = unit(b.at - a.at);
  return cut_line_circle({false, a.at + x * e, left_of(e), 0}, a, tolerance);
}

struct State {
  std::optional<Point> from, to, centre;
  std::optional<double> radius;
  std::optional<Point> along;
};
using States = std::vector<State>;

class Search {
 public:
  Search(const std::vector<Element>& elements, double tolerance) : e_(elements), tolerance_(tolerance) {}

  void run(States s) {
    if (++steps_ > 400 || !infer(s)) return;
    if (complete(s)) {
      if (fits(s)) found.push_back(std::move(s));
      return;
    }
    for (std::size_t i = 0; i < e_.size(); ++i) {
      if (arc_centre(s, i) || arc_radius(s, i)) return;
    }
    for (std::size_t i = 0; i < e_.size(); ++i) {
      if (!s[i].to && (i + 1 < e_.size() ? junction(s, i) : by_coordinate(s, i, carrier(s[i], i)))) return;
    }
    undetermined = true;
  }

  std::vector<States> found;
  bool undetermined = false;

 private:
  static bool complete(const States& s) {
    return std::all_of(s.begin(), s.end(), [](const State& x) { return x.from && x.to; });
  }
  [[nodiscard]] bool tangent(std::size_t i) const { return i < e_.size() && e_[i].end == ElementEnd::tangent; }

  /// What follows without choice. False: the data contradict each other.
  bool infer(States& s) const {
    for (bool more = true; more;) {
      more = false;
      for (std::size_t i = 0; i < s.size(); ++i) {
        State& x = s[i];
        if (i > 0 && s[i - 1].to && !x.from) {
          x.from = s[i - 1].to;
          more = true;
        }
        if (!e_[i].arc) {
          if (!x.along && x.from && x.to && length(*x.to - *x.from) > same) {
            x.along = unit(*x.to - *x.from);
            more = true;
          }
          continue;
        }
        for (const auto& p : {x.from, x.to}) {
          if (!x.centre || !p) continue;
          const double r = length(*p - *x.centre);
          if (x.radius && std::fabs(*x.radius - r) > tolerance_) return false;
          if (!x.radius) {
            x.radius = r;
            more = true;
          }
        }
      }
    }
    return true;
  }

  [[nodiscard]] std::optional<Locus> carrier(const State& x, std::size_t i) const {
    if (e_[i].arc) {
      if (!x.centre || !x.radius) return std::nullopt;
      return Locus{true, *x.centre, {}, *x.radius};
    }
    if (!x.along || (!x.from && !x.to)) return std::nullopt;
    return Locus{false, x.from ? *x.from : *x.to, *x.along, 0};
  }

  void fork(const States& s, std::size_t i, const std::vector<Point>& ends) {
    for (const Point p : ends) {
      States next = s;
      next[i].to = p;
      run(std::move(next));
    }
  }

  /// Where the centre of arc `i` lies because its neighbour `j` is tangent to it.
  [[nodiscard]] std::optional<Locus> centre_beside(const States& s, std::size_t i, std::size_t j) const {
    const auto c = carrier(s[j], j);
    if (!c) return std::nullopt;
    const double r = *s[i].radius;
    if (!c->circle) return Locus{false, c->at + (e_[i].ccw ? r : -r) * left_of(c->along), c->along, 0};
    const bool alike = e_[i].ccw == e_[j].ccw;
    return Locus{true, c->at, {}, alike ? std::fabs(c->radius - r) : c->radius + r};
  }

  /// The centre of an arc of known radius, from two of: start, end, tangent neighbours.
  bool arc_centre(States& s, std::size_t i) {
    if (!e_[i].arc || s[i].centre || !s[i].radius) return false;
    std::vector<Locus> loci;
    for (const auto& p : {s[i].from, s[i].to}) {
      if (p) loci.push_back({true, *p, {}, *s[i].radius});
    }
    const bool by_ends = loci.size() == 2;
    if (i > 0 && tangent(i - 1) && !by_ends) {
      if (const auto l = centre_beside(s, i, i - 1)) loci.push_back(*l);
    }
    if (i + 1 < e_.size() && tangent(i) && loci.size() < 2) {
      if (const auto l = centre_beside(s, i, i + 1)) loci.push_back(*l);
    }
    if (loci.size() < 2) return false;
    for (const Point c : cut(loci[0], loci[1], tolerance_)) {
      // By its ends and its radius an arc turns less than 180 degrees.
      if (by_ends && cross(*s[i].to - *s[i].from, c - *s[i].from) * (e_[i].ccw ? 1 : -1) < -same) continue;
      States next = s;
      next[i].centre = c;
      run(std::move(next));
    }
    return true;
  }

  /// The radius of an arc of known centre, from a tangent neighbour.
  bool arc_radius(States& s, std::size_t i) {
    if (!e_[i].arc || !s[i].centre || s[i].radius) return false;
    for (const std::size_t j : {i - 1, i + 1}) {
      if (j >= e_.size() || !tangent(std::min(i, j))) continue;
      const auto c = carrier(s[j], j);
      if (!c) continue;
      const double d = length(*s[i].centre - c->at);
      std::vector<double> radii;
      if (!c->circle) {
        const double side = cross(c->along, *s[i].centre - c->at) * (e_[i].ccw ? 1 : -1);
        if (side > same) radii = {side};
      } else if (e_[i].ccw == e_[j].ccw) {
        radii = {c->radius + d, std::fabs(c->radius - d)};
      } else if (d > c->radius) {
        radii = {d - c->radius};
      }
      for (const double r : radii) {
        States next = s;
        next[i].radius = r;
        run(std::move(next));
      }
      return true;
    }
    return false;
  }

  /// One coordinate of the end is written; the other lies on `on`.
  bool by_coordinate(const States& s, std::size_t i, const std::optional<Locus>& on) {
    const Element& e = e_[i];
    if (!on || e.u.has_value() == e.v.has_value()) return false;
    const Locus at = e.u ? Locus{false, {*e.u, 0}, {0, 1}, 0} : Locus{false, {0, *e.v}, {1, 0}, 0};
    fork(s, i, cut(at, *on, tolerance_));
    return true;
  }

  /// The point between elements `i` and `i + 1`. False: the data do not give it yet.
  bool junction(const States& s, std::size_t i) {
    const auto a = carrier(s[i], i), b = carrier(s[i + 1], i + 1);
    const Element& e = e_[i];
    if (e.u.has_value() != e.v.has_value()) return by_coordinate(s, i, a ? a : b);
    if (e.end == ElementEnd::secant) {
      if (!a || !b) return false;
      fork(s, i, cut(*a, *b, tolerance_));
      return true;
    }
    return e.end == ElementEnd::tangent && tangent_point(s, i, a, b);
  }

  bool tangent_point(const States& s, std::size_t i, const std::optional<Locus>& a, const std::optional<Locus>& b) {
    for (const auto& [arc, line] : {std::pair{i, i + 1}, std::pair{i + 1, i}}) {
      if (!e_[arc].arc || e_[line].arc || !s[arc].centre || !s[arc].radius) continue;
      const Point c = *s[arc].centre;
      const double r = *s[arc].radius, sense = e_[arc].ccw ? 1 : -1;
      if (s[line].along) {  // the direction gives the point
        fork(s, i, {c - (sense * r) * left_of(*s[line].along)});
        return true;
      }
      const auto& far = line == i ? s[line].from : s[line].to;
      if (!far) continue;
      const double d = length(*far - c);
      if (d < r - tolerance_) return true;  // the point lies inside the circle: no solution
      if (d <= r + same) {
        fork(s, i, {*far});
        return true;
      }
      const Point mid = 0.5 * (*far + c);
      std::vector<Point> ends;
      for (const Point p : cut({true, c, {}, r}, {true, mid, {}, d / 2}, same)) {
        const Point along = line == i ? p - *far : *far - p;
        if (cross(along, c - p) * sense > 0) ends.push_back(p);
      }
      fork(s, i, ends);
      return true;
    }
    if (!a || !b || !a->circle || !b->circle) return false;
    const double d = length(b->at - a->at);
    if (d < same) return true;
    const Point along = unit(b->at - a->at);
    const bool alike = e_[i].ccw == e_[i + 1].ccw;
    fork(s, i, {a->at + (alike && a->radius < b->radius ? -a->radius : a->radius) * along});
    return true;
  }

  /// Direction of travel at the start or end of an element.
  [[nodiscard]] Point heading(const State& x, std::size_t i, Point at) const {
    if (!e_[i].arc) return unit(*x.to - *x.from);
    const Point n = left_of(unit(at - *x.centre));
    return e_[i].ccw ? n : -1.0 * n;
  }

  [[nodiscard]] bool fits(const States& s) const {
    for (std::size_t i = 0; i < s.size(); ++i) {
      const State& x = s[i];
      if (e_[i].arc && (!x.centre || length(*x.from - *x.centre) < same ||
                        std::fabs(length(*x.from - *x.centre) - length(*x.to - *x.centre)) > tolerance_))
        return false;
      const Point way = *x.to - *x.from;
      if (length(way) < same) return false;
      // By its radius alone an arc turns less than 180 degrees.
      if (e_[i].arc && !e_[i].centre && cross(way, *x.centre - *x.from) * (e_[i].ccw ? 1 : -1) < -1e-6 * length(way))
        return false;
      if (!e_[i].arc && e_[i].angle) {
        const Point along = direction(*e_[i].angle);
        if (dot(way, along) <= 0 || std::fabs(cross(along, way)) > tolerance_) return false;
      }
      if (i + 1 == s.size() || e_[i].end != ElementEnd::tangent) continue;
      const Point out = heading(x, i, *x.to), in = heading(s[i + 1], i + 1, *x.to);
      // An angle that the tolerance makes of a short element.
      const double span = std::min(length(way), length(*s[i + 1].to - *s[i + 1].from));
      if (dot(out, in) <= 0 || std::fabs(cross(out, in)) > std::max(1e-3, tolerance_ / span)) return false;
    }
    return true;
  }

  const std::vector<Element>& e_;
  double tolerance_;
  int steps_ = 0;
};

bool before(Point a, Point b) {
  return std::fabs(a.u - b.u) > 1e-6 ? a.u < b.u : a.v < b.v;
}
bool equal(const States& a, const States& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (length(*a[i].to - *b[i].to) > 1e-6) return false;
    if (a[i].centre && b[i].centre && length(*a[i].centre - *b[i].centre) > 1e-6) return false;
  }
  return true;
}

/// Of all that fit: what the branches ask for, then the one whose first free point is nearest.
States pick(std::vector<States> all, const std::vector<Element>& elements, Point start, bool& chosen) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (elements[i].branch == Branch::none) continue;
    const bool greater = elements[i].branch == Branch::plus;
    Point best = *all.front()[i].to;
    for (const auto& s : all) {
      if (greater ? before(best, *s[i].to) : before(*s[i].to, best)) best = *s[i].to;
    }
    std::erase_if(all, [&](const States& s) { return length(*s[i].to - best) > 1e-6; });
  }
  std::vector<States> kinds;
  for (const auto& s : all) {
    if (std::none_of(kinds.begin(), kinds.end(), [&](const States& k) { return equal(k, s); })) kinds.push_back(s);
  }
  chosen = kinds.size() > 1;
  const auto distance = [start](const States& s) {
    double d = 0;
    for (const auto& x : s) d += length(*x.to - start);
    return d;
  };
  return *std::min_element(kinds.begin(), kinds.end(),
                           [&](const States& a, const States& b) { return distance(a) < distance(b); });
}

}  // namespace

Result solve(Point start, const std::vector<Element>& elements, double tolerance) {
  Result result;
  if (elements.empty()) return result;
  if (elements.size() > longest) {
    result.error = "more than 3 elements in a row whose end follows from the next one";
    return result;
  }
  States s(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Element& e = elements[i];
    if (e.u && e.v) s[i].to = Point{*e.u, *e.v};
    if (e.angle) s[i].along = direction(*e.angle);
    s[i].centre = e.centre;
    s[i].radius = e.radius;
  }
  s.front().from = start;
  const Element& last = elements.back();
  if (!last.u && !last.v) {
    result.error = "the last element has no end point";
    return result;
  }
  Search search(elements, tolerance);
  search.run(std::move(s));
  if (search.found.empty()) {
    result.error = search.undetermined ? "the data do not determine the contour"
                                       : "the elements do not meet as they are written (no such point)";
    return result;
  }
  const States best = pick(std::move(search.found), elements, start, result.chosen);
  for (const auto& x : best) result.elements.push_back({*x.from, *x.to, x.centre.value_or(Point{})});
  result.ok = true;
  return result;
}

}  // namespace cnctrans::ir::contour
