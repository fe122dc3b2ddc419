// A cycle is followed in the order of the text; control comes by other ways as well. Where they bring another cycle,
// the text does not say which one a point runs.
#include <algorithm>

#include "legaliser/cycles/cycle_pass.h"

namespace cnctrans::ir::passes {

void CyclePass::look_for_definitions() {
  const Body& body = editor_.routine.body;
  if (!body.empty() && !std::holds_alternative<Return>(body.back().node) &&
      !std::holds_alternative<End>(body.back().node))
    falls_ = body.back().line.span;
  const Statement* first = nullptr;
  for_each_statement(body, [&](const Statement& s) {
    if (first == nullptr) first = &s;
    if (const auto* m = std::get_if<ModalCall>(&s.node); m != nullptr && m->cycle) {
      definitions_.insert(s.id);
      has_modal_calls_ = true;
    }
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    for (const auto& a : b->actions) {
      const auto* d = std::get_if<CycleDefine>(&a.data);
      if (d == nullptr || !d->modal) continue;
      definitions_.insert(s.id);
    }
  });
  for (const auto& r : program_.routines) {
    for_each_statement(r.body, [this](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      plane_words_ = plane_words_ || (b != nullptr && sets_retract_plane(*b));
      const auto* m = std::get_if<ModalCall>(&s.node);
      calls_anywhere_ = calls_anywhere_ || (m != nullptr && m->cycle);
    });
  }
  enters_unsure_ = first != nullptr && editor_.routine.kind != RoutineKind::main &&
                   facts_.before(*first).cycle_from == Facts::several_cycles;
}

bool CyclePass::old_may_run(const Facts& facts) const {
  if (active_ && sure(facts)) return active_->on_target || active_->maybe_on_target;
  return facts.reachable && (facts.cycle_active || !facts.cycle_active_known);
}

bool CyclePass::refuse_unknown_plane(Statement& s, const CyclePtr& cycle, Body& out) const {
  const auto* hole = cycle ? std::get_if<HoleCycle>(&cycle->node) : nullptr;
  const auto* b = std::get_if<Block>(&s.node);
  if (hole == nullptr || b == nullptr || hole->retract.given || !plane_words_ || context_.target.retract_plane_switch)
    return false;
  const Facts& facts = facts_.before(s);
  if (!facts.reachable || setting_in<RetractPlane>(*b, facts, Setting::retract_plane)) return false;
  refuse(s, program_, context_, "TRN-331",
         "the plane to which this hole retracts depends on the path that leads here, and the target's cycle names it",
         "say the plane in the block that defines the cycle");
  out.push_back(std::move(s));
  return true;
}

void CyclePass::end_elsewhere(const Statement& s) {
  const Facts& facts = facts_.before(s);
  const auto* b = std::get_if<Block>(&s.node);
  const bool own = b != nullptr ? definitions_.count(s.id) != 0 || action_in<CycleCancel>(*b) != nullptr
                                : std::holds_alternative<ModalCall>(s.node);
  if (own) enters_unsure_ = false;
  if (!active_ || surely_active_ || !facts.reachable || !facts.cycle_active_known || facts.cycle_active) return;
  leave_off();  // a jump may have taken it to the end of the routine
  active_.reset();
  tap_feed_ = false;  // it comes back where the cycle ends
}
bool CyclePass::refuse_two_ways(Statement& s, Body& out) const {
  const auto& b = std::get<Block>(s.node);
  const Facts& facts = facts_.before(s);
  const bool either = active_ ? active_->native && !facts.cycle_active_known
                              : facts.cycle_from == Facts::several_cycles && may_be_point(b, facts);
  if (!by_call_ || !either || !facts.reachable || surely_active_ || !b.has_motion || !b.motion.moves() ||
      b.motion.kind != MotionKind::modal || facts.motion == MotionKind::rapid ||
      context_.source_machine.policies.cycle_positioning != machine::CyclePositioning::rapid)
    return false;
  refuse(
      s, program_, context_, "TRN-331",
      "whether a cycle is active here depends on the path that leads here: with it the tool moves in rapid, without it "
      "by the function in force",
      "write G0 before this block, or cancel the cycle on every path");
  out.push_back(std::move(s));
  return true;
}

void CyclePass::check_tap(const Statement& s) const {
  const auto* b = std::get_if<Block>(&s.node);
  if (!active_ || !active_->native || b == nullptr) return;
  const auto* own = std::get_if<HoleCycle>(&active_->source->node);
  const auto* theirs = std::get_if<HoleCycle>(&active_->native->node);
  const bool tap = own != nullptr && (own->kind == HoleKind::tap || own->kind == HoleKind::tap_floating);
  const bool sense = tap && theirs != nullptr && own->spindle_after != theirs->spindle_after;
  for (const auto& a : b->actions) {
    const bool feed = std::holds_alternative<SetFeed>(a.data) || std::holds_alternative<SetSpindle>(a.data);
    const auto* run = std::get_if<SpindleRun>(&a.data);
    const bool turns = run != nullptr && run->number == 1 && run->state != SpindleState::off;
    if (!(feed && active_->needs.bound) && !(turns && sense)) continue;
    context_.diagnostics.error(
        "TRN-330", s.line.span,
        feed ? "a new feed or speed while a tap is active: its pitch would follow on one control only"
             : "a new sense of the spindle while a tap is active: it would turn on in that sense on one control only",
        "end the cycle before the change and define it again");
    return;
  }
}

void CyclePass::cancel_statement(Statement&& s, Body& out) {
  const bool on = active_->on_target || active_->maybe_on_target;
  tap_feed_ = tap_feed_ || tap_by_a_jump(facts_.before(s)) || (on && !by_call_ && active_->needs.feed);
  leave_off();
  active_.reset();
  if (!on && !tap_feed_) return leave_line(std::move(s), out);
  if (!by_call_) {
    Block b;
    if (on) b.actions.push_back(action(CycleCancel{}));
    feed_comes_back(s, b, facts_.before(s));
    s.node = std::move(b);
  }
  out.push_back(std::move(s));
}

void CyclePass::cancel(const Statement& s, Block& b, bool defines_again, Body& pieces) {
  // A cancel where nothing can be active is a habit of safe starts; as a modal call it would only puzzle.
  const Facts& facts = facts_.before(s);
  const bool none = by_call_ && facts.cycle_active_known && !facts.cycle_active;
  const bool own = facts.cycle_from == 0 || definitions_.count(facts.cycle_from) != 0;
  const bool on =
      active_ ? active_->on_target || active_->maybe_on_target : !defines_again && !(written_out_ && own) && !none;
  tap_feed_ = tap_feed_ || (on && !by_call_ && active_ && active_->needs.feed);
  leave_off();
  active_.reset();
  if (defines_again) return;
  if (on && by_call_)
    pieces.push_back(off_statement(s.line, true));
  else if (on)
    b.actions.insert(b.actions.begin(), action(CycleCancel{}));
  feed_comes_back(s, b, facts);
}

bool CyclePass::tap_by_a_jump(const Facts& facts) const {
  if (by_call_ || !facts.reachable || (active_ && sure(facts))) return false;
  return facts.cycle_from == Facts::several_cycles ? !feeds_.taps().empty()
                                                   : feeds_.taps().count(facts.cycle_from) != 0;
}

void CyclePass::feed_comes_back(const Statement& s, Block& b, const Facts& facts) {
  if (!std::exchange(tap_feed_, false)) return;
  if (action_in<SetFeed>(b) != nullptr) return;
  const FeedBefore before = feeds_.at(s, b, facts);
  if (const auto word = before.word()) {
    b.actions.push_back(action(SetFeed{*word, false}));
  } else if (!before.none) {
    context_.diagnostics.error(
        "TRN-330", s.line.span,
        "the tap before this block has its pitch as F there, and the F that comes back behind it "
        "is not known here",
        "write F behind the tap");
  }
}

bool CyclePass::levels_by_mode(const CyclePtr& native, const Block& b, const Facts& facts) const {
  const auto* hole = std::get_if<HoleCycle>(&native->node);
  if (hole == nullptr || context_.target_machine.policies.cycle_levels != machine::CycleLevels::by_mode ||
      setting_in<Distance>(b, facts, Setting::distance) != Distance::incremental)
    return false;
  const auto absolute = [](const Level& l) { return l.given && l.base == LevelBase::absolute; };
  return absolute(hole->reference) || absolute(hole->bottom) || absolute(hole->retract);
}

void CyclePass::turn(const Block& b, const Facts& facts, const LineInfo& like, Body& pieces) {
  if (active_->trigger != CycleTrigger::path_motion) return;
  const auto now = tool_axis(active_->source, b, facts);
  if (!now || !active_->axis || now == active_->axis) return;
  const Active before = *active_;
  if (before.on_target || before.maybe_on_target) pieces.push_back(off_statement(like, by_call_));
  active_ = define(before.source, before.trigger, b, facts);
  active_->from = before.from;
  active_->deferred = before.deferred;
  active_->single = before.single;
  active_->stale = before.stale;
  active_->said_by = before.said_by;
}

bool CyclePass::sure(const Facts& facts) const {
  return surely_active_ || !facts.reachable || !facts.cycle_active_known || facts.cycle_from == active_->from;
}

bool CyclePass::cycle_by_another_way(const Block& b, const Facts& facts) const {
  const bool moves = b.has_motion && b.motion.moves() && b.motion.frame == FrameUse::normal;
  if (!facts.reachable || (!moves && !((by_call_ || has_modal_calls_) && disturbs_call(b)))) return false;
  if (facts.cycle_from == Facts::several_cycles) {
    const bool left = by_call_ && editor_.routine.kind == RoutineKind::main;  // by a called routine, on some way
    return (!enters_unsure_ && (!definitions_.empty() || may_end_ || left)) ||
           (!by_call_ && refuses_axis_word(b, facts));
  }
  // One that a called routine has left in force: a modal call would run at words and moves that are no points.
  const bool left = by_call_ && definitions_.count(facts.cycle_from) == 0;
  return facts.cycle_active && (left || definitions_.count(facts.cycle_from) != 0);
}

/// A move along the tool axis, which the target takes for a word of the cycle.
bool CyclePass::refuses_axis_word(const Block& b, const Facts& facts) const {
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  return context_.target_machine.policies.cycle_axis_word == machine::CycleAxisWord::refused &&
         (!plane || moves_along(b, plane_axes(*plane).w));
}

bool CyclePass::bare_point(const Block& b, const Facts& facts) const {
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  if (!plane || (has_modal_calls_ && !by_call_) || context_.target.cycle_each_call) return false;
  const AxisId w = plane_axes(*plane).w;
  if (!has_plane_word(b, w) || moves_along(b, w) || !b.motion.centers.empty() || b.motion.radius_given) return false;
  const bool rapid = context_.target_machine.policies.cycle_positioning == machine::CyclePositioning::rapid;
  return !rapid || way_to_hole(b, facts, context_) == MotionKind::rapid;
}

void CyclePass::refuse_other_ways(Statement& s) const {
  refuse(s, program_, context_, "TRN-331",
         "which cycle is active here depends on the path that leads here, and the target needs to know it",
         "define the cycle again before this block, or cancel it on every path");
}

bool CyclePass::gives_back(bool reachable) const {
  return reachable && active_ && active_->deferred && !active_->on_target && definitions_.count(active_->from) != 0 &&
         editor_.routine.kind != RoutineKind::main;
}

/// A subprogram gives back a modal call whose points lie with its callers, and the target defines the cycle at them.
static void refuse_given_back(const Span& where, const LegaliseContext& context) {
  context.diagnostics.error("TRN-331", where,
                            "the modal cycle goes on behind the return, and the target defines it at its first point: "
                            "which points of the callers it drills can't be seen here",
                            "cancel it before the return, or write the modal call where its points are");
}

void CyclePass::leave_off() const {
  if (active_ && !active_->on_target) callees_.left_off.insert(active_->from);
}

void refuse_foreign_cycles(const CycleCallees& callees, const LegaliseContext& context) {
  const auto among = [](const std::set<std::uint32_t>& all, std::uint32_t from) {
    return from == Facts::several_cycles ? !all.empty() : all.count(from) != 0;
  };
  // Calls under a cycle that is known go to copies; the original is left to those without one.
  const auto for_others = [&callees](std::size_t routine) {
    return callees.entered.count(routine) == 0 &&
           std::any_of(callees.copies.begin(), callees.copies.end(),
                       [routine](const auto& c) { return c->original == routine; });
  };
  std::vector<Span> refused;
  for (const auto& [routine, where, from] : callees.points) {
    if (!among(callees.left_off, from) || for_others(routine)) continue;
    refused.push_back(where);
    context.diagnostics.error("TRN-331", where,
                              "a cycle that another part of the program defines may be active here, and the target "
                              "has none in force: it is written out there, or defined at a point that is not passed",
                              "define the cycle again before this block");
  }
  for (const auto& [where, from] : callees.feeds) {
    if (among(callees.bound_taps, from))
      context.diagnostics.error("TRN-330", where,
                                "a new feed or speed while a tap of another program part is active: its pitch would "
                                "follow on one control only",
                                "end the cycle before the change and define it again");
  }
  for (const auto& [routine, where] : callees.disturbed) {
    if (callees.entered.count(routine) != 0 && std::find(refused.begin(), refused.end(), where) == refused.end())
      context.diagnostics.error("TRN-331", where,
                                "a cycle that another part of the program defines may be active here, and the target's "
                                "would make another move or hole of this block",
                                "cancel the cycle before the call, or before this block");
  }
}

bool CyclePass::path_word_under_call(const Block& b, const Facts& facts) const {
  const bool moves = b.has_motion && b.motion.moves();
  return !by_call_ && calls_anywhere_ && !surely_active_ && !moves && disturbs_call(b) && facts.reachable &&
         facts.cycle_from != 0 && definitions_.count(facts.cycle_from) == 0;
}

bool CyclePass::may_be_point(const Block& b, const Facts& facts) const {
  if (pattern_in(b) != nullptr) return true;
  if (!b.has_motion || !b.motion.moves() || b.motion.frame != FrameUse::normal) return false;
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  return (calls_anywhere_ && !by_call_) || !plane || has_plane_word(b, plane_axes(*plane).w) ||
         turns_to_point(b, context_.source_machine);
}

void CyclePass::note_foreign(const Statement& s, const Facts& facts) const {
  if (!facts.reachable || surely_active_) return;
  const auto* modal = std::get_if<ModalCall>(&s.node);
  const auto* called = modal != nullptr && !modal->cycle ? &modal->call : std::get_if<CallRoutine>(&s.node);
  const auto callee = called != nullptr ? callee_of(*called) : std::nullopt;
  // The second pass of a counted call begins under what the first one has left.
  const bool again = modal != nullptr || (called != nullptr && called->count != nullptr);
  if (callee && (again || (facts.cycle_from != 0 && (!active_ || !sure(facts))))) callees_.entered.insert(*callee);
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || facts.cycle_from == 0 || definitions_.count(facts.cycle_from) != 0) return;
  const bool point = may_be_point(*b, facts);
  std::size_t here = 0;  // a copy: behind the last one
  while (here < program_.routines.size() && &program_.routines[here] != &editor_.routine) ++here;
  if (point && !(active_ && sure(facts))) callees_.points.push_back({here, s.line.span, facts.cycle_from});
  const bool feed = std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
    return std::holds_alternative<SetFeed>(a.data) || std::holds_alternative<SetSpindle>(a.data);
  });
  if (feed) callees_.feeds.emplace_back(s.line.span, facts.cycle_from);
  const bool moves = b->has_motion && b->motion.moves() && b->motion.frame == FrameUse::normal;
  if (active_ || (by_call_ ? point || !(moves || disturbs_call(*b)) : !point || bare_point(*b, facts))) return;
  if (editor_.routine.kind == RoutineKind::main) callees_.entered.insert(here);  // one that a subprogram has left
  if (here < program_.routines.size()) callees_.disturbed.emplace_back(here, s.line.span);
}

