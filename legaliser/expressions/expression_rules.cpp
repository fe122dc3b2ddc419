// What becomes of an operator or function that the target lacks (equivalences 19.3). Each rule is exact unless it
// reports.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "legaliser/expressions/expression_lowering.h"

namespace cnctrans::ir::passes {

namespace {

ExprPtr add(const ExprPtr& a, const ExprPtr& b) {
  return binary(BinaryOp::add, a, b);
}
ExprPtr sub(const ExprPtr& a, const ExprPtr& b) {
  return binary(BinaryOp::subtract, a, b);
}
ExprPtr mul(const ExprPtr& a, const ExprPtr& b) {
  return binary(BinaryOp::multiply, a, b);
}
ExprPtr div(const ExprPtr& a, const ExprPtr& b) {
  return binary(BinaryOp::divide, a, b);
}
ExprPtr rel(BinaryOp op, const ExprPtr& a, double b) {
  return binary(op, a, number(b));
}
ExprPtr f1(Function f, const ExprPtr& a) {
  return call(f, {a});
}

/// Whatever its variables hold.
bool never_negative(const ExprPtr& e) {
  if (const auto v = constant_value(e)) return *v >= 0;
  if (const auto* c = std::get_if<Call>(&e->node)) {
    switch (c->function) {
      case Function::abs:
      case Function::sqrt:
      case Function::square: return true;
      case Function::max: return std::any_of(c->args.begin(), c->args.end(), never_negative);
      case Function::min:
      case Function::ceil:
      case Function::floor:
      case Function::trunc:
      case Function::round: return std::all_of(c->args.begin(), c->args.end(), never_negative);
      default: return false;
    }
  }
  const auto* b = std::get_if<Binary>(&e->node);
  if (b == nullptr) return false;
  if (is_comparison(b->op)) return true;
  const bool keeps = b->op == BinaryOp::add || b->op == BinaryOp::multiply || b->op == BinaryOp::divide;
  return keeps && never_negative(b->left) && never_negative(b->right);
}

}  // namespace

ExprPtr ExpressionLowering::binary_rule(const Binary& b, const ExprPtr& e) {
  const auto& t = editor_.target();
  if (is_comparison(b.op) && b.op != BinaryOp::eq && b.op != BinaryOp::ne && b.left->type == Type::string)
    return fail(e, "which of two texts comes first is not known here, and the target can't tell");
  if ((is_comparison(b.op) || b.op == BinaryOp::logical_and || b.op == BinaryOp::logical_or ||
       b.op == BinaryOp::logical_xor) &&
      !t.relation_as_value)
    return truth_value(e);
  if (has(b.op)) {
    const ExprPtr left = node(b.left), right = node(b.right);
    return left == b.left && right == b.right ? e : binary(b.op, left, right, b.compare);
  }
  switch (b.op) {
    case BinaryOp::modulo: {
      const ExprPtr x = primary(b.left), y = primary(b.right);
      return node(sub(x, mul(f1(Function::trunc, div(x, y)), y)));
    }
    case BinaryOp::int_divide: return node(f1(Function::trunc, div(b.left, b.right)));
    case BinaryOp::power: return power(b, e);
    case BinaryOp::bit_xor: {  // what one side has, less what both have
      const ExprPtr x = primary(b.left), y = primary(b.right);
      return node(sub(binary(BinaryOp::bit_or, x, y), binary(BinaryOp::bit_and, x, y)));
    }
    default: return fail(e, "the target has no operator " + std::string(name(b.op)));
  }
}

ExprPtr ExpressionLowering::power(const Binary& b, const ExprPtr& e) {
  const auto exponent = constant_value(b.right);
  if (exponent && *exponent == 0) return number(1);
  if (exponent && *exponent == 0.5) return node(f1(Function::sqrt, b.left));
  if (exponent && *exponent == 2 && has(Function::square)) return call(Function::square, {node(b.left)});
  if (exponent && std::nearbyint(*exponent) == *exponent && std::fabs(*exponent) <= 8) {
    const ExprPtr base = primary(b.left);
    ExprPtr product = base;
    for (int i = 1; i < static_cast<int>(std::fabs(*exponent)); ++i) product = mul(product, base);
    return *exponent > 0 ? node(product) : node(div(number(1), product));
  }
  if (has(Function::exp) && has(Function::ln)) {
    editor_.context.diagnostics.warning(
        "TRN-112", word_span(like_.span, e->pos),
        "a power with a computed exponent is written with EXP and LN: right for a base above 0, "
        "with a relative error up to 1e-12");
    return node(f1(Function::exp, mul(b.right, f1(Function::ln, b.left))));
  }
  return fail(e, "the target has no power with this exponent");
}

ExprPtr ExpressionLowering::truth_value(const ExprPtr& e) {
  const auto v = temporary();
  if (!v) return e;
  assign(*v, number(0));
  const LabelRef behind = editor_.fresh_label();
  jump_if(negated_condition(e), behind);
  assign(*v, number(1));
  label_here(behind);
  return variable(*v);
}

ExprPtr ExpressionLowering::unary_rule(const Unary& u, const ExprPtr& e) {
  const auto& t = editor_.target();
  if (u.op == UnaryOp::logical_not && (!t.relation_as_value || t.unary.count(u.op) == 0)) {
    if (!t.relation_as_value) return truth_value(e);
    const ExprPtr turned = negated_condition(u.operand);
    return std::holds_alternative<Unary>(turned->node) ? node(rel(BinaryOp::eq, u.operand, 0)) : node(turned);
  }
  if (u.op == UnaryOp::negate) {
    const ExprPtr inner = node(u.operand);
    if (const auto* n = as_number(inner)) return number(-n->value);
    if (t.unary.count(u.op) != 0 || t.expressions == ExpressionForm::left_to_right) {
      return inner == u.operand ? e : unary(u.op, inner);
    }
    return node(sub(number(0), inner));
  }
  if (t.unary.count(u.op) == 0 && u.op == UnaryOp::bit_not) {  // two's complement: ~x is -1 - x of the whole part
    return node(sub(number(-1), f1(Function::trunc, u.operand)));
  }
  if (t.unary.count(u.op) == 0) return fail(e, "the target has no operator " + std::string(name(u.op)));
  return unary(u.op, node(u.operand));
}

ExprPtr ExpressionLowering::call_rule(const Call& c, const ExprPtr& e) {
  if (has(c.function)) {
    if (c.function == Function::ceil && !never_negative(c.args[0]) &&
        editor_.program.dialect != editor_.context.target.dialect &&
        editor_.context.target_machine.policies.round_up_negative == machine::RoundUpNegative::unstated) {
      if (const auto known = constant_value(e)) return node(number(*known));
      editor_.context.diagnostics.note(
          "TRN-670", word_span(like_.span, e->pos),
          "a value is rounded up, and it may be negative: the target's manual does not say what its function makes of "
          "negative values; upwards (-2.5 becomes -2) is assumed",
          "check it on the machine, or keep the value positive");
    }
    Args args;
    bool same = true;
    for (const auto& a : c.args) {
      args.push_back(node(a));
      same = same && args.back() == a;
    }
    return same ? e : call(c.function, std::move(args), c.half);
  }
  if (const auto known = constant_value(e)) return node(number(*known));
  switch (c.function) {
    case Function::tan:
    case Function::asin:
    case Function::acos:
    case Function::atan: return trigonometric(c, e);
    case Function::atan2:
    case Function::arg: return full_angle(c, e);
    case Function::square: {
      if (has(BinaryOp::power)) return node(binary(BinaryOp::power, c.args[0], number(2)));
      const ExprPtr x = primary(c.args[0]);
      return mul(x, x);
    }
    case Function::trunc:
    case Function::ceil:
    case Function::floor:
    case Function::round:
    case Function::to_integer: return rounding(c, e);
    case Function::abs:
    case Function::sign:
    case Function::min:
    case Function::max:
    case Function::bound: return selection(c, e);
    case Function::exp:
    case Function::ln:
    case Function::log10: return logarithm(c, e);
    case Function::to_bcd:
    case Function::from_bcd: return bcd(c, e);
    case Function::to_boolean: return node(rel(BinaryOp::ne, c.args[0], 0));
    default: return fail(e, "the target has no function " + std::string(name(c.function)));
  }
}

/// The digits of one base written in another: a carry of the low base leaves 16 - 10 behind in the high one.
ExprPtr ExpressionLowering::bcd(const Call& c, const ExprPtr& e) {
  const bool to = c.function == Function::to_bcd;
  editor_.context.diagnostics.warning("TRN-134", word_span(like_.span, e->pos),
                                      to ? "BCD is written as arithmetic: right for whole numbers from 0 to 99999999"
                                         : "BIN is written as arithmetic: right for whole numbers whose hexadecimal "
                                           "digits are 0 to 9");
  const ExprPtr x = primary(c.args[0]);
  const auto total = temporary(), digits = temporary();
  if (!total || !digits) return e;
  assign(*total, x);
  double from = 1, into = 1;
  for (int digit = 1; digit < 8; ++digit) {
    from *= to ? 10 : 16;
    assign(*digits, lower(div(x, number(from))));
    assign(*digits, lower(f1(Function::trunc, variable(*digits))));
    const ExprPtr carried = mul(variable(*digits), number(6 * into));
    assign(*total, lower(to ? add(variable(*total), carried) : sub(variable(*total), carried)));
    into *= to ? 16 : 10;
  }
  return variable(*total);
}

ExprPtr ExpressionLowering::trigonometric(const Call& c, const ExprPtr& e) {
  if (c.function == Function::atan) {
    if (has(Function::atan2)) return call(Function::atan2, {node(c.args[0]), number(1)});
    return fail(e, "the target has no arc tangent");
  }
  const ExprPtr x = primary(c.args[0]);
  if (c.function == Function::tan) return node(div(f1(Function::sin, x), f1(Function::cos, x)));
  if (c.function == Function::acos) return node(sub(number(90), f1(Function::asin, x)));
  if (has(Function::atan2)) return node(call(Function::atan2, {x, f1(Function::sqrt, sub(number(1), mul(x, x)))}));
  // asin by the arc tangent; at the ends, where the divisor is 0, the angle itself.
  const auto v = temporary();
  const auto r = temporary();
  if (!v || !r) return e;
  assign(*r, lower(mul(x, x)));
  assign(*r, lower(sub(number(1), variable(*r))));
  assign(*v, lower(mul(x, number(90))));
  const LabelRef behind = editor_.fresh_label();
  jump_if(rel(BinaryOp::le, variable(*r), 0), behind);
  assign(*r, lower(f1(Function::sqrt, variable(*r))));
  assign(*v, lower(div(x, variable(*r))));
  assign(*v, lower(f1(Function::atan, variable(*v))));
  label_here(behind);
  return variable(*v);
}

/// atan2(y, x) in (-180, 180] and arg(x, y) in [0, 360).
ExprPtr ExpressionLowering::full_angle(const Call& c, const ExprPtr& e) {
  const bool positive = c.function == Function::arg;
  const ExprPtr& y = positive ? c.args[1] : c.args[0];
  const ExprPtr& x = positive ? c.args[0] : c.args[1];
  const Function other = positive ? Function::atan2 : Function::arg;
  if (!has(other)) {
    if (!has(Function::atan)) return fail(e, "the target has no arc tangent");
    return quadrants(y, x, positive);
  }
  const ExprPtr low = positive ? call(other, {node(y), node(x)}) : call(other, {node(x), node(y)});
  const auto v = temporary();
  if (!v) return e;
  assign(*v, low);
  if (positive)
    assign_if(rel(BinaryOp::lt, variable(*v), 0), *v, add(variable(*v), number(360)));
  else
    assign_if(rel(BinaryOp::gt, variable(*v), 180), *v, sub(variable(*v), number(360)));
  return variable(*v);
}

/// The angle by quadrants with the plain arc tangent; 0 where both are zero.
ExprPtr ExpressionLowering::quadrants(const ExprPtr& y_in, const ExprPtr& x_in, bool positive) {
  const ExprPtr x = primary(x_in), y = primary(y_in);
  const auto v = temporary();
  if (!v) return y_in;
  const auto one = constant_value(x_in);
  const bool right_half = one && *one > 0;
  if (right_half) {  // the sign of x is known: no chain
    assign(*v, lower(div(y, x)));
    assign(*v, f1(Function::atan, variable(*v)));
    if (positive) assign_if(rel(BinaryOp::lt, variable(*v), 0), *v, add(variable(*v), number(360)));
    return variable(*v);
  }
  if (one && *one < 0) {
    assign(*v, lower(div(y, x)));
    assign(*v, f1(Function::atan, variable(*v)));
    assign(*v, add(variable(*v), number(180)));
    if (!positive) assign_if(rel(BinaryOp::gt, variable(*v), 180), *v, sub(variable(*v), number(360)));
    return variable(*v);
  }
  const LabelRef on_axis = editor_.fresh_label(), end = editor_.fresh_label();
  pre.push_back(make_jump(like_, on_axis, rel(BinaryOp::eq, x, 0)));
  assign(*v, lower(div(y, x)));
  assign(*v, f1(Function::atan, variable(*v)));
  if (positive) {
    const LabelRef left = editor_.fresh_label();
    pre.push_back(make_jump(like_, left, rel(BinaryOp::lt, x, 0)));
    pre.push_back(make_jump(like_, end, rel(BinaryOp::ge, variable(*v), 0)));
    assign(*v, add(variable(*v), number(360)));
    pre.push_back(make_jump(like_, end));
    label_here(left);
    assign(*v, add(variable(*v), number(180)));
    pre.push_back(make_jump(like_, end));
  } else {
    pre.push_back(make_jump(like_, end, rel(BinaryOp::gt, x, 0)));
    assign(*v, add(variable(*v), number(180)));
    pre.push_back(make_jump(like_, end, rel(BinaryOp::le, variable(*v), 180)));
    assign(*v, sub(variable(*v), number(360)));
    pre.push_back(make_jump(like_, end));
  }
  label_here(on_axis);
  const auto up = constant_value(y);
  if (!up || *up > 0) assign(*v, number(90));
  if (!up) pre.push_back(make_jump(like_, end, rel(BinaryOp::gt, y, 0)));
  if (!up || *up < 0) assign(*v, number(positive ? 270 : -90));
  if (!up) pre.push_back(make_jump(like_, end, rel(BinaryOp::lt, y, 0)));
  if (!up || *up == 0) assign(*v, number(0));
  label_here(end);
  return variable(*v);
}

ExprPtr ExpressionLowering::rounding(const Call& c, const ExprPtr& e) {
  if (c.function == Function::trunc) {
    if (has(BinaryOp::int_divide)) return node(binary(BinaryOp::int_divide, c.args[0], number(1)));
    return fail(e, "the target has no truncation");
  }
  if (c.function == Function::to_integer && has(Function::round)) return node(call(Function::round, c.args, c.half));
  const ExprPtr x = primary(c.args[0]);
  const auto v = temporary();
  if (!v) return e;
  if (c.function == Function::ceil || c.function == Function::floor) {
    const bool up = c.function == Function::ceil;
    assign(*v, lower(f1(Function::trunc, x)));
    assign_if(binary(up ? BinaryOp::lt : BinaryOp::gt, variable(*v), x), *v,
              up ? add(variable(*v), number(1)) : sub(variable(*v), number(1)));
    return variable(*v);
  }
  // Nearest: half away from zero for both signs.
  if (c.half == RoundHalf::even) return fail(e, "the target has no rounding of halves to the even number");
  assign(*v, lower(add(x, number(0.5))));
  assign_if(rel(BinaryOp::lt, x, 0), *v, lower(sub(x, number(0.5))));
  assign(*v, lower(f1(Function::trunc, variable(*v))));
  return variable(*v);
}

ExprPtr ExpressionLowering::selection(const Call& c, const ExprPtr& e) {
  if (c.function == Function::bound)
    return node(call(Function::min, {c.args[1], call(Function::max, {c.args[0], c.args[2]})}));
  if (const auto fixed = constant_value(e)) return number(*fixed);
  const ExprPtr x = primary(c.args[0]);
  const ExprPtr y = c.args.size() > 1 ? primary(c.args[1]) : nullptr;
  const auto v = temporary();
  if (!v) return e;
  switch (c.function) {
    case Function::abs:
      assign(*v, x);
      assign_if(rel(BinaryOp::lt, x, 0), *v, lower(sub(number(0), x)));
      break;
    case Function::sign:
      assign(*v, number(0));
      assign_if(rel(BinaryOp::gt, x, 0), *v, number(1));
      assign_if(rel(BinaryOp::lt, x, 0), *v, number(-1));
      break;
    default:
      if (!y) return fail(e, "a function without its second value");
      assign(*v, x);
      assign_if(binary(c.function == Function::min ? BinaryOp::lt : BinaryOp::gt, y, x), *v, y);
      break;
  }
  return variable(*v);
}

ExprPtr ExpressionLowering::logarithm(const Call& c, const ExprPtr& e) {
  const double log10_e = 0.43429448190325182765;
  if (c.function == Function::ln && has(Function::log10))
    return node(div(f1(Function::log10, c.args[0]), number(log10_e)));
  if (c.function == Function::log10 && has(Function::ln))
    return node(div(f1(Function::ln, c.args[0]), number(1 / log10_e)));
  return fail(e, "the target has no function " + std::string(name(c.function)));
}

}  // namespace cnctrans::ir::passes
