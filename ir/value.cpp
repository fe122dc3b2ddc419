#include "ir/value.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "ir/known_number.h"

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

Value polar_leg(const Value& r, const Value& angle, Function wave) {
  const auto q = known_number(angle);
  if (!q) return Value{binary(BinaryOp::multiply, as_expr(r), call(wave, {angle.expr}))};
  const double quarters = *q / 90;
  if (quarters == std::floor(quarters)) {
    constexpr std::array<int, 4> cosine{1, 0, -1, 0};
    const auto quarter = static_cast<std::size_t>(quarters - 4 * std::floor(quarters / 4));
    const int factor = cosine[wave == Function::cos ? quarter : (quarter + 3) % 4];
    return factor == 0 ? Value{0.0} : factor > 0 ? r : negate(r);
  }
  const double radians = *q * std::numbers::pi / 180;
  if (r.literal()) return Value{r.number * (wave == Function::cos ? std::cos(radians) : std::sin(radians))};
  return Value{binary(BinaryOp::multiply, r.expr, call(wave, {number(*q)}))};
}

}  // namespace cnctrans::ir
