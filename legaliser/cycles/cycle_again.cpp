// Statements that are no blocks, and what it takes to write the active cycle once more: its words as they were at its
// definition, in the unit in force.
#include <algorithm>
#include <cmath>

#include "legaliser/cycles/cycle_pass.h"

namespace cnctrans::ir::passes {

void CyclePass::lower(Statement&& s, Body& out) {
  check_words(s);
  leave_while_off(s);
  if (auto* m = std::get_if<ModalCall>(&s.node)) {
    // What ends a modal subprogram that is made at once as well leaves a modal cycle in force.
    if (m->off && m->here && facts_.before(s).modal_call == 0) return leave_line(std::move(s), out);
    if (m->off && active_ && !m->here) return cancel_statement(std::move(s), out);
    // Only a cycle can be meant, or nothing.
    const bool nothing = facts_.before(s).cycle_active_known && !facts_.before(s).cycle_active;
    const bool no_call = facts_.before(s).modal_call == 0 && !(nothing && context_.target.modal_call);
    if (m->off && !by_call_ && no_call) {
      const bool bare = s.line.number.empty() && s.line.labels.empty() && s.line.comments.empty();
      if (nothing && bare) return;
      if (nothing) {
        s.node = Label{};
      } else {
        Block b;
        b.actions.push_back(action(CycleCancel{}));
        tap_feed_ = tap_feed_ || tap_by_a_jump(facts_.before(s));
        feed_comes_back(s, b, facts_.before(s));
        s.node = std::move(b);
      }
      out.push_back(std::move(s));
      return;
    }
    if (!m->off && m->cycle) return modal_call(std::move(s), out);
  }
  if (std::holds_alternative<Block>(s.node)) return block(std::move(s), out);
  if (std::holds_alternative<Assign>(s.node) && refuse_other_levels(s, out)) return;
  note_foreign(s, facts_.before(s));
  if (const auto* call = std::get_if<CallRoutine>(&s.node); call != nullptr && active_) callee_sets_plane(*call, s);
  if (auto* call = std::get_if<CallRoutine>(&s.node);
      call != nullptr && active_ && call_with_cycle(*call, s.line, facts_.before(s))) {
    out.push_back(std::move(s));
    return;
  }
  if (active_ && (!active_->native || context_.target.cycle_each_call) &&
      (std::holds_alternative<CallRoutine>(s.node) || std::holds_alternative<Repeat>(s.node))) {
    context_.diagnostics.error(
        "TRN-331", s.line.span,
        "a call or a repeated part while a cycle is active that the target lacks: which holes it drills "
        "can't be seen here",
        "cancel the cycle before the call");
  }
  out.push_back(std::move(s));
}

/// The plane function ends the target's own cycle: the next point defines it again.
static bool sets_plane(const Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    const auto* m = std::get_if<ModalSet>(&a.data);
    return m != nullptr && m->setting == Setting::plane;
  });
}

void CyclePass::plain(Statement&& s, Body&& pieces, Body& out) {
  auto& b = std::get<Block>(s.node);
  // A block that is no point, while the target's own cycle would make it one or take its words for the depth.
  const bool plane_ends = !by_call_ && active_->native && (active_->on_target || active_->maybe_on_target) &&
                          context_.target_machine.policies.cycle_plane_function == machine::CyclePlaneFunction::ends &&
                          sets_plane(b);
  const bool refused_word = context_.target_machine.policies.cycle_axis_word == machine::CycleAxisWord::refused &&
                            active_->native && (active_->on_target || active_->maybe_on_target) && !by_call_ &&
                            b.has_motion && b.motion.moves() && b.motion.frame == FrameUse::normal;
  const Facts& facts = facts_.before(s);
  if (refused_word || plane_ends) {
    pieces.push_back(off_statement(s.line, false));
    active_->on_target = active_->maybe_on_target = false;
    const bool cuts = refused_word && motion_in(b, facts) != MotionKind::rapid;
    if (facts.feed || cuts) feed_comes_back(s, std::get<Block>(pieces.back().node), facts);
  }
  const auto w = tool_axis(active_->source, b, facts);
  if (w && moves_along(b, *w)) active_->height = height_after(b, facts, *w);
  put(out, std::move(pieces), std::move(s));
}

namespace {

/// Calls `visit` for every expression among the words of the cycle.
void each_word(const Cycle& cycle, const std::function<void(const ExprPtr&)>& visit) {
  Cycle copy = cycle;
  bool changed = false;
  visit_values(
      copy,
      [&visit](Value& v, const Place&) {
        if (!v.literal()) visit(v.expr);
        return false;
      },
      changed);
}

bool reads_in(const Cycle& cycle, const VarRef& v) {
  bool found = false;
  each_word(cycle, [&](const ExprPtr& e) { found = found || reads(e, v); });
  return found;
}

}  // namespace

