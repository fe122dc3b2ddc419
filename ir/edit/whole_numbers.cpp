#include "ir/edit/whole_numbers.h"

#include <cmath>

namespace cnctrans::ir {

namespace {

bool gives_whole(Function f) {
  return f == Function::trunc || f == Function::ceil || f == Function::floor || f == Function::round ||
         f == Function::to_integer || f == Function::to_boolean;
}

bool keeps_whole(BinaryOp op) {
  return op == BinaryOp::add || op == BinaryOp::subtract || op == BinaryOp::multiply || op == BinaryOp::modulo;
}

}  // namespace

bool works_on_bits(BinaryOp op) {
  return op == BinaryOp::bit_and || op == BinaryOp::bit_or || op == BinaryOp::bit_xor;
}

bool is_whole(const ExprPtr& e) {
  if (!e) return false;
  if (const auto* n = std::get_if<Number>(&e->node)) return n->value == std::trunc(n->value);
  if (e->type == Type::integer || e->type == Type::boolean) return true;
  if (const auto* c = std::get_if<Call>(&e->node)) return gives_whole(c->function);
  if (const auto* u = std::get_if<Unary>(&e->node)) return u->op != UnaryOp::negate || is_whole(u->operand);
  const auto* b = std::get_if<Binary>(&e->node);
  if (b == nullptr) return false;
  if (is_comparison(b->op) || works_on_bits(b->op) || b->op == BinaryOp::int_divide) return true;
  return keeps_whole(b->op) && is_whole(b->left) && is_whole(b->right);
}

}  // namespace cnctrans::ir
