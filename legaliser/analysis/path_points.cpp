#include "legaliser/analysis/path_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "legaliser/analysis/words.h"

namespace cnctrans::ir::passes {

using namespace geometry;

namespace {

/// Noise of the arithmetic far below the last place of any control.
double rounded_off(double v) {
  const double r = std::round(v * 1e9) / 1e9;
  return r == 0 ? 0 : r;
}

/// Of the words that only some motions need: those of a plain element of a contour, which its points say as well.
bool only_element_words(const MotionExtra& x) {
  return !x.has_turns && !x.has_pitch && !x.has_polar_radius && !x.has_polar_angle && !x.has_lead &&
         !x.has_start_angle && !x.has_probe_edge && !x.has_fixed_point && x.computed.empty() && x.polynomials.empty() &&
         !x.has_interval && !x.has_weight && !x.has_degree;
}

/// A line by its angle: the coordinate that the block does not name. False: not in numbers.
bool end_by_angle(const Motion& m, const PlaneAxes& axes, Element& e) {
  const auto names = [&m](AxisId axis) {
    return std::any_of(m.coords.begin(), m.coords.end(), [axis](const CoordWord& c) { return c.axis == axis; });
  };
  const bool has_u = names(axes.u);
  if (!m.extra->line_angle.literal() || has_u == names(axes.v)) return false;
  const double turns = m.extra->line_angle.number / 180 * std::numbers::pi;
  const double along = has_u ? std::cos(turns) : std::sin(turns), across = has_u ? std::sin(turns) : std::cos(turns);
  if (std::fabs(along) < 1e-9) return false;
  if (has_u)
    e.b.v = rounded_off(e.a.v + (e.b.u - e.a.u) * across / along);
  else
    e.b.u = rounded_off(e.a.u + (e.b.v - e.a.v) * across / along);
  return true;
}

}  // namespace

std::optional<Path> PathPoints::path_of(const Statement& s, bool by_three) const {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || !b->has_motion || b->motion.frame != FrameUse::normal ||
      (b->motion.extra && !only_element_words(*b->motion.extra)))
    return std::nullopt;
  const Facts& facts = facts_.before(s);
  const auto plane = setting_in<Plane>(*b, facts, Setting::plane);
  const auto kind = motion_in(*b, facts);
  if (!plane || !kind) return std::nullopt;
  const auto axes = plane_axes(*plane);
  auto u = facts.position[axes.u], v = facts.position[axes.v];
  if (const auto cut = starts_.find(s.id); cut != starts_.end() && s.id != 0) u = cut->second.u, v = cut->second.v;
  if (!u || !v) return std::nullopt;
  Path path{*plane, {false, {*u, *v}, {*u, *v}, {}, false}};
  for (const auto& c : b->motion.coords) {
    if (c.axis != axes.u && c.axis != axes.v) continue;
    const auto d = distance_of(c, *b, facts);
    const auto f = to_radius(c.axis, c.scale, d, *b, facts, context_.source_machine);
    if (!d || !f || !c.value.literal()) return std::nullopt;
    double& to = c.axis == axes.u ? path.e.b.u : path.e.b.v;
    to = c.value.number * *f + (*d == Distance::incremental ? to : 0);
  }
  const bool line = *kind == MotionKind::linear || *kind == MotionKind::rapid;
  const MotionExtra* extra = b->motion.extra.get();
  if (extra != nullptr && line)
    return extra->has_line_angle && end_by_angle(b->motion, axes, path.e) ? std::optional(path) : std::nullopt;
  if (line) return path;
  path.e.arc = true;
  if (*kind == MotionKind::arc_through_point && extra != nullptr && by_three) {
    const auto middle = through(*b, facts, axes, path.e.a);
    return middle && centre_by_three_points(path.e.a, *middle, path.e.b, path.e.c, path.e.ccw) ? std::optional(path)
                                                                                               : std::nullopt;
  }
  if (*kind != MotionKind::arc_cw && *kind != MotionKind::arc_ccw) return std::nullopt;
  path.e.ccw = *kind == MotionKind::arc_ccw;
  if (extra != nullptr) {
    const double sweep = std::fabs(extra->opening_angle.number);
    if (!extra->has_angle || !extra->opening_angle.literal() || !b->motion.centers.empty() || b->motion.radius_given ||
        sweep < 1e-6 || sweep > 359.999)
      return std::nullopt;
    const double radius = length(path.e.b - path.e.a) / (2 * std::sin(sweep / 360 * std::numbers::pi));
    const auto c = centre_by_radius(path.e.a, path.e.b, sweep > 180 ? -radius : radius, path.e.ccw, long_chord);
    if (c) path.e.c = *c;
    return c ? std::optional(path) : std::nullopt;
  }
  if (b->motion.radius_given) {
    if (!b->motion.radius.literal()) return std::nullopt;
    const auto c = centre_by_radius(path.e.a, path.e.b, b->motion.radius.number, path.e.ccw, long_chord);
    if (!c) return std::nullopt;
    path.e.c = *c;
    return path;
  }
  if (b->motion.centers.empty()) return std::nullopt;
  path.e.c = path.e.a;
  const auto distance = setting_in<Distance>(*b, facts, Setting::distance);
  for (const auto& w : b->motion.centers) {
    const bool relative = w.mode == CenterMode::from_start ||
                          (w.mode == CenterMode::follows_distance && distance == Distance::incremental);
    const auto f = to_radius(w.axis, w.scale, relative ? Distance::incremental : Distance::absolute, *b, facts,
                             context_.source_machine);
    if (!f || !w.value.literal() || (w.mode == CenterMode::follows_distance && !distance)) return std::nullopt;
    double& c = w.axis == axes.u ? path.e.c.u : path.e.c.v;
    c = w.value.number * *f + (relative ? c : 0);
  }
  return path;
}

