// The programmable frame along a program, calls included.
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "ir/analysis/call_graph.h"
#include "legaliser/frames/frame_state.h"

namespace cnctrans::ir::passes {

namespace {

template <class Visit>
void each_frame_change(const Routine& r, const Visit& visit) {
  for_each_statement(r.body, [&visit](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    for (const auto& a : b->actions) {
      if (const auto* f = std::get_if<FrameOp>(&a.data); f != nullptr && f->change) visit(*f->change);
    }
  });
}

/// Puts the preset in force or out of it, or changes what the words of a shift count in.
bool selects_or_counts(const Routine& r) {
  bool found = false;
  for_each_statement(r.body, [&found](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
      const auto* m = std::get_if<ModalSet>(&b->actions[i].data);
      found = found || std::holds_alternative<WorkOffset>(b->actions[i].data) ||
              (m != nullptr && (m->setting == Setting::units || m->setting == Setting::diameter));
    }
  });
  return found;
}

/// A range of a routine run from elsewhere: neither its start nor its end is the routine's own.
bool runs_part(const Statement& s) {
  if (const auto* r = std::get_if<Repeat>(&s.node)) return r->has_program || r->first.computed || r->last.computed;
  const auto* c = std::get_if<CallRoutine>(&s.node);
  return c != nullptr && c->has_range;
}

/// Leaves the frame alone, asks nothing of it, and goes on with the statement behind it.
bool indifferent(const Statement* s) {
  if (s == nullptr) return true;
  if (const auto* m = std::get_if<ModalCall>(&s->node)) return m->cycle || m->off;
  if (std::holds_alternative<Assign>(s->node) || std::holds_alternative<Message>(s->node) ||
      std::holds_alternative<Label>(s->node))
    return true;
  const auto* b = std::get_if<Block>(&s->node);
  return b != nullptr && (!b->has_motion || b->motion.frame == FrameUse::normal) &&
         std::none_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
           const auto* m = std::get_if<ModalSet>(&a.data);
           return std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data) ||
                  (m != nullptr && m->setting == Setting::plane);
         });
}

