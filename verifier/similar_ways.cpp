#include "verifier/similar_ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "base/text.h"
#include "verifier/normalise.h"

namespace cnctrans::verifier {

using interpreter::Event;
using interpreter::EventKind;
using interpreter::Position;

namespace {

struct WayPoint {
  double u = 0, v = 0;
};
double cross(const WayPoint& o, const WayPoint& a, const WayPoint& b) {
  return (a.u - o.u) * (b.v - o.v) - (a.v - o.v) * (b.u - o.u);
}

/// Corners of the convex hull, counter-clockwise.
std::vector<WayPoint> hull_of(std::vector<WayPoint> points) {
  std::sort(points.begin(), points.end(),
            [](const WayPoint& a, const WayPoint& b) { return a.u < b.u || (a.u == b.u && a.v < b.v); });
  std::vector<WayPoint> out;
  const auto half = [&out](auto from, auto to) {
    const std::size_t least = out.size() + 1;
    for (; from != to; ++from) {
      while (out.size() > least && cross(out[out.size() - 2], out.back(), *from) <= 0) out.pop_back();
      out.push_back(*from);
    }
    out.pop_back();
  };
  half(points.begin(), points.end());
  half(points.rbegin(), points.rend());
  return out;
}

/// How far the point lies outside.
double outside(const std::vector<WayPoint>& hull, const WayPoint& p) {
  double most = 0;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const WayPoint &a = hull[k], &b = hull[(k + 1) % hull.size()];
    const double way = std::hypot(b.u - a.u, b.v - a.v);
    if (way > 0) most = std::max(most, -cross(a, b, p) / way);
  }
  return most;
}

/// Where the moves of a side go, each axis by itself.
struct Box {
  Position low, high;
  void add(const Position& p) {
    for (std::size_t k = 0; k < p.value.size(); ++k) {
      if ((p.known >> k & 1U) != 0) add(k, p.value[k]);
    }
  }
  void add(std::size_t axis, double at) {
    const bool first = (low.known >> axis & 1U) == 0;
    low.known |= 1U << axis;
    low.value[axis] = first ? at : std::min(low.value[axis], at);
    high.value[axis] = first ? at : std::max(high.value[axis], at);
  }
};

/// How low, along the axis of the cycle, the tool goes across it in rapid before the first cut; where it does not, how
/// high it stands there.
double crossing(const CyclePasses& side) {
  const auto axes = ir::plane_axes(side.run->plane);
  const auto height = [&](const Position& p) { return p.value[axes.w] * side.run->out; };
  constexpr double none = std::numeric_limits<double>::infinity();
  Position at = side.start;
  double low = none;
  for (const Event* e : side.events) {
    if (!is_motion(e->kind)) continue;
    if (e->kind != EventKind::rapid) break;
    if (std::hypot(e->to.value[axes.u] - at.value[axes.u], e->to.value[axes.v] - at.value[axes.v]) > 1e-6)
      low = std::min({low, height(at), height(e->to)});
    at = e->to;
  }
  return low < none ? low : height(side.start);
}

}  // namespace

std::string crossing_difference(const CyclePasses& source, const CyclePasses& target) {
  constexpr double room = 0.004;  // mm
  return crossing(target) < crossing(source) - room
             ? "the translation goes across to its cycle lower than the source does"
             : "";
}

std::string way_difference(const CyclePasses& source, const CyclePasses& target, bool turned) {
  constexpr double margin = 1;  // mm: the distances that cycles keep are not the same on all controls
  const auto point = [](const Position& p) { return WayPoint{p.value[ir::axis::x], p.value[ir::axis::z]}; };
  Box box;
  std::vector<WayPoint> points{point(source.start)};
  box.add(source.start);
  for (const Event* e : source.events) {
    if (!is_motion(e->kind)) continue;
    box.add(e->to);
    points.push_back(point(e->to));
    if (e->kind != EventKind::arc) continue;
    const auto axes = ir::plane_axes(e->plane);
    const double r = std::hypot(e->to.value[axes.u] - e->center_u, e->to.value[axes.v] - e->center_v);
    for (const double by : {-r, r}) {
      box.add(axes.u, e->center_u + by);
      box.add(axes.v, e->center_v + by);
    }
  }
  // What the cycle comes down to belongs to it, and what lies before it as the tool stands at the start, where the
  // blank is not: a cycle may begin its last pass there.
  const WayPoint start = point(source.start);
  for (const auto* contour : {&source.run->rough, &source.run->finish}) {
    for (const auto& c : *contour) {
      points.insert(points.end(), {{c.x, c.z}, {c.x, start.v}, {start.u, c.z}});
      box.add(ir::axis::x, c.x);
      box.add(ir::axis::z, c.z);
    }
  }
  const auto hull = turned ? hull_of(std::move(points)) : std::vector<WayPoint>();
  for (const Event* e : target.events) {
    if (e->kind != EventKind::rapid) continue;
    double out = outside(hull, point(e->to));
    for (std::size_t k = 0; k < e->to.value.size(); ++k) {
      if ((e->to.known & box.low.known & 1U << k) == 0) continue;
      out = std::max({out, box.low.value[k] - e->to.value[k], e->to.value[k] - box.high.value[k]});
    }
    if (out > margin)
      return fmt::format("a rapid move of the translation's cycle ends {} mm outside of where the source's tool goes",
                         rounded(out, 3));
  }
  return {};
}

std::string beside_the_moves(const CyclePasses& a, const CyclePasses& b) {
  const bool tap = a.run->family == "tap";
  const auto of = [tap](const CyclePasses& side) {
    std::multiset<std::string> found;
    for (const Event* e : side.events) {
      if (is_motion(e->kind) && e->kind != EventKind::probe) continue;
      if (tap && (e->kind == EventKind::dwell || e->kind == EventKind::spindle)) continue;
      if (e->kind == EventKind::dwell) {
        found.insert("a dwell of " + shortest(e->amount) + (e->revolutions ? " revolutions" : " s"));
      } else if (e->kind == EventKind::comp) {
        if (e->state != "off") found.insert("compensation " + e->state);
      } else if (e->kind == EventKind::spindle) {
        const std::string speed = e->state == "off" ? "" : fmt::format(" {:.3g}", e->value);
        found.insert(fmt::format("spindle {} {}{}", e->number, e->state, speed));
      } else {
        const bool numbered = e->kind == EventKind::m || e->kind == EventKind::tool;
        found.insert(std::string(interpreter::name(e->kind)) + (numbered ? " " + std::to_string(e->number) : "") +
                     (e->kind == EventKind::coolant ? " " + e->state : ""));
      }
    }
    return found;
  };
  const auto there = of(a), here = of(b);
  for (const auto& what : there) {
    if (here.count(what) < there.count(what)) return "the translation's cycle lacks " + what;
  }
  for (const auto& what : here) {
    if (there.count(what) < here.count(what)) return "the translation's cycle has " + what + " besides";
  }
  return {};
}

}  // namespace cnctrans::verifier
