// Expressions of a block: parse tree -> syntax::Expr.
#include <charconv>
#include <cstdlib>

#include "base/text.h"
#include "frontends/sinumerik/syntax/tree.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

double number_value(std::string_view digits) {
  std::string plain;
  plain.reserve(digits.size());
  for (const char c : digits) {  // 8.2EX-3 -> 8.2E-3
    if (c != 'X' && c != 'x') plain += c;
  }
  double value = 0;
  std::from_chars(plain.data(), plain.data() + plain.size(), value);
  return value;
}

bool plain_number(Grammar::ExprContext* tree, std::string_view line, PlainNumber& out) {
  antlr4::Token* sign = nullptr;
  if (auto* prefix = dynamic_cast<Grammar::PrefixOperationContext*>(tree); prefix != nullptr) {
    sign = prefix->op;
    if (sign->getType() != Grammar::PLUS && sign->getType() != Grammar::MINUS) return false;
    tree = prefix->expr();
  }
  auto* operand = dynamic_cast<Grammar::OperandContext*>(tree);
  if (operand == nullptr) return false;
  auto* number = dynamic_cast<Grammar::NumberOperandContext*>(operand->primary());
  if (number == nullptr) return false;
  const antlr4::Token& digits = *number->getStart();
  if (sign != nullptr && sign->getStopIndex() + 1 != digits.getStartIndex()) return false;
  const std::size_t first = sign != nullptr ? sign->getStartIndex() : digits.getStartIndex();
  out.text = line.substr(first, digits.getStopIndex() + 1 - first);
  if (out.text.find_first_of("Xx") != std::string_view::npos) return false;  // exponents stay expressions
  const double v =
      number_value(line.substr(digits.getStartIndex(), digits.getStopIndex() + 1 - digits.getStartIndex()));
  out.value = sign != nullptr && sign->getType() == Grammar::MINUS ? -v : v;
  return true;
}

WordPos ExprBuilder::pos(const antlr4::Token& first, const antlr4::Token& last) {
  const auto start = static_cast<std::uint32_t>(first.getStartIndex());
  const auto stop = static_cast<std::uint32_t>(last.getStopIndex()) + 1;
  return WordPos{start + 1, stop > start ? stop - start : 0};
}
WordPos ExprBuilder::pos(antlr4::ParserRuleContext* tree) const {
  return pos(*tree->getStart(), *tree->getStop());
}

std::string_view ExprBuilder::text(antlr4::ParserRuleContext* tree) const {
  const WordPos p = pos(tree);
  return line_.substr(p.column - 1, p.length);
}
std::string_view ExprBuilder::text(const antlr4::Token& token) const {
  return line_.substr(token.getStartIndex(), token.getStopIndex() + 1 - token.getStartIndex());
}

void ExprBuilder::fail(antlr4::ParserRuleContext* tree, std::string_view message) {
  if (failed_) return;
  failed_ = true;
  const WordPos p = pos(tree);
  error_.column = p.column;
  error_.length = p.length == 0 ? 1 : p.length;
  error_.message = message;
}

Expr ExprBuilder::name(antlr4::ParserRuleContext* tree) {
  Expr out;
  out.kind = ExprKind::name;
  for (const char c : text(tree)) {
    if (c != ' ' && c != '\t') out.text += c;  // `N 100` names N100
  }
  out.text = to_upper_ascii(out.text);
  out.pos = pos(tree);
  return out;
}

Expr ExprBuilder::system(antlr4::tree::TerminalNode* token) {
  Expr out;
  out.kind = ExprKind::variable;
  out.text = to_upper_ascii(text(*token->getSymbol()));
  out.pos = pos(*token->getSymbol(), *token->getSymbol());
  return out;
}

