// How a target defines a cycle that it has: by words that hold for the points behind them, by a modal call, or anew at
// each point.
#include "legaliser/cycles/cycle_pass.h"

#include "ir/cycles/pattern.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

void CyclePass::define_in_block(Statement&& s, const CycleDefine& d, Body&& pieces, Body& out) {
  const auto* change = std::get_if<HoleCycle>(&d.cycle->node);
  if (change != nullptr && change->keeps_initial && active_ &&
      follow_units(s, std::get<Block>(s.node), facts_.before(s), pieces, out))
    return;
  // The modal cycle goes on behind one that is called by itself; the target defines it again at its next point.
  std::optional<Active> goes_on;
  if (change != nullptr && !d.modal && d.here) goes_on = active_;
  const auto units = setting_in<Units>(std::get<Block>(s.node), facts_.before(s), Setting::units);
  const auto left = retract_mm(change, units);
  define_here(std::move(s), d, std::move(pieces), out);
  if (!goes_on) return;
  active_ = std::move(goes_on);
  const bool same = left && left == retract_mm(std::get_if<HoleCycle>(&active_->source->node), units);
  active_->maybe_on_target = !same && (active_->maybe_on_target || active_->on_target);
  active_->on_target = false;
  active_->height = left;
  active_->left_height = active_->left_height || !same;
}

void CyclePass::define_here(Statement&& s, const CycleDefine& d, Body&& pieces, Body& out) {
  auto& b = std::get<Block>(s.node);
  const Facts& facts = facts_.before(s);
  if (const auto* named = std::get_if<NamedCycle>(&d.cycle->node);
      named != nullptr && cycles::find_pattern(named->name) != nullptr)
    return pattern(std::move(s), d, std::move(pieces), out);
  if (const auto* hole = std::get_if<HoleCycle>(&d.cycle->node);
      hole != nullptr && hole->keeps_initial &&
      !(active_ && sure(facts) && std::holds_alternative<HoleCycle>(active_->source->node))) {
    refuse(s, program_, context_, "TRN-330",
           "the words of a cycle are changed, and which cycle is in force can't be seen here", "write the cycle again");
    out.push_back(std::move(s));
    return;
  }
  hold_back(b);
  if (d.modal) leave_off();
  const auto old_on = active_ && active_->on_target;
  const bool old_may = old_may_run(facts);
  const auto* named = std::get_if<NamedCycle>(&d.cycle->node);
  if (named != nullptr && !d.modal && d.here && cycles::find_machining(named->name) != nullptr && !active_ &&
      !native_form(d.cycle, b, facts, context_)) {
    const NamedCycle cycle = *named;
    return write_out_machining(std::move(s), cycle, std::move(pieces), out);
  }
  if (refuse_unknown_plane(s, d.cycle, out) || refuse_stale_change(s, d, out) || refuse_lost_bottom(s, d, out)) return;
  Active a = define(d.cycle, d.trigger, b, facts_for_tap(s, b));
  if (!a.native && !d.modal && d.here) feed_as_a_word(a, b, facts);
  if (a.native && sense_.stands()) tell_standing_tap(*a.native, s.line, context_);
  if (d.here) judge_feedless(a, s);
  tell_tap(a, s.line);
  tell_reference(a, s.line);
  if (a.needs.bound) callees_.bound_taps.insert(s.id);
  if (!a.native || !a.needs.feed) feed_comes_back(s, b, facts);
  a.from = s.id;
  a.said_by.push_back(s.id);
  lacking_ = lacking_ || (d.modal && !a.native);
  if (d.here) ran_ = a;
  const auto w = tool_axis(d.cycle, b, facts);
  const bool point_here = w && has_plane_word(b, *w);
  if (!a.native) {
    if (old_may) pieces.push_back(off_statement(s.line, by_call_));
    written_out_ = true;
    active_ = a;
    if (d.here)
      write_out(std::move(s), std::move(pieces), out);
    else
      put(out, std::move(pieces), std::move(s));
    if (!d.modal) active_.reset();
    return;
  }
  if (context_.target.cycle_each_call) return define_each(std::move(s), d, std::move(a), std::move(pieces), out);
  if (!by_call_) return define_by_words(std::move(s), d, std::move(a), old_may, std::move(pieces), out);
  const bool on = old_on || !(facts.cycle_active_known && !facts.cycle_active);
  // The words of this block must not run the old cycle once more.
  if (on && d.modal && runs_old(b, point_here, d.here))
    pieces.push_back(off_statement(s.line, true));
  else if (on && old_may && d.modal && d.here && !point_here)  // the run of its own would run it at each move
    pieces.push_back(off_statement(s.line, true));
  define_by_call(std::move(s), d, std::move(a), point_here, std::move(pieces), out);
}

