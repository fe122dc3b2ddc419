#include "frontends/num/syntax/tree.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"

namespace cnctrans::frontends::num {

namespace {

using cnc_num::NumLexer;
using cnc_num::NumParser;
using syntax::Expr;
using syntax::ExprKind;
using syntax::Statement;
using syntax::Word;

std::string without_blanks(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c != ' ' && c != '\t') out += c;
  }
  return out;
}

/// Walks one tree; `line` is what all views point into.
class Builder {
 public:
  Builder(std::string_view line, syntax::Block& out, ParseError& error) : line_(line), out_(out), error_(error) {}

  bool block(NumParser::BlockContext& tree);

 private:
  [[nodiscard]] std::string_view slice(antlr4::Token* first, antlr4::Token* last) const {
    return line_.substr(first->getStartIndex(), last->getStopIndex() - first->getStartIndex() + 1);
  }
  [[nodiscard]] std::string_view slice(antlr4::ParserRuleContext& c) const { return slice(c.getStart(), c.getStop()); }
  [[nodiscard]] static WordPos pos(antlr4::Token* first, antlr4::Token* last) {
    return {static_cast<std::uint32_t>(first->getStartIndex() + 1),
            static_cast<std::uint32_t>(last->getStopIndex() - first->getStartIndex() + 1)};
  }
  [[nodiscard]] static WordPos pos(antlr4::ParserRuleContext& c) { return pos(c.getStart(), c.getStop()); }

  bool fail(WordPos where, std::string message) {
    error_ = {where, std::move(message)};
    return false;
  }

  bool number_part(NumParser::BlockContext& tree);
  bool item(NumParser::ItemContext& item, NumParser::ItemContext* next);
  bool word(NumParser::WordItemContext& item, NumParser::ItemContext* next);
  void code(antlr4::Token* token, NumParser::SignContext* sign);
  void bare(antlr4::Token* token);
  void test(NumParser::TestContext& tree);
  void test_number(NumParser::TestNumberItemContext& item);
  void statement(NumParser::StatementContext& tree);
  void keyword(std::string_view name, antlr4::ParserRuleContext& tree, std::vector<Expr> args = {});
  Statement assign(NumParser::VariableContext& target, NumParser::ExpressionContext& value, WordPos where);

  [[nodiscard]] Expr number(antlr4::Token* token) const;
  [[nodiscard]] Expr variable(NumParser::VariableContext& tree) const;
  [[nodiscard]] Expr symbol(NumParser::SymbolContext& tree) const;
  [[nodiscard]] Expr index(NumParser::IndexContext& tree) const;
  [[nodiscard]] Expr operand(NumParser::OperandContext& tree) const;
  [[nodiscard]] Expr primary(NumParser::PrimaryContext& tree) const;
  [[nodiscard]] Expr chain(NumParser::SignContext* sign, Expr first,
                           const std::vector<NumParser::OperationContext*>& ops,
                           const std::vector<NumParser::PrimaryContext*>& rest, std::size_t skip) const;
  [[nodiscard]] Expr expression(NumParser::ExpressionContext& tree) const;
  [[nodiscard]] Expr comparison(NumParser::ExpressionContext& left, NumParser::RelationContext& op,
                                NumParser::ExpressionContext& right) const;
  [[nodiscard]] Expr condition(NumParser::ConditionContext& tree) const;

  std::string_view line_;
  syntax::Block& out_;
  ParseError& error_;
};

Expr binary(std::string op, Expr left, Expr right) {
  Expr e;
  e.kind = ExprKind::binary;
  e.text = std::move(op);
  e.pos = {left.pos.column, right.pos.column + right.pos.length - left.pos.column};
  e.args.push_back(std::move(left));
  e.args.push_back(std::move(right));
  return e;
}

Expr Builder::number(antlr4::Token* token) const {
  Expr e;
  e.kind = ExprKind::number;
  e.text = without_blanks(slice(token, token));
  e.number = parse_decimal(e.text).value_or(0);
  e.pos = pos(token, token);
  return e;
}