bool CyclePass::refuse_foreign_plane(Statement& s, Body& out) const {
  const Facts& facts = facts_.before(s);
  if (!facts.reachable || context_.target.retract_plane_switch || !sets_retract_plane(std::get<Block>(s.node)) ||
      facts.cycle_from == 0 || definitions_.count(facts.cycle_from) != 0)
    return false;
  refuse(s, program_, context_, "TRN-331",
         "this block changes the plane to which the active cycle retracts, another program part has defined the cycle, "
         "and the target's cycle names that plane",
         "define the cycle again before this block, or cancel it");
  out.push_back(std::move(s));
  return true;
}

void CyclePass::leave_while_off(const Statement& s) const {
  const bool returns = std::holds_alternative<Return>(s.node) || std::holds_alternative<End>(s.node);
  if (returns && gives_back(facts_.before(s).reachable)) refuse_given_back(s.line.span, context_);
  if (returns && facts_.before(s).reachable) leave_off();
  const bool leaves = std::holds_alternative<Jump>(s.node) || std::holds_alternative<Switch>(s.node) ||
                      std::holds_alternative<Repeat>(s.node) || std::holds_alternative<CallRoutine>(s.node);
  if (!leaves || !off_between()) return;
  context_.diagnostics.error(
      "TRN-331", s.line.span,
      "the cycle of the target is off here until the next point defines it again, and control may go elsewhere before",
      "put what changes the cycle into the block of its next point");
}

