#include "backends/common/expression_printer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cnctrans::backends {
namespace {

template <class Table, class Op>
auto find_op(const Table& table, Op op) -> decltype(&table.front()) {
  for (const auto& entry : table) {
    if (entry.op == op) return &entry;
  }
  return nullptr;
}

Printed wrapped(Printed p, const ExpressionStyle& style) {
  return Printed{std::string(style.open) + p.text + std::string(style.close), primary_level, false};
}

bool is_comparison_node(const ir::ExprPtr& e) {
  const auto* b = std::get_if<ir::Binary>(&e->node);
  return b != nullptr && ir::is_comparison(b->op);
}

}  // namespace

std::string ExpressionPrinter::print(const ir::ExprPtr& e) {
  return print_node(e).text;
}

std::string ExpressionPrinter::operand(const ir::ExprPtr& e, int level, bool front) {
  Printed p = print_node(e);
  const bool comparison = style_.comparison_needs_parentheses && e && is_comparison_node(e);
  if (p.level < level || comparison || (p.signed_front && !front && style_.sign_needs_parentheses)) {
    p = wrapped(std::move(p), style_);
  }
  return p.text;
}

std::string ExpressionPrinter::take_problem(WordPos* pos) {
  if (pos != nullptr) *pos = problem_pos_;
  return std::exchange(problem_, std::string{});
}

void ExpressionPrinter::problem(const ir::ExprPtr& e, std::string text) {
  if (!problem_.empty()) return;
  problem_ = std::move(text);
  problem_pos_ = e ? e->pos : WordPos{};
}

std::string ExpressionPrinter::arguments(const std::vector<ir::ExprPtr>& args) {
  std::string out;
  for (std::size_t i = 0; i < args.size(); ++i) {
    if (i != 0) out += style_.separator;
    if (args[i]) out += print(args[i]);
  }
  return out;
}

Printed ExpressionPrinter::print_node(const ir::ExprPtr& e) {
  if (!e) {
    problem(e, "an expression is missing");
    return {};
  }
  if (auto s = special(e)) return *std::move(s);
  if (const auto* n = std::get_if<ir::Number>(&e->node)) return number(*n);
  if (const auto* s = std::get_if<ir::String>(&e->node)) return {string(e, *s), primary_level, false};
  if (const auto* a = std::get_if<ir::AxisName>(&e->node)) return {axis(*a), primary_level, false};
  if (const auto* v = std::get_if<ir::VarRef>(&e->node)) return {variable(e, *v), primary_level, false};
  if (const auto* s = std::get_if<ir::SystemRef>(&e->node)) return {system(e, *s), primary_level, false};
  if (const auto* u = std::get_if<ir::Unary>(&e->node)) return unary(e, *u);
  if (const auto* b = std::get_if<ir::Binary>(&e->node)) return binary(e, *b);
  return function(e, std::get<ir::Call>(e->node));
}

Printed ExpressionPrinter::unary(const ir::ExprPtr& e, const ir::Unary& u) {
  const UnaryText* t = find_op(style_.unary, u.op);
  if (t == nullptr) {
    problem(e, "the operator '" + std::string(ir::name(u.op)) + "' does not exist there");
    return {};
  }
  std::string text(t->text);
  const bool word = !text.empty() && text.back() >= 'A' && text.back() <= 'Z';
  if (word) text += ' ';
  text += operand(u.operand, t->level, false);
  return {std::move(text), t->level, u.op == ir::UnaryOp::negate};
}

Printed ExpressionPrinter::binary(const ir::ExprPtr& e, const ir::Binary& b) {
  const BinaryText* t = find_op(style_.binary, b.op);
  if (t == nullptr) {
    problem(e, "the operator '" + std::string(ir::name(b.op)) + "' does not exist there");
    return {};
  }
  // Left to right: an operand of the same level needs parentheses on the right only.
  Printed left = print_node(b.left);
  const bool comparison = style_.comparison_needs_parentheses && b.left && is_comparison_node(b.left);
  if (left.level < t->level || comparison) left = wrapped(std::move(left), style_);
  const bool sign = left.signed_front;
  std::string text = std::move(left.text);
  if (t->blanks) text += ' ';
  text += t->text;
  if (t->blanks) text += ' ';
  text += operand(b.right, t->level + 1, style_.sign_after_comparison && ir::is_comparison(b.op));
  return {std::move(text), t->level, sign};
}

Printed ExpressionPrinter::function(const ir::ExprPtr& e, const ir::Call& c) {
  const auto at = std::find_if(style_.functions.begin(), style_.functions.end(),
                               [&](const FunctionText& f) { return f.function == c.function; });
  if (at == style_.functions.end()) {
    problem(e, "the function '" + std::string(ir::name(c.function)) + "' does not exist there");
    return {};
  }
  std::string text(at->name);
  text += style_.open;
  text += arguments(c.args);
  text += style_.close;
  return {std::move(text), primary_level, false};
}

Printed ExpressionPrinter::number(const ir::Number& n) {
  std::string text;
  append_number(text, n.value, n.text, numbers_);
  const bool negative = !text.empty() && text.front() == '-';
  return {std::move(text), primary_level, negative};
}

std::string ExpressionPrinter::string(const ir::ExprPtr& /*e*/, const ir::String& s) {
  return std::string(style_.string_quote) + s.text + std::string(style_.string_quote);
}

std::string ExpressionPrinter::axis(const ir::AxisName& a) {
  return std::string(program_.axis_name(a.axis));
}

std::string ExpressionPrinter::system(const ir::ExprPtr& e, const ir::SystemRef& s) {
  problem(e, "the system variable '" + s.text + "' has no counterpart there");
  return s.text;
}

std::optional<Printed> ExpressionPrinter::special(const ir::ExprPtr& /*e*/) {
  return std::nullopt;
}

}  // namespace cnctrans::backends