/// The words of a cycle stand in a block and hold for the points behind it. `old_may`: the cycle before may run at the
/// moves that are written here.
void CyclePass::define_by_words(Statement&& s, const CycleDefine& d, Active&& a, bool old_may, Body&& pieces,
                                Body& out) {
  auto& b = std::get<Block>(s.node);
  const Facts& facts = facts_.before(s);
  const auto w = tool_axis(d.cycle, b, facts);
  if (!d.here) {  // the next point runs it
    if (old_may) pieces.push_back(off_statement(s.line, false));
    a.was_on_target = true;
    if (w && moves_along(b, *w)) a.height = height_after(b, facts, *w);
    active_ = std::move(a);
    return put(out, std::move(pieces), std::move(s));
  }
  const bool target_rapid = context_.target_machine.policies.cycle_positioning == machine::CyclePositioning::rapid;
  if (target_rapid && w && has_plane_word(b, *w) && way_to_hole(b, facts, context_) != MotionKind::rapid) {
    // The target would go there in rapid: the move, then one run of the cycle.
    if (old_may) pieces.push_back(off_statement(s.line, false));
    const std::size_t main = pieces.size();
    Statement run = single_run(s.line, a.native);
    const Block way = b;
    pieces.push_back(std::move(s));
    run_alone(std::move(run), a, way, facts, pieces);
    if (d.modal) active_ = std::move(a);
    return put_group(out, std::move(pieces), main);
  }
  CycleDefine native = d;
  native.cycle = a.native;
  native.trigger = CycleTrigger::plane_axis_word;
  std::optional<Value> leave;
  if (!d.modal) leave = leave_by_own_move(native.cycle, a);
  if (leave && !w) {
    refuse(s, program_, context_, "TRN-330", "a cycle in a plane that is not known here",
           "write the plane before it on every path");
    return out.push_back(std::move(s));
  }
  Active rising = a;
  rising.native = native.cycle;
  if (rises_first(rising, b, facts) && (!leave || late_.empty())) {
    const LineInfo like = s.line;
    rise_and_define(std::move(s), rising, d.modal, std::move(pieces), out);
    if (leave) out.push_back(made(like, straight_move(MotionKind::rapid, *w, *leave)));
    if (!d.modal) return;
    a.on_target = a.was_on_target = true;
    active_ = std::move(a);
    return;
  }
  put_words(s, std::move(native), a, old_may, pieces);
  if (d.modal) {
    a.on_target = a.was_on_target = true;
    active_ = std::move(a);
  }
  if (!leave) return put(out, std::move(pieces), std::move(s));
  const LineInfo like = s.line;
  const std::size_t main = pieces.size();
  pieces.push_back(std::move(s));
  pieces.push_back(made(like, straight_move(MotionKind::rapid, *w, *leave)));
  put_group(out, std::move(pieces), main);
}

/// The definition joins the actions of its block; what has to stand before it, in a block of its own, joins `pieces`.
void CyclePass::put_words(Statement& s, CycleDefine&& native, const Active& a, bool old_may, Body& pieces) {
  auto& b = std::get<Block>(s.node);
  const Facts& facts = facts_.before(s);
  const bool moves = b.has_motion && b.motion.moves(), modal = native.modal;
  if (comes_in_two_moves(a.native, context_)) {
    position_rapid(b, context_);
    if (old_may && moves) pieces.push_back(off_statement(s.line, false));
  }
  if (auto code = code_before_cycle(b, facts, context_)) {
    if (old_may) pieces.push_back(off_statement(s.line, false));
    pieces.push_back(made(s.line, *std::move(code)));
  }
  feed_for_tap(b, a);
  if (!modal && !moves && levels_by_mode(a.native, b, facts)) {
    b.actions.push_back(distance_set(Distance::absolute));
    then_.push_back(distance_set(Distance::incremental));
  }
  b.actions.push_back(action(std::move(native)));
  if (const auto feed = feed_after_tap(a, facts); feed && !modal) {
    then_.push_back(*feed);
    tap_feed_ = false;
  }
}