void CyclePass::branch_before_first_point(Statement& s) {
  if (!active_ || by_call_ || active_->on_target || active_->trigger != CycleTrigger::path_motion) return;
  bool back = false;
  each_label_ref(s, [&](const LabelRef& l, bool) { back = back || under_cycle_.count({l.is_number, l.text}) != 0; });
  if (back && active_->native)
    context_.diagnostics.error("TRN-331", s.line.span,
                               "the cycle goes on at points further up, where the target's own is in force, and the "
                               "target has defined it at no point yet",
                               "write the modal call in front of these points");
  if (active_->maybe_on_target) return;
  bool branch = std::holds_alternative<Jump>(s.node) || std::holds_alternative<Switch>(s.node) ||
                std::holds_alternative<CallRoutine>(s.node) || std::holds_alternative<Repeat>(s.node);
  if (const auto* call = std::get_if<CallRoutine>(&s.node); call != nullptr && callee_of(*call)) branch = false;
  for (const auto& l : labels_on(s.line)) branch = branch || uses_.is_target(l);
  active_->single = active_->single || branch;
}

void CyclePass::callee_sets_plane(const CallRoutine& call, const Statement& s) const {
  const auto* hole = std::get_if<HoleCycle>(&active_->source->node);
  const auto callee = callee_of(call);
  if (!by_call_ || !active_->native || hole == nullptr || !callee) return;
  bool beside = false, turns = false;
  for_each_statement(program_.routines[*callee].body, [&](const Statement& inner) {
    const auto* b = std::get_if<Block>(&inner.node);
    if (b == nullptr || active_->trigger != CycleTrigger::plane_axis_word) return;
    const Facts& facts = facts_.before(inner);
    bool ended = !facts.reachable || (facts.cycle_active_known && facts.cycle_from != active_->from &&
                                      facts.cycle_from != Facts::several_cycles);
    for (const auto& a : b->actions) {
      ended = ended || std::holds_alternative<CycleDefine>(a.data) || std::holds_alternative<CycleCancel>(a.data);
      const auto* m = std::get_if<ModalSet>(&a.data);
      const auto before = setting<Plane>(facts, Setting::plane);
      turns = turns || (!ended && m != nullptr && m->setting == Setting::plane &&
                        (!before || static_cast<std::uint8_t>(*before) != m->value));
    }
    const bool moves = b->has_motion && b->motion.moves();
    const bool no_point = moves ? b->motion.frame == FrameUse::normal && !triggers(*b, facts) : disturbs_call(*b);
    beside = beside || (!ended && no_point);
  });
  if (beside || turns) {
    context_.diagnostics.error(
        "TRN-331", s.line.span,
        beside ? "the subprogram has a move along the tool axis, or F, S or a motion code alone, that is "
                 "no point of the active cycle; the target's modal cycle runs there"
               : "the subprogram changes the plane, which ends the active cycle; the target's "
                 "modal cycle goes on",
        "cancel the cycle before the call");
    return;
  }
  if (hole->retract.given) return;
  bool sets = false;
  for_each_statement(program_.routines[*callee].body, [&sets](const Statement& inner) {
    const auto* b = std::get_if<Block>(&inner.node);
    sets = sets || (b != nullptr && sets_retract_plane(*b));
  });
  if (!sets) return;
  context_.diagnostics.error(
      "TRN-331", s.line.span,
      "the subprogram changes the plane to which the active cycle retracts, and the target's cycle names that plane",
      "cancel the cycle before the call, or change the plane where the cycle is defined");
}

