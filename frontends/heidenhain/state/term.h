// Arithmetic with values that may be parameters: numbers stay numbers, everything else becomes an expression.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "base/noise.h"
#include "ir/value.h"

namespace cnctrans::frontends::heidenhain {

class Term {
 public:
  Term() = default;
  Term(double n) : v_(n) {}  // NOLINT: a number is a term
  explicit Term(ir::Value v) : v_(std::move(v)) { v_.text = {}; }

  [[nodiscard]] bool literal() const { return v_.literal(); }
  [[nodiscard]] double number() const { return v_.number; }
  /// Without the noise that roots and sines leave in the last places.
  [[nodiscard]] ir::Value value() const {
    constexpr double places = 1e10;
    return literal() ? ir::Value(without_noise(v_.number, places)) : v_;
  }

  friend Term operator+(const Term& a, const Term& b) { return two(ir::BinaryOp::add, a, b, a.number() + b.number()); }
  friend Term operator-(const Term& a, const Term& b) {
    if (a.is(0) && !b.literal()) return Term(ir::negate(b.v_));
    return two(ir::BinaryOp::subtract, a, b, a.number() - b.number());
  }
  friend Term operator*(const Term& a, const Term& b) {
    if (a.is(0) || b.is(0)) return 0;
    if (a.is(1)) return b;
    if (b.is(1)) return a;
    return two(ir::BinaryOp::multiply, a, b, a.number() * b.number());
  }
  friend Term operator/(const Term& a, const Term& b) {
    return two(ir::BinaryOp::divide, a, b, b.number() == 0 ? 0 : a.number() / b.number());
  }
  [[nodiscard]] Term root() const { return one(ir::Function::sqrt, std::sqrt(std::max(0.0, number()))); }
  /// Of degrees.
  [[nodiscard]] Term sine() const { return one(ir::Function::sin, std::sin(number() * std::numbers::pi / 180)); }
  [[nodiscard]] Term cosine() const { return one(ir::Function::cos, std::cos(number() * std::numbers::pi / 180)); }
  [[nodiscard]] bool is(double n) const { return v_.is(n); }

 private:
  static Term two(ir::BinaryOp op, const Term& a, const Term& b, double result) {
    if (a.literal() && b.literal()) return result;
    const bool sum = op == ir::BinaryOp::add || op == ir::BinaryOp::subtract;
    if (sum && b.is(0)) return a;
    if (op == ir::BinaryOp::add && a.is(0)) return b;
    return Term(ir::Value(ir::binary(op, ir::as_expr(a.value()), ir::as_expr(b.value()))));
  }
  [[nodiscard]] Term one(ir::Function f, double result) const {
    return literal() ? Term(result) : Term(ir::Value(ir::call(f, {v_.expr})));
  }

  ir::Value v_;
};

/// A point or a direction of the plane.
struct Pair {
  Term u, v;
  friend Pair operator+(const Pair& a, const Pair& b) { return {a.u + b.u, a.v + b.v}; }
  friend Pair operator-(const Pair& a, const Pair& b) { return {a.u - b.u, a.v - b.v}; }
  friend Pair operator*(const Term& k, const Pair& a) { return {k * a.u, k * a.v}; }
  [[nodiscard]] Pair left() const { return {Term(0) - v, u}; }
  [[nodiscard]] Term length() const { return (u * u + v * v).root(); }
  [[nodiscard]] bool literal() const { return u.literal() && v.literal(); }
  /// Has a length, as far as that can be told.
  [[nodiscard]] bool some() const { return !literal() || std::hypot(u.number(), v.number()) > 1e-9; }
  [[nodiscard]] Pair unit() const {
    // Along an axis no root is needed.
    if (v.is(0) && u.literal()) return {u.number() < 0 ? -1 : 1, 0};
    if (u.is(0) && v.literal()) return {0, v.number() < 0 ? -1 : 1};
    const Term l = length();
    return {u / l, v / l};
  }
  [[nodiscard]] Pair turned(const Term& degrees) const {
    const Term c = degrees.cosine(), s = degrees.sine();
    return {c * u - s * v, s * u + c * v};
  }
};

}  // namespace cnctrans::frontends::heidenhain
