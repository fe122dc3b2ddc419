// Canned cycles (equivalences 22): native where the target has exactly the moves, else written out move by move.
#include "legaliser/cycles/cycle_pass.h"

#include <algorithm>
#include <utility>

#include "ir/cycles/assumed.h"
#include "ir/cycles/pattern.h"
#include "legaliser/cycles/copied_cycles.h"
#include "legaliser/cycles/cycle_ranges.h"
#include "legaliser/cycles/milling/pocket_calls.h"
#include "legaliser/data/written_data.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

void CyclePass::walk(Body& body, Body& out) {
  out.reserve(body.size());
  for (auto& s : body) {
    bodies(s);
    rest_ = {&s + 1, body.data() + body.size()};
    one(std::move(s), out);
  }
}

void CyclePass::point(Statement&& s, Body&& pieces, Body& out) {
  check_tap(s);
  auto& b = std::get<Block>(s.node);
  const Facts& facts = facts_.before(s);
  if (triggers(b, facts) && follow_units(s, b, facts, pieces, out)) return;
  if (sure(facts) && triggers(b, facts)) turn(b, facts, s.line, pieces);
  const bool was_on = active_->on_target;
  const bool new_plane = follow_retract_plane(b, facts), changed = follow_height(b, facts) || new_plane;
  const bool hole_here = triggers(b, facts);
  if (hole_here && !std::exchange(active_->told, true)) tell_reference(*active_, s.line);
  if (hole_here) judge_feedless(*active_, s);
  if (hole_here && tap_feed_ && !active_->needs.feed) feed_comes_back(s, b, facts);  // a tap stood before this cycle
  if (hole_here && (refuse_unknown_plane(s, active_->source, out) || refuse_two_ways(s, out))) return;
  const LineInfo like = s.line;
  // A modal cycle of the target is in force on the same ways as the source's; one that each point gets is not.
  const bool follows =
      active_->native && (by_call_ || (active_->on_target && !active_->single && !active_->maybe_on_target));
  if (hole_here && !follows && !facts.cycle_active_known && !surely_active_) {
    refuse(s, program_, context_, "TRN-331",
           "whether a cycle is active here depends on the path that leads here, and the target needs to know it",
           "cancel the cycle on every path, or define it on every path");
    out.push_back(std::move(s));
    return;
  }
  const bool wrap = by_call_ && active_->native && !hole_here && was_on && disturbs_call(b);
  // What is written again here would be in force on every way.
  const bool again = wrap || (changed && was_on);
  const bool perhaps = again && facts.reachable && !facts.cycle_active_known && !surely_active_;
  if (perhaps || ((hole_here || changed || wrap) && !sure(facts))) {
    if (perhaps || !follows || changed || wrap) return refuse_other_ways(std::move(s), out);
    unsure_.push_back(s.line.span);
  }
  if (changed && !active_->native && was_on) {
    active_->on_target = false;
    pieces.push_back(off_statement(like, by_call_));
  } else if (changed && was_on && by_call_) {
    pieces.push_back(on_statement(like, active_->native));
  } else if (changed && was_on) {
    active_->on_target = false;  // the next point defines it again
    const bool apart = active_->native && comes_in_two_moves(active_->native, context_);
    if (!hole_here || apart) pieces.push_back(off_statement(like, false));
  }
  if (hole_here) hold_back(b);
  if (((changed && was_on && by_call_) || wrap || (hole_here && !active_->native)) && refuse_stale(s, out)) return;
  if (!active_->native)
    return hole_here ? write_out(std::move(s), std::move(pieces), out) : plain(std::move(s), std::move(pieces), out);
  if (by_call_) {
    if (hole_here) position_kind(b, context_);
    if (wrap) pieces.push_back(off_statement(like, true));
    const std::size_t main = pieces.size();
    pieces.push_back(std::move(s));
    if (wrap) pieces.push_back(on_statement(like, active_->native));
    put_group(out, std::move(pieces), main);
    return;
  }
  if (!hole_here) return plain(std::move(s), std::move(pieces), out);
  const auto* hole = std::get_if<HoleCycle>(&active_->source->node);
  const auto units = setting_in<Units>(b, facts, Setting::units);
  native_point(std::move(s), std::move(pieces), out);
  if (const auto left = retract_mm(hole, units); left && active_) active_->height = left;
}

/// The cycle where the tool stands, in a block that is absolute.
static Statement under_absolute(const LineInfo& like, const CyclePtr& cycle, bool modal) {
  Statement run = make_block(like, distance_set(Distance::absolute));
  auto& b = std::get<Block>(run.node);
  b.actions.push_back(action(CycleDefine{cycle, modal, true, CycleTrigger::plane_axis_word}));
  return run;
}

