// Calls while a cycle is active: the points lie in the called routine.
#include <algorithm>

#include "legaliser/cycles/cycle_pass.h"

namespace cnctrans::ir::passes {

namespace {

/// Something in the routine could be a point of the cycle (F or S alone is one of a modal call), or runs another one.
bool moves_anywhere(const Body& body) {
  bool found = false;
  for_each_statement(body, [&found](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    found =
        found || (b != nullptr && (b->has_motion || disturbs_call(*b))) || std::holds_alternative<CallRoutine>(s.node);
    for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i)
      found = found || std::holds_alternative<CycleDefine>(b->actions[i].data);
  });
  return found;
}

/// Defines or ends a cycle, or calls something that may.
bool touches_cycle(const Body& body) {
  bool found = false;
  for_each_statement(body, [&found](const Statement& s) {
    found = found || std::holds_alternative<CallRoutine>(s.node) || std::holds_alternative<ModalCall>(s.node);
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    const bool points = pattern_in(*b) != nullptr;
    for (const auto& a : b->actions)
      found = found || (std::holds_alternative<CycleDefine>(a.data) && !points) ||
              std::holds_alternative<CycleCancel>(a.data);
  });
  return found;
}

void each_call(Program& program, const std::function<void(CallRoutine&)>& visit) {
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&visit](Statement& s) {
      if (auto* c = std::get_if<CallRoutine>(&s.node)) visit(*c);
      if (auto* m = std::get_if<ModalCall>(&s.node); m != nullptr && !m->cycle) visit(m->call);
    });
  }
}

/// Calls `visit` for every expression among the words of the cycle.
void each_word(const CyclePtr& cycle, const std::function<void(const ExprPtr&)>& visit) {
  Cycle copy = *cycle;
  bool changed = false;
  visit_values(
      copy,
      [&visit](Value& v, const Place&) {
        if (!v.literal()) visit(v.expr);
        return false;
      },
      changed);
}

}  // namespace

bool local_variable(const Program& program, const VarRef& v) {
  if (v.space >= program.spaces.size()) return true;
  const auto& space = program.spaces[v.space];
  if (space.named()) return space.scope != Scope::global;
  const auto n = constant_index(v);
  return std::any_of(space.segments.begin(), space.segments.end(), [&](const SpaceSegment& part) {
    return (!n || (*n >= part.lo && *n <= part.hi)) && part.scope != Scope::global;
  });
}

static bool reads_local_variables(const CyclePtr& cycle, const Program& program) {
  bool own = false;
  each_word(cycle, [&](const ExprPtr& e) {
    map_expr(e, [&](const ExprPtr& n) {
      if (const auto* v = as_variable(n)) own = own || local_variable(program, *v);
      return n;
    });
  });
  return own;
}

std::optional<std::size_t> CyclePass::callee_of(const CallRoutine& call) const {
  if (call.computed || call.has_range || call.tail || call.optional) return std::nullopt;
  for (std::size_t i = 0; i < program_.routines.size(); ++i) {
    const Routine& r = program_.routines[i];
    if (r.name == call.routine && r.kind != RoutineKind::main) return i;
  }
  return std::nullopt;
}

/// A number or a name that no other routine has.
void CyclePass::name_copy(CycleCallees::Copy& copy) {
  RoutineName& name = copy.routine.name;
  ++callees_.made;
  if (name.text.empty()) {
    std::int64_t number = name.number;
    const auto taken = [this, &copy](std::int64_t n) {
      return std::any_of(program_.routines.begin(), program_.routines.end(),
                         [n](const Routine& r) { return r.name.number == n; }) ||
             std::any_of(callees_.copies.begin(), callees_.copies.end(),
                         [&copy, n](const auto& c) { return c.get() != &copy && c->routine.name.number == n; });
    };
    number += callees_.made;
    while (taken(number)) ++number;
    name.number = number;
  } else {
    name.text += "_" + std::to_string(callees_.made);
  }
}

/// The routine as it is where the cycle of now is in force.
CycleCallees::Copy& CyclePass::write_copy(std::size_t callee) {
  callees_.copies.push_back(std::make_unique<CycleCallees::Copy>());
  CycleCallees::Copy* copy = callees_.copies.back().get();
  copy->original = callee;
  copy->source = active_->source;
  copy->native = active_->native;
  copy->on_target = active_->on_target;
  copy->maybe_on_target = active_->maybe_on_target;
  copy->single = active_->single;
  copy->routine = program_.routines[callee];
  name_copy(*copy);
  CyclePass inner(program_, copy->routine, context_, facts_, feeds_, callees_, stale_);
  inner.active_ = active_;
  inner.sense_ = sense_;  // this routine is taken apart just now: what holds throughout is not to be seen any more
  inner.sense_.forget();
  inner.surely_active_ = !touches_cycle(copy->routine.body);
  inner.may_end_ = !inner.surely_active_;
  inner.run();
  copy->ended_after = !inner.active_;
  copy->on_target_after = inner.active_ && inner.active_->on_target && !inner.active_->maybe_on_target;
  copy->maybe_on_target_after = inner.active_ && inner.active_->maybe_on_target;
  if (inner.active_) copy->height_after = inner.active_->height;
  copy->left_height = inner.active_ && inner.active_->left_height;
  copy->finished = true;
  return *copy;
}