Expr Builder::index(NumParser::IndexContext& tree) const {
  std::optional<Expr> value;
  const auto operands = tree.indexOperand();
  const auto ops = tree.SYM_OP();
  const bool signed_first = ops.size() == operands.size();
  for (std::size_t i = 0; i < operands.size(); ++i) {
    Expr e;
    if (auto* inner = operands[i]->symbol()) {
      e = symbol(*inner);
    } else {
      auto* token = operands[i]->getStart();
      e.pos = pos(token, token);
      e.text = to_upper_ascii(slice(token, token));
      const bool numeric = token->getType() == NumLexer::SYM_NUMBER;
      e.kind = numeric ? ExprKind::number : ExprKind::name;
      if (numeric) e.number = parse_decimal(e.text).value_or(0);
      // L5 as an index: the variable.
      if (!numeric && e.text.size() > 1 && (e.text[0] == 'L' || e.text[0] == 'E') &&
          e.text.find_first_not_of("0123456789", 1) == std::string::npos) {
        Expr n;
        n.kind = ExprKind::number;
        n.text = e.text.substr(1);
        n.number = parse_decimal(n.text).value_or(0);
        n.pos = {e.pos.column + 1, e.pos.length - 1};
        e.text.resize(1);
        e.kind = ExprKind::variable;
        e.args.push_back(std::move(n));
      }
    }
    if (!value) {
      if (signed_first) {
        Expr u;
        u.kind = ExprKind::unary;
        u.text = ops[0]->getText();
        u.pos = pos(ops[0]->getSymbol(), operands[i]->getStop());
        u.args.push_back(std::move(e));
        e = std::move(u);
      }
      value = std::move(e);
    } else {
      value = binary(ops[signed_first ? i : i - 1]->getText(), std::move(*value), std::move(e));
    }
  }
  return value.value_or(Expr{});
}

Expr Builder::symbol(NumParser::SymbolContext& tree) const {
  Expr e;
  e.kind = ExprKind::variable;
  auto* name = tree.SYM_NAME()->getSymbol();
  e.text = "[" + to_upper_ascii(slice(name, name)) + "]";
  e.pos = pos(tree);
  for (auto* i : tree.index()) e.args.push_back(index(*i));
  return e;
}

Expr Builder::variable(NumParser::VariableContext& tree) const {
  if (auto* s = tree.symbol()) return symbol(*s);
  Expr e;
  e.kind = ExprKind::variable;
  e.pos = pos(tree);
  if (tree.aliasAddress() != nullptr) {
    e.text = "'" + to_upper_ascii(without_blanks(slice(*tree.aliasAddress())));
    return e;
  }
  e.text = tree.L() != nullptr ? "L" : "E";
  e.args.push_back(number(tree.NUMBER()->getSymbol()));
  return e;
}

Expr Builder::operand(NumParser::OperandContext& tree) const {
  if (auto* v = tree.variable()) return variable(*v);
  return number(tree.NUMBER()->getSymbol());
}

Expr Builder::primary(NumParser::PrimaryContext& tree) const {
  if (auto* o = tree.operand()) return operand(*o);
  Expr e;
  e.kind = ExprKind::call;
  auto* f = tree.FUNCTION()->getSymbol();
  e.text = to_upper_ascii(slice(f, f));
  e.pos = pos(tree);
  e.args.push_back(primary(*tree.primary()));
  return e;
}

Expr Builder::chain(NumParser::SignContext* sign, Expr first, const std::vector<NumParser::OperationContext*>& ops,
                    const std::vector<NumParser::PrimaryContext*>& rest, std::size_t skip) const {
  Expr value = std::move(first);
  if (sign != nullptr) {
    Expr u;
    u.kind = ExprKind::unary;
    u.text = sign->getText();
    const std::uint32_t column = pos(*sign).column;
    u.pos = {column, value.pos.column + value.pos.length - column};
    u.args.push_back(std::move(value));
    value = std::move(u);
  }
  for (std::size_t i = 0; i < ops.size(); ++i) {
    value = binary(ops[i]->getText(), std::move(value), primary(*rest[i + skip]));
  }
  return value;
}

