#include "ir/analysis/domains/kept_values.h"

#include <algorithm>
#include <string>

#include "ir/edit/rewrite.h"

namespace cnctrans::ir::passes {

std::set<std::size_t> reached_from(const CallGraph& calls, std::size_t routine) {
  std::set<std::size_t> reached{routine};
  for (bool more = true; more;) {
    more = false;
    for (const auto& site : calls.sites()) {
      if (site.callee && reached.count(site.caller) != 0) more = reached.insert(*site.callee).second || more;
    }
  }
  return reached;
}

Writes::Writes(const Program& program) : program_(program) {
  for (std::size_t r = 0; r < program.routines.size(); ++r) {
    for_each_statement(program.routines[r].body, [&](const Statement& s) {
      const auto add = [&](const VarRef& v) { list_.push_back({r, s.id, v}); };
      each_target(s, add);
      const auto* call = std::get_if<CallRoutine>(&s.node);
      if (const auto* m = std::get_if<ModalCall>(&s.node); m != nullptr) call = &m->call;
      if (call == nullptr) return;
      for (const auto& a : call->arguments) {  // the callee may take it by reference
        if (a.by_reference) add(a.reference);
        if (const auto* v = a.value ? as_variable(a.value) : nullptr; v != nullptr && !v->name.empty()) add(*v);
      }
    });
  }
}

bool Writes::touches(const Write& w, const ExprPtr& value, std::size_t reader) const {
  bool found = false;
  walk(value, [&](const ExprPtr& x) {
    const auto* v = as_variable(x);
    if (v == nullptr || v->space != w.variable.space || v->name != w.variable.name) return;
    const VariableSpace* space = v->space < program_.spaces.size() ? &program_.spaces[v->space] : nullptr;
    const bool own = space != nullptr && space->named() && space->scope == Scope::routine;
    if (own && w.routine != reader) return;
    const auto* a = v->index ? as_number(v->index) : nullptr;
    const auto* b = w.variable.index ? as_number(w.variable.index) : nullptr;
    found = found || a == nullptr || b == nullptr || a->value == b->value;
  });
  return found;
}

bool Writes::may_change(const ExprPtr& value, std::size_t reader, const std::set<std::size_t>& routines) const {
  return reads_machine(value) || std::any_of(list_.begin(), list_.end(), [&](const Write& w) {
           return routines.count(w.routine) != 0 && touches(w, value, reader);
         });
}

bool Writes::reads_machine(const ExprPtr& value) {
  bool found = false;
  walk(value, [&found](const ExprPtr& x) { found = found || std::holds_alternative<SystemRef>(x->node); });
  return found;
}

ExprPtr kept(Program& program, const LineInfo& like, const ExprPtr& value, std::string_view what, int& count,
             Body& before) {
  VarRef v{frame_space(program), "K" + std::to_string(++count) + "@" + std::string(what), nullptr, {}};
  before.push_back(make_assign(like, v, value));
  return variable(v, value->type);
}

}  // namespace cnctrans::ir::passes