void CyclePass::report_unsure() const {
  if (falls_) leave_off();
  if (falls_ && gives_back(true)) refuse_given_back(*falls_, context_);
  if (!lacking_) return;
  for (const Span& where : unsure_) {
    context_.diagnostics.error(
        "TRN-331", where,
        "which cycle is active here depends on the path that leads here, and the target lacks one of them",
        "define the cycle again before this block");
  }
}

static std::uint32_t last_inside(Body& body) {
  std::uint32_t last = 0;
  for_each_statement(body, [&last](const Statement& s) { last = std::max(last, s.id); });
  return last;
}

/// Both branches begin with what is active before them; behind them holds what both say.
bool CyclePass::begins_with_point(const Body& body) const {
  for (const Statement& s : body) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b != nullptr && !b->empty()) {  // one along the tool alone is written out, and defines nothing
      const auto w = tool_axis(active_->source, *b, facts_.before(s));
      return triggers(*b, facts_.before(s)) && (!w || has_plane_word(*b, *w));
    }
    if (b == nullptr && !std::holds_alternative<Assign>(s.node) && !std::holds_alternative<Message>(s.node))
      return false;
  }
  return true;
}

void CyclePass::bodies(Statement& s) {
  auto* i = std::get_if<If>(&s.node);
  const auto before = active_;
  if (i == nullptr) {
    each_body(s, [&](Body& inner) {
      if (!inner.empty()) note_writes_of_loop(s.id, last_inside(inner));
      sense_.forget();  // the next pass may begin with another sense
      for_each_statement(inner, [this](const Statement& x) { leave_height(x); });  // its end is before its beginning
      // A point further down in the body defines the target's cycle: it would be in force where the next pass begins.
      if (active_ && active_->deferred && !by_call_ && !active_->on_target)
        active_->single = active_->single || !begins_with_point(inner);
      walk_inside(inner);
    });
    // The next pass of a loop begins as the first one did.
    if (before && before->on_target && active_ && active_->from == before->from && off_between()) {
      context_.diagnostics.error("TRN-331", s.line.span,
                                 "the cycle of the target is off at the end of this loop and on at its beginning",
                                 "put what changes the cycle into the block of its next point");
    }
    return;
  }
  const SpindleSense sense = sense_;
  walk_inside(i->then_body);
  const auto then = active_;
  active_ = before;
  sense_ = sense;
  walk_inside(i->else_body);
  if (!active_) active_ = then;
  if (!then || !active_ || then->from != active_->from) return;
  const bool either = then->on_target || active_->on_target || then->maybe_on_target || active_->maybe_on_target;
  active_->on_target = active_->on_target && then->on_target;
  active_->was_on_target = active_->was_on_target || then->was_on_target;
  active_->maybe_on_target = either && !active_->on_target;
  if (active_->height != then->height) active_->height.reset();
  active_->left_height = active_->left_height || then->left_height;
  active_->stale.insert(active_->stale.end(), then->stale.begin(), then->stale.end());
}

}  // namespace cnctrans::ir::passes
