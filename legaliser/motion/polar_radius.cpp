#include "legaliser/motion/polar_radius.h"

#include <algorithm>

#include "ir/motion_kinds.h"
#include "legaliser/motion/polar_words.h"

namespace cnctrans::ir::passes {

namespace {

/// The pole, or what its place is counted from, changes.
bool moves_pole(const Action& a) {
  const auto* m = std::get_if<ModalSet>(&a.data);
  const auto* d = std::get_if<CycleDefine>(&a.data);
  return std::holds_alternative<PoleSet>(a.data) || std::holds_alternative<FrameOp>(a.data) ||
         std::holds_alternative<WorkOffset>(a.data) || (d != nullptr && !leaves_point(*d)) ||
         (m != nullptr && (m->setting == Setting::plane || m->setting == Setting::units));
}

/// The motion leads away from its place in the plane by other words than polar ones.
bool leaves_place(const Block& b, const Facts& facts) {
  if (b.motion.frame != FrameUse::normal || b.motion.extra || !b.motion.centers.empty() ||
      ends_at_the_machine(b.motion.kind))
    return true;
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  if (!plane) return true;
  const PlaneAxes axes = plane_axes(*plane);
  return std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                     [&](const CoordWord& c) { return c.axis == axes.u || c.axis == axes.v; });
}

}  // namespace

void RadiusDomain::transfer(const Statement& s, State& state) const {
  if (const auto* o = std::get_if<Opaque>(&s.node)) state.same = state.same && o->harmless;
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr) return;
  if (std::any_of(b->actions.begin(), b->actions.end(), moves_pole)) state.same = false;
  if (!b->has_motion || !b->motion.moves()) return;
  const Facts& facts = facts_.before(s);
  const auto& x = b->motion.extra;
  if (written_out_.count(s.id) != 0)
    state.same = false;
  else if (is_polar_line(*b, facts))
    state.same = true;  // the pass says the radius where it has to
  else if (is_polar_arc(*b, facts))
    state.same = b->motion.centers.empty() && polar_absolute(*x, setting_in<Distance>(*b, facts, Setting::distance));
  else if (leaves_place(*b, facts))
    state.same = false;
}

bool RadiusDomain::touches(const Routine& r) {
  bool found = false;
  for_each_statement(r.body, [&found](const Statement& s) {
    found = found || std::holds_alternative<Block>(s.node) || std::holds_alternative<Opaque>(s.node);
  });
  return found;
}

}  // namespace cnctrans::ir::passes