/// A repeated range that leaves the frame alone is passed by: what holds before its Repeat holds behind it, whoever
/// else runs the range.
void pass_by_repeats(ControlFlow& flow) {
  std::map<std::pair<bool, std::string>, std::uint32_t> at;  // whether it is a number, its text
  for (std::uint32_t id = 1; id < flow.statements.size(); ++id) {
    if (flow.statements[id] == nullptr) continue;
    for (auto& l : labels_on(flow.statements[id]->line)) at.try_emplace({l.is_number, std::move(l.text)}, id);
  }
  const auto labelled = [&at](const LabelRef& l) {
    const auto found = at.find({l.is_number, l.text});
    return found == at.end() || l.computed ? std::uint32_t{0} : found->second;
  };
  const auto leads_to = [&flow](std::uint32_t from, std::uint32_t to) {
    const auto& next = flow.successors[from];
    return std::find(next.begin(), next.end(), to) != next.end();
  };
  struct Range {
    std::uint32_t first = 0, last = 0;
  };
  const auto range_of = [&](std::uint32_t id) {
    const auto* r = flow.statements[id] != nullptr ? std::get_if<Repeat>(&flow.statements[id]->node) : nullptr;
    if (r == nullptr || r->has_program || r->first.computed || r->last.computed || r->last.text.empty()) return Range{};
    const std::uint32_t a = labelled(r->first), b = labelled(r->last);
    return Range{std::min(a, b), std::max(a, b)};
  };
  const auto changes = [](const Statement* s) {
    if (s == nullptr) return false;
    if (const auto* m = std::get_if<ModalCall>(&s->node)) return !m->cycle && !m->off;
    if (const auto* kept = std::get_if<Opaque>(&s->node)) return !kept->harmless;
    if (std::holds_alternative<CallRoutine>(s->node)) return true;
    const auto* b = std::get_if<Block>(&s->node);
    return b != nullptr && std::any_of(b->actions.begin(), b->actions.end(),
                                       [](const Action& a) { return std::holds_alternative<FrameOp>(a.data); });
  };
  // Neither the range nor what it repeats itself changes a frame.
  constexpr int deepest = 8;
  const std::function<bool(const Range&, int)> leaves_alone = [&](const Range& range, int depth) {
    if (range.first == 0 || depth > deepest) return false;
    for (std::uint32_t i = range.first; i <= range.last; ++i) {
      const Statement* s = flow.statements[i];
      if (changes(s)) return false;
      if (s != nullptr && std::holds_alternative<Repeat>(s->node) && !leaves_alone(range_of(i), depth + 1))
        return false;
    }
    return true;
  };
  const std::function<bool(const Range&, int)> nobody_looks = [&](const Range& range, int depth) {
    if (range.first == 0 || depth > deepest) return false;
    for (std::uint32_t i = range.first; i <= range.last; ++i) {
      const Statement* s = flow.statements[i];
      const bool repeat = s != nullptr && std::holds_alternative<Repeat>(s->node);
      if (repeat ? !nobody_looks(range_of(i), depth + 1) : !indifferent(s)) return false;
    }
    return true;
  };
  // A range that ends with a Repeat ends where the range of that one ends.
  const auto exit_of = [&](std::uint32_t last) {
    for (int depth = 0; depth < deepest; ++depth) {
      const Range inner = range_of(last);
      if (inner.first == 0) break;
      last = inner.last;
    }
    return last;
  };
  std::map<std::uint32_t, std::set<std::uint32_t>> behind;  // last statement of a range -> behind its repeats
  for (std::uint32_t id = 1; id + 1 < flow.statements.size(); ++id) {
    const Range range = range_of(id);
    const std::uint32_t first = range.first, last = range.last, next = id + 1;
    if (first == 0 || (id >= first && id <= last) || flow.statements[next] == nullptr) continue;
    if (!leads_to(exit_of(last), next) || !leaves_alone(range, 0)) continue;
    if (first > 1 && leads_to(first - 1, first) && nobody_looks(range, 0))
      std::erase_if(flow.successors[id], [first, last](std::uint32_t n) { return n >= first && n <= last; });
    flow.successors[id].push_back(next);
    if (next != last + 1) behind[exit_of(last)].insert(next);
  }
  for (const auto& entry : behind) {
    std::erase_if(flow.successors[entry.first], [&ids = entry.second](std::uint32_t n) { return ids.count(n) != 0; });
  }
}

bool leaves_by(const Statement& s) {
  const auto* e = std::get_if<End>(&s.node);
  return e == nullptr || e->returns_from_sub;
}

}  // namespace

FrameStates::FrameStates(const Program& program, const FactsOf& facts, const LegaliseContext& context)
    : program_(program), facts_(facts), machine_(context.source_machine), routines_(program.routines.size()) {
  look();
  const CallGraph calls(program);
  for (std::size_t i = 0; i < routines_.size(); ++i) {
    const bool uncalled = program.routines[i].kind == RoutineKind::sub && !calls.called(i);
    const bool assumed = uncalled && context.options.uncalled == Uncalled::power_on;
    if (program.routines[i].kind == RoutineKind::main || assumed) enter(i, neutral_);
    if (uncalled && !assumed) {
      FrameState any;
      any.limit(anything());
      any.forget();
      enter(i, any);
    }
  }
  for (const auto& site : calls.sites()) {
    if (!site.callee) continue;
    const auto* c = std::get_if<CallRoutine>(&site.statement->node);
    if (c == nullptr || c->computed || c->has_range) enter(*site.callee, unknown_);
  }
  for (bool more = true; more;) {
    more = false;
    for (std::size_t i = 0; i < routines_.size(); ++i) {
      if (!routines_[i].open) continue;
      routines_[i].open = false;
      follow(i);
      more = true;
    }
  }
}

/// A program that is not here may use every slot but the preset.
SlotUses FrameStates::anything() const {
  SlotUse any{0, true, true, true};
  for (const auto& a : machine_.axes) any.axes |= 1U << a.id;
  SlotUses uses;
  for (const auto s : machine_.frame_order) {
    if (s != FrameSlot::preset) uses[static_cast<std::size_t>(s)] = any;
  }
  return uses;
}

