// Patterns under the cycle in force: in the words of the target, as points, or as a loop over them.
#include <algorithm>
#include <utility>

#include "legaliser/cycles/cycle_pass.h"

namespace cnctrans::ir::passes {

void CyclePass::tell_guessed_row(const Statement& s) const {
  context_.diagnostics.warning("TRN-421", s.line.span,
                               "the row begins at its end that is nearer to the tool, and where the tool stands is "
                               "not known here: it is taken to stand at the zero point",
                               "move the tool to a place in the plane before it; the holes are the same, only their "
                               "order may differ");
}

void CyclePass::pattern(Statement&& s, const CycleDefine& d, Body&& pieces, Body& out) {
  auto& b = std::get<Block>(s.node);
  const auto& named = std::get<NamedCycle>(d.cycle->node);
  const Facts& facts = facts_.before(s);
  ran_ = active_;
  const bool plain = !active_ || (active_->native && active_->on_target);
  if (plain) {
    if (auto native = native_pattern(named, b, facts, context_)) {
      b.actions.push_back(action(CycleDefine{*native, false, true, d.trigger}));
      return put(out, std::move(pieces), std::move(s));
    }
  }
  std::string error;
  bool guessed = false;
  const auto w = active_ ? tool_axis(active_->source, b, facts) : std::nullopt;
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  if (w && plane && *w != plane_axes(*plane).w) error = "its points lie along the axis of the tool, not across it";
  const bool across = error.empty();
  auto points = across ? pattern_blocks(named, s.line, b, facts, &guessed, &error) : std::nullopt;
  if (!points && error.empty()) {
    if (auto loop = pattern_loop(named, s.line, b, facts, editor_, &error)) {
      if (loop->guessed) tell_guessed_row(s);
      return pattern_as_loop(std::move(s), std::move(*loop), std::move(pieces), out);
    }
  }
  if (!points) {
    refuse(s, program_, context_, "TRN-330", "a pattern that the target lacks can't be written out: " + error,
           "give the pattern's words and the place before it as numbers");
    out.push_back(std::move(s));
    return;
  }
  // The cycle is another program part's: a way of its own to a point would run it in between.
  const bool own_ways = std::any_of(points->begin(), points->end(), [](const Statement& p) {
    const auto* block = std::get_if<Block>(&p.node);
    return block != nullptr && !block->actions.empty();
  });
  if (!active_ && own_ways && facts.reachable && (facts.cycle_active || !facts.cycle_active_known)) {
    refuse_other_ways(s);
    out.push_back(std::move(s));
    return;
  }
  if (guessed) tell_guessed_row(s);
  balance_increments(*points, s, b, facts, context_);
  const auto id = s.id;
  const LineInfo like = s.line;
  const FeedBefore feed = feeds_.at(s, b, facts);
  const bool bare = b.empty();
  if (!bare || points->empty()) put(out, std::move(pieces), std::move(s));
  bool first = bare;
  for (auto& p : *points) {
    p.id = id;
    if (first) p.line = like;
    Body before;
    if (first) before = std::move(pieces);
    first = false;
    if (!way_by_itself(p, feed, before)) return;
    if (active_)
      point(std::move(p), std::move(before), out);
    else
      put(out, std::move(before), std::move(p));
  }
}

/// A way at a feed of its own goes before the point, with the target's cycle off: at the point the feed of before
/// counts again, for the hole as well. False: that feed is not known, which is reported.
bool CyclePass::way_by_itself(Statement& p, const FeedBefore& feed, Body& before) {
  auto& b = std::get<Block>(p.node);
  if (b.actions.empty()) return true;
  if (!feed.value && !feed.none) {
    refuse(
        p, program_, context_, "TRN-330",
        "a pattern that the target lacks can't be written out: the feed after the pattern's own one is not known here",
        "write F before it");
    return false;
  }
  LineInfo like;
  like.span = p.line.span;
  like.skip_mask = p.line.skip_mask;
  const bool on = active_ && (active_->on_target || active_->maybe_on_target);
  if (on) before.push_back(off_statement(like, by_call_));
  if (on && !by_call_) active_->on_target = active_->maybe_on_target = false;
  Block way = b;
  std::get<SetFeed>(way.actions.front().data).block_only = false;
  before.push_back(made(like, std::move(way)));
  if (feed.value) before.push_back(made(like, Block{}));
  if (feed.value) std::get<Block>(before.back().node).actions.push_back(action(SetFeed{Value{*feed.value}, false}));
  if (on && by_call_) before.push_back(on_statement(like, active_->native));
  b.actions.clear();
  b.motion.kind = MotionKind::rapid;
  b.motion.centers.clear();
  for (auto& c : b.motion.coords) {  // the way has been travelled
    if (c.mode == WordMode::incremental) c.value = Value(0);
  }
  return true;
}

void CyclePass::pattern_as_loop(Statement&& s, PatternLoop&& loop, Body&& pieces, Body& out) {
  const auto id = s.id;
  const LineInfo like = s.line;
  auto& b = std::get<Block>(s.node);
  if (b.empty()) {
    loop.setup.front().line = like;
    put(out, std::move(pieces), std::move(loop.setup.front()));
    loop.setup.erase(loop.setup.begin());
  } else {
    put(out, std::move(pieces), std::move(s));
  }
  for (auto& piece : loop.setup) out.push_back(std::move(piece));
  const auto run = [&](Block block, Body& to) {
    Statement p = made(like, std::move(block));
    p.id = id;
    if (active_) return point(std::move(p), {}, to);
    to.push_back(std::move(p));
  };
  if (loop.first) run(std::move(*loop.first), out);
  While node;
  node.condition = loop.again;
  if (active_) active_->repeats = true;
  run(std::move(loop.next), node.body);
  if (active_) active_->repeats = false;
  const ExprPtr counter = variable(loop.counter);
  node.body.push_back(make_assign(like, loop.counter, binary(BinaryOp::add, counter, number(1))));
  Body written;
  written.push_back(made(like, std::move(node)));
  lower_structures(editor_, written);
  for (auto& piece : written) out.push_back(std::move(piece));
  for (const auto& v : loop.taken) editor_.release(v);
}

}  // namespace cnctrans::ir::passes
