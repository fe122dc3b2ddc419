#include "legaliser/motion/said_points.h"

#include <cmath>

#include "legaliser/analysis/words.h"

namespace cnctrans::ir::passes {

namespace {

/// The end in the plane follows from other words than the coordinates.
bool ends_by_angle(const Motion& m) {
  return m.extra &&
         (m.extra->has_line_angle || m.extra->has_polar_radius || m.extra->has_polar_angle || m.extra->has_angle);
}
bool sets_units(const Action& a) {
  const auto* m = std::get_if<ModalSet>(&a.data);
  return m != nullptr && m->setting == Setting::units;
}

}  // namespace

void SaidPoints::transfer(const Statement& s, State& state) const {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr) return;
  const Facts& facts = facts_.before(s);
  for (const auto& a : b->actions) {
    if (sets_units(a)) state = 0;
  }
  if (!b->has_motion || !b->motion.moves()) return;
  const bool inch = setting_in<Units>(*b, facts, Setting::units) == Units::inch;
  const double places = std::pow(10, inch ? target_.word_decimals_inch : target_.word_decimals);
  const auto on_grid = [places](double v) { return std::fabs(v * places - std::round(v * places)) < 1e-6; };
  if (ends_by_angle(b->motion)) {
    const auto plane = setting_in<Plane>(*b, facts, Setting::plane);
    const PlaneAxes axes = plane_axes(plane.value_or(Plane::xy));
    state = plane ? state & ~(1U << axes.u | 1U << axes.v) : 0;
  }
  for (const auto& w : b->motion.coords) {
    if (w.axis >= axis::count_max) continue;
    const bool steps = distance_of(w, *b, facts) != Distance::absolute;
    if (steps && w.value.literal() && on_grid(w.value.number)) continue;
    state = steps || !w.value.literal() ? state & ~(1U << w.axis) : state | 1U << w.axis;
  }
}

bool SaidPoints::touches(const Routine& r) {
  bool found = false;
  for_each_statement(r.body, [&found](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    found = found || (b != nullptr && (b->has_motion || !b->actions.empty()));
  });
  return found;
}

bool SaidPoints::needed(const Program& program) {
  int units = 0;
  bool angles = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      angles = angles || (b->has_motion && ends_by_angle(b->motion));
      for (const auto& a : b->actions) units += sets_units(a) ? 1 : 0;
    });
  }
  return angles || units > 1;
}

}  // namespace cnctrans::ir::passes
