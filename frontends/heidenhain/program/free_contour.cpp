#include "frontends/heidenhain/program/free_contour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnctrans::frontends::heidenhain {

namespace {

using ir::geometry::cross;
using ir::geometry::dot;
using ir::geometry::left_of;
using ir::geometry::length;
using ir::geometry::normalised;
using ir::geometry::Vec;

constexpr double near = 1e-6, fits = 0.005;  ///< mm: the same; a dimension of the drawing agrees

/// A directed line or circle on which an element lies.
struct Carrier {
  bool arc = false;
  Vec p, d;      ///< line: a point and the direction
  Vec c;         ///< circle: centre
  double r = 0;  ///< and radius, + counter-clockwise
  [[nodiscard]] Vec direction(Vec at) const { return arc ? (r > 0 ? 1.0 : -1.0) * left_of(normalised(at - c)) : d; }
};
Vec of_angle(double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  const auto clean = [](double x) { return std::abs(x) < 1e-15 ? 0.0 : x; };
  return {clean(std::cos(a)), clean(std::sin(a))};
}
Carrier line(Vec p, Vec d) {
  Carrier k;
  k.p = p;
  k.d = d;
  return k;
}
Carrier circle(Vec c, double r) {
  Carrier k;
  k.arc = true;
  k.c = c;
  k.r = r;
  return k;
}
double distance_left(const Carrier& l, Vec at) {
  return cross(l.d, at - l.p);
}
bool on(const Carrier& k, Vec at) {
  return std::abs(k.arc ? length(at - k.c) - std::abs(k.r) : distance_left(k, at)) < fits;
}
/// Where both are in the same direction; nullopt: they do not touch.
std::optional<Vec> touch(const Carrier& a, const Carrier& b) {
  if (!a.arc && !b.arc) return std::nullopt;
  if (!a.arc || !b.arc) {
    const Carrier &l = a.arc ? b : a, &k = a.arc ? a : b;
    if (std::abs(distance_left(l, k.c) - k.r) > fits) return std::nullopt;
    return k.c - k.r * left_of(l.d);
  }
  if (std::abs(a.r - b.r) < near || std::abs(length(b.c - a.c) - std::abs(b.r - a.r)) > fits) return std::nullopt;
  return a.c - a.r * normalised((1 / (b.r - a.r)) * (b.c - a.c));
}
std::vector<Vec> cut(const Carrier& a, const Carrier& b) {
  if (!a.arc && !b.arc) {
    const double n = cross(a.d, b.d);
    if (std::abs(n) < 1e-9) return {};
    return {a.p + (cross(b.p - a.p, b.d) / n) * a.d};
  }
  if (a.arc && b.arc) {
    const Vec v = b.c - a.c;
    const double l = length(v);
    if (l < near) return {};
    const double x = (l * l + a.r * a.r - b.r * b.r) / (2 * l), h = a.r * a.r - x * x;
    if (h < -fits * std::abs(a.r)) return {};
    const double y = std::sqrt(std::max(0.0, h));
    const Vec e = normalised(v), foot = a.c + x * e;
    if (y < near) return {foot};
    return {foot + y * left_of(e), foot - y * left_of(e)};
  }
  const Carrier &l = a.arc ? b : a, &k = a.arc ? a : b;
  const double off = distance_left(l, k.c), h = k.r * k.r - off * off;
  if (h < -fits * std::abs(k.r)) return {};
  const Vec foot = k.c - off * left_of(l.d);
  const double y = std::sqrt(std::max(0.0, h));
  if (y < near) return {foot};
  return {foot + y * l.d, foot - y * l.d};
}
/// Directed lines that touch both circles (radius 0: a point).
std::vector<Carrier> tangents(Vec a, double ra, Vec b, double rb) {
  const Vec v = b - a;
  const double l = length(v), k = rb - ra;
  if (l < near || std::abs(k) > l + near) return {};
  // left(d) . v = k
  const double s = std::clamp(k / l, -1.0, 1.0), c = std::sqrt(1 - s * s);
  const Vec e = normalised(v);
  std::vector<Carrier> out;
  for (const double sign : {1.0, -1.0}) {
    const Vec n = s * e + (sign * c) * left_of(e);
    const Vec d = -1.0 * left_of(n);
    out.push_back(line(a - ra * n, d));
    if (c < near) break;
  }
  return out;
}

class Solver {
 public:
  Solver(const std::vector<FreeElement>& elements, Vec start) : e_(elements), start_(start) {}