Expr Builder::expression(NumParser::ExpressionContext& tree) const {
  const auto primaries = tree.primary();
  return chain(tree.sign(), primary(*primaries[0]), tree.operation(), primaries, 1);
}

Expr Builder::comparison(NumParser::ExpressionContext& left, NumParser::RelationContext& op,
                         NumParser::ExpressionContext& right) const {
  return binary(without_blanks(slice(op)), expression(left), expression(right));
}

Expr Builder::condition(NumParser::ConditionContext& tree) const {
  std::optional<Expr> value;
  std::string joint;
  for (auto* child : tree.children) {
    if (auto* c = dynamic_cast<NumParser::ComparisonContext*>(child)) {
      Expr e = comparison(*c->expression(0), *c->relation(), *c->expression(1));
      value = value ? binary(joint, std::move(*value), std::move(e)) : std::move(e);
    } else {
      joint = to_upper_ascii(child->getText());
    }
  }
  return value.value_or(Expr{});
}

Statement Builder::assign(NumParser::VariableContext& target, NumParser::ExpressionContext& value, WordPos where) {
  Statement s;
  s.keyword = "ASSIGN";
  s.args.push_back(variable(target));
  s.args.push_back(expression(value));
  s.pos = where;
  return s;
}

void Builder::test(NumParser::TestContext& tree) {
  Statement s;
  s.keyword = "TEST";
  s.pos = pos(tree);
  const auto sides = tree.expression();
  if (auto* target = tree.variable()) {
    s.children.push_back(assign(*target, *sides[0], pos(target->getStart(), sides[0]->getStop())));
    s.args.push_back(binary(without_blanks(slice(*tree.relation())), variable(*target), expression(*sides[1])));
  } else {
    s.args.push_back(comparison(*sides[0], *tree.relation(), *sides[1]));
  }
  out_.statements.push_back(std::move(s));
}

/// `G79 5<L1`: the token holds the code and the first number of the test.
void Builder::test_number(NumParser::TestNumberItemContext& item) {
  auto* token = item.G_TEST_NUMBER()->getSymbol();
  code(token, nullptr);
  auto* rest = item.testRest();
  if (rest == nullptr) return;
  const std::string_view text = slice(token, token);
  std::size_t end = 1;
  for (int value = 0; end < text.size() && value != 79 && value != 10; ++end) {
    if (text[end] >= '0' && text[end] <= '9') value = value * 10 + (text[end] - '0');
  }
  Word& w = out_.words.back();
  w.number_text = trim(text.substr(1, end - 1));
  w.number = parse_decimal(without_blanks(w.number_text)).value_or(0);
  w.pos.length = static_cast<std::uint32_t>(end);
  const std::size_t begin = text.find_first_not_of(" \t", end);
  Expr first;
  first.kind = ExprKind::number;
  first.text = without_blanks(text.substr(begin));
  first.number = parse_decimal(first.text).value_or(0);
  first.pos = {w.pos.column + static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(text.size() - begin)};
  Statement s;
  s.keyword = "TEST";
  s.pos = {first.pos.column, pos(*rest).column + pos(*rest).length - first.pos.column};
  s.args.push_back(binary(without_blanks(slice(*rest->relation())),
                          chain(nullptr, std::move(first), rest->operation(), rest->primary(), 0),
                          expression(*rest->expression())));
  out_.statements.push_back(std::move(s));
}

void Builder::code(antlr4::Token* token, NumParser::SignContext* sign) {
  Word w;
  const std::string_view text = slice(token, sign != nullptr ? sign->getStop() : token);
  w.address = text.substr(0, 1);
  w.number_text = trim(text.substr(1));
  const std::string_view digits = trim(slice(token, token).substr(1));
  w.has_value = sign == nullptr;
  w.number = parse_decimal(without_blanks(digits)).value_or(0);
  w.pos = pos(token, sign != nullptr ? sign->getStop() : token);
  out_.words.push_back(w);
}

