#include "frontends/fagor/lower_expr.h"

#include <cmath>
#include <optional>

#include "base/saturate.h"
#include "dialects/fagor/limits.h"
#include "dialects/fagor/operators.h"
#include "dialects/fagor/variables.h"

namespace cnctrans::fagor {

namespace {

namespace facts = dialects::fagor;
using ir::BinaryOp;
using ir::Datum;
using ir::ExprPtr;
using syntax::Expr;
using syntax::ExprKind;

ExprPtr nothing() {
  return ir::number(0);
}

bool is_letter(const Expr& e) {
  return e.kind == ExprKind::variable && e.text.size() == 1 && e.args.empty();
}

/// `P100`, `P(expr)`, a letter. A fixed number that no parameter has is an error.
ir::VarRef parameter(const Expr& e, LowerState& state) {
  if (is_letter(e)) return {parameter_space, {}, ir::number(facts::letter_parameter(e.text[0])), {}};
  const Expr& index = e.args.front();
  if (index.kind != ExprKind::number) return {parameter_space, {}, lower_expr(index, state), {}};
  const double n = index.number;
  if (n != std::floor(n) || n > 1e6 || !facts::valid_parameter(saturate<std::int64_t>(n))) {
    state.error("FAG-018", e.pos, "the parameter P" + index.text + " does not exist",
                "parameters are P0-P25, P100-P299, P1000-P1255 and P2000-P2255");
  }
  return {parameter_space, {}, ir::number(n), {}};
}

/// Data the IR has a name for, and that this frontend knows how to index.
Datum known_datum(const facts::VariableInfo& info, const Expr& e) {
  switch (info.datum) {
    case Datum::programmed_position:
    case Datum::machine_position:
    case Datum::work_position:
    case Datum::programmed_shift:
    case Datum::active_offset:
    case Datum::tool_number:
    case Datum::next_tool:
    case Datum::offset_number:
    case Datum::feed:
    case Datum::spindle_speed:
    case Datum::part_count: return info.datum;
    case Datum::tool_length:
    case Datum::tool_radius: return e.args.size() == 1 ? info.datum : Datum::other;
    case Datum::work_offset:
      return e.args.size() == 1 && e.args[0].kind == ExprKind::number ? info.datum : Datum::other;
    default: return Datum::other;
  }
}

/// TOX, TOZ, TOL speak of an axis that is not written as the variable's axis letter.
ir::AxisId tool_axis(std::string_view name) {
  if (name == "TOX") return ir::axis::x;
  return name == "TOZ" || name == "TOL" ? ir::axis::z : ir::axis::none;
}

/// `written`: it is the target of an assignment. nullopt: no variable of the control; reported.
std::optional<ir::SystemRef> system_variable(const Expr& e, LowerState& state, bool written) {
  const auto [info, axis] = facts::find_variable(e.text);
  if (!info) {
    state.error("FAG-019", e.pos, "there is no variable " + e.text, "a parameter is P and a number, or one letter");
    return std::nullopt;
  }
  using facts::Access;
  if (written ? info->access == Access::read || info->access == Access::none : info->access == Access::write) {
    state.error(
        "FAG-021", e.pos,
        "the variable " + e.text + (written ? " can't be written by a program" : " can't be read by a program"));
    return std::nullopt;
  }
  ir::SystemRef ref;
  ref.text = e.text;
  ref.datum = known_datum(*info, e);
  ref.axis = axis != ir::axis::none ? axis : tool_axis(info->name);
  if (ref.datum == Datum::work_offset) {
    const int row = facts::offset_row(static_cast<int>(e.args[0].number));
    if (row == 0)
      state.error("FAG-013", e.args[0].pos, "the zero offset table has no row " + e.args[0].text,
                  "rows are 54 to 59 and 1 to 20");
    ref.args.push_back(ir::number(row));
  } else {
    for (const auto& a : e.args) ref.args.push_back(lower_expr(a, state));
  }
  if (ref.datum == Datum::other) {
    state.error("FAG-020", e.pos,
                "the value of " + e.text + " is known to the machine only; it can't be run or translated yet");
  }
  return ref;
}

ExprPtr variable(const Expr& e, LowerState& state) {
  if (e.text == "P" || is_letter(e)) return ir::variable(parameter(e, state));
  auto ref = system_variable(e, state, false);
  if (!ref) return nothing();
  ir::Expr node;
  node.node = std::move(*ref);
  return std::make_shared<const ir::Expr>(std::move(node));
}

bool condition(const ExprPtr& e) {
  return e->type == ir::Type::boolean;
}

/// AND OR XOR: of two conditions the truth value, else bit by bit on 32 bits (§11.4).
BinaryOp by_operands(BinaryOp logical, const ExprPtr& a, const ExprPtr& b) {
  if (condition(a) && condition(b)) return logical;
  switch (logical) {
    case BinaryOp::logical_and: return BinaryOp::bit_and;
    case BinaryOp::logical_or: return BinaryOp::bit_or;
    case BinaryOp::logical_xor: return BinaryOp::bit_xor;
    default: return logical;
  }
}

ExprPtr unary(const Expr& e, LowerState& state) {
  ExprPtr operand = lower_expr(e.args.front(), state);
  if (e.text == "+") return operand;
  if (e.text == "-") return ir::unary(ir::UnaryOp::negate, std::move(operand));
  const auto op = condition(operand) ? ir::UnaryOp::logical_not : ir::UnaryOp::bit_not;
  return ir::unary(op, std::move(operand));
}

ExprPtr function(const Expr& e, LowerState& state) {
  if (e.text == "PI") return ir::number(facts::pi);
  const auto* f = facts::find_function(e.text);
  if (!f) {
    state.error("FAG-024", e.pos, e.text + " can't be part of an expression");
    return nothing();
  }
  std::vector<ExprPtr> args;
  for (const auto& a : e.args) args.push_back(lower_expr(a, state));
  return ir::call(f->function, std::move(args));
}

}  // namespace

char parameter_letter(const syntax::Expr& e) {
  if (is_letter(e)) return e.text[0];
  if (e.kind != ExprKind::variable || e.text != "P" || e.args.size() != 1 || e.args[0].kind != ExprKind::number)
    return 0;
  const double n = e.args[0].number;
  return n >= 0 && n <= 25 && n == std::floor(n) ? facts::parameter_letter(static_cast<int>(n)) : '\0';
}

ir::ExprPtr lower_expr(const syntax::Expr& e, LowerState& state) {
  switch (e.kind) {
    case ExprKind::number:
      return ir::at(ir::number(e.number, e.text.substr(0, 1) == "$" ? std::string{} : e.text), e.pos);
    case ExprKind::variable: return ir::at(variable(e, state), e.pos);
    case ExprKind::unary: return ir::at(unary(e, state), e.pos);
    case ExprKind::call: return ir::at(function(e, state), e.pos);
    case ExprKind::binary: {
      ExprPtr a = lower_expr(e.args[0], state), b = lower_expr(e.args[1], state);
      const auto* op = facts::find_operator(e.text);
      if (!op) return nothing();
      const BinaryOp chosen = by_operands(op->op, a, b);
      return ir::at(ir::binary(chosen, std::move(a), std::move(b)), e.pos);
    }
    default: break;
  }
  state.error("FAG-024", e.pos, "a text can't be part of an expression");
  return nothing();
}

bool lower_target(const syntax::Expr& e, LowerState& state, ir::Assign::Item& item) {
  item.pos = e.pos;
  if (e.text == "P" || is_letter(e)) {
    item.target = parameter(e, state);
    return true;
  }
  auto ref = system_variable(e, state, true);
  if (!ref) return false;
  item.to_system = true;
  item.system = std::move(*ref);
  return true;
}

}  // namespace cnctrans::fagor
