// Pockets, slots and long holes.
#include <algorithm>
#include <cmath>

#include "ir/cycles/milling/mill_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

/// Where the tool's middle may go: a rounded rectangle, half sizes and corner; a >= b.
struct Area {
  double a = 0, b = 0, c = 0;
  [[nodiscard]] Area less(double by) const { return {a - by, b - by, std::max(0.0, c - by)}; }
  [[nodiscard]] bool line() const { return b < least_mm; }
};

/// Along the middle line from `from` (-1 or 1: its end; 0: its middle), then round in equal steps not above `step`.
void clear(MillPath& path, const Area& area, double step, bool ccw, double from) {
  const double half = area.a - area.b;
  if (half > least_mm) {
    if (from == 0) path.mill(-half, 0);
    path.mill(from == 0 ? half : -from * half, 0);
  }
  if (area.line()) return;
  const double width = area.b;
  const auto rounds = path.times(width / step);
  for (long k = 1; k <= rounds; ++k) {
    const double out = width * static_cast<double>(rounds - k) / static_cast<double>(rounds);
    const Area ring = area.less(out);
    path.mill(ring.a, 0);
    round_rectangle(path, ring.a, ring.b, ring.c, ccw);
  }
}

/// Once round along the wall, in and out on a quarter circle. The tool stands where `entry` says.
struct Entry {
  double p, q;
};
double entry_radius(const MillPath& path, const Area& area) {
  return std::min(path.tool_radius(), area.b);
}
Entry entry(const MillPath& path, const Area& area, bool ccw) {
  const double r = entry_radius(path, area);
  return {area.a - r, ccw ? -r : r};
}
void wall(MillPath& path, const Area& area, bool ccw) {
  const double r = entry_radius(path, area);
  if (area.line()) {
    path.mill(area.b - area.a, 0);
    path.mill(area.a - area.b, 0);
    return;
  }
  path.mill_arc(area.a, 0, area.a - r, 0, ccw);
  round_rectangle(path, area.a, area.b, area.c, ccw);
  path.mill_arc(area.a - r, ccw ? r : -r, area.a - r, 0, ccw);
}

/// From the level where the tool stands down to `w`.
bool go_down(MillPath& path, Plunge way, const Area& area, double w, bool ccw, std::string* error) {
  const double depth = std::abs(path.height() - w);
  switch (way) {
    case Plunge::rapid: path.rapid_to(w); return true;
    case Plunge::feed: path.plunge(w); return true;
    case Plunge::helix: {
      const double r = path.get("plunge_radius"), pitch = path.get("plunge_pitch");
      if (r <= 0 || pitch <= 0) return *error = "the helix into the pocket needs its radius and its pitch", false;
      if (r > area.b + least_mm) return *error = "the helix into the pocket is larger than the pocket", false;
      path.mill(r, 0);
      const double top = path.height();
      const long turns = depth < least_mm ? 0 : path.times(depth / pitch);
      for (long k = 1; k <= turns; ++k)
        path.plunge_circle(0, 0, top + (w - top) * static_cast<double>(k) / static_cast<double>(turns), ccw);
      path.plunge_circle(0, 0, w, ccw);
      path.mill(0, 0);
      return true;
    }
    case Plunge::ramp: {
      const double angle = path.get("plunge_radius");
      if (angle <= 0 || angle >= 90)
        return *error = "the ramp into the pocket needs an angle from 0 to 90 degrees", false;
      const double half = std::max(area.a - area.b, area.a / 2);
      if (half < least_mm) return *error = "the pocket is too small for a ramp", false;
      path.mill(-half, 0);
      const double top = path.height(), most = 2 * half * std::tan(angle * radians);
      const long strokes = depth < least_mm ? 0 : path.times(depth / most);
      double side = 1;
      for (long k = 1; k <= strokes; ++k, side = -side)
        path.plunge_to(side * half, 0, top + (w - top) * static_cast<double>(k) / static_cast<double>(strokes));
      path.mill(side * half, 0);
      path.mill(0, 0);
      return true;
    }
  }
  return true;
}

