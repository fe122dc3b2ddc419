// The height from which a cycle starts, where the controls go another way to its planes.
#include "ir/passes/cycle_pass.h"

namespace cnctrans::ir::passes {

bool comes_in_two_moves(const CyclePtr& native, const LegaliseContext& context) {
  const auto* hole = native ? std::get_if<HoleCycle>(&native->node) : nullptr;
  return hole != nullptr && context.target.retract_plane_switch && hole->retract.given &&
         !(hole->retract.base == hole->reference.base && equal(hole->retract.value, hole->reference.value));
}

std::optional<Block> code_before_cycle(Block& b, const Facts& facts, const LegaliseContext& context) {
  const bool own_code = b.has_motion && b.motion.kind == MotionKind::rapid && b.motion.explicit_code &&
                        b.motion.keeps_modal && facts.motion != MotionKind::rapid;
  const bool target_rapid = context.target_machine.option("cycle.positioning") == "rapid";
  if (!own_code || !target_rapid || context.target.retract_plane_switch) return std::nullopt;
  Block code;
  code.has_motion = true;
  code.motion.kind = MotionKind::rapid;
  code.motion.explicit_code = true;
  by_itself(b);
  return code;
}

bool CyclePass::below_retract_plane(const Block& b, const Facts& facts) const {
  const auto* hole = std::get_if<HoleCycle>(&active_->native->node);
  const auto height = in_units(active_->height, b, facts);
  if (hole == nullptr || !height || !hole->retract.given) return false;
  const auto fixed = [](const Level& l) { return l.base == LevelBase::absolute && l.value.literal(); };
  if (!fixed(hole->retract) || !fixed(hole->reference) || !stands_by_itself(*hole)) return false;
  const double retract = hole->retract.value.number, reference = hole->reference.value.number;
  const double to = fixed(hole->bottom) ? hole->bottom.value.number : reference;
  const double up = retract > to ? 1 : -1;
  return (retract - *height) * up > 1e-9 && (retract - reference) * up > 1e-9;
}

/// A single run whose retract plane is not the height it starts from: the target's cycle would go there first. It
/// returns to the reference plane instead, and the rest is a move of its own. The place to go to; empty: as it is.
std::optional<Value> CyclePass::leave_by_own_move(CyclePtr& cycle, const Active& a) const {
  const auto* hole = std::get_if<HoleCycle>(&cycle->node);
  if (hole == nullptr || !hole->retract.given || hole->retract.base != LevelBase::absolute ||
      hole->reference.base != LevelBase::absolute || equal(hole->retract.value, hole->reference.value))
    return std::nullopt;
  if (!hole->retract.value.literal() || a.height == hole->retract.value.number) return std::nullopt;
  HoleCycle low = *hole;
  low.retract = low.reference;
  for (const bool approach : {low.approach_by_retract, !low.approach_by_retract}) {
    low.approach_by_retract = approach;
    auto made = std::make_shared<Cycle>();
    made->node = low;
    if (!context_.target.native_cycle(*made)) continue;
    const Value to = hole->retract.value;
    cycle = std::move(made);
    return to;
  }
  return std::nullopt;
}

}  // namespace cnctrans::ir::passes
