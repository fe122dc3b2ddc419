#include "legaliser/analysis/compensated_variables.h"

#include <algorithm>

#include "ir/edit/rewrite.h"
#include "ir/geometry/contour.h"
#include "legaliser/analysis/facts.h"

namespace cnctrans::ir::passes {

/// The block describes a contour: a line by its angle, a corner, an element whose end follows from the next one.
static bool describes_contour(const Block& b) {
  if (b.motion.extra && b.motion.extra->has_line_angle) return true;
  return contour::marks_of(b).any() || std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
           return std::holds_alternative<Corner>(a.data);
         });
}

VariableNames compensated_variables(Program& program, const LegaliseContext& context) {
  VariableNames found;
  const FactsOf facts(program, context);
  for (auto& routine : program.routines) {
    for_each_statement(routine.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      const Facts& before = facts.before(s);
      const auto side =
          b != nullptr ? setting_in<CompSide>(*b, before, Setting::comp) : setting<CompSide>(before, Setting::comp);
      const bool off = side == CompSide::off && setting<CompSide>(before, Setting::comp) == CompSide::off;
      if (off && (b == nullptr || !describes_contour(*b))) return;
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