struct PocketPlan {
  Area finished;  ///< along the finished wall
  double wall = 0, floor = 0;
  double each = 0;  ///< of `wall`: taken by a pass on every level
  double step = 0;
  bool ccw = true;
  Operation operation = Operation::rough;
  Plunge way = Plunge::feed;
  double start = 0;  ///< on the middle line: 0 its middle, -1 its end
};

double start_of(const PocketPlan& plan, const Area& area) {
  return plan.start * (area.a - area.b);
}

bool rough(MillPath& path, const PocketPlan& plan, std::string* error) {
  const Area area = plan.finished.less(plan.wall + plan.each);
  const auto& n = path.levels();
  const auto depths = path.depths(n.surface, n.bottom + n.up * plan.floor);
  bool from_far_end = false;
  for (std::size_t k = 0; k < depths.size(); ++k) {
    if (!go_down(path, plan.way, area, depths[k], plan.ccw, error)) return false;
    const bool to_and_fro = plan.start != 0 && area.line();
    clear(path, area, plan.step, plan.ccw, from_far_end ? 1 : plan.start);
    if (to_and_fro) {
      from_far_end = !from_far_end;
      continue;
    }
    if (plan.each > 0) {
      path.finishing(true);
      const Area last = plan.finished.less(plan.wall);
      path.mill(last.a, 0);
      round_rectangle(path, last.a, last.b, last.c, plan.ccw);
      path.finishing(false);
    }
    path.rapid(start_of(plan, area), 0);
    if (k + 1 < depths.size()) path.rapid_to(depths[k] + n.up * level_lift);
  }
  return true;
}

void finish(MillPath& path, const PocketPlan& plan) {
  const auto& n = path.levels();
  const Area& area = plan.finished;
  path.finishing(true);
  if (plan.floor > 0) {
    const Area inside = area.less(plan.wall);
    path.rapid_to(n.reference);
    path.rapid(start_of(plan, inside), 0);
    path.plunge(n.bottom);
    clear(path, inside, plan.step, plan.ccw, plan.start);
  }
  path.rapid_to(n.reference);
  const bool own = path.says("finish_infeed") || plan.operation == Operation::complete;
  const auto depths =
      own ? path.depths(n.surface, n.bottom, path.get("finish_infeed"), true) : path.depths(n.surface, n.bottom);
  const Entry at = area.line() ? Entry{area.a - area.b, 0} : entry(path, area, plan.ccw);
  for (std::size_t k = 0; k < depths.size(); ++k) {
    path.rapid(at.p, at.q);
    path.plunge(depths[k]);
    wall(path, area, plan.ccw);
    if (k + 1 < depths.size()) path.rapid_to(depths[k] + n.up * level_lift);
  }
  path.rapid_to(n.reference);
  path.rapid(start_of(plan, area), 0);
  path.finishing(false);
}

bool machine(MillPath& path, const PocketPlan& plan, std::string* error) {
  if (plan.operation != Operation::finish && !rough(path, plan, error)) return false;
  const bool left = plan.wall > 0 || plan.floor > 0;
  if (plan.operation == Operation::finish || (plan.operation == Operation::complete && left)) finish(path, plan);
  return true;
}

/// Stocks, step, sense and kind of machining, as all shapes have them.
bool read_plan(MillPath& path, PocketPlan& plan, std::string* error) {
  plan.wall = std::abs(path.get("wall_stock"));
  plan.floor = std::abs(path.get("floor_stock"));
  plan.each = std::abs(path.get("wall_pass"));
  plan.step = path.step(usual_step, error);
  plan.ccw = path.inside_ccw(error);
  plan.operation = path.operation(error);
  if (!error->empty()) return false;
  const Area rough = plan.finished.less(plan.wall + plan.each);
  if (rough.b < -least_mm) return *error = "the tool is too large for the shape and its allowance", false;
  for (const auto* blank : {"blank_length", "blank_width", "blank_depth"}) {
    if (path.says(blank)) return *error = "a pocket that is partly there already is not carried out yet", false;
  }
  return true;
}