/// What is ever put into the slots, who changes frames.
void FrameStates::look() {
  SlotUses uses;
  for (std::size_t i = 0; i < routines_.size(); ++i) {
    const Routine& r = program_.routines[i];
    routines_[i].flow = control_flow(program_, r);
    pass_by_repeats(routines_[i].flow);
    routines_[i].changes_frames = selects_or_counts(r);
    each_frame_change(r, [&](const FrameChange& c) {
      routines_[i].changes_frames = true;
      auto& u = uses[static_cast<std::size_t>(c.slot)];
      u.turns = u.turns || c.kind == FrameKind::rotate;
      u.scales = u.scales || c.kind == FrameKind::scale;
      u.mirrors = u.mirrors || c.kind == FrameKind::mirror;
      for (const auto& w : c.words) {
        const bool shifts = c.kind == FrameKind::translate || (c.kind == FrameKind::rotate && c.has_angle);
        if (w.axis < PlanarFrame::axes && shifts) u.axes |= 1U << w.axis;
      }
      if (c.slot == FrameSlot::chain && (u.turns || u.mirrors)) {  // turned shifts reach the other axes of the plane
        if ((u.axes & 7U) != 0) u.axes |= 7U;
      }
    });
  }
  const CallGraph calls(program_);
  for (bool more = true; more;) {
    more = false;
    for (const auto& site : calls.sites()) {
      auto& caller = routines_[site.caller];
      const bool changes = !site.callee || routines_[*site.callee].changes_frames;
      if (changes && !caller.changes_frames) caller.changes_frames = more = true;
    }
  }
  for (const auto& site : calls.sites()) {
    const bool modal = std::holds_alternative<ModalCall>(site.statement->node);
    if (!site.callee) {  // a program that is not here may shift any axis
      const SlotUses any = anything();
      for (std::size_t i = 0; i < frame_slots; ++i) {
        uses[i].axes |= any[i].axes;
        uses[i].turns = uses[i].turns || any[i].turns;
        uses[i].scales = uses[i].scales || any[i].scales;
        uses[i].mirrors = uses[i].mirrors || any[i].mirrors;
      }
    }
    modal_calls_change_ = modal_calls_change_ || (modal && (!site.callee || routines_[*site.callee].changes_frames));
  }
  neutral_.limit(uses);
  unknown_.limit(uses);
  unknown_.forget();
}

void FrameStates::enter(std::size_t routine, FrameState state) {
  auto& r = routines_[routine];
  state.forget_expressions();
  if (r.entry) {
    FrameState joined = *r.entry;
    joined.join(state);
    if (joined == *r.entry) return;
    state = joined;
  }
  r.entry = state;
  r.open = true;
}

void FrameStates::follow(std::size_t routine) {
  const Routine& r = program_.routines[routine];
  auto& of = routines_[routine];
  std::optional<FrameState> exit;
  const auto leave = [&exit](const FrameState& state) {
    if (exit)
      exit->join(state);
    else
      exit = state;
  };
  std::vector<std::uint32_t> open;
  if (r.body.empty()) {
    leave(*of.entry);
  } else {
    states_.resize(std::max(states_.size(), of.flow.statements.size()));
    for_each_statement(r.body, [this](const Statement& s) { states_[s.id].reset(); });
    states_[r.body.front().id] = std::make_shared<FrameState>(*of.entry);
    open.push_back(r.body.front().id);
  }
  while (!open.empty()) {
    const auto id = open.back();
    open.pop_back();
    if (id == 0 || id >= of.flow.statements.size() || of.flow.statements[id] == nullptr) continue;
    const Statement& s = *of.flow.statements[id];
    const State before = states_[id];
    State state = after(routine, s, before);
    if (!state) continue;
    if (s.line.skip_mask != 0 && state != before) {
      auto either = std::make_shared<FrameState>(*state);
      either->join(*before);
      state = std::move(either);
    }
    if (std::holds_alternative<Return>(s.node)) leave(*state);
    for (const auto next : of.flow.successors[id]) {
      if (next == 0 && leaves_by(s)) leave(*state);
      if (next == 0 || states_[next] == state) continue;
      State& there = states_[next];
      if (!there) {
        there = state;
      } else {
        auto joined = std::make_shared<FrameState>(*there);
        joined->join(*state);
        if (*joined == *there) continue;
        there = std::move(joined);
      }
      open.push_back(next);
    }
  }
  if (!exit || (of.exit && *of.exit == *exit)) return;
  if (of.exit) exit->join(*of.exit);
  if (of.exit && *of.exit == *exit) return;
  of.exit = exit;
  for (auto& other : routines_) other.open = other.open || other.entry.has_value();
}