bool CyclePass::call_with_cycle(CallRoutine& call, const LineInfo& where, const Facts& facts) {
  const bool stays_active = by_call_ && active_->native;
  const auto callee = stays_active ? std::nullopt : callee_of(call);
  if (!callee || !std::holds_alternative<HoleCycle>(active_->source->node)) return false;
  if (const Body& body = program_.routines[*callee].body; !moves_anywhere(body)) {
    for_each_statement(body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      const auto* offset = b != nullptr ? action_in<WorkOffset>(*b) : nullptr;
      if (offset != nullptr && offset->off && (active_->on_target || active_->maybe_on_target))
        context_.diagnostics.error("TRN-331", where.span, std::string(offset_ends),
                                   "cancel the cycle before the call and define it again behind it");
      if (moves_coordinates(s)) lose_height(s);
    });
    return false;
  }
  const bool unknown = facts.reachable && !facts.cycle_active_known && !surely_active_;
  if (unknown || !sure(facts)) {
    context_.diagnostics.error("TRN-331", where.span,
                               "which cycle is active at this call depends on the path that leads here, and the "
                               "subprogram has its points",
                               "define the cycle again before the call");
    return true;
  }
  const bool sees_others = call.level == CallLevel::new_level || !call.arguments.empty();
  if (sees_others && !(active_->native && active_->on_target) && reads_local_variables(active_->source, program_)) {
    context_.diagnostics.error(
        "TRN-331", where.span,
        "the points of this cycle lie in a subprogram that does not see the variables its words read",
        "give the cycle's words as numbers or by variables that every routine sees");
    return true;
  }
  // Another cycle in force in each round of a call that leads back here would need a copy for each of them.
  const bool leads_back = std::any_of(callees_.copies.begin(), callees_.copies.end(), [&](const auto& c) {
    return c->original == *callee && !c->finished && (c->native != active_->native || c->source != active_->source);
  });
  if (leads_back) {
    context_.diagnostics.error(
        "TRN-331", where.span,
        "this call leads back into the subprogram that it stands in, and another cycle may be in force there",
        "write the repetition as a loop");
    return true;
  }
  const auto same = std::find_if(callees_.copies.begin(), callees_.copies.end(), [&](const auto& c) {
    return c->original == *callee && c->source == active_->source && c->native == active_->native &&
           c->on_target == active_->on_target && c->maybe_on_target == active_->maybe_on_target &&
           c->single == active_->single;
  });
  CycleCallees::Copy* copy = same == callees_.copies.end() ? nullptr : same->get();
  if (copy != nullptr && !copy->finished) return false;  // it calls itself
  if (copy == nullptr) copy = &write_copy(*callee);
  call.routine = copy->routine.name;
  if (copy->ended_after) {
    active_.reset();
    return true;
  }
  active_->left_height = active_->left_height || copy->left_height;
  active_->on_target = copy->on_target_after;
  active_->maybe_on_target = copy->maybe_on_target_after;
  active_->height = copy->height_after;
  return true;
}

void add_callees(Program& program, CycleCallees& callees) {
  if (callees.copies.empty()) return;
  std::vector<std::pair<RoutineName, RoutineName>> originals;  // of the copy, of its original
  for (auto& c : callees.copies) {
    originals.emplace_back(c->routine.name, program.routines[c->original].name);
    program.routines.push_back(std::move(c->routine));
  }
  // An original that nothing calls any more leaves its name to the first copy.
  for (const auto& entry : originals) {
    const auto &copy = entry.first, &original = entry.second;
    bool called = false;
    each_call(program, [&](const CallRoutine& c) { called = called || c.computed || c.routine == original; });
    const auto at = std::find_if(program.routines.begin(), program.routines.end(),
                                 [&](const Routine& r) { return r.name == original; });
    if (called || at == program.routines.end()) continue;
    const auto by = std::find_if(program.routines.begin(), program.routines.end(),
                                 [&](const Routine& r) { return r.name == copy; });
    if (by == program.routines.end()) continue;
    by->name = original;
    *at = std::move(*by);
    program.routines.erase(by);
    each_call(program, [&](CallRoutine& c) {
      if (c.routine == copy) c.routine = original;
    });
  }
}

}  // namespace cnctrans::ir::passes