  FreeResult run(std::optional<Vec> direction) {
    std::vector<ir::geometry::Element> path;
    solve(0, start_, direction, nullptr, path);
    FreeResult out;
    out.at = std::min(furthest_, e_.size() - 1);
    if (solutions_.empty() || too_many_) {
      out.error = too_many_ ? "the free contour has too many possible ways"
                            : "the data of the free contour do not give the end of this element";
      return out;
    }
    if (solutions_.size() > 1) {
      out.at = 0;
      out.error = std::to_string(solutions_.size()) +
                  " contours fit the data: which one FSELECT means is not known, and no other data decide";
      return out;
    }
    out.elements = std::move(solutions_.front());
    return out;
  }

 private:
  using Path = std::vector<ir::geometry::Element>;
  static constexpr int most_steps = 20'000;

  [[nodiscard]] std::optional<double> get(std::size_t i, const char* name) const {
    const auto it = e_[i].words.find(name);
    return it == e_[i].words.end() ? std::nullopt : std::optional(it->second);
  }
  [[nodiscard]] std::optional<Vec> pair(std::size_t i, const char* u, const char* v) const {
    const auto x = get(i, u), y = get(i, v);
    return x && y ? std::optional(Vec{*x, *y}) : std::nullopt;
  }
  [[nodiscard]] std::optional<Vec> polar(std::size_t i, const char* r, const char* a) const {
    const auto radius = get(i, r), angle = get(i, a);
    if (!radius || !angle || !e_[i].pole) return std::nullopt;
    return Vec{e_[i].pole->first, e_[i].pole->second} + *radius * of_angle(*angle);
  }
  [[nodiscard]] std::optional<Vec> end_point(std::size_t i) const {
    if (e_[i].closes) return start_;
    const auto xy = pair(i, "X", "Y");
    return xy ? xy : polar(i, "PR", "PA");
  }
  [[nodiscard]] std::optional<Vec> centre(std::size_t i) const {
    const auto xy = pair(i, "CCX", "CCY");
    return xy ? xy : polar(i, "CCPR", "CCPA");
  }
  [[nodiscard]] std::vector<Vec> points(std::size_t i) const {
    std::vector<Vec> out;
    for (const auto& [u, v] : {std::pair("P1X", "P1Y"), std::pair("P2X", "P2Y"), std::pair("P3X", "P3Y")}) {
      if (const auto p = pair(i, u, v)) out.push_back(*p);
    }
    return out;
  }
  [[nodiscard]] std::vector<double> senses(std::size_t i) const {
    if (e_[i].sense != 0) return {static_cast<double>(e_[i].sense)};
    return {1, -1};
  }

