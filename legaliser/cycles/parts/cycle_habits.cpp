// Habits of cycles: when they run, how they are reached, which words they take.
#include <algorithm>
#include <cmath>

#include "legaliser/cycles/parts/cycle_parts.h"

namespace cnctrans::ir::passes {

CyclePtr with_fixed_bases(const CyclePtr& cycle, std::optional<Distance> distance) {
  const auto* hole = std::get_if<HoleCycle>(&cycle->node);
  if (hole == nullptr || !distance) return cycle;
  HoleCycle h = *hole;
  bool changed = false;
  for (Level* l : {&h.surface, &h.reference, &h.bottom, &h.retract, &h.pecks.first_to}) {
    if (l->base != LevelBase::distance_mode) continue;
    l->base = *distance == Distance::absolute ? LevelBase::absolute : l->otherwise;
    changed = true;
  }
  if (!changed) return cycle;
  auto made = std::make_shared<Cycle>();
  made->node = std::move(h);
  return made;
}
std::optional<double> in_units(std::optional<double> mm, const Block& b, const Facts& facts) {
  const auto units = setting_in<Units>(b, facts, Setting::units);
  if (!mm || !units) return std::nullopt;
  return *units == Units::inch ? *mm / 25.4 : *mm;
}

bool position_only(const Block& b) {
  return b.repeat_given != 0 && b.repeat.is(0);
}

bool runs_old(const Block& b, bool point_here, bool here) {
  Block words;
  words.actions = b.actions;
  const bool moves = b.has_motion && !(b.motion.moves() && here && point_here);  // a bare motion code runs it as well
  return moves || disturbs_call(words);
}

std::optional<MotionKind> way_to_hole(const Block& b, const Facts& facts, const LegaliseContext& context) {
  if (b.motion.kind == MotionKind::modal &&
      context.source_machine.policies.cycle_positioning == machine::CyclePositioning::rapid)
    return MotionKind::rapid;
  return motion_in(b, facts);
}

void position_rapid(Block& b, const LegaliseContext& context) {
  if (context.source_machine.policies.cycle_positioning != machine::CyclePositioning::rapid || !b.has_motion ||
      b.motion.kind != MotionKind::modal)
    return;
  b.motion.kind = MotionKind::rapid;
  b.motion.explicit_code = true;
  b.motion.keeps_modal = false;
}

std::optional<double> height_mm(const Block& b, const Facts& facts, AxisId w) {
  const auto units = setting_in<Units>(b, facts, Setting::units);
  if (!facts.position[w] || !units) return std::nullopt;
  return *facts.position[w] * (*units == Units::inch ? 25.4 : 1);
}

void position_kind(Block& b, const LegaliseContext& context) {
  const bool source_rapid = context.source_machine.policies.cycle_positioning == machine::CyclePositioning::rapid;
  const bool target_rapid = context.target_machine.policies.cycle_positioning == machine::CyclePositioning::rapid &&
                            !context.target.modal_cycle_by_call;
  if (!source_rapid || target_rapid || !b.has_motion) return;
  if (b.motion.kind != MotionKind::modal) return;
  b.motion.kind = MotionKind::rapid;
  b.motion.explicit_code = true;
  b.motion.keeps_modal = false;
}

void by_itself(Block& b) {
  if (b.motion.kind != MotionKind::rapid) return;
  b.motion.kind = MotionKind::modal;
  b.motion.explicit_code = false;
}

bool stands_right(const HoleCycle& c, std::optional<double> height) {
  if (!c.retract.given || (c.retract.base == c.reference.base && equal(c.retract.value, c.reference.value)))
    return true;
  return height && c.retract.base == LevelBase::absolute && c.retract.value.literal() &&
         std::fabs(*height - c.retract.value.number) < 1e-9;
}

std::optional<AxisId> tool_axis(const CyclePtr& cycle, const Block& b, const Facts& facts) {
  const auto* hole = std::get_if<HoleCycle>(&cycle->node);
  return hole != nullptr ? cycle_axis(*hole, b, facts) : std::nullopt;
}

bool moves_along(const Block& b, AxisId w) {
  return b.has_motion &&
         std::any_of(b.motion.coords.begin(), b.motion.coords.end(), [w](const CoordWord& c) { return c.axis == w; });
}

std::optional<double> height_after(const Block& b, const Facts& facts, AxisId w) {
  const auto units = setting_in<Units>(b, facts, Setting::units);
  std::optional<double> height;
  for (const auto& c : b.motion.coords) {
    if (c.axis != w) continue;
    const auto mode = c.mode == WordMode::modal      ? setting_in<Distance>(b, facts, Setting::distance)
                      : c.mode == WordMode::absolute ? std::optional(Distance::absolute)
                                                     : std::nullopt;
    height.reset();
    if (mode == Distance::absolute && units && c.value.literal())
      height = c.value.number * (*units == Units::inch ? 25.4 : 1);
  }
  return height;
}

bool sets_retract_plane(const Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    const auto* m = std::get_if<ModalSet>(&a.data);
    return m != nullptr && m->setting == Setting::retract_plane;
  });
}

}  // namespace cnctrans::ir::passes
