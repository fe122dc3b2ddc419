#include "backends/linuxcnc/expressions.h"

#include "backends/linuxcnc/tables.h"
#include "base/text.h"

namespace cnctrans::backends::linuxcnc {
namespace {

constexpr NumberFormat constants{15, 12, false};

}  // namespace

Expressions::Expressions(const ir::Program& program) : ExpressionPrinter(program, expression_style, constants) {}

std::string Expressions::value(const ir::ExprPtr& e) {
  Printed p = print_node(e);
  const bool variable = !p.text.empty() && p.text.find_first_of(" []", 1) == std::string::npos;
  const bool plain = e && (std::holds_alternative<ir::Number>(e->node) || std::holds_alternative<ir::VarRef>(e->node));
  const auto* u = e ? std::get_if<ir::Unary>(&e->node) : nullptr;
  const bool negative = u != nullptr && std::holds_alternative<ir::VarRef>(u->operand->node) && variable;
  return plain || negative ? p.text : '[' + p.text + ']';
}

std::string Expressions::condition(const ir::ExprPtr& e) {
  return '[' + print(e) + ']';
}

std::string Expressions::name(const ir::VarRef& v) {
  return variable(nullptr, v);
}

std::string Expressions::variable(const ir::ExprPtr& e, const ir::VarRef& v) {
  if (v.space >= program_.spaces.size() || program_.spaces[v.space].named() || !v.index) {
    problem(e, "the variable '" + v.name + "' has no number here");
    return "#0";
  }
  if (const auto n = ir::constant_value(v.index)) return '#' + shortest(*n);
  return "#[" + print(v.index) + ']';
}

std::string Expressions::string(const ir::ExprPtr& e, const ir::String& /*s*/) {
  problem(e, "this language has no texts in expressions");
  return {};
}

std::string Expressions::bracket(const ir::ExprPtr& e) {
  return '[' + print(e) + ']';
}

/// -1, 0 or 1 by two comparisons, which are 1 or 0. `x` is a primary.
std::string Expressions::sign(const std::string& x) const {
  return "[[" + x + " GT 0]-[" + x + " LT 0]]";
}

Printed Expressions::truncated(const ir::ExprPtr& e) {
  const std::string x = operand(e, primary_level, false);
  return {"FIX[ABS[" + x + "]]*" + sign(x), 5, false};
}

std::optional<Printed> Expressions::special(const ir::ExprPtr& e) {
  if (const auto* c = std::get_if<ir::Call>(&e->node)) return special_call(e, *c);
  if (const auto* u = std::get_if<ir::Unary>(&e->node)) {
    if (u->op != ir::UnaryOp::logical_not) return std::nullopt;
    const std::string x = operand(u->operand, primary_level, false);
    return Printed{"[" + x + " LE 0] AND [" + x + " GE 0]", 2, false};
  }
  const auto* b = std::get_if<ir::Binary>(&e->node);
  if (b == nullptr) return std::nullopt;
  if (b->op == ir::BinaryOp::eq || b->op == ir::BinaryOp::ne) tolerant_ = true;
  if (b->op == ir::BinaryOp::modulo) {  // MOD of this language is never negative; ours has the sign of the first
    const std::string x = operand(b->left, primary_level, false);
    return Printed{"[ABS[" + x + "] MOD ABS" + bracket(b->right) + "]*" + sign(x), 5, false};
  }
  if (b->op == ir::BinaryOp::int_divide) return truncated(ir::binary(ir::BinaryOp::divide, b->left, b->right));
  return std::nullopt;
}

std::optional<Printed> Expressions::special_call(const ir::ExprPtr& e, const ir::Call& c) {
  const auto arg = [&](std::size_t i) { return operand(c.args.at(i), primary_level, false); };
  const auto whole = [](std::string text) { return Printed{std::move(text), primary_level, false}; };
  switch (c.function) {
    case ir::Function::atan: return whole("ATAN" + bracket(c.args.at(0)) + "/[1]");
    case ir::Function::atan2: return whole("ATAN" + bracket(c.args.at(0)) + "/" + bracket(c.args.at(1)));
    case ir::Function::arg: {  // 0 to 360, of (x, y)
      const std::string y = arg(1);
      return Printed{"ATAN[" + y + "]/" + bracket(c.args.at(0)) + "+360*[" + y + " LT 0]", 4, false};
    }
    case ir::Function::square: return Printed{arg(0) + "**2", 6, false};
    case ir::Function::log10: return Printed{"LN" + bracket(c.args.at(0)) + "/LN[10]", 5, false};
    case ir::Function::sign: return whole(sign(arg(0)));
    case ir::Function::trunc: return truncated(c.args.at(0));
    case ir::Function::to_integer:
    case ir::Function::round:
      if (c.half == ir::RoundHalf::away) return whole("ROUND" + bracket(c.args.at(0)));
      if (c.half == ir::RoundHalf::up) return whole("FIX[" + operand(c.args.at(0), 4, true) + "+0.5]");
      problem(e, "rounding of halves to the even number does not exist there");
      return Printed{};
    case ir::Function::to_boolean: return whole("[[" + arg(0) + " GT 0] OR [" + arg(0) + " LT 0]]");
    case ir::Function::min:
    case ir::Function::max: {
      if (c.args.size() != 2) break;
      const std::string x = arg(0), y = arg(1);
      const std::string first = c.function == ir::Function::min ? " LE " : " GE ";
      const std::string second = c.function == ir::Function::min ? " LT " : " GT ";
      return Printed{x + "*[" + x + first + y + "]+" + y + "*[" + y + second + x + "]", 4, false};
    }
    default: break;
  }
  return std::nullopt;
}

}  // namespace cnctrans::backends::linuxcnc