  /// The data that concern the carrier alone agree with it.
  [[nodiscard]] bool agrees(std::size_t i, const Carrier& k) const {
    for (const Vec p : points(i)) {
      if (!on(k, p)) return false;
    }
    if (const auto e = end_point(i); e && !on(k, *e)) return false;
    if (!k.arc) {
      if (const auto an = get(i, "AN"); an && length(of_angle(*an) - k.d) > 1e-4) return false;
      const auto p = pair(i, "PDX", "PDY");
      const auto d = get(i, "D");
      return !p || !d || std::abs(std::abs(distance_left(k, *p)) - std::abs(*d)) < fits;
    }
    if (e_[i].sense != 0 && k.r * e_[i].sense < 0) return false;
    if (const auto r = get(i, "R"); r && std::abs(std::abs(k.r) - std::abs(*r)) > fits) return false;
    const auto c = centre(i);
    return !c || length(*c - k.c) < fits;
  }
  /// Carriers by the element's own data.
  [[nodiscard]] std::vector<Carrier> alone(std::size_t i) const {
    std::vector<Carrier> out;
    const auto end = end_point(i);
    auto known = points(i);
    if (end) known.push_back(*end);
    if (!e_[i].arc) {
      const auto an = get(i, "AN"), d = get(i, "D");
      const auto p = pair(i, "PDX", "PDY");
      if (an && !known.empty()) {
        out.push_back(line(known.front(), of_angle(*an)));
      } else if (an && p && d) {
        const Vec n = left_of(of_angle(*an));
        for (const double s : {1.0, -1.0}) out.push_back(line(*p - (s * *d) * n, of_angle(*an)));
      } else if (known.size() >= 2 && length(known[1] - known[0]) > near) {
        const Vec dir = normalised(known[1] - known[0]);
        out = {line(known[0], dir), line(known[0], -1.0 * dir)};
      } else if (p && d && !known.empty()) {
        for (const double s : {1.0, -1.0}) {
          for (auto& t : tangents(*p, s * *d, known[0], 0)) {
            out.push_back(t);
            out.push_back(line(t.p, -1.0 * t.d));
          }
        }
      }
    } else if (const auto c = centre(i)) {
      auto r = get(i, "R");
      if (!r && !known.empty()) r = length(known.front() - *c);
      for (const double s : senses(i)) {
        if (r && std::abs(*r) > near) out.push_back(circle(*c, s * std::abs(*r)));
      }
    }
    std::erase_if(out, [&](const Carrier& k) { return !agrees(i, k); });
    return out;
  }
  /// Carriers of an element that begins in `p`, in direction `d` where it is tangential.
  [[nodiscard]] std::vector<Carrier> from(std::size_t i, Vec p, const std::optional<Vec>& d) const {
    std::vector<Carrier> out;
    const auto end = end_point(i);
    const auto an = get(i, "AN");
    std::optional<Vec> begin;
    if (e_[i].tangent) begin = d;
    if (an) begin = of_angle(*an);
    if (!e_[i].arc) {
      auto known = points(i);
      if (end) known.insert(known.begin(), *end);
      const auto pd = pair(i, "PDX", "PDY");
      const auto dist = get(i, "D");
      if (begin) {
        out.push_back(line(p, *begin));
      } else if (!known.empty() && length(known.front() - p) > near) {
        out.push_back(line(p, normalised(known.front() - p)));
        if (!end) out.push_back(line(p, -1.0 * out.back().d));
      } else if (pd && dist) {
        for (const double s : {1.0, -1.0}) {
          for (auto& t : tangents(p, 0, *pd, s * *dist)) {
            out.push_back(line(p, t.d));
            out.push_back(line(p, -1.0 * t.d));
          }
        }
      }
    } else {
      const auto c = centre(i), xy = end;
      const auto r = get(i, "R");
      for (const double s : senses(i)) {
        if (c) {
          out.push_back(circle(*c, s * length(p - *c)));
        } else if (begin && r) {
          out.push_back(circle(p + (s * std::abs(*r)) * left_of(*begin), s * std::abs(*r)));
        } else if (begin && xy) {
          Vec m;
          bool ccw = false;
          if (ir::geometry::centre_by_tangent(p, *begin, *xy, m, ccw) && ccw == (s > 0))
            out.push_back(circle(m, s * length(p - m)));
        } else if (r && xy) {
          for (const double side : {1.0, -1.0}) {
            if (const auto m = ir::geometry::centre_by_radius(p, *xy, side * std::abs(*r), s > 0, fits))
              out.push_back(circle(*m, s * std::abs(*r)));
          }
        }
      }
    }
    std::erase_if(out, [&](const Carrier& k) {
      const bool turns = e_[i].tangent && d && length(k.direction(p) - *d) > 1e-4;
      const bool other = k.arc && an && length(k.direction(p) - of_angle(*an)) > 1e-4;
      return turns || other || !on(k, p) || !agrees(i, k);
    });
    return out;
  }
  /// Carriers of a tangential element that touches the one before it, wherever that ends.
  [[nodiscard]] std::vector<Carrier> touching(std::size_t i, const Carrier& a) const {
    std::vector<Carrier> out;
    auto known = points(i);
    if (const auto e = end_point(i)) known.push_back(*e);
    if (!e_[i].arc && a.arc) {
      if (const auto an = get(i, "AN")) out.push_back(line(a.c - a.r * left_of(of_angle(*an)), of_angle(*an)));
      const auto p = pair(i, "PDX", "PDY");
      const auto d = get(i, "D");
      if (out.empty() && !known.empty()) out = tangents(a.c, a.r, known.front(), 0);
      if (out.empty() && p && d) {
        for (const double s : {1.0, -1.0}) {
          for (auto& t : tangents(a.c, a.r, *p, s * *d)) out.push_back(t);
        }
      }
    } else if (e_[i].arc) {
      const auto c = centre(i);
      const auto r = get(i, "R");
      for (const double s : senses(i)) {
        if (c && !a.arc) {
          out.push_back(circle(*c, distance_left(a, *c)));
        } else if (c) {
          for (const double side : {1.0, -1.0}) out.push_back(circle(*c, a.r + side * length(*c - a.c)));
        } else if (r && !known.empty()) {
          for (const Vec m : cut(beside(a, s * std::abs(*r)), circle(known.front(), std::abs(*r))))
            out.push_back(circle(m, s * std::abs(*r)));
        }
      }
    }
    std::erase_if(out, [&](const Carrier& k) { return (k.arc && std::abs(k.r) < near) || !agrees(i, k); });
    return out;
  }
  /// Where the centres of circles of the signed radius lie that touch it.
  static Carrier beside(const Carrier& a, double r) {
    return a.arc ? circle(a.c, std::abs(a.r - r)) : line(a.p + r * left_of(a.d), a.d);
  }
  /// Elements between two that are known: a line that touches both circles, an arc of known radius.
  [[nodiscard]] std::vector<Carrier> between(std::size_t i, const Carrier& a, const Carrier& b) const {
    std::vector<Carrier> out;
    if (!e_[i].arc) {
      if (a.arc && b.arc) out = tangents(a.c, a.r, b.c, b.r);
    } else if (const auto r = get(i, "R")) {
      for (const double s : senses(i)) {
        const double radius = s * std::abs(*r);
        for (const Vec m : cut(beside(a, radius), beside(b, radius))) out.push_back(circle(m, radius));
      }
    }
    std::erase_if(out, [&](const Carrier& k) { return !agrees(i, k) || !touch(a, k) || !touch(k, b); });
    return out;
  }
  /// Ends by the element's own data.
  [[nodiscard]] std::vector<Vec> ends(std::size_t i, const Carrier& k, Vec p) const {
    if (const auto e = end_point(i)) return {*e};
    if (const auto len = get(i, "LEN")) {
      if (!k.arc) return {p + *len * k.d};
      return {ir::geometry::turned(p, k.c, *len / k.r * 180 / std::numbers::pi)};
    }
    if (const auto x = get(i, "X")) return cut(k, line({*x, 0}, {0, 1}));
    if (const auto y = get(i, "Y")) return cut(k, line({0, *y}, {1, 0}));
    if (const auto pa = get(i, "PA");
        pa && e_[i].pole && k.arc && length(Vec{e_[i].pole->first, e_[i].pole->second} - k.c) < fits)
      return {k.c + std::abs(k.r) * of_angle(*pa)};
    return {};
  }