void CyclePass::native_point(Statement&& s, Body&& pieces, Body& out) {
  auto& b = std::get<Block>(s.node);
  const Facts& facts = facts_.before(s);
  const auto w = tool_axis(active_->source, b, facts);
  const bool moves_tool = w && moves_along(b, *w);
  const bool may_be_on = active_->on_target || active_->maybe_on_target;
  // The target would go up first, the source goes straight down.
  if ((moves_tool || !active_->on_target) && sure(facts) && below_retract_plane(b, facts)) {
    if (facts.reachable && !surely_on(facts)) return refuse_other_ways(std::move(s), out);
    if (refuse_stale(s, out)) return;
    if (may_be_on) pieces.push_back(off_statement(s.line, false));
    active_->on_target = active_->maybe_on_target = false;
    return write_out(std::move(s), std::move(pieces), out);
  }
  const auto kind = way_to_hole(b, facts, context_);
  const bool target_rapid = context_.target_machine.policies.cycle_positioning == machine::CyclePositioning::rapid;
  // The target takes no motion code beside its cycle: one that stays in force has to go elsewhere.
  const bool new_code = target_rapid && active_->on_target && b.motion.explicit_code && b.motion.keeps_modal &&
                        facts.motion != b.motion.kind;
  const bool simple = !new_code && w && has_plane_word(b, *w) && !moves_tool &&
                      (!target_rapid || kind == MotionKind::rapid) && b.motion.centers.empty() &&
                      !b.motion.radius_given;
  const LineInfo like = s.line;
  const bool point_there = !w || has_plane_word(b, *w) || turns_to_point(b, context_.target_machine);
  const bool as_is = !context_.target.cycle_each_call && !active_->single && point_there &&
                     (simple || (active_->trigger == CycleTrigger::plane_axis_word && !target_rapid));
  if (as_is && active_->on_target) {
    // A code that does not stay is said: without it the writer would put the one that stays in force.
    if (target_rapid && (b.motion.keeps_modal || facts.motion == MotionKind::rapid)) by_itself(b);
    if (surely_on(facts) && comes_in_two_moves(active_->native, context_) && b.motion.kind == MotionKind::modal) {
      position_rapid(b, context_);
      b.motion.explicit_code = false;  // the move to the retract plane has said it
    }
    return put(out, std::move(pieces), std::move(s));
  }
  if (!sure(facts) || (facts.reachable && !surely_on(facts)))  // each way would have to be written here
    return refuse_other_ways(std::move(s), out);
  if (refuse_stale(s, out)) return;
  if (may_be_on && !active_->on_target) pieces.push_back(off_statement(like, false));  // the way would run it
  active_->maybe_on_target = false;
  const bool apart = levels_by_mode(active_->native, b, facts);  // the move first, then the cycle with its levels
  if (as_is && rises_first(*active_, b, facts)) {
    active_->defined_in = s.id;
    rise_and_define(std::move(s), *active_, true, std::move(pieces), out);
    active_->on_target = active_->was_on_target = true;
    return;
  }
  if (as_is && apart) {
    position_rapid(b, context_);
    const std::size_t main = pieces.size();
    pieces.push_back(std::move(s));
    pieces.push_back(under_absolute(like, active_->native, true));
    feed_for_tap(std::get<Block>(pieces.back().node), *active_);
    pieces.push_back(make_block(like, distance_set(Distance::incremental)));
    active_->on_target = active_->was_on_target = true;
    active_->defined_in = pieces[main].id;
    return put_group(out, std::move(pieces), main);
  }
  if (as_is) {
    if (comes_in_two_moves(active_->native, context_)) position_rapid(b, context_);
    if (auto code = code_before_cycle(b, facts, context_)) pieces.push_back(made(like, *std::move(code)));
    feed_for_tap(b, *active_);
    b.actions.push_back(action(CycleDefine{active_->native, true, true, CycleTrigger::plane_axis_word}));
    active_->on_target = active_->was_on_target = true;
    active_->defined_in = s.id;
    return put(out, std::move(pieces), std::move(s));
  }
  run_once(std::move(s), std::move(pieces), apart, out);
}

/// Moved there in another way than the target's cycle does: the move, then one run of the cycle.
void CyclePass::run_once(Statement&& s, Body&& pieces, bool apart, Body& out) {
  const LineInfo like = s.line;
  auto& b = std::get<Block>(s.node);
  const Facts& facts = facts_.before(s);
  if (active_->on_target) pieces.push_back(off_statement(like, false));
  if (active_->on_target && active_->needs.feed && way_to_hole(b, facts, context_) != MotionKind::rapid) {
    tap_feed_ = true;  // the way has the feed of before
    feed_comes_back(s, b, facts);
  }
  active_->on_target = false;
  position_rapid(b, context_);
  const std::size_t main = pieces.size();
  const Block way = b;
  pieces.push_back(std::move(s));
  run_alone(apart ? under_absolute(like, active_->native, false) : single_run(like, active_->native), *active_, way,
            facts, pieces);
  if (apart) pieces.push_back(make_block(like, distance_set(Distance::incremental)));
  put_group(out, std::move(pieces), main);
}

