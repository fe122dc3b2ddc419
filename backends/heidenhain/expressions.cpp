#include "backends/heidenhain/expressions.h"

#include "backends/heidenhain/tables.h"
#include "base/text.h"
#include "dialects/heidenhain/functions.h"
#include "dialects/heidenhain/variables.h"

namespace cnctrans::backends::heidenhain {

namespace facts = dialects::heidenhain;

namespace {
constexpr NumberFormat constants{15, 12, false};
}

Expressions::Expressions(const ir::Program& program) : ExpressionPrinter(program, expression_style, constants) {}

bool Expressions::is_plain(const ir::ExprPtr& e) {
  if (!e) return false;
  if (std::holds_alternative<ir::Number>(e->node) || std::holds_alternative<ir::VarRef>(e->node)) return true;
  const auto* u = std::get_if<ir::Unary>(&e->node);
  return u != nullptr && u->op == ir::UnaryOp::negate && is_plain(u->operand) &&
         !std::holds_alternative<ir::Unary>(u->operand->node);
}

std::string Expressions::operand_of_fn(const ir::ExprPtr& e) {
  if (!is_plain(e)) problem(e, "an operand of a condition is a number or a parameter here");
  std::string text = print(e);
  return text.empty() || text.front() == '-' || text.front() == '+' ? text : '+' + text;
}

std::string Expressions::variable(const ir::ExprPtr& e, const ir::VarRef& v) {
  const auto n = v.index ? ir::constant_value(v.index) : std::nullopt;
  if (v.space >= program_.spaces.size() || program_.spaces[v.space].named() || !n) {
    problem(e, "the variable '" + v.name + "' has no fixed number here");
    return "Q0";
  }
  return program_.spaces[v.space].prefix + shortest(*n);
}

/// What the control itself keeps in a parameter.
std::string Expressions::system(const ir::ExprPtr& e, const ir::SystemRef& s) {
  if (s.given) return s.text;
  for (const auto& row : facts::system_q) {
    if (row.datum == s.datum && s.args.empty()) return "Q" + std::to_string(row.number);
  }
  return ExpressionPrinter::system(e, s);
}

/// Prefix functions: `SIN Q1`, `SQRT (Q1 + Q2)`.
std::optional<Printed> Expressions::special(const ir::ExprPtr& e) {
  const auto* c = std::get_if<ir::Call>(&e->node);
  const auto* row = c != nullptr && c->args.size() == 1 ? facts::find_function(c->function) : nullptr;
  if (row == nullptr) return std::nullopt;
  const ir::ExprPtr& a = c->args.front();
  const bool bare = a && (std::holds_alternative<ir::VarRef>(a->node) || std::holds_alternative<ir::Number>(a->node));
  const std::string text = print(a);
  const bool alone = bare && !text.empty() && text.front() != '-';
  return Printed{std::string(row->word) + (alone ? ' ' + text : " (" + text + ')'), 4, false};
}

}  // namespace cnctrans::backends::heidenhain