  /// The element `i` from `p` on the carrier ends in `to`; true: it does, and is in the path.
  bool step(std::size_t i, const Carrier& k, Vec p, Vec to, Path& path) const {
    ir::geometry::Element one;
    one.arc = k.arc;
    one.a = p;
    one.b = to;
    one.c = k.c;
    one.ccw = k.r > 0;
    if (!k.arc && dot(to - p, k.d) < near) return false;
    if (k.arc && length(to - p) < near && !e_[i].closes && !end_point(i)) return false;
    if (const auto len = get(i, "LEN"); len && !k.arc && std::abs(length(to - p) - std::abs(*len)) > fits) return false;
    path.push_back(one);
    return true;
  }

  void solve(std::size_t i, Vec p, const std::optional<Vec>& d, const Carrier* fixed, Path& path) {
    furthest_ = std::max(furthest_, i);
    too_many_ = too_many_ || ++steps_ > most_steps;
    if (too_many_) return;
    if (i == e_.size()) return found(path);
    const std::size_t depth = path.size();
    const auto goes_on = [&](const Carrier& k, Vec to, std::size_t next, const Carrier* its) {
      if (step(i, k, p, to, path)) solve(next, to, k.direction(to), its, path);
      path.resize(depth);
    };
    std::vector<Carrier> carriers = fixed != nullptr ? std::vector{*fixed} : from(i, p, d);
    const bool last = i + 1 == e_.size();
    if (carriers.empty() && !e_[i].arc && !last &&
        e_[i + 1].tangent) {  // a line from here that touches the next circle
      for (const Carrier& k : alone(i + 1)) {
        if (!k.arc) continue;
        for (const Carrier& t : tangents(p, 0, k.c, k.r)) carriers.push_back(line(p, t.d));
      }
    }
    for (const Carrier& k : carriers) {
      const auto own = ends(i, k, p);
      for (const Vec to : own) goes_on(k, to, i + 1, nullptr);
      if (!own.empty() || last) continue;
      auto following = alone(i + 1);
      const bool independent = !following.empty();
      if (e_[i + 1].tangent && !independent) following = touching(i + 1, k);
      for (const Carrier& n : following) {
        if (!e_[i + 1].tangent) {
          for (const Vec to : cut(k, n)) goes_on(k, to, i + 1, &n);
        } else if (const auto to = touch(k, n)) {
          goes_on(k, *to, i + 1, &n);
        }
      }
      if (!following.empty() || !e_[i + 1].tangent || i + 2 >= e_.size() || !e_[i + 2].tangent) continue;
      for (const Carrier& l : alone(i + 2)) {
        for (const Carrier& n : between(i + 1, k, l)) {
          const auto t1 = touch(k, n), t2 = touch(n, l);
          if (step(i, k, p, *t1, path) && step(i + 1, n, *t1, *t2, path)) solve(i + 2, *t2, n.direction(*t2), &l, path);
          path.resize(depth);
        }
      }
    }
  }
  void found(const Path& path) {
    const auto same = [&](const Path& other) {
      for (std::size_t k = 0; k < path.size(); ++k) {
        if (length(path[k].b - other[k].b) > fits || path[k].ccw != other[k].ccw ||
            (path[k].arc && length(path[k].c - other[k].c) > fits))
          return false;
      }
      return true;
    };
    if (std::none_of(solutions_.begin(), solutions_.end(), same)) solutions_.push_back(path);
  }

  const std::vector<FreeElement>& e_;
  Vec start_;
  std::vector<Path> solutions_;
  std::size_t furthest_ = 0;
  int steps_ = 0;
  bool too_many_ = false;
};

}  // namespace

FreeResult solve_free_contour(const std::vector<FreeElement>& elements, Vec start, std::optional<Vec> direction) {
  return Solver(elements, start).run(direction);
}

}  // namespace cnctrans::frontends::heidenhain