void Builder::bare(antlr4::Token* token) {
  Word w;
  w.address = slice(token, token);
  w.pos = pos(token, token);
  out_.words.push_back(w);
}

bool Builder::word(NumParser::WordItemContext& item, NumParser::ItemContext* next) {
  auto* value = item.value();
  Word w;
  w.address = slice(*item.address());
  w.pos = pos(item);
  const bool bare_word = value == nullptr || value->operand() == nullptr;
  if (bare_word && dynamic_cast<NumParser::AssignItemContext*>(next) != nullptr) {
    return fail(w.pos, "`" + std::string(w.address) + "` has no value and an assignment follows it: whether `" +
                           std::string(slice(*next)) + "` is its value or a statement can't be told");
  }
  if (value == nullptr) {
    out_.words.push_back(w);
    return true;
  }
  w.number_text = slice(*value);
  if (bare_word) {
    out_.words.push_back(w);
    return true;
  }
  w.has_value = true;
  auto* operand_tree = value->operand();
  if (operand_tree->NUMBER() != nullptr && value->operation().empty()) {
    const double n = number(operand_tree->NUMBER()->getSymbol()).number;
    w.number = value->sign() != nullptr && value->sign()->MINUS() != nullptr ? -n : n;
  } else {
    w.is_expression = true;
    w.number_text = {};
    w.expr = static_cast<std::int32_t>(out_.exprs.size());
    out_.exprs.push_back(chain(value->sign(), operand(*operand_tree), value->operation(), value->primary(), 0));
  }
  out_.words.push_back(w);
  return true;
}

bool Builder::item(NumParser::ItemContext& item, NumParser::ItemContext* next) {
  if (auto* w = dynamic_cast<NumParser::WordItemContext*>(&item)) return word(*w, next);
  if (auto* c = dynamic_cast<NumParser::CodeItemContext*>(&item)) {
    code(c->G_CODE()->getSymbol(), c->sign());
  } else if (auto* t = dynamic_cast<NumParser::TestItemContext*>(&item)) {
    code(t->G_TEST()->getSymbol(), nullptr);
    if (t->test() != nullptr) test(*t->test());
  } else if (auto* number_first = dynamic_cast<NumParser::TestNumberItemContext*>(&item)) {
    test_number(*number_first);
  } else if (auto* o = dynamic_cast<NumParser::LetterOItemContext*>(&item)) {
    code(o->G_LETTER_O()->getSymbol(), nullptr);
  } else if (auto* signed_code = dynamic_cast<NumParser::SignedCodeItemContext*>(&item)) {
    code(signed_code->getStart(), nullptr);
    Word& w = out_.words.back();
    const double n = number(signed_code->NUMBER()->getSymbol()).number;
    w.number = signed_code->sign()->MINUS() != nullptr ? -n : n;
    w.number_text = slice(signed_code->sign()->getStart(), signed_code->getStop());
    w.pos = pos(*signed_code);
  } else if (auto* g = dynamic_cast<NumParser::BareCodeItemContext*>(&item)) {
    if (dynamic_cast<NumParser::AssignItemContext*>(next) != nullptr) {
      return fail(pos(*g), "`G` has no value and an assignment follows it: write the number of the code");
    }
    bare(g->getStart());
  } else if (auto* d = dynamic_cast<NumParser::DiscriminantItemContext*>(&item)) {
    bare(d->getStart());
    out_.words.back().number_text = slice(*d->sign());
    out_.words.back().pos = pos(*d);
  } else if (auto* a = dynamic_cast<NumParser::AssignItemContext*>(&item)) {
    out_.statements.push_back(assign(*a->variable(), *a->expression(), pos(*a)));
  } else if (auto* i = dynamic_cast<NumParser::InputItemContext*>(&item)) {
    keyword("INPUT", *i, {variable(*i->variable())});
    auto* text = i->MESSAGE()->getSymbol();
    out_.statements.back().text = std::string(slice(text, text).substr(1));
  } else if (auto* s = dynamic_cast<NumParser::DeclareItemContext*>(&item)) {
    keyword("DECL", *s, {symbol(*s->symbol())});
  } else if (auto* e = dynamic_cast<NumParser::EquivalenceItemContext*>(&item)) {
    std::vector<Expr> names;
    for (auto* address : e->equalAddress()) {
      Expr n;
      n.kind = ExprKind::name;
      n.text = to_upper_ascii(without_blanks(slice(*address)));
      n.pos = pos(*address);
      names.push_back(std::move(n));
    }
    keyword("EQUIV", *e, std::move(names));
  }
  return true;
}