void CyclePass::write_out(Statement&& s, Body&& pieces, Body& out) {
  auto& b = std::get<Block>(s.node);
  const Facts& facts = facts_.before(s);
  const auto* hole = std::get_if<HoleCycle>(&active_->source->node);
  auto sense = sense_.surely() ? sense_.surely() : sense_.or_off();
  if (callees_.spindle && callees_.spindle->turns_on_some_way(s)) sense.reset();
  if (callees_.spindle && callees_.spindle->stands(s)) sense = SpindleState::off;
  constexpr double above = 1e6;
  std::string error, differs;
  std::optional<Explosion> moves;
  std::optional<double> height = active_->height;
  const auto w = hole != nullptr ? cycle_axis(*hole, b, facts) : std::nullopt;
  if (w && moves_along(b, *w)) height = height_after(b, facts, *w);
  // Over the holes the tool stands elsewhere than at the definition, whose height nobody knows.
  if (w && !height) height = height_mm(b, facts, *w);
  const bool plane_lost = active_->left_height && !active_->defined_at && hole != nullptr && hole->reference.given &&
                          hole->reference.base == LevelBase::from_initial;
  const bool lost = hole != nullptr && height && (plane_lost || !back_is_known(*hole, active_->defined_at, b, facts));
  const bool milling = hole != nullptr && hole->kind == HoleKind::mill;
  if (const std::string option = milling ? cycles::assumed_option(*hole) : std::string(); !option.empty())
    return refuse_assumed(std::move(s), option, out);
  if (milling && !lost && put_similar_pocket(*hole, s, pieces, height, false, out)) return;
  if (lost)
    error = "the height at which it was defined, to which it goes back, is not known here";
  else if (milling)
    moves = milling_.write_out(*hole, s, b, facts, height, active_->defined_at ? active_->defined_at : height,
                               sense_.now(), sense_.surely(), &error);
  else if (hole == nullptr)
    error = "cycles of this kind are not carried yet";
  else if ((moves = tap_strokes(*hole, s, b, &differs)) || (moves = axial_tap(*hole, s, b, sense)))
    error.clear();
  else if (height || stands_by_itself(*hole))  // from somewhere above, where the height does not matter
    moves = explode(*hole, s.line, b, facts, feeds_.at(s, b, facts), active_->repeats ? above : height.value_or(above),
                    active_->defined_at.value_or(height.value_or(above)), sense, &error);
  if (!moves && milling && !lost && put_similar_pocket(*hole, s, pieces, height, true, out)) return;
  if (!moves && error.empty()) {
    const auto initial = active_->defined_at ? active_->defined_at : height;
    bool downward = false;
    moves =
        explode_computed(*hole, s.line, b, facts, feeds_.at(s, b, facts), initial, sense, editor_, &downward, &error);
    if (moves && downward)
      context_.diagnostics.warning("TRN-334", s.line.span,
                                   "the hole is taken to go downward: how deep it is only the run knows");
  }
  if (!moves) return no_moves(std::move(s), error, out);
  if (!differs.empty())
    context_.diagnostics.warning("TRN-423", s.line.span, "the target's tap takes the place of this one: " + differs,
                                 "the thread is the same; check the tap on the target");
  if (milling)
    context_.diagnostics.note("TRN-333", s.line.span,
                              "the cycle is written out as its " + std::to_string(moves->blocks.size()) +
                                  " moves: the target has none that moves the same way");
  position_rapid(b, context_);
  if (s.id == active_->from) remark_words(s.line, out);  // at later points the source has no words of the cycle
  active_->height = moves->end_height;
  drop_idle_feed(moves->blocks);
  const std::size_t main = pieces.size();
  auto first = moves->blocks.begin();
  if (b.empty() && first != moves->blocks.end()) s.node = std::move((first++)->node);  // nothing of the line is left
  pieces.push_back(std::move(s));
  for (; first != moves->blocks.end(); ++first) pieces.push_back(std::move(*first));
  put_group(out, std::move(pieces), main);
}

static void carry_out_noting(Program& program, const LegaliseContext& context, StaleWords* stale) {
  settle_pockets(program, context);
  const FactsOf facts(program, context);
  const FeedsBefore feeds(program, context);
  std::set<std::uint32_t> profiles;
  std::vector<ProfileUse> uses;
  CycleCallees callees;
  callees.spindle.emplace(program);
  for (auto& r : program.routines) {
    CyclePass pass(program, r, context, facts, feeds, callees, stale);
    pass.run();
    profiles.merge(pass.profiles());
    uses.insert(uses.end(), pass.uses_of_profiles().begin(), pass.uses_of_profiles().end());
  }
  refuse_foreign_cycles(callees, context);
  add_callees(program, callees);
  keep_used(program, uses, profiles);
  retire_profiles(program, profiles, uses, facts);
  label_profiles(program, uses);
}

static void carry_out_cycles(Program& program, const LegaliseContext& context) {
  carry_out_noting(program, context, nullptr);
}

void lower_cycles(Program& program, const LegaliseContext& context) {
  if (!uses_cycles(program)) return leave_out_data(program, context);
  if (program.dialect == context.target.dialect && !program.dialect.empty() &&
      context.options.cycles != CycleWriting::explode)
    return refuse_other_moves(program, context);
  separate_cycle_ranges(program, context, carry_out_cycles);
  keep_cycle_words(program, context, carry_out_noting);
  carry_out_cycles(program, context);
  leave_out_data(program, context);
}

}  // namespace cnctrans::ir::passes