void CyclePass::define_by_call(Statement&& s, const CycleDefine& d, Active&& a, bool point_here, Body&& pieces,
                               Body& out) {
  auto& b = std::get<Block>(s.node);
  if (!d.modal) {
    if (point_here || !b.empty()) {
      pieces.push_back(std::move(s));
      const LineInfo like = pieces.back().line;
      const std::size_t main = pieces.size() - 1;
      pieces.push_back(single_run(like, a.native));
      put_group(out, std::move(pieces), main);
    } else {
      b.actions.push_back(action(CycleDefine{a.native, false, true, CycleTrigger::path_motion}));
      put(out, std::move(pieces), std::move(s));
    }
    return;
  }
  a.on_target = true;
  const LineInfo like = s.line;
  const bool bare_code = b.has_motion && !b.motion.moves();
  if (!b.actions.empty() || bare_code) {  // F, S and a motion code first: the call takes them
    Block first;
    first.actions = std::move(b.actions);
    b.actions.clear();
    if (bare_code) std::swap(first.motion, b.motion);
    if (bare_code) std::swap(first.has_motion, b.has_motion);
    pieces.push_back(made(like, std::move(first)));
  }
  if (!d.here && b.has_motion && b.motion.moves()) {  // to a plane first; the next point runs the cycle
    const std::size_t main = pieces.size();
    pieces.push_back(std::move(s));
    pieces.push_back(on_statement(like, a.native));
    active_ = a;
    put_group(out, std::move(pieces), main);
    return;
  }
  if (d.here && !point_here) {
    if (b.has_motion) {
      Statement mover = made(like, Block{});
      std::get<Block>(mover.node).has_motion = true;
      std::get<Block>(mover.node).motion = std::move(b.motion);
      pieces.push_back(std::move(mover));
    }
    pieces.push_back(single_run(like, a.native));
    s.node = ModalCall{};
    std::get<ModalCall>(s.node).cycle = a.native;
    pieces.push_back(std::move(s));
    active_ = a;
    const std::size_t main = pieces.size() - 1;
    put_group(out, std::move(pieces), main);
    return;
  }
  pieces.push_back(on_statement(like, a.native));
  if (point_here) {
    position_kind(b, context_);
    pieces.push_back(std::move(s));
  } else {
    pieces.back().line = s.line;
  }
  active_ = a;
  const std::size_t main = pieces.size() - 1;
  put_group(out, std::move(pieces), main);
}

/// Targets without modal cycles: each point of the source's cycle gets a call of its own.
/// The block without the definition; where it is a point as well, its call follows.
void CyclePass::define_each(Statement&& s, const CycleDefine& d, Active&& a, Body&& pieces, Body& out) {
  auto& b = std::get<Block>(s.node);
  a.single = true;
  const LineInfo like = s.line;
  if (d.here) position_rapid(b, context_);
  const CyclePtr native = a.native;
  if (!d.here) {
    const auto w = tool_axis(d.cycle, b, facts_.before(s));
    if (w && moves_along(b, *w)) a.height = height_after(b, facts_.before(s), *w);
  }
  const Active now = a;
  if (d.modal) active_ = std::move(a);
  if (!d.here) return put(out, std::move(pieces), std::move(s));
  const Facts& facts = facts_.before(s);
  const Block way = b;
  Statement run = single_run(like, native);
  if (way.empty()) {
    b.actions.push_back(action(CycleDefine{native, false, true, CycleTrigger::plane_axis_word}));
    run = std::move(s);
  }
  const std::size_t main = pieces.size() + (way.empty() && now.needs.feed ? 1U : 0U);
  if (!way.empty()) pieces.push_back(std::move(s));
  run_alone(std::move(run), now, way, facts, pieces);
  put_group(out, std::move(pieces), main);
}

}  // namespace cnctrans::ir::passes
