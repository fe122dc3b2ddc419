// Slots along a circle.
#include <algorithm>
#include <cmath>

#include "ir/cycles/milling/mill_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

/// One slot: the frame's origin is the middle of the circle, its first axis points to the beginning of the slot.
struct RingSlot {
  double radius = 0, opening = 0;  ///< of the middle line; degrees
  struct Place {
    double p, q;
  };
  [[nodiscard]] Place at(double r, double degrees) const {
    return {r * std::cos(degrees * radians), r * std::sin(degrees * radians)};
  }
};

/// Once round at the distance `out` from the middle line, from the outer side of the slot's end.
void round(MillPath& path, const RingSlot& ring, double out, bool ccw) {
  const auto end = ring.at(ring.radius, ring.opening), begin = ring.at(ring.radius, 0);
  const auto inner_end = ring.at(ring.radius - out, ring.opening), outer_end = ring.at(ring.radius + out, ring.opening);
  const auto inner_begin = ring.at(ring.radius - out, 0), outer_begin = ring.at(ring.radius + out, 0);
  if (ccw) {
    path.mill_arc(inner_end.p, inner_end.q, end.p, end.q, true);
    path.mill_arc(inner_begin.p, inner_begin.q, 0, 0, false);
    path.mill_arc(outer_begin.p, outer_begin.q, begin.p, begin.q, true);
    path.mill_arc(outer_end.p, outer_end.q, 0, 0, true);
    return;
  }
  path.mill_arc(outer_begin.p, outer_begin.q, 0, 0, false);
  path.mill_arc(inner_begin.p, inner_begin.q, begin.p, begin.q, false);
  path.mill_arc(inner_end.p, inner_end.q, 0, 0, true);
  path.mill_arc(outer_end.p, outer_end.q, end.p, end.q, false);
}

/// In and out on quarter circles beside the outer side of the slot's end. `side` -1: before the wall, 1: behind it.
RingSlot::Place beside(const RingSlot& ring, double out, double r, bool ccw, int side) {
  const double turn = ring.opening * radians, along = (ccw ? side : -side) * r;
  const double radial = ring.radius + out - r;
  return {radial * std::cos(turn) - along * std::sin(turn), radial * std::sin(turn) + along * std::cos(turn)};
}
void wall(MillPath& path, const RingSlot& ring, double out, bool ccw) {
  const double r = std::min(path.tool_radius(), out);
  const auto end = ring.at(ring.radius + out, ring.opening), centre = ring.at(ring.radius + out - r, ring.opening);
  path.mill_arc(end.p, end.q, centre.p, centre.q, ccw);
  round(path, ring, out, ccw);
  const auto away = beside(ring, out, r, ccw, 1);
  path.mill_arc(away.p, away.q, centre.p, centre.q, ccw);
}

/// Along the middle line from one end to the other.
void along(MillPath& path, const RingSlot& ring, bool backwards) {
  const auto to = ring.at(ring.radius, backwards ? 0 : ring.opening);
  path.mill_arc(to.p, to.q, 0, 0, !backwards);
}

void rough(MillPath& path, const RingSlot& ring, double out, double step, bool ccw) {
  const auto& n = path.levels();
  const auto begin = ring.at(ring.radius, 0);
  const auto depths = path.depths(n.surface, n.bottom);
  bool backwards = false;
  for (std::size_t k = 0; k < depths.size(); ++k) {
    path.plunge(depths[k]);
    along(path, ring, backwards);
    if (out < least_mm) {
      backwards = !backwards;
      continue;
    }
    const auto rounds = path.times(out / step);
    for (long i = 1; i <= rounds; ++i) {
      const double w = out * static_cast<double>(i) / static_cast<double>(rounds);
      const auto to = ring.at(ring.radius + w, ring.opening);
      path.mill(to.p, to.q);
      round(path, ring, w, ccw);
    }
    path.rapid_to(n.reference);  // a straight way back would cross the inner wall
    if (k + 1 == depths.size()) continue;
    path.rapid(begin.p, begin.q);
    path.rapid_to(depths[k] + n.up * level_lift);
  }
}

void finish(MillPath& path, const RingSlot& ring, double out, bool ccw) {
  const auto& n = path.levels();
  path.finishing(true);
  path.rapid_to(n.reference);
  const auto depths = path.depths(n.surface, n.bottom, path.get("finish_infeed"), true);
  const auto at = out < least_mm ? ring.at(ring.radius, ring.opening)
                                 : beside(ring, out, std::min(path.tool_radius(), out), ccw, -1);
  for (std::size_t k = 0; k < depths.size(); ++k) {
    path.rapid(at.p, at.q);
    path.plunge(depths[k]);
    if (out < least_mm) {
      along(path, ring, true);
      along(path, ring, false);
    } else {
      wall(path, ring, out, ccw);
    }
    if (k + 1 < depths.size()) path.rapid_to(depths[k] + n.up * level_lift);
  }
  path.finishing(false);
}

}  // namespace

bool ring_slots(MillPath& path, std::string* error) {
  const double width = std::abs(path.get("width")), stock = std::abs(path.get("wall_stock"));
  const double out = width / 2 - path.tool_radius();
  const Operation operation = path.operation(error);
  const bool ccw = path.inside_ccw(error);
  const double step = path.step(usual_step, error);
  if (!error->empty()) return false;
  if (out - stock < -least_mm) return *error = "the tool is too large for the slot and its allowance", false;
  const RingSlot ring{std::abs(path.get("radius")), std::abs(path.get("opening"))};
  if (ring.radius <= width / 2 + least_mm) return *error = "the slot is wider than its circle", false;
  if (ring.opening <= 0 || ring.opening >= 360) return *error = "a slot on a circle needs its opening angle", false;
  const auto count = std::lround(path.get("count", 1));
  if (count < 1) return *error = "the number of slots is not at least 1", false;
  const double turn = path.says("angle_step") ? path.get("angle_step") : 360.0 / static_cast<double>(count);
  const auto [u, v] = path.place();
  const auto begin = ring.at(ring.radius, 0);
  for (long k = 0; k < count; ++k) {
    path.frame(u, v, path.get("angle") + static_cast<double>(k) * turn);
    if (k == 0)
      path.approach(begin.p, begin.q);
    else
      path.rapid(begin.p, begin.q);
    if (operation != Operation::finish) rough(path, ring, std::max(0.0, out - stock), step, ccw);
    if (operation == Operation::finish || (operation == Operation::complete && stock > 0))
      finish(path, ring, std::max(0.0, out), ccw);
    path.rapid_to(path.levels().reference);
  }
  path.retract();
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