std::vector<VarRef> CyclePass::writes_of(const Statement& s, std::set<std::size_t>& called) const {
  std::vector<VarRef> all;
  each_target(s, [&all](const VarRef& v) { all.push_back(v); });
  const auto* call = std::get_if<CallRoutine>(&s.node);
  const auto callee = call != nullptr ? callee_of(*call) : std::nullopt;
  if (!callee || !called.insert(*callee).second) return all;
  const bool own_level = call->level == CallLevel::new_level || !call->arguments.empty();
  for_each_statement(program_.routines[*callee].body, [&](const Statement& inner) {
    for (auto& v : writes_of(inner, called)) {
      if (!own_level || !local_variable(program_, v)) all.push_back(std::move(v));
    }
  });
  return all;
}

void CyclePass::look_for_writes() {
  for_each_statement(editor_.routine.body, [this](Statement& s) {
    std::set<std::size_t> called;
    for (auto& v : writes_of(s, called)) writes_.emplace_back(s.id, std::move(v));
    last_id_ = std::max(last_id_, s.id);
    each_label_ref(s, [&](LabelRef& l, bool) { last_use_[{l.is_number, l.text}] = s.id; });
  });
}

void CyclePass::note_write(const VarRef& v) {
  if (active_ && reads_in(*active_->source, v)) active_->stale.push_back(v);
}

/// What is changed further down in the text counts where control comes back up.
void CyclePass::note_writes_of_loop(std::uint32_t first, std::uint32_t last) {
  for (const auto& [id, v] : writes_) {
    if (id >= first && id <= last) note_write(v);
  }
}

void CyclePass::come_back_to(const Statement& s) {
  for (const auto& l : labels_on(s.line)) {
    const auto use = last_use_.find({l.is_number, l.text});
    if (!uses_.computed && use == last_use_.end()) continue;
    const std::uint32_t last = uses_.computed ? last_id_ : use->second;
    note_writes_of_loop(s.id, last);
    for (const Statement* r = rest_.first; r != rest_.second && r->id <= last; ++r) leave_height(*r);
  }
}

void CyclePass::note_stale(const VarRef& v) const {
  if (stale_ == nullptr) return;
  for (const auto id : active_->said_by) stale_->found[id].push_back(v);
}

bool CyclePass::refuse_stale(Statement& s, Body& out) {
  if (active_->stale.empty()) return false;
  for (const auto& v : active_->stale) note_stale(v);
  refuse(s, program_, context_, "TRN-330",
         "a variable that the words of the active cycle read has changed since its definition, and the target's cycle "
         "would have to be written once more here",
         "end the cycle before the change and define it again, or read copies of the variables in its words");
  active_->stale.clear();  // said once
  active_->from = s.id;
  late_.clear();
  out.push_back(std::move(s));
  return true;
}

/// The words that a change of the cycle leaves alone are written again, and the others are new.
bool CyclePass::refuse_stale_change(Statement& s, const CycleDefine& d, Body& out) {
  const auto* change = std::get_if<HoleCycle>(&d.cycle->node);
  if (change == nullptr || !change->keeps_initial || !active_ || active_->stale.empty()) return false;
  HoleCycle left = *change;
  const auto* before = std::get_if<HoleCycle>(&active_->source->node);
  if (before == nullptr) return false;
  left.reference = change->reference.given ? Level{} : before->reference;
  left.bottom = change->bottom.given ? Level{} : before->bottom;
  const Cycle words{left};
  const bool again =
      std::any_of(active_->stale.begin(), active_->stale.end(), [&](const VarRef& v) { return reads_in(words, v); });
  return again && refuse_stale(s, out);
}

/// The words of the cycle are read at each of its points, or at the first: they must be what they were. The target's
/// own cycle keeps them, until it has to be written again.
void CyclePass::check_words(const Statement& s) {
  if (!active_) return;
  come_back_to(s);
  std::set<std::size_t> called;
  const bool kept = active_->native && active_->on_target;
  if (kept) {
    for (const auto& v : writes_of(s, called)) note_write(v);
    return;
  }
  each_target(s, [&](const VarRef& v) {
    if (!reads_in(*active_->source, v)) return;
    note_stale(v);
    context_.diagnostics.error(
        "TRN-330", s.line.span,
        "a variable that the words of the active cycle read is changed, and the cycle is written "
        "behind that place",
        "end the cycle before the change");
  });
}

}  // namespace cnctrans::ir::passes