void Builder::keyword(std::string_view name, antlr4::ParserRuleContext& tree, std::vector<Expr> args) {
  Statement s;
  s.keyword = std::string(name);
  s.args = std::move(args);
  s.pos = pos(tree);
  out_.statements.push_back(std::move(s));
}

void Builder::statement(NumParser::StatementContext& tree) {
  if (auto* i = dynamic_cast<NumParser::IfStatementContext*>(&tree))
    return keyword("IF", tree, {condition(*i->condition())});
  if (auto* w = dynamic_cast<NumParser::WhileStatementContext*>(&tree)) {
    return keyword("WHILE", tree, {condition(*w->condition())});
  }
  if (auto* u = dynamic_cast<NumParser::UntilStatementContext*>(&tree)) {
    return keyword("UNTIL", tree, {condition(*u->condition())});
  }
  if (auto* f = dynamic_cast<NumParser::ForStatementContext*>(&tree)) {
    std::vector<Expr> args{variable(*f->variable()), expression(*f->expression(0)), expression(*f->expression(1))};
    args.push_back(f->KW_BY() != nullptr ? expression(*f->expression(2)) : Expr{});
    keyword("FOR", tree, std::move(args));
    out_.statements.back().text = f->KW_TO() != nullptr ? "TO" : "DOWNTO";
    return;
  }
  if (dynamic_cast<NumParser::CarriedStatementContext*>(&tree) != nullptr) {
    keyword("CARRIED", tree);
    out_.statements.back().text = std::string(slice(tree));
    return;
  }
  keyword(to_upper_ascii(slice(tree.getStart(), tree.getStart())), tree);
}

bool Builder::number_part(NumParser::BlockContext& tree) {
  if (auto* slash = tree.SLASH()) {
    out_.skip_mask = 1;
    out_.skip_pos = pos(slash->getSymbol(), slash->getSymbol());
  }
  auto* n = tree.number();
  if (n == nullptr) return true;
  auto* digits = n->NUMBER()->getSymbol();
  out_.number = slice(digits, digits);
  out_.number_pos = pos(*n);
  if (out_.number.find('.') != std::string_view::npos) {
    return fail(out_.number_pos, "a block number has no decimal point");
  }
  return true;
}

bool Builder::block(NumParser::BlockContext& tree) {
  if (!number_part(tree)) return false;
  auto& content = *tree.content();
  if (auto* h = content.header()) {
    std::vector<Expr> args;
    if (h->NUMBER() != nullptr) args.push_back(number(h->NUMBER()->getSymbol()));
    keyword("%", *h, std::move(args));
    if (out_.skip_mask != 0 || !out_.number.empty()) return fail(pos(*h), "a program header stands alone in its line");
    return true;
  }
  if (auto* s = content.statement()) {
    statement(*s);
    return true;
  }
  const auto items = content.item();
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!item(*items[i], i + 1 < items.size() ? items[i + 1] : nullptr)) return false;
  }
  if (auto* m = content.message()) {
    keyword("MSG", *m);
    out_.statements.back().text = std::string(slice(*m).substr(1));
  }
  out_.plain = out_.statements.empty() &&
               std::none_of(out_.words.begin(), out_.words.end(), [](const Word& w) { return w.is_expression; });
  return true;
}

}  // namespace

bool build_block(NumParser::BlockContext& tree, std::string_view line, syntax::Block& out, ParseError& error) {
  return Builder(line, out, error).block(tree);
}

}  // namespace cnctrans::frontends::num