void ExprBuilder::arguments(Grammar::ArgumentListContext* tree, std::vector<Expr>& out) {
  const auto list = tree->argument();
  if (list.size() == 1 && list[0]->expr() == nullptr) return;  // `()`
  for (auto* argument : list) out.push_back(argument->expr() != nullptr ? expr(argument->expr()) : Expr{});
}

Expr ExprBuilder::indexed(Grammar::IndexedContext* tree) {
  Expr out;
  out.kind = ExprKind::variable;
  if (tree->SYSVAR() != nullptr) {
    out.text = to_upper_ascii(text(*tree->SYSVAR()->getSymbol()));
  } else {
    out.text = to_upper_ascii(tree->name() != nullptr ? text(tree->name())
                                                      : text(static_cast<antlr4::ParserRuleContext*>(tree->letter())));
    if (tree->INTEGER() != nullptr) out.text += text(*tree->INTEGER()->getSymbol());  // an array called T1
  }
  arguments(tree->argumentList(), out.args);
  out.pos = pos(tree);
  return out;
}

Expr ExprBuilder::lvalue(Grammar::LvalueContext* tree) {
  if (tree->indexed() != nullptr) return indexed(tree->indexed());
  if (tree->SYSVAR() != nullptr) return system(tree->SYSVAR());
  Expr out = name(tree);
  if (tree->letter() != nullptr && tree->letter()->LETTER_R() != nullptr && tree->INTEGER() != nullptr) {
    Expr index;
    index.kind = ExprKind::number;
    index.text = text(*tree->INTEGER()->getSymbol());
    index.number = number_value(index.text);
    index.pos = pos(*tree->INTEGER()->getSymbol(), *tree->INTEGER()->getSymbol());
    out.kind = ExprKind::variable;
    out.text = "R";
    out.args.push_back(std::move(index));
  }
  return out;
}

Expr ExprBuilder::letter(Grammar::LetterOperandContext* tree) {
  Expr out = name(tree);
  if (tree->letter()->LETTER_R() != nullptr && tree->INTEGER() != nullptr) {
    const antlr4::Token& digits = *tree->INTEGER()->getSymbol();
    Expr index;
    index.kind = ExprKind::number;
    index.text = text(digits);
    index.number = number_value(index.text);
    index.pos = pos(digits, digits);
    out.kind = ExprKind::variable;
    out.text = "R";
    out.args.push_back(std::move(index));
  }
  return out;
}

Expr ExprBuilder::number(antlr4::ParserRuleContext* tree) {
  Expr out;
  out.kind = ExprKind::number;
  out.text = text(tree);
  out.number = number_value(out.text);
  out.pos = pos(tree);
  return out;
}

/// 'H1F' and 'B1010': an integer written in another base, 32 bits.
Expr ExprBuilder::based(antlr4::ParserRuleContext* tree) {
  Expr out;
  out.kind = ExprKind::number;
  out.text = to_upper_ascii(text(tree));
  out.pos = pos(tree);
  const int base = out.text[1] == 'H' ? 16 : 2;
  std::uint32_t bits = 0;
  const char* last = out.text.data() + out.text.size() - 1;
  const auto read = std::from_chars(out.text.data() + 2, last, bits, base);
  if (read.ec != std::errc{} || read.ptr != last) fail(tree, "the constant does not fit into 32 bits");
  out.number = static_cast<double>(static_cast<std::int32_t>(bits));
  return out;
}

Expr ExprBuilder::parenthesised(Grammar::ParenthesisedContext* tree, bool list_allowed) {
  if (tree->argument().empty()) return condition(tree->condition());
  if (!list_allowed) fail(tree, "a list of values may stand only right of `=`");
  Expr out;
  out.kind = ExprKind::call;
  out.pos = pos(tree);
  out.args.push_back(condition(tree->condition()));
  for (auto* argument : tree->argument())
    out.args.push_back(argument->expr() != nullptr ? expr(argument->expr()) : Expr{});
  return out;
}

