#include "ir/value.h"

#include <string>

namespace cnctrans::ir {

ExprPtr as_expr(const Value& v) {
  return v.expr ? v.expr : number(v.number, std::string(v.text));
}

bool equal(const Value& a, const Value& b) {
  if (a.literal() != b.literal()) return false;
  return a.literal() ? a.number == b.number : equal(a.expr, b.expr);
}

Value add(const Value& a, const Value& b) {
  if (a.literal() && b.literal()) return Value{a.number + b.number};
  if (a.is(0)) return b;
  if (b.is(0)) return a;
  if (b.literal() && b.number < 0) return Value{binary(BinaryOp::subtract, as_expr(a), number(-b.number))};
  return Value{binary(BinaryOp::add, as_expr(a), as_expr(b))};
}

Value subtract(const Value& a, const Value& b) {
  if (a.literal() && b.literal()) return Value{a.number - b.number};
  if (b.is(0)) return a;
  if (b.literal() && b.number < 0) return Value{binary(BinaryOp::add, as_expr(a), number(-b.number))};
  return Value{binary(BinaryOp::subtract, as_expr(a), as_expr(b))};
}

Value scale(const Value& a, double factor) {
  if (factor == 1) return a;
  if (a.literal()) return Value{a.number * factor};
  return Value{binary(BinaryOp::multiply, as_expr(a), number(factor))};
}

Value negate(const Value& a) {
  if (a.literal()) return Value{a.number == 0 ? 0 : -a.number};
  return Value{unary(UnaryOp::negate, a.expr)};
}

}  // namespace cnctrans::ir
