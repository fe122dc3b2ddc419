#include "frontends/fagor/statements/expr.h"
#include "base/text.h"

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
  if (n == std::floor(n) && n >= 0 && n < 100 && facts::unlisted_parameter(saturate<std::int64_t>(n))) {
    state.facts.unlisted_parameters = true;
    state.warning(
        "FAG-018", e.pos, "the manuals list no parameter P" + index.text,
        "the control may stop here (error 72); it is read as a global parameter. Listed are P0-P25, P100-P299, "
        "P1000-P1255 and P2000-P2255");
  } else if (n != std::floor(n) || n > 1e6 || !facts::valid_parameter(saturate<std::int64_t>(n))) {
    state.error("FAG-018", e.pos, "the parameter P" + index.text + " does not exist",
                "parameters are P0-P25, P100-P299, P1000-P1255 and P2000-P2255");
  } else if (n >= facts::first_oem_parameter && !state.attributes.empty() &&
             to_upper_ascii(state.attributes).find('O') == std::string::npos) {
    state.error("FAG-046", e.pos, "P" + index.text + " belongs to the programs of the machine's maker [1254]",
                "the header of such a program has the attribute O");
  }
  return {parameter_space, {}, ir::number(n), {}};
}

bool one_fixed_index(const Expr& e) {
  return e.args.size() == 1 && e.args[0].kind == ExprKind::number;
}

/// Data the IR has a name for, and that this frontend knows how to index.
Datum known_datum(const facts::VariableInfo& info, const Expr& e) {
  switch (info.datum) {
    case Datum::tool_length:
    case Datum::tool_nose:
    case Datum::tool_nose_width: return e.args.size() == 1 ? info.datum : Datum::other;
    case Datum::tool_radius:
    case Datum::tool_wear: return e.args.size() <= 1 ? info.datum : Datum::other;
    case Datum::work_offset:
      if (e.args.empty()) return Datum::active_shift;
      return e.args.size() == 1 ? info.datum : Datum::other;
    case Datum::active_modal:
    case Datum::spindle_state: return one_fixed_index(e) ? info.datum : Datum::other;
    default: return e.args.empty() ? info.datum : Datum::other;
  }
}

/// TOX, TOZ, TOL and their wear speak of an axis that is not written as the variable's axis letter.
ir::AxisId tool_axis(std::string_view name) {
  if (name == "TOX" || name == "TOI") return ir::axis::x;
  return name == "TOZ" || name == "TOK" ? ir::axis::z : ir::axis::none;
}

/// GS of a G function that is a setting, the motion or an offset: its own number, the setting, the value. Else false.
bool modal_arguments(int code, LowerState& state, ir::SystemRef& ref) {
  const auto* row = state.g(code);
  if (!row) return false;
  int setting = static_cast<int>(row->setting), value = row->value;
  switch (row->use) {
    case facts::Use::setting:
    case facts::Use::setting_after:
    case facts::Use::compensation: break;
    case facts::Use::plane: setting = static_cast<int>(ir::Setting::plane); break;
    case facts::Use::motion:
      setting = static_cast<int>(ir::setting_count);
      value = static_cast<int>(row->motion);
      break;
    case facts::Use::work_offset: setting = static_cast<int>(ir::setting_count) + 1; break;
    default: return false;
  }
  for (const int n : {code, setting, value}) ref.args.push_back(ir::number(n));
  return true;
}

/// MS of a function that turns or stops the spindle.
bool spindle_arguments(int code, LowerState& state, ir::SystemRef& ref) {
  const auto* row = state.m(code);
  using machine::MMeaning;
  if (!row) return false;
  auto value = ir::SpindleState::off;
  switch (row->meaning) {
    case MMeaning::spindle_cw: value = ir::SpindleState::cw; break;
    case MMeaning::spindle_ccw: value = ir::SpindleState::ccw; break;
    case MMeaning::spindle_stop: break;
    default: return false;
  }
  ref.args.push_back(ir::number(code));
  ref.args.push_back(ir::number(static_cast<int>(value)));
  return true;
}

