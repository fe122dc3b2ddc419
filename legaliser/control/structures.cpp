#include "legaliser/control/structures.h"

#include <cmath>

#include "base/text.h"

namespace cnctrans::ir::passes {

namespace {

bool joins(const Binary& b) {
  return b.op == BinaryOp::logical_and || b.op == BinaryOp::logical_or;
}

bool plain_variable(const ExprPtr& e) {
  const auto* v = as_variable(e);
  return v != nullptr && v->indices.empty() && (!v->index || constant_value(v->index));
}

bool operand(const ExprPtr& e) {
  return e && (plain_variable(e) || as_number(e) != nullptr);
}

/// All relations of a chain; false: it is none.
template <class F>
bool each_relation(const ExprPtr& e, const F& visit) {
  const auto* b = e ? std::get_if<Binary>(&e->node) : nullptr;
  if (b == nullptr) return false;
  if (joins(*b)) {
    const auto* right = std::get_if<Binary>(&b->right->node);
    return right != nullptr && is_comparison(right->op) && each_relation(b->left, visit) &&
           each_relation(b->right, visit);
  }
  return is_comparison(b->op) && visit(*b);
}

}  // namespace

bool is_relation_chain(const ExprPtr& e) {
  return each_relation(e, [](const Binary& b) {
    return operand(b.left) && operand(b.right) && (plain_variable(b.left) || plain_variable(b.right));
  });
}

ExprPtr in_target_form(const ExprPtr& e, Compare compare) {
  const auto& b = std::get<Binary>(e->node);
  if (!joins(b)) return variable_first(binary(b.op, b.left, b.right, compare));
  return binary(b.op, in_target_form(b.left, compare), in_target_form(b.right, compare));
}

Structures::Structures(const Program& program, const Routine& routine, const ExactNumbers& numbers)
    : uses_(label_uses(program, routine)), numbers_(numbers) {}

bool Structures::operand_fits(const ExprPtr& e, const Capabilities& target) const {
  return operand(e) && (as_number(e) == nullptr ||
                        (std::fabs(as_number(e)->value) <= target.constant_max &&
                         parse_decimal(rounded(as_number(e)->value, target.constant_decimals)) == as_number(e)->value));
}

bool Structures::condition_fits(const ExprPtr& e, const Capabilities& target) const {
  return is_relation_chain(e) && each_relation(e, [&](const Binary& b) {
           const bool same = b.compare == target.compare || (numbers_.has(b.left) && numbers_.has(b.right));
           return same && operand_fits(b.left, target) && operand_fits(b.right, target);
         });
}

bool Structures::relation_fits(const ExprPtr& e, const Capabilities& target) const {
  const auto* b = e ? std::get_if<Binary>(&e->node) : nullptr;
  if (b == nullptr || !is_comparison(b->op) || b->left->type == Type::string) return false;
  const bool numbers = constant_value(b->left) && constant_value(b->right);
  return !numbers && (b->compare == target.compare || (numbers_.has(b->left) && numbers_.has(b->right)));
}

ExprPtr Structures::unrounded(const ExprPtr& e) const {
  const auto* c = e ? std::get_if<Call>(&e->node) : nullptr;
  const bool rounds =
      c != nullptr && c->args.size() == 1 &&
      (c->function == Function::to_integer || c->function == Function::round || c->function == Function::trunc);
  return rounds && numbers_.whole.exact(c->args[0]) ? c->args[0] : e;
}

bool Structures::closed(const Body& body) const {
  bool good = true;
  for_each_statement(body, [&](const Statement& s) {
    const bool leaves = std::holds_alternative<Jump>(s.node) || std::holds_alternative<Switch>(s.node) ||
                        std::holds_alternative<Return>(s.node) || std::holds_alternative<Opaque>(s.node);
    good = good && !leaves;
    for (const auto& l : labels_on(s.line)) good = good && !uses_.is_target(l) && !uses_.is_end(l);
  });
  return good;
}

}  // namespace cnctrans::ir::passes
