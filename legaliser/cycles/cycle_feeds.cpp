// Feeds that a cycle names itself, on targets whose cycles go by the F in force.
#include "legaliser/cycles/cycle_pass.h"

namespace cnctrans::ir::passes {

void CyclePass::judge_feedless(Active& a, const Statement& s) const {
  const auto& b = std::get<Block>(s.node);
  const Facts& facts = facts_.before(s);
  const auto mode = setting_in<FeedMode>(b, facts, Setting::feed_mode);
  a.told_feedless =
      a.told_feedless || judge_feedless_tap(*a.source, feeds_.at(s, b, facts), mode, s.line, program_, context_);
}

void CyclePass::feed_for_tap(Block& b, const Active& a) {
  if (!a.needs.feed || by_call_) return;
  std::erase_if(b.actions, [](const Action& x) { return std::holds_alternative<SetFeed>(x.data); });
  b.actions.push_back(action(SetFeed{*a.needs.feed, false}));
  tap_feed_ = true;
}

std::optional<Action> CyclePass::feed_after_tap(const Active& a, const Facts& facts) {
  if (!a.needs.feed || !facts.feed) return std::nullopt;
  return action(SetFeed{Value{*facts.feed}, false});
}

/// Equivalences 22.4: CYCLE85 with one feed for both ways is the target's reaming at that F; the F before comes back.
void CyclePass::feed_as_a_word(Active& a, const Block& b, const Facts& facts) const {
  const auto* hole = std::get_if<HoleCycle>(&a.source->node);
  const bool one = hole != nullptr && hole->kind == HoleKind::ream && hole->has_feed && hole->has_feed_out &&
                   equal(hole->feed, hole->feed_out);
  const bool moves = b.has_motion && b.motion.moves();
  const bool own = action_in<SetFeed>(b) != nullptr;
  if (!one || by_call_ || moves || own || !facts.feed) return;
  HoleCycle plain = *hole;
  plain.has_feed = plain.has_feed_out = false;
  auto made = std::make_shared<Cycle>();
  made->node = std::move(plain);
  const auto native = native_form(made, b, facts, context_, in_units(a.height, b, facts), sense_.now(), nullptr);
  if (!native) return;
  a.native = *native;
  if (!hole->feed.is(*facts.feed)) a.needs.feed = hole->feed;
}

void CyclePass::run_alone(Statement&& run, const Active& a, const Block& way, const Facts& facts, Body& pieces) {
  const LineInfo like = run.line;
  const auto f = [&](const Value& v) { pieces.push_back(make_block(like, action(SetFeed{v, false}))); };
  if (a.needs.feed) f(*a.needs.feed);
  pieces.push_back(std::move(run));
  if (!a.needs.feed) return;
  const auto* own = action_in<SetFeed>(way);
  if (own != nullptr) return f(own->value);
  if (facts.feed) f(Value(*facts.feed));
}

}  // namespace cnctrans::ir::passes
