// What stands beside a cycle in its block, and when it acts: before the way to the hole, or behind the hole.
#include <algorithm>

#include "legaliser/cycles/cycle_pass.h"

namespace cnctrans::ir::passes {

void CyclePass::put_group(Body& out, Body&& pieces, std::size_t main) {
  const LineInfo like = pieces[main].line;
  auto* b = main + 1 == pieces.size() ? std::get_if<Block>(&pieces[main].node) : nullptr;
  // A cycle by call runs behind the whole block: a function that acts after the motion would come before the hole.
  const bool events = std::any_of(late_.begin(), late_.end(), [](const Action& a) { return makes_event(a); });
  Block behind;
  auto& late = b != nullptr && !(by_call_ && events) ? b->actions : behind.actions;
  std::move(late_.begin(), late_.end(), std::back_inserter(late));
  std::move(then_.begin(), then_.end(), std::back_inserter(behind.actions));
  late_.clear();
  then_.clear();
  if (!behind.actions.empty()) pieces.push_back(made(like, std::move(behind)));
  editor_.put_group(out, std::move(pieces), main);
}

std::optional<Block> code_before_cycle(Block& b, const Facts& facts, const LegaliseContext& context) {
  const bool stays = b.has_motion && b.motion.explicit_code && b.motion.keeps_modal && facts.motion != b.motion.kind;
  const bool bare = b.has_motion && !b.motion.moves();
  const bool target_rapid = context.target_machine.policies.cycle_positioning == machine::CyclePositioning::rapid;
  if (!target_rapid || context.target.retract_plane_switch) return std::nullopt;
  if (bare && !stays) b.has_motion = false;  // it is in force
  if (!stays) return std::nullopt;
  if (!bare && b.motion.kind != MotionKind::rapid) return std::nullopt;
  Block code;
  code.has_motion = true;
  code.motion.kind = b.motion.kind;
  code.motion.explicit_code = true;
  by_itself(b);
  if (bare) b.has_motion = false;
  return code;
}

}  // namespace cnctrans::ir::passes
