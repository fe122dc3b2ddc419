// Well-formedness of expressions: spaces, numbers of arguments, types.
#include <array>
#include <cmath>

#include "ir/check/well_formed.h"
#include "ir/text/text.h"

namespace cnctrans::ir::detail {
namespace {

struct Arity {
  std::size_t least, most;
};

Arity arity(Function f) {
  switch (f) {
    case Function::atan2:
    case Function::arg: return {2, 2};
    case Function::min:
    case Function::max: return {1, 99};
    case Function::bound: return {3, 3};
    case Function::substring:
    case Function::index_of: return {2, 3};
    case Function::last_index_of:
    case Function::index_of_any:
    case Function::frame_chain: return {2, 2};
    case Function::frame_shift:
    case Function::frame_fine:
    case Function::frame_turn:
    case Function::frame_solid_turn:
    case Function::frame_stretch:
    case Function::frame_mirror: return {0, 64};
    case Function::frame_part: return {3, 3};
    case Function::frame_with: return {4, 4};
    default: return {1, 1};
  }
}

bool is_number(Type t) {
  return t == Type::real || t == Type::integer || t == Type::boolean;
}

/// Functions whose arguments need not be numbers.
bool takes_other_than_numbers(Function f) {
  return f >= Function::to_integer && f <= Function::frame_with;
}

void check_operands(const Binary& b, const Report& report) {
  if (!b.left || !b.right) return report.error("IR-012", "an operand of '" + std::string(name(b.op)) + "' is missing");
  const Type l = b.left->type;
  const Type r = b.right->type;
  if (b.op == BinaryOp::concat) return;
  if (is_comparison(b.op) && l == r) return;
  if (is_number(l) && is_number(r)) return;
  report.error("IR-013", "'" + std::string(name(b.op)) + "' cannot work on " + std::string(name(l)) + " and " +
                             std::string(name(r)));
}

void check_call(const Call& c, const Report& report) {
  const Arity wanted = arity(c.function);
  if (c.args.size() < wanted.least || c.args.size() > wanted.most) {
    report.error("IR-013",
                 std::string(name(c.function)) + " cannot have " + std::to_string(c.args.size()) + " arguments");
  }
  for (const auto& a : c.args) {
    if (!a) {
      report.error("IR-012", "an argument of " + std::string(name(c.function)) + " is missing");
    } else if (!is_number(a->type) && !takes_other_than_numbers(c.function)) {
      report.error("IR-013", std::string(name(c.function)) + " cannot work on " + std::string(name(a->type)));
    }
  }
}

void check_node(const Expr& e, const Report& report) {
  if (const auto* v = std::get_if<VarRef>(&e.node)) {
    check_variable(*v, report);
  } else if (const auto* a = std::get_if<AxisName>(&e.node)) {
    check_axis(a->axis, report);
  } else if (const auto* s = std::get_if<SystemRef>(&e.node)) {
    if (s->axis != axis::none) check_axis(s->axis, report);
    if (s->text.empty() && s->datum == Datum::other) report.error("IR-011", "a system variable has no name");
  } else if (const auto* u = std::get_if<Unary>(&e.node)) {
    if (!u->operand) {
      report.error("IR-012", "the operand of '" + std::string(name(u->op)) + "' is missing");
    } else if (!is_number(u->operand->type)) {
      report.error("IR-013",
                   "'" + std::string(name(u->op)) + "' cannot work on " + std::string(name(u->operand->type)));
    }
  } else if (const auto* b = std::get_if<Binary>(&e.node)) {
    check_operands(*b, report);
  } else if (const auto* c = std::get_if<Call>(&e.node)) {
    check_call(*c, report);
  }
}

bool in_a_segment(const VariableSpace& space, double n) {
  for (const auto& s : space.segments) {
    if (n >= static_cast<double>(s.lo) && n <= static_cast<double>(s.hi)) return true;
  }
  return false;
}

}  // namespace

void check_axis(AxisId id, const Report& report) {
  if (id < axis::first_extra + report.program.axis_names.size()) return;
  report.error("IR-014", id == axis::none ? "an axis is missing" : "axis " + std::to_string(id) + " has no name");
}

/// The variable itself; walk() comes to its indices.
void check_variable(const VarRef& v, const Report& report) {
  if (v.space >= report.program.spaces.size()) {
    return report.error("IR-010", "a variable is of space " + std::to_string(v.space) + ", which is not there");
  }
  const VariableSpace& space = report.program.spaces[v.space];
  if (space.named()) {
    if (v.name.empty()) report.error("IR-011", "a variable of a space of names has no name");
    return;
  }
  if (!v.index) return report.error("IR-011", "a variable of space '" + space.prefix + "' has no number");
  const auto n = constant_value(v.index);
  if (!n || (in_a_segment(space, *n) && std::trunc(*n) == *n)) return;
  report.error("IR-011", "there is no variable " + space.prefix + std::to_string(*n));
}

void check_expression(const ExprPtr& e, const Report& report) {
  if (!e) return report.error("IR-012", "an expression is missing");
  walk(e, [&report](const ExprPtr& node) { check_node(*node, report); });
}

}  // namespace cnctrans::ir::detail
