#include "legaliser/technology/mixed_feeds.h"

#include "ir/edit/search.h"
#include "legaliser/analysis/facts.h"

namespace cnctrans::ir::passes {

bool mixed_feeds_differ(const machine::Profile& source, const machine::Profile& target) {
  return source.policies.feed_mixed_axes != target.policies.feed_mixed_axes;
}

bool moves_and_turns(const Block& block, const machine::Profile& machine) {
  bool linear = false, rotary = false;
  for (const auto& c : block.motion.coords) {
    const auto* axis = machine.axis(c.axis);
    if (axis != nullptr) (axis->rotary ? rotary : linear) = true;
  }
  return block.has_motion && linear && rotary;
}

void check_mixed_feeds(Program& program, const LegaliseContext& context) {
  if (!mixed_feeds_differ(context.source_machine, context.target_machine)) return;
  std::optional<FactsOf> facts;
  for (const auto& r : program.routines) {
    const Statement* found = nullptr;
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (found != nullptr || b == nullptr || !moves_and_turns(*b, context.source_machine)) return;
      if (!facts) facts.emplace(program, context);
      const Facts& before = facts->before(s);
      if (motion_in(*b, before) == MotionKind::rapid) return;
      if (setting_in<FeedMode>(*b, before, Setting::feed_mode) == FeedMode::inverse_time) return;
      found = &s;
    });
    if (found == nullptr) continue;
    const bool by_linear = context.source_machine.policies.feed_mixed_axes == machine::FeedMixedAxes::linear;
    context.diagnostics.warning(
        "TRN-655", found->line.span,
        by_linear ? "linear and rotary axes move together: F is the speed of the linear axes here, the target counts "
                    "degrees as millimetres of the way and moves them more slowly (said once a program)"
                  : "linear and rotary axes move together: the degrees count as millimetres of the way here, on the "
                    "target F is the speed of the linear axes alone, which can be many times as fast (said once a "
                    "program)",
        by_linear
            ? "check the feeds, or let F hold for the linear axes alone on the target too (FGROUP, where it has that)"
            : "check the feeds of these moves, or program them in inverse time");
    return;
  }
}

}  // namespace cnctrans::ir::passes
