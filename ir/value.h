// A number or an expression in the place of a word's value.
#pragma once

#include <string_view>

#include "ir/expr.h"

namespace cnctrans::ir {

/// `text` is the number as written in the source (a view into text the program keeps; empty: made by a pass, write
/// `number`). A pass that changes `number` must clear `text`.
struct Value {
  double number = 0;
  std::string_view text;
  ExprPtr expr;  ///< null: the literal `number`

  Value() = default;
  explicit Value(double n) : number(n) {}
  Value(double n, std::string_view t) : number(n), text(t) {}
  explicit Value(ExprPtr e) : expr(std::move(e)) {}

  [[nodiscard]] bool literal() const { return !expr; }
  [[nodiscard]] bool is(double n) const { return !expr && number == n; }
};

/// The value as an expression (a literal becomes a Number node).
ExprPtr as_expr(const Value& v);
/// Same meaning: same number or structurally equal expression; source text ignored.
bool equal(const Value& a, const Value& b);
/// Literal arithmetic when both are literal, else an expression.
Value add(const Value& a, const Value& b);
Value subtract(const Value& a, const Value& b);
Value scale(const Value& a, double factor);
Value negate(const Value& a);

}  // namespace cnctrans::ir
