// Printing of expressions, variables and values.
#include "ir/text/text_printer.h"

namespace cnctrans::ir {
namespace detail {
namespace {

std::string number_node(const Number& n, bool forced) {
  const bool bare = !forced && says(n.text, n.value, false);
  std::string out;
  if (bare) {
    out = n.text;
  } else {
    out = "#" + shortest(n.value);
    if (!n.text.empty()) out += detail::quoted(n.text);
  }
  if (n.integer != natural_integer(n.value)) out += n.integer ? 'i' : 'r';
  return out;
}

std::string_view unary_text(UnaryOp op) {
  switch (op) {
    case UnaryOp::negate: return "-";
    case UnaryOp::logical_not: return "not ";
    case UnaryOp::bit_not: break;
  }
  return "bitnot ";
}

}  // namespace

std::string Printer::handle(SpaceId id) const {
  return id < handles_.size() ? handles_[id] : "s" + std::to_string(id);
}

/// In brackets a number without source text is the rule: it stands bare there.
std::string Printer::index_text(const ExprPtr& e) const {
  const auto* n = e ? std::get_if<Number>(&e->node) : nullptr;
  if (n == nullptr) return expr_text(e, false);
  const std::string after = suffix(*e);
  const std::string plain = shortest(n->value);
  const bool bare = n->text.empty() && after.empty() && n->integer && natural_integer(n->value) &&
                    number_length(plain) == plain.size();
  return bare ? plain : number_node(*n, true) + after;
}

std::string Printer::list_text(const std::vector<ExprPtr>& list) const {
  std::string text;
  for (const auto& e : list) {
    if (!text.empty()) text += ", ";
    text += index_text(e);
  }
  return text;
}

std::string Printer::variable_text(const VarRef& v) const {
  std::string text = handle(v.space);
  if (v.index) text += "[" + index_text(v.index) + "]";
  if (v.name.empty() && v.indices.empty()) return text;
  const bool bare =
      !v.name.empty() && is_word_start(v.name[0]) &&
      v.name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789") == std::string::npos;
  text += "." + (bare ? v.name : detail::quoted(v.name));
  if (!v.indices.empty()) text += "[" + list_text(v.indices) + "]";
  return text;
}

std::string Printer::suffix(const Expr& e) const {
  std::string text;
  if (e.type != natural_type(e)) {
    text += ":";
    text += name(e.type);
  }
  if (options_.places && e.pos != WordPos{}) {
    text += "^" + std::to_string(e.pos.column) + "+" + std::to_string(e.pos.length);
  }
  return text;
}

std::string Printer::expr_text(const ExprPtr& e, bool primary) const {
  if (!e) return "nothing";
  const std::string after = suffix(*e);
  if (const auto* n = std::get_if<Number>(&e->node)) return number_node(*n, false) + after;
  if (const auto* s = std::get_if<String>(&e->node)) return detail::quoted(s->text) + after;
  if (const auto* a = std::get_if<AxisName>(&e->node)) return "axis(" + axis_text(program_, a->axis) + ")" + after;
  if (const auto* v = std::get_if<VarRef>(&e->node)) return variable_text(*v) + after;
  if (const auto* s = std::get_if<SystemRef>(&e->node)) {
    std::string text =
        (s->given ? "given(" : "sys(") + std::string(enum_name(s->datum)) + ", " + axis_text(program_, s->axis) + ", ";
    text += detail::quoted(s->text);
    if (!s->args.empty()) text += ", " + list_text(s->args);
    return text + ")" + after;
  }
  if (const auto* c = std::get_if<Call>(&e->node)) {
    std::string text(name(c->function));
    if (c->half != RoundHalf::away) text += "." + std::string(enum_name(c->half));
    return text + "(" + list_text(c->args) + ")" + after;
  }
  std::string text;
  if (const auto* u = std::get_if<Unary>(&e->node)) {
    text = std::string(unary_text(u->op)) + expr_text(u->operand, true);
  } else if (const auto* b = std::get_if<Binary>(&e->node)) {
    text = expr_text(b->left, true) + " " + std::string(name(b->op));
    text += b->compare == Compare::exact ? " " : "~ ";
    text += expr_text(b->right, true);
  }
  return primary || !after.empty() ? "(" + text + ")" + after : text;
}

void Printer::expression(const ExprPtr& e, bool primary) {
  put(expr_text(e, primary));
}

/// A literal stands bare with its source text, or after # without; an expression is one operand.
void Printer::value(const Value& v) {
  if (v.expr) {
    const auto* n = std::get_if<Number>(&v.expr->node);
    put(n != nullptr ? "(" + number_node(*n, false) + ")" + suffix(*v.expr) : expr_text(v.expr, true));
  } else if (says(v.text, v.number, true)) {
    put(v.text);
  } else {
    put("#" + shortest(v.number));
    if (!v.text.empty()) glue(detail::quoted(v.text));
  }
}

void Printer::exprs(std::string_view, const std::vector<ExprPtr>& list) {
  if (!list.empty()) put("(" + list_text(list) + ")");
}

}  // namespace detail

std::string to_text(const ExprPtr& expr, const Program& program) {
  detail::Printer printer(program, {});
  printer.expression(expr, false);
  return std::move(printer.out);
}

}  // namespace cnctrans::ir
