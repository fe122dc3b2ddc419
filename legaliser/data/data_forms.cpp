// Machine data that the program writes, under the target's name and in its unit. Behind the cycles: they ask which
// radius the source has written for its tool.
#include <cmath>

#include "base/text.h"
#include "ir/edit/rewrite.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

/// What is divided there: whole steps of the datum.
ExprPtr in_steps(const ExprPtr& e, double units) {
  const auto* b = std::get_if<Binary>(&e->node);
  const auto* steps = b != nullptr && b->op == BinaryOp::divide ? as_number(b->right) : nullptr;
  return steps != nullptr && steps->value == units && b->left->type == Type::integer ? b->left : nullptr;
}

void write(Assign::Item& i, const Statement& s, const LegaliseContext& context) {
  const auto& target = context.target;
  if (!i.to_system || i.system.given || !target.data_form || (target.system_data && target.system_data(i.system)))
    return;
  const auto own = target.data_form(i.system);
  if (!own || !own->writable) return;
  i.system.text = own->text;
  if (own->units == 1) return;
  const auto value = constant_value(i.value);
  if (!value) {
    if (auto whole = in_steps(i.value, own->units)) {
      i.value = std::move(whole);
      return;
    }
    i.value = call(Function::round, {binary(BinaryOp::multiply, i.value, number(own->units))});
    return;
  }
  const double whole = std::nearbyint(*value * own->units);
  if (std::fabs(whole - *value * own->units) > 1e-6) {
    context.diagnostics.warning("TRN-133", s.line.span,
                                own->text + " counts in steps of " + shortest(1 / own->units) + ": the value " +
                                    shortest(*value) + " is rounded");
  }
  i.value = number(whole);
}

}  // namespace

void write_data_forms(Program& program, const LegaliseContext& context) {
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&context](Statement& s) {
      auto* a = std::get_if<Assign>(&s.node);
      for (std::size_t k = 0; a != nullptr && k < a->items.size(); ++k) write(a->items[k], s, context);
    });
  }
}

}  // namespace cnctrans::ir::passes
