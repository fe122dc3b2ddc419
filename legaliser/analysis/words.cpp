#include "legaliser/analysis/words.h"

#include <algorithm>

namespace cnctrans::ir::passes {

std::optional<double> to_radius(AxisId axis, WordScale scale, std::optional<Distance> distance, const Block& b,
                                const Facts& facts, const machine::Profile& machine) {
  if (scale == WordScale::diameter) return 0.5;  // said by the word itself, on any axis
  if (scale == WordScale::radius || !is_diameter_axis(machine, axis)) return 1;
  const auto mode = setting_in<DiameterMode>(b, facts, Setting::diameter);
  if (!mode) return std::nullopt;
  switch (*mode) {
    case DiameterMode::radius: return 1;
    case DiameterMode::diameter: return 0.5;
    case DiameterMode::absolute_only: break;
  }
  if (!distance) return std::nullopt;
  return *distance == Distance::absolute ? 0.5 : 1;
}

std::optional<std::vector<CoordWord>> absolute_words(const Block& b, const Facts& facts,
                                                     const machine::Profile& machine,
                                                     const std::function<std::optional<double>(AxisId)>& base) {
  if (b.motion.extra || b.motion.frame != FrameUse::normal || b.repeat_given != 0) return std::nullopt;
  for (const auto& c : b.motion.centers) {
    if (c.mode == CenterMode::follows_distance) return std::nullopt;
  }
  std::vector<CoordWord> coords = b.motion.coords;
  for (auto& c : coords) {
    const auto d = distance_of(c, b, facts);
    if (!d) return std::nullopt;
    c.mode = WordMode::absolute;
    if (*d == Distance::absolute) continue;
    const auto at = base(c.axis);
    const auto from = to_radius(c.axis, c.scale, d, b, facts, machine);
    const auto to = to_radius(c.axis, WordScale::modal, Distance::absolute, b, facts, machine);
    if (!at || !from || !to) return std::nullopt;
    c.value = scale(add(Value{*at}, scale(c.value, *from)), 1 / *to);
    c.value.text = {};
    c.scale = WordScale::modal;
  }
  return coords;
}

bool table_row(const FrameChange& c) {
  return !c.words.empty() && std::all_of(c.words.begin(), c.words.end(), [](const FrameWord& w) {
    const auto* datum = w.value.expr ? std::get_if<SystemRef>(&w.value.expr->node) : nullptr;
    return w.pos.column == 0 && datum != nullptr && datum->datum == Datum::work_offset;
  });
}

std::optional<Plane> plane_of_words(const Motion& m) {
  if (m.centers.size() != 2) return std::nullopt;
  for (const auto plane : {Plane::xy, Plane::zx, Plane::yz}) {
    const PlaneAxes axes = plane_axes(plane);
    const AxisId a = m.centers[0].axis, b = m.centers[1].axis;
    if ((a == axes.u && b == axes.v) || (a == axes.v && b == axes.u)) return plane;
  }
  return std::nullopt;
}

std::optional<Value> at_run(const LegaliseContext& context, Datum datum, AxisId axis) {
  SystemRef here;
  here.datum = datum;
  here.axis = axis;
  if (!context.target.system_data || !context.target.system_data(here)) return std::nullopt;
  Expr e;
  e.node = std::move(here);
  return Value{std::make_shared<const Expr>(std::move(e))};
}

bool positions_alone(const Block& b) {
  return b.has_motion && !b.motion.coords.empty() && b.motion.centers.empty() && !b.motion.extra &&
         b.motion.frame == FrameUse::normal &&
         std::all_of(b.motion.coords.begin(), b.motion.coords.end(),
                     [](const CoordWord& c) { return c.positioning == Positioning::alone; });
}

}  // namespace cnctrans::ir::passes
