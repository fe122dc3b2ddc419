// A dataflow analysis of one pass over the whole program, calls included: what a pass wants to know before each
// statement. A subprogram starts with what all its callers agree on, and gives back what its ends agree on.
#pragma once

#include <optional>
#include <vector>

#include "ir/analysis/call_graph.h"

namespace cnctrans::ir::passes {

/// `Domain` has a type State and:
///   State start(const Routine&, bool called): at the head of a main program, or of a subprogram nothing here calls;
///   void transfer(const Statement&, State&): what one statement does, calls excepted;
///   bool touches(const Routine&): the routine's own statements can change a state;
///   void unknown(State&): after a call of a routine that is not at hand, or of a part of one that touches the state;
///   bool join(State&, const State&): narrows the first to what holds on both ways; true when it changed.
/// It may have both of
///   bool adds(const Routine&): the routine's own statements can put something into a state;
///   void only_kept(State& back, const State& before): behind a call of routines that put nothing in, nothing is there
///     that was not there before the call, whatever other callers have.
/// It may have
///   void crosses(const Statement&, std::optional<std::size_t> callee, State&): the border of a routine, on the way
///   into
///     `callee` or (nullopt) on the way back from the call.
template <class Domain>
class FlowStates {
 public:
  using State = typename Domain::State;
  FlowStates(const Program& program, const Domain& domain)
      : program_(program), domain_(domain), calls_(program), routines_(program.routines.size()) {
    find_touching();
    for (std::size_t i = 0; i < routines_.size(); ++i) {
      routines_[i].flow = control_flow(program, program.routines[i]);
      const bool main = program.routines[i].kind == RoutineKind::main;
      if (main || !calls_.called(i)) enter(i, domain.start(program.routines[i], false));
    }
    for (const auto& site : calls_.sites()) {
      const auto* c = std::get_if<CallRoutine>(&site.statement->node);
      if (site.callee && c != nullptr && c->has_range)
        enter(*site.callee, domain.start(program.routines[*site.callee], true));
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
  /// nullptr: the statement is never reached, or made after the analysis.
  [[nodiscard]] const State* before(const Statement& s) const { return has(s.id) ? &*states_[s.id] : nullptr; }
  /// Behind the last statement and the returns of a routine; nullptr: control never comes there.
  [[nodiscard]] const State* behind(std::size_t routine) const {
    const auto& exit = routines_[routine].exit;
    return exit ? &*exit : nullptr;
  }
  [[nodiscard]] bool called(std::size_t routine) const { return calls_.called(routine); }

 private:
  struct OfRoutine {
    ControlFlow flow;
    std::optional<State> entry, exit;
    bool touches = false, open = false, adds = true;
  };

  void find_touching() {
    for (std::size_t i = 0; i < routines_.size(); ++i) routines_[i].touches = domain_.touches(program_.routines[i]);
    for (bool more = true; more;) {
      more = false;
      for (const auto& site : calls_.sites()) {
        auto& caller = routines_[site.caller];
        if (caller.touches || (site.callee && !routines_[*site.callee].touches)) continue;
        caller.touches = more = true;
      }
    }
    for (const auto& site : calls_.sites()) {
      if (!std::holds_alternative<ModalCall>(site.statement->node)) continue;
      if (site.callee)
        modal_callees_.push_back(*site.callee);
      else
        modal_unknown_ = true;
    }
    find_adding();
  }
  void find_adding() {
    if constexpr (keeps_own) {
      for (std::size_t i = 0; i < routines_.size(); ++i) routines_[i].adds = domain_.adds(program_.routines[i]);
      for (bool more = true; more;) {
        more = false;
        for (const auto& site : calls_.sites()) {
          auto& caller = routines_[site.caller];
          if (caller.adds || (site.callee && !routines_[*site.callee].adds)) continue;
          caller.adds = more = true;
        }
      }
      bool by_modal = modal_unknown_;
      for (const auto callee : modal_callees_) by_modal = by_modal || routines_[callee].adds;
      for (auto& r : routines_) r.adds = r.adds || by_modal;  // any move may run it
    }
  }
  static constexpr bool keeps_own = requires(const Domain& d, const Routine& r, State& a) {
    d.adds(r);
    d.only_kept(a, a);
  };
  void enter(std::size_t routine, const State& state) {
    auto& r = routines_[routine];
    if (!r.entry) {
      r.entry = state;
      r.open = true;
    } else if (domain_.join(*r.entry, state)) {
      r.open = true;
    }
  }
  static bool leaves(const Statement& s) {
    const auto* e = std::get_if<End>(&s.node);
    return e == nullptr || e->returns_from_sub;
  }

  void follow(std::size_t routine) {
    const Routine& r = program_.routines[routine];
    auto& of = routines_[routine];
    std::optional<State> exit = of.exit;
    bool changed = false;
    const auto leave = [&](const State& state) {
      if (!exit) {
        exit = state;
        changed = true;
      } else {
        changed = domain_.join(*exit, state) || changed;
      }
    };
    std::vector<std::uint32_t> open;
    if (r.body.empty()) {
      leave(*of.entry);
    } else {
      meet(r.body.front().id, *of.entry);
      // What a callee gives back may have changed as well: everything is looked at again.
      for_each_statement(r.body, [&](const Statement& s) {
        if (has(s.id)) open.push_back(s.id);
      });
    }
    while (!open.empty()) {
      const auto id = open.back();
      open.pop_back();
      if (id == 0 || id >= of.flow.statements.size() || of.flow.statements[id] == nullptr) continue;
      const Statement& s = *of.flow.statements[id];
      const State before = *states_[id];
      auto state = after(s, before);
      if (!state) continue;
      if (s.line.skip_mask != 0) domain_.join(*state, before);
      if (std::holds_alternative<Return>(s.node)) leave(*state);
      for (const auto next : of.flow.successors[id]) {
        if (next == 0 && leaves(s)) leave(*state);
        if (next != 0 && meet(next, *state)) open.push_back(next);
      }
    }
    if (!changed) return;
    of.exit = exit;
    for (auto& other : routines_) other.open = other.open || other.entry.has_value();
  }
  bool meet(std::uint32_t id, const State& state) {
    if (states_.size() <= id) states_.resize(id + 1);
    auto& there = states_[id];
    if (there) return domain_.join(*there, state);
    there = state;
    return true;
  }
  [[nodiscard]] bool has(std::uint32_t id) const { return id < states_.size() && states_[id]; }

  std::optional<State> after(const Statement& s, State state) {
    if (const auto* call = std::get_if<CallRoutine>(&s.node)) {
      const auto callee = call->computed ? std::nullopt : calls_.index_of(call->routine);
      return called(s, callee, call->has_range, call->count != nullptr, state);
    }
    if (const auto* r = std::get_if<Repeat>(&s.node); r != nullptr && r->has_program)
      return called(s, calls_.index_of(r->program), true, true, state);
    domain_.transfer(s, state);
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr || !b->has_motion) return state;
    if (modal_unknown_) domain_.unknown(state);
    for (const auto callee : modal_callees_) {
      const auto back = called(s, callee, false, true, state);
      if (back) domain_.join(state, *back);
    }
    return state;
  }
  void crosses(const Statement& s, std::optional<std::size_t> callee, State& state) const {
    if constexpr (requires(const Domain& d) { d.crosses(s, callee, state); }) domain_.crosses(s, callee, state);
  }
  std::optional<State> called(const Statement& s, std::optional<std::size_t> callee, bool part, bool maybe_never,
                              State state) {
    if (!callee) {
      domain_.unknown(state);
      return state;
    }
    auto& of = routines_[*callee];
    crosses(s, callee, state);
    if (!part) enter(*callee, state);
    if (!of.touches) return state;
    if (part) {
      domain_.unknown(state);
      return state;
    }
    if (!of.exit) return std::nullopt;
    State back = *of.exit;
    crosses(s, std::nullopt, back);
    if constexpr (keeps_own) {
      if (!of.adds) domain_.only_kept(back, state);
    }
    if (maybe_never) {
      enter(*callee, back);
      domain_.join(back, state);
    }
    return back;
  }

  const Program& program_;
  const Domain& domain_;
  const CallGraph calls_;
  std::vector<OfRoutine> routines_;
  std::vector<std::size_t> modal_callees_;
  bool modal_unknown_ = false;
  std::vector<std::optional<State>> states_;  ///< by the number of the statement
};

}  // namespace cnctrans::ir::passes