std::optional<Vec> PathPoints::through(const Block& b, const Facts& facts, const PlaneAxes& axes, Vec start) const {
  const auto distance = setting_in<Distance>(b, facts, Setting::distance);
  Vec middle = start;
  for (const auto& w : b.motion.extra->through) {
    if (w.axis != axes.u && w.axis != axes.v) return std::nullopt;
    const bool relative = w.mode == CenterMode::from_start ||
                          (w.mode == CenterMode::follows_distance && distance == Distance::incremental);
    const auto f = to_radius(w.axis, w.scale, relative ? Distance::incremental : Distance::absolute, b, facts,
                             context_.source_machine);
    if (!f || !w.value.literal() || (w.mode == CenterMode::follows_distance && !distance)) return std::nullopt;
    double& c = w.axis == axes.u ? middle.u : middle.v;
    c = w.value.number * *f + (relative ? c : 0);
  }
  return middle;
}

void PathPoints::set_end(Motion& m, Plane plane, Vec to) const {
  const auto axes = plane_axes(plane);
  for (const auto& [axis, value] : {std::pair{axes.u, to.u}, std::pair{axes.v, to.v}}) {
    auto it =
        std::find_if(m.coords.begin(), m.coords.end(), [axis = axis](const CoordWord& c) { return c.axis == axis; });
    if (it == m.coords.end()) it = m.coords.insert(m.coords.end(), CoordWord{});
    it->axis = axis;
    it->value = Value{rounded_off(value)};
    it->mode = WordMode::absolute;
    it->scale = is_diameter_axis(context_.source_machine, axis) ? WordScale::radius : WordScale::modal;
    it->pos = {};
  }
  if (m.extra && only_element_words(*m.extra)) m.extra = nullptr;  // the points say it now
}

void PathPoints::set_centre(Motion& m, Plane plane, Vec from, Vec centre) {
  const auto axes = plane_axes(plane);
  m.radius_given = false;
  m.radius = Value{};
  m.centers.clear();
  for (const auto& [axis, value] : {std::pair{axes.u, centre.u - from.u}, std::pair{axes.v, centre.v - from.v}}) {
    CenterWord w;
    w.axis = axis;
    w.mode = CenterMode::from_start;
    w.scale = WordScale::radius;
    w.value = Value{rounded_off(value)};
    m.centers.push_back(w);
  }
}

bool moves_frames(const Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    return std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data);
  });
}

}  // namespace cnctrans::ir::passes
