#include "backends/num/chain_printer.h"

#include "backends/num/data_names.h"
#include "base/text.h"
#include "dialects/num/functions.h"
#include "dialects/num/variables.h"

namespace cnctrans::backends::num {

namespace facts = dialects::num;

bool system_units(const ir::ExprPtr& e) {
  const auto* n = std::get_if<ir::Number>(&e->node);
  return n != nullptr && n->text.empty() && n->value > 1;  // written out by the reader
}

std::string ChainPrinter::variable(const ir::ExprPtr& e, const ir::VarRef& v) {
  if (v.space >= program_.spaces.size()) {
    problem(e, "a variable of no space");
    return {};
  }
  const ir::VariableSpace& space = program_.spaces[v.space];
  if (space.named()) {
    const bool bracketed = !v.name.empty() && v.name.front() == '[';
    std::string text = bracketed ? v.name : "[" + v.name + "]";
    std::string list;
    for (const auto& i : v.indices) list += (list.empty() ? "" : ",") + print_node(i).text;
    if (!list.empty()) text.insert(text.size() - 1, "(" + list + ")");
    return text;
  }
  const auto n = ir::constant_value(v.index);
  if (!n) {
    problem(e, "a variable with a computed number has no counterpart on this control");
    return {};
  }
  return space.prefix + shortest(*n);
}

std::string ChainPrinter::system(const ir::ExprPtr& e, const ir::SystemRef& s) {
  if (s.given) return s.text;
  if ((program_.dialect == "num" && !s.text.empty()) || is_parameter_name(s.text)) return s.text;
  problem(e, "'" + s.text + "' is data of the source machine that this control has no name for");
  return {};
}

std::string ChainPrinter::string(const ir::ExprPtr& e, const ir::String& /*s*/) {
  problem(e, "this control has no texts in expressions");
  return {};
}

bool ChainPrinter::primary(const ir::ExprPtr& e) {
  if (const auto* n = std::get_if<ir::Number>(&e->node)) return n->value >= 0;
  if (const auto* b = std::get_if<ir::Binary>(&e->node)) {
    return b->op == ir::BinaryOp::multiply && std::holds_alternative<ir::SystemRef>(b->left->node) &&
           system_units(b->right);
  }
  if (const auto* c = std::get_if<ir::Call>(&e->node)) return c->args.size() == 1 && primary(c->args[0]);
  return std::holds_alternative<ir::VarRef>(e->node) || std::holds_alternative<ir::SystemRef>(e->node);
}

Printed ChainPrinter::chain(const ir::ExprPtr& e, const ir::Binary& b) {
  const BinaryText* text = nullptr;
  for (const auto& t : style_.binary) {
    if (t.op == b.op) text = &t;
  }
  if (text == nullptr) {
    problem(e, "the operator '" + std::string(ir::name(b.op)) + "' has no counterpart on this control");
    return {};
  }
  // An E parameter is read in system units: the reader wrote its scaling out.
  if (program_.dialect == "num" && b.op == ir::BinaryOp::multiply &&
      std::holds_alternative<ir::SystemRef>(b.left->node) && system_units(b.right)) {
    return print_node(b.left);
  }
  Printed left = print_node(b.left);
  // a + (-2) is a - 2.
  if (const auto* n = std::get_if<ir::Number>(&b.right->node); n != nullptr && n->value < 0) {
    const auto opposite = b.op == ir::BinaryOp::add ? "-" : b.op == ir::BinaryOp::subtract ? "+" : "";
    if (*opposite != '\0') return {left.text + opposite + print_node(ir::number(-n->value)).text, 2, left.signed_front};
  }
  if (!primary(b.right) && !ir::is_comparison(b.op)) {
    problem(e, "this control has no parentheses: the right operand needs a variable of its own");
    return {};
  }
  return {left.text + std::string(text->text) + print_node(b.right).text, text->level, left.signed_front};
}

std::optional<Printed> ChainPrinter::special(const ir::ExprPtr& e) {
  if (const auto* b = std::get_if<ir::Binary>(&e->node)) return chain(e, *b);
  if (const auto* c = std::get_if<ir::Call>(&e->node)) {
    for (const auto& f : facts::functions) {
      if (f.function != c->function || c->args.size() != 1) continue;
      if (!primary(c->args[0])) break;
      return Printed{std::string(1, f.letter) + " " + print_node(c->args[0]).text, primary_level, false};
    }
    problem(
        e, "the function '" + std::string(ir::name(c->function)) + "' cannot be written in this place on this control");
    return Printed{};
  }
  if (const auto* u = std::get_if<ir::Unary>(&e->node)) {
    if (u->op == ir::UnaryOp::negate && primary(u->operand)) return Printed{"-" + print_node(u->operand).text, 2, true};
    problem(e, "this sign or negation needs a variable of its own on this control");
    return Printed{};
  }
  return std::nullopt;
}

}  // namespace cnctrans::backends::num
