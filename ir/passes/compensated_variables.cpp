#include "ir/passes/compensated_variables.h"

#include "ir/passes/facts.h"
#include "ir/passes/rewrite.h"

namespace cnctrans::ir::passes {

VariableNames compensated_variables(Program& program, const LegaliseContext& context) {
  VariableNames found;
  const FactsOf facts(program, context);
  for (auto& routine : program.routines) {
    for_each_statement(routine.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      const Facts& before = facts.before(s);
      const auto side =
          b != nullptr ? setting_in<CompSide>(*b, before, Setting::comp) : setting<CompSide>(before, Setting::comp);
      if (side == CompSide::off && setting<CompSide>(before, Setting::comp) == CompSide::off) return;
      const auto note = [&found](const VarRef& v) {
        const auto n = v.name.empty() ? constant_index(v) : std::nullopt;
        if (n || !v.name.empty()) found.emplace(v.space, n ? std::to_string(*n) : v.name);
      };
      each_target(s, note);
      each_expression(s, [&](const ExprPtr& e) {
        walk(e, [&](const ExprPtr& x) {
          if (const auto* v = as_variable(x)) note(*v);
        });
      });
    });
  }
  return found;
}

}  // namespace cnctrans::ir::passes