namespace {
/// The block may change the frame.
bool touches(const Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    const auto* m = std::get_if<ModalSet>(&a.data);
    return std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data) ||
           (m != nullptr && (m->setting == Setting::units || m->setting == Setting::diameter));
  });
}
}  // namespace

FrameStates::State FrameStates::after(std::size_t routine, const Statement& s, const State& before) {
  const auto forgotten = [&before] {
    auto state = std::make_shared<FrameState>(*before);
    state->forget();
    return state;
  };
  if (const auto* b = std::get_if<Block>(&s.node)) {
    const bool runs_subprogram = b->has_motion && modal_calls_change_;
    if (!touches(*b)) return runs_subprogram ? forgotten() : before;
    auto state = std::make_shared<FrameState>(*before);
    state->follow_units(*b, facts_.before(s), machine_);
    for (const auto& a : b->actions) {
      if (const auto* f = std::get_if<FrameOp>(&a.data); f != nullptr && f->change)
        state->apply(*f->change, facts_.before(s), *b, machine_);
      if (const auto* w = std::get_if<WorkOffset>(&a.data)) state->select(*w, machine_);
    }
    if (runs_subprogram) state->forget();
    return state;
  }
  if (runs_part(s)) return forgotten();
  if (const auto* call = std::get_if<CallRoutine>(&s.node)) return after_call(routine, *call, before);
  if (std::holds_alternative<ModalCall>(s.node)) return modal_calls_change_ ? forgotten() : before;
  if (!before->has_expressions()) return before;
  auto state = std::make_shared<FrameState>(*before);
  each_target(s, [&state](const VarRef& v) { state->forget(v); });
  return state;
}

FrameStates::State FrameStates::after_call(std::size_t routine, const CallRoutine& call, const State& before) {
  const Routine* callee = call.computed ? nullptr : program_.find(call.routine);
  if (callee == nullptr) {
    auto state = std::make_shared<FrameState>(*before);
    state->forget();
    return state;
  }
  auto& of = routines_[static_cast<std::size_t>(callee - program_.routines.data())];
  enter(static_cast<std::size_t>(callee - program_.routines.data()), *before);
  if (!of.changes_frames) return without_written(routine, before);
  if (!of.exit) return nullptr;
  auto back = std::make_shared<FrameState>(*of.exit);
  back->forget_expressions();
  if (call.count) {  // any number of times, none included
    enter(static_cast<std::size_t>(callee - program_.routines.data()), *back);
    back->join(*before);
  }
  return back;
}

/// What other routines write may stand in the expressions of the caller's frame.
FrameStates::State FrameStates::without_written(std::size_t caller, const State& before) const {
  if (!before->has_expressions()) return before;
  auto state = std::make_shared<FrameState>(*before);
  for (std::size_t i = 0; i < program_.routines.size(); ++i) {
    if (i == caller) continue;
    for_each_statement(program_.routines[i].body, [&state](const Statement& s) {
      each_target(s, [&state](const VarRef& v) { state->forget(v); });
    });
  }
  return state;
}

const FrameState& FrameStates::before(const Statement& s) const {
  const bool reached = s.id < states_.size() && states_[s.id];
  return reached ? *states_[s.id] : unknown_;
}

}  // namespace cnctrans::ir::passes
