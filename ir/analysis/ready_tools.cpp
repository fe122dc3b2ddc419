#include "ir/analysis/ready_tools.h"

#include "ir/analysis/flow_states.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::ir {

namespace {

bool same_tool(const std::optional<ToolSelect>& a, const std::optional<ToolSelect>& b) {
  if (!a || !b) return !a && !b;
  return a->name == b->name && equal(a->number, b->number);
}

/// A domain of FlowStates.
struct ReadyDomain {
  using State = ReadyTool;

  static State start(const Routine& /*r*/, bool called) { return {std::nullopt, called, false}; }
  static void unknown(State& state) { state = {std::nullopt, true, false}; }
  static bool join(State& a, const State& b) {
    if (a.unsure) return false;
    if (b.unsure || !same_tool(a.tool, b.tool)) {
      unknown(a);
      return true;
    }
    const bool changed = a.changed && !b.changed;
    a.changed = a.changed && b.changed;
    return changed;
  }
  static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      passes::each_target(s, [&found](const VarRef&) { found = true; });
      const auto* b = std::get_if<Block>(&s.node);
      for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i)
        found = found || std::holds_alternative<ToolSelect>(b->actions[i].data) ||
                std::holds_alternative<ToolChange>(b->actions[i].data);
    });
    return found;
  }
  static void transfer(const Statement& s, State& state) {
    passes::each_target(s, [&state](const VarRef& v) {
      if (state.tool && !state.tool->number.literal() && passes::reads(state.tool->number.expr, v)) unknown(state);
    });
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    bool changes = false;
    for (const auto& a : b->actions) {
      changes = changes || std::holds_alternative<ToolChange>(a.data);
      if (const auto* t = std::get_if<ToolSelect>(&a.data)) state = {*t, false, t->changes};
    }
    state.changed = state.changed || changes;
  }
};

}  // namespace

ReadyTools::ReadyTools(const Program& program) {
  const ReadyDomain domain;
  const passes::FlowStates<ReadyDomain> states(program, domain);
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      if (const ReadyTool* state = states.before(s)) before_[s.id] = *state;
    });
  }
}

ReadyTool ReadyTools::before(const Statement& s) const {
  const auto at = before_.find(s.id);
  return at == before_.end() ? ReadyTool{std::nullopt, true, false} : at->second;
}

}  // namespace cnctrans::ir