Expr ExprBuilder::primary(Grammar::PrimaryContext* tree) {
  if (auto* t = dynamic_cast<Grammar::NumberOperandContext*>(tree)) return number(t);
  if (auto* t = dynamic_cast<Grammar::LetterOperandContext*>(tree)) return letter(t);
  if (auto* t = dynamic_cast<Grammar::NameOperandContext*>(tree)) return name(t);
  if (auto* t = dynamic_cast<Grammar::ParenthesisedContext*>(tree)) return parenthesised(t, false);
  if (auto* t = dynamic_cast<Grammar::IndexedOperandContext*>(tree)) return indexed(t->indexed());
  if (auto* t = dynamic_cast<Grammar::SystemOperandContext*>(tree)) return system(t->SYSVAR());
  if (auto* t = dynamic_cast<Grammar::BasedOperandContext*>(tree)) return based(t);
  if (auto* t = dynamic_cast<Grammar::FunctionOperandContext*>(tree)) {
    Expr out;
    out.kind = ExprKind::call;
    out.text = to_upper_ascii(text(t->name()));
    out.pos = pos(t);
    arguments(t->arguments()->argumentList(), out.args);
    return out;
  }
  Expr out;  // "text" or 'c'
  const std::string_view with_marks = text(tree);
  out.kind = ExprKind::string;
  out.text = with_marks.substr(1, with_marks.size() - 2);
  out.pos = pos(tree);
  return out;
}

/// Left-leaning chains are taken in a loop, so that a long sum does not need a deep stack.
Expr ExprBuilder::infix(Grammar::InfixOperationContext* tree) {
  std::vector<Grammar::InfixOperationContext*> chain;
  Grammar::ExprContext* leftmost = tree;
  while (auto* t = dynamic_cast<Grammar::InfixOperationContext*>(leftmost)) {
    chain.push_back(t);
    leftmost = t->expr(0);
  }
  Expr out = expr(leftmost);
  for (auto it = chain.rbegin(); it != chain.rend(); ++it) {
    Expr node;
    node.kind = ExprKind::binary;
    node.text = to_upper_ascii(text(*(*it)->op));
    node.pos = pos(*it);
    node.args.reserve(2);
    node.args.push_back(std::move(out));
    node.args.push_back(expr((*it)->expr(1)));
    out = std::move(node);
  }
  return out;
}

Expr ExprBuilder::expr(Grammar::ExprContext* tree) {
  if (auto* t = dynamic_cast<Grammar::OperandContext*>(tree)) return primary(t->primary());
  if (auto* t = dynamic_cast<Grammar::InfixOperationContext*>(tree)) return infix(t);
  auto* t = dynamic_cast<Grammar::PrefixOperationContext*>(tree);
  Expr out;
  if (t == nullptr) return out;
  out.kind = ExprKind::unary;
  out.text = to_upper_ascii(text(*t->op));
  out.pos = pos(t);
  out.args.push_back(expr(t->expr()));
  return out;
}

/// `a = b` in a condition reads as a comparison written with one sign: kept as the binary operator "=".
Expr ExprBuilder::condition(Grammar::ConditionContext* tree) {
  Expr left = expr(tree->expr(0));
  if (tree->ASSIGN() == nullptr) return left;
  Expr out;
  out.kind = ExprKind::binary;
  out.text = "=";
  if (tree->mirrored != nullptr) out.text = tree->mirrored->getType() == Grammar::LT ? "=<" : "=>";
  out.pos = pos(tree);
  out.args.push_back(std::move(left));
  out.args.push_back(expr(tree->expr(1)));
  return out;
}

Expr ExprBuilder::value(Grammar::ExprContext* tree) {
  if (auto* operand = dynamic_cast<Grammar::OperandContext*>(tree)) {
    if (auto* list = dynamic_cast<Grammar::ParenthesisedContext*>(operand->primary())) return parenthesised(list, true);
  }
  return expr(tree);
}

}  // namespace cnctrans::sinumerik