void count_angles(const MillPath& path, double& step, long& count) {
  count = std::lround(path.get("count", 1));
  step = path.get("angle_step");
  if (step == 0 && count > 0) step = 360.0 / static_cast<double>(count);
}

}  // namespace

bool pocket(MillPath& path, bool circle, std::string* error) {
  const double r = path.tool_radius();
  double a = path.says("half_length") ? std::abs(path.get("half_length")) : std::abs(path.get("length")) / 2;
  double b = path.says("half_width") ? std::abs(path.get("half_width")) : std::abs(path.get("width")) / 2;
  double corner = std::abs(path.get("corner"));
  if (circle) a = b = corner = std::abs(path.get(path.says("signed_radius") ? "signed_radius" : "radius"));
  if (a < least_mm || b < least_mm) return *error = "a pocket needs its size", false;
  if (corner > 0 && corner < r - least_mm) return *error = "the tool is larger than the corners of the pocket", false;
  if (corner > std::min(a, b) + least_mm) return *error = "the corners of the pocket are larger than the pocket", false;
  double angle = circle ? 0 : path.get("angle");
  if (b > a) {  // the middle line lies along the longer side
    std::swap(a, b);
    angle += 90;
  }
  PocketPlan plan;
  plan.finished = {a - r, b - r, std::max(0.0, corner - r)};
  plan.way = path.plunge_way();
  if (!read_plan(path, plan, error)) return false;
  const auto [u, v] = path.place();
  path.frame(u, v, angle);
  path.approach(0, 0);
  if (!machine(path, plan, error)) return false;
  path.retract();
  return true;
}

bool slots(MillPath& path, std::string* error) {
  const double r = path.tool_radius();
  const double length = std::abs(path.get("length")), width = std::abs(path.get("width"));
  if (length < width - least_mm || width < least_mm)
    return *error = "a slot needs a width, and is not shorter than wide", false;
  PocketPlan plan;
  plan.start = -1;
  plan.finished = {length / 2 - r, width / 2 - r, width / 2 - r};
  if (!read_plan(path, plan, error)) return false;
  double step = 0;
  long count = 0;
  count_angles(path, step, count);
  const auto [u, v] = path.place();
  const double middle = std::abs(path.get("radius")) + length / 2;
  for (long k = 0; k < count; ++k) {
    const double angle = path.get("angle") + static_cast<double>(k) * step;
    path.frame(u, v, angle);
    path.frame_along(middle);
    const double at = -(length - width) / 2;
    if (k == 0)
      path.approach(at, 0);
    else
      path.rapid(at, 0);
    if (!machine(path, plan, error)) return false;
    path.rapid_to(path.levels().reference);
  }
  path.retract();
  return count > 0 || (*error = "the number of slots is not at least 1", false);
}

bool long_holes(MillPath& path, std::string* error) {
  const double r = path.tool_radius();
  const double length = std::abs(path.get("length"));
  if (length < 2 * r - least_mm) return *error = "the long hole is shorter than the tool is wide", false;
  double step = 0;
  long count = 0;
  count_angles(path, step, count);
  if (count < 1) return *error = "the number of long holes is not at least 1", false;
  const auto [u, v] = path.place();
  const auto& n = path.levels();
  const auto depths = path.depths(n.surface, n.bottom);
  const double half = length / 2 - r;
  for (long k = 0; k < count; ++k) {
    path.frame(u, v, path.get("angle") + static_cast<double>(k) * step);
    path.frame_along(std::abs(path.get("radius")) + length / 2);
    double end = path.local().first > least_mm ? half : -half;  // the nearer one
    if (k == 0)
      path.approach(end, 0);
    else
      path.rapid(end, 0);
    for (const double w : depths) {
      path.plunge(w);
      end = -end;
      path.mill(end, 0);
    }
    path.rapid_to(n.reference);
  }
  path.retract();
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