/// A computed index: 54 to 59 are the rows 1 to 6, smaller ones the rows themselves. The relation counts as 1 or 0.
ExprPtr computed_row(const ExprPtr& n) {
  const auto from_code = ir::binary(BinaryOp::gt, n, ir::number(20));
  return ir::binary(BinaryOp::subtract, n, ir::binary(BinaryOp::multiply, ir::number(53), from_code));
}

void offset_index(const Expr& e, LowerState& state, ir::SystemRef& ref) {
  if (!one_fixed_index(e)) {
    const ExprPtr n = lower_expr(e.args[0], state);
    const auto constant = ir::constant_value(n);
    const int row = constant ? facts::offset_row(static_cast<int>(*constant)) : 0;
    ref.args.push_back(row != 0 ? ir::number(row) : computed_row(n));
    return;
  }
  const int row = facts::offset_row(static_cast<int>(e.args[0].number));
  if (row == 0)
    state.error("FAG-013", e.args[0].pos, "the zero offset table has no row " + e.args[0].text,
                "rows are 54 to 59 and 1 to 20");
  ref.args.push_back(ir::number(row));
}

void arguments(const Expr& e, LowerState& state, ir::SystemRef& ref) {
  if (ref.datum == Datum::work_offset) return offset_index(e, state, ref);
  const int code = one_fixed_index(e) ? static_cast<int>(e.args[0].number) : 0;
  if (ref.datum == Datum::active_modal && modal_arguments(code, state, ref)) return;
  if (ref.datum == Datum::spindle_state && spindle_arguments(code, state, ref)) return;
  if (ref.datum == Datum::active_modal || ref.datum == Datum::spindle_state) ref.datum = Datum::other;
  for (const auto& a : e.args) ref.args.push_back(lower_expr(a, state));
}

/// What only the machine knows is kept under its name; said once for every name.
void note_machine_datum(const Expr& e, LowerState& state) {
  if (!state.facts.machine_data.insert(e.text).second) return;
  state.note("FAG-020", e.pos, "the value of " + e.text + " is known to the machine only",
             "a run takes it from the profile (\"data\") or from --set, else that of a machine at rest (RUN-044); "
             "no other control can be told it");
}

/// Target of an assignment when `written`. nullopt: it may not be used like this; reported.
std::optional<ir::SystemRef> system_variable(const Expr& e, LowerState& state, bool written) {
  const auto [info, axis] = facts::find_variable(e.text);
  using facts::Access;
  const bool no_write = info && (info->access == Access::read || info->access == Access::none);
  const bool no_read = info && (info->access == Access::write || info->access == Access::none);
  if (written && no_write) {
    state.error("FAG-021", e.pos, "the variable " + e.text + " can't be written by a program",
                "the control stops here (error 74 or 75)");
  } else if (!written && no_read) {  // programs of other versions do
    state.warning("FAG-021", e.pos, "by the manual the variable " + e.text + " can't be read by a program",
                  "the control may stop here (error 74 or 76); it is kept under its name");
  }
  if (written ? no_write : no_read) {
    ir::SystemRef kept;
    kept.text = e.text;
    for (const auto& a : e.args) kept.args.push_back(lower_expr(a, state));
    return kept;
  }
  ir::SystemRef ref;
  ref.text = e.text;
  if (!info) {
    state.warning("FAG-019", e.pos, "the manuals know no variable " + e.text,
                  "it is kept under this name; a run stops where its value is needed, unless --set gives it");
    for (const auto& a : e.args) ref.args.push_back(lower_expr(a, state));
    return ref;
  }
  ref.datum = known_datum(*info, e);
  ref.axis = axis != ir::axis::none ? axis : tool_axis(info->name);
  arguments(e, state, ref);
  if (ref.datum == Datum::other && info->name != "GPOS") note_machine_datum(e, state);
  if (!written && info->stops_preparation && state.comp_by_text != ir::CompSide::off) {  // 13.6
    state.warning("FAG-028", e.pos,
                  "reading " + e.text +
                      " under radius compensation stops the look-ahead: the control drops the compensation at this "
                      "point and takes it up again",
                  "read it before G41 or G42, or check the contour around it");
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
