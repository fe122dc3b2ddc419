#include "frontends/fagor/syntax/tree_reader.h"

#include <antlr4-runtime.h>

#include <cmath>
#include <utility>

#include "base/text.h"
#include "fagor/FagorParser.h"

namespace cnctrans::fagor {

namespace {

using Parser = cnc_fagor::FagorParser;
using syntax::Expr;
using syntax::ExprKind;
using syntax::Statement;

class TreeReader {
 public:
  TreeReader(std::string_view line, ParseError& error) : line_(line), error_(error) {}

  bool block(Parser::BlockContext* c, syntax::Block& out);

 private:
  // places and texts
  [[nodiscard]] WordPos pos(antlr4::ParserRuleContext* c) const { return between(c->getStart(), c->getStop()); }
  [[nodiscard]] static WordPos pos(antlr4::Token* t) { return between(t, t); }
  [[nodiscard]] static WordPos between(const antlr4::Token* a, const antlr4::Token* b) {
    return {static_cast<std::uint32_t>(a->getStartIndex() + 1),
            static_cast<std::uint32_t>(b->getStopIndex() - a->getStartIndex() + 1)};
  }
  [[nodiscard]] std::string_view text(WordPos p) const { return line_.substr(p.column - 1, p.length); }
  [[nodiscard]] std::string folded(WordPos p) const;
  bool fail(WordPos p, std::string message);

  // values
  double decimal(antlr4::Token* t);
  Expr number(antlr4::Token* t);
  Expr hex(antlr4::Token* t);
  Expr string(antlr4::Token* t) const;
  Expr parameter(antlr4::Token* t);
  Expr letter(Parser::LetterContext* c) const;
  Expr unknown(Parser::UnknownContext* c);
  Expr index(Parser::IndexValueContext* c);
  Expr variable(Parser::VariableContext* c);
  Expr expr(Parser::ExprContext* c);
  Expr unary(antlr4::Token* op, Expr operand, WordPos p) const;
  Expr signed_value(antlr4::Token* sign, Expr value, WordPos p) const;

  // words and statements
  void skip_marks(Parser::BlockContext* c, syntax::Block& out);
  void word(Parser::WordContext* c, syntax::Block& out);
  void value(Parser::ValueContext* c, syntax::Word& w, syntax::Block& out);
  Statement statement(Parser::StatementContext* c);
  Statement action(Parser::ActionContext* c);
  Statement make(std::string keyword, antlr4::ParserRuleContext* c) const;
  Expr program(Parser::ProgramContext* c);
  Expr target(Parser::TargetContext* c);
  void assignment(Parser::AssignmentContext* c, std::vector<Expr>& out);
  void argument(Parser::ArgumentContext* c, std::vector<Expr>& out);
  Statement program_action(Parser::ProgramActionContext* c);

  std::string_view line_;
  ParseError& error_;
  bool ok_ = true;
};

std::string TreeReader::folded(WordPos p) const {
  return to_upper_ascii(text(p));
}

bool TreeReader::fail(WordPos p, std::string message) {
  if (ok_) error_ = {p, std::move(message)};
  ok_ = false;
  return false;
}

double TreeReader::decimal(antlr4::Token* t) {
  const auto value = parse_decimal(text(pos(t)));
  if (!value || !std::isfinite(*value)) {
    fail(pos(t), "the number is too large");
    return 0;
  }
  return *value;
}

Expr TreeReader::number(antlr4::Token* t) {
  Expr e;
  e.kind = ExprKind::number;
  e.pos = pos(t);
  e.text = std::string(text(e.pos));
  e.number = decimal(t);
  return e;
}

Expr TreeReader::hex(antlr4::Token* t) {
  Expr e;
  e.kind = ExprKind::number;
  e.pos = pos(t);
  e.text = folded(e.pos);
  if (e.text.size() > 9) fail(e.pos, "a hexadecimal number has at most 8 digits");
  for (const char c : std::string_view(e.text).substr(1))
    e.number = e.number * 16 + (c <= '9' ? c - '0' : c - 'A' + 10);
  return e;
}

Expr TreeReader::string(antlr4::Token* t) const {
  Expr e;
  e.kind = ExprKind::string;
  e.pos = pos(t);
  const std::string_view s = text(e.pos);
  e.text = std::string(s.substr(1, s.size() - 2));
  return e;
}

/// `P100`: the digits are the index.
Expr TreeReader::parameter(antlr4::Token* t) {
  Expr e;
  e.kind = ExprKind::variable;
  e.text = "P";
  e.pos = pos(t);
  Expr n;
  n.kind = ExprKind::number;
  const std::string_view all = text(e.pos);
  const std::size_t digits = all.find_first_not_of("Pp \t");
  n.text = std::string(all.substr(digits));
  n.pos = {e.pos.column + static_cast<std::uint32_t>(digits), static_cast<std::uint32_t>(all.size() - digits)};
  n.number = parse_decimal(n.text).value_or(0);
  e.args.push_back(std::move(n));
  return e;
}

Expr TreeReader::letter(Parser::LetterContext* c) const {
  Expr e;
  e.kind = ExprKind::variable;
  e.pos = pos(c);
  e.text = folded(e.pos);
  return e;
}

/// Letters that are no mnemonic of ours, joined without blanks.
Expr TreeReader::unknown(Parser::UnknownContext* c) {
  Expr e;
  e.kind = ExprKind::variable;
  e.pos = pos(c);
  for (auto* l : c->letter()) e.text += folded(pos(l));
  if (auto* i = c->indexValue()) e.args.push_back(index(i));
  return e;
}

Expr TreeReader::index(Parser::IndexValueContext* c) {
  if (c->NUMBER()) return number(c->NUMBER()->getSymbol());
  if (c->PARAM()) return parameter(c->PARAM()->getSymbol());
  if (c->letter()) return letter(c->letter());
  return expr(c->expr());
}

Expr TreeReader::variable(Parser::VariableContext* c) {
  Expr e;
  e.kind = ExprKind::variable;
  e.pos = pos(c);
  e.text = folded(pos(c->getStart()));
  if (auto* i = c->indexValue()) e.args.push_back(index(i));
  if (c->GPOS())
    e.args.push_back(std::move(parameter(c->PARAM()->getSymbol()).args.front()));  // a program, no parameter
  for (auto* x : c->expr()) e.args.push_back(expr(x));
  return e;
}

Expr TreeReader::unary(antlr4::Token* op, Expr operand, WordPos p) const {
  Expr e;
  e.kind = op->getType() == Parser::FUNCTION ? ExprKind::call : ExprKind::unary;
  e.text = folded(pos(op));
  e.pos = p;
  e.args.push_back(std::move(operand));
  return e;
}

/// A plus sign says nothing; a minus makes a negative number or a negation.
Expr TreeReader::signed_value(antlr4::Token* sign, Expr value, WordPos p) const {
  if (!sign) return value;
  if (value.kind == ExprKind::number) {
    if (sign->getType() == Parser::MINUS) {
      value.number = -value.number;
      value.text.insert(0, "-");
    }
    value.pos = p;
    return value;
  }
  return sign->getType() == Parser::MINUS ? unary(sign, std::move(value), p) : value;
}

Expr TreeReader::expr(Parser::ExprContext* c) {
  if (auto* x = dynamic_cast<Parser::PrefixExprContext*>(c)) return unary(x->op, expr(x->expr()), pos(x));
  if (auto* x = dynamic_cast<Parser::BinaryExprContext*>(c)) {
    Expr e;
    e.kind = ExprKind::binary;
    e.text = folded(pos(x->op));
    e.pos = pos(x);
    e.args.push_back(expr(x->expr(0)));
    e.args.push_back(expr(x->expr(1)));
    return e;
  }
  if (auto* x = dynamic_cast<Parser::ArgExprContext*>(c)) {
    Expr e;
    e.kind = ExprKind::call;
    e.text = "ARG";
    e.pos = pos(x);
    for (auto* a : x->expr()) e.args.push_back(expr(a));
    return e;
  }
  if (auto* x = dynamic_cast<Parser::GroupExprContext*>(c)) return expr(x->expr());
  if (auto* x = dynamic_cast<Parser::ConstantExprContext*>(c)) {
    if (x->NUMBER()) return number(x->NUMBER()->getSymbol());
    if (x->HEX()) return hex(x->HEX()->getSymbol());
    Expr e;
    e.kind = ExprKind::call;
    e.text = "PI";
    e.pos = pos(x);
    return e;
  }
  if (auto* x = dynamic_cast<Parser::ParamExprContext*>(c)) return parameter(x->PARAM()->getSymbol());
  if (auto* x = dynamic_cast<Parser::IndirectExprContext*>(c)) {
    Expr e;
    e.kind = ExprKind::variable;
    e.text = "P";
    e.pos = pos(x);
    e.args.push_back(expr(x->expr()));
    return e;
  }
  if (auto* x = dynamic_cast<Parser::VariableExprContext*>(c)) return variable(x->variable());
  if (auto* x = dynamic_cast<Parser::UnknownExprContext*>(c)) return unknown(x->unknown());
  if (auto* x = dynamic_cast<Parser::LetterExprContext*>(c)) return letter(x->letter());
  return {};
}

// --- ISO ------------------------------------------------------------------------------------------------------------

void TreeReader::skip_marks(Parser::BlockContext* c, syntax::Block& out) {
  for (auto* s : c->skipMark()) {
    std::uint16_t level = 0;
    if (s->NUMBER()) {
      const std::string_view digits = text(pos(s->NUMBER()->getSymbol()));
      if (digits.size() != 1 || digits[0] < '1' || digits[0] > '3') {
        fail(pos(s), "a skip mark is /, /1, /2 or /3");
        return;
      }
      level = static_cast<std::uint16_t>(digits[0] - '1');
    }
    out.skip_mask = static_cast<std::uint16_t>(out.skip_mask | (1U << level));
  }
  if (!c->skipMark().empty())
    out.skip_pos = between(c->skipMark().front()->getStart(), c->skipMark().back()->getStop());
}

void TreeReader::value(Parser::ValueContext* c, syntax::Word& w, syntax::Block& out) {
  w.has_value = true;
  antlr4::Token* digits = c->NUMBER()->getSymbol();
  if (!c->P()) {
    w.number_text = text(pos(c));
    w.number = decimal(digits);
    if (c->sign && c->sign->getType() == Parser::MINUS) w.number = -w.number;
    return;
  }
  Expr n = number(digits);
  if (n.text.find('.') != std::string::npos) fail(n.pos, "the number of a parameter has no decimals");
  Expr e;
  e.kind = ExprKind::variable;
  e.text = "P";
  e.pos = between(c->P()->getSymbol(), digits);
  e.args.push_back(std::move(n));
  w.is_expression = true;
  w.expr = static_cast<std::int32_t>(out.exprs.size());
  out.exprs.push_back(signed_value(c->sign, std::move(e), pos(c)));
}

void TreeReader::word(Parser::WordContext* c, syntax::Block& out) {
  syntax::Word w;
  w.pos = pos(c);
  if (auto* plain = dynamic_cast<Parser::PlainWordContext*>(c)) {
    w.address = text(pos(plain->address()));
    if (plain->value()) value(plain->value(), w, out);
  } else if (auto* assigned = dynamic_cast<Parser::AssignedWordContext*>(c)) {
    w.address = text(pos(assigned->address()));
    w.equals = true;
    if (assigned->ext) {
      const double n = decimal(assigned->ext);
      if (n > 9999 || n != std::floor(n)) fail(w.pos, "a parameter number is a whole number up to 9999");
      w.extension = static_cast<std::int32_t>(std::min(n, 9999.0));
    }
    value(assigned->value(), w, out);
  }
  out.words.push_back(w);
}

// --- statements -----------------------------------------------------------------------------------------------------

Statement TreeReader::make(std::string keyword, antlr4::ParserRuleContext* c) const {
  Statement s;
  s.keyword = std::move(keyword);
  s.pos = pos(c);
  return s;
}

Expr TreeReader::program(Parser::ProgramContext* c) {
  if (c->P() && c->PARAM()) return parameter(c->PARAM()->getSymbol());
  if (c->PARAM()) return std::move(parameter(c->PARAM()->getSymbol()).args.front());
  return expr(c->expr());
}

Expr TreeReader::target(Parser::TargetContext* c) {
  if (c->letter()) return letter(c->letter());
  if (c->PARAM()) return parameter(c->PARAM()->getSymbol());
  if (c->variable()) return variable(c->variable());
  if (c->unknown()) return unknown(c->unknown());
  Expr e;
  e.kind = ExprKind::variable;
  e.text = "P";
  e.pos = pos(c);
  e.args.push_back(expr(c->expr()));
  return e;
}

void TreeReader::assignment(Parser::AssignmentContext* c, std::vector<Expr>& out) {
  if (auto* s = dynamic_cast<Parser::ShortAssignmentContext*>(c)) {
    antlr4::Token* digits = s->NUMBER()->getSymbol();
    out.push_back(letter(s->letter()));
    out.push_back(signed_value(s->sign, number(digits), s->sign ? between(s->sign, digits) : pos(digits)));
    return;
  }
  auto* f = dynamic_cast<Parser::FullAssignmentContext*>(c);
  if (!f) return;
  out.push_back(target(f->target()));
  if (f->STRING()) {
    out.push_back(string(f->STRING()->getSymbol()));
  } else if (auto* in = f->inputForm()) {
    Expr e;
    e.kind = ExprKind::call;
    e.text = "INPUT";
    e.pos = pos(in);
    e.args.push_back(string(in->STRING()->getSymbol()));
    if (in->NUMBER()) {
      antlr4::Token* digits = in->NUMBER()->getSymbol();
      e.args.push_back(signed_value(in->sign, number(digits), in->sign ? between(in->sign, digits) : pos(digits)));
    }
    out.push_back(std::move(e));
  } else {
    out.push_back(expr(f->expr()));
  }
}

void TreeReader::argument(Parser::ArgumentContext* c, std::vector<Expr>& out) {
  if (c->assignment()) return assignment(c->assignment(), out);
  out.push_back(letter(c->letter()));
  if (c->PARAM()) {
    out.push_back(signed_value(c->sign, parameter(c->PARAM()->getSymbol()), pos(c)));
  } else {
    Expr none;
    none.pos = pos(c);
    out.push_back(std::move(none));
  }
}

Statement TreeReader::program_action(Parser::ProgramActionContext* c) {
  Statement s = make(folded(pos(c->PROGRAM()->getSymbol())), c);
  s.args.push_back(program(c->program()));
  for (std::size_t i = 2; i < c->children.size(); ++i) {  // after the keyword and the program: commas and items
    if (auto* l = dynamic_cast<Parser::LetterContext*>(c->children[i])) {
      s.args.push_back(letter(l));
      s.args.back().kind = ExprKind::name;
    } else if (auto* t = dynamic_cast<antlr4::tree::TerminalNode*>(c->children[i])) {
      antlr4::Token* token = t->getSymbol();
      if (token->getType() == Parser::STRING) s.args.push_back(string(token));
      if (token->getType() != Parser::DEVICE) continue;
      Expr e;
      e.kind = ExprKind::name;
      e.pos = pos(token);
      e.text = folded(e.pos);
      s.args.push_back(std::move(e));
    }
  }
  return s;
}

Statement TreeReader::action(Parser::ActionContext* c) {
  if (auto* a = dynamic_cast<Parser::AssignActionContext*>(c)) {
    Statement s = make("=", a);
    for (auto* each : a->assignment()) assignment(each, s.args);
    return s;
  }
  if (auto* a = dynamic_cast<Parser::ProgramActionContext*>(c)) return program_action(a);
  Statement s = make(folded(pos(c->getStart())), c);
  if (auto* a = dynamic_cast<Parser::GotoActionContext*>(c)) {
    s.args.push_back(expr(a->expr()));
  } else if (auto* r = dynamic_cast<Parser::RptActionContext*>(c)) {
    for (auto* x : r->expr()) s.args.push_back(expr(x));
    if (r->program()) s.args.push_back(program(r->program()));
  } else if (auto* call = dynamic_cast<Parser::CallActionContext*>(c)) {
    s.args.push_back(expr(call->expr()));
  } else if (auto* pcall = dynamic_cast<Parser::PcallActionContext*>(c)) {
    s.args.push_back(expr(pcall->expr()));
    for (auto* x : pcall->argument()) argument(x, s.args);
  } else if (auto* w = dynamic_cast<Parser::WriteActionContext*>(c)) {
    if (w->WRITTEN_TEXT()) s.text = std::string(text(pos(w->WRITTEN_TEXT()->getSymbol())));
  } else {
    std::vector<Parser::ItemContext*> items;
    if (auto* k = dynamic_cast<Parser::KeywordActionContext*>(c)) items = k->item();
    if (auto* u = dynamic_cast<Parser::UnknownActionContext*>(c)) {
      s.keyword.clear();
      for (auto* l : u->letter()) s.keyword += folded(pos(l));
      s.text = std::string(text(s.pos));
      items = u->item();
    }
    for (auto* i : items) s.args.push_back(i->STRING() ? string(i->STRING()->getSymbol()) : expr(i->expr()));
  }
  return s;
}

Statement TreeReader::statement(Parser::StatementContext* c) {
  if (auto* i = dynamic_cast<Parser::IfStatementContext*>(c)) {
    Statement s = make("IF", i);
    s.args.push_back(expr(i->expr()));
    for (auto* a : i->action()) s.children.push_back(action(a));
    return s;
  }
  if (auto* sub = dynamic_cast<Parser::SubStatementContext*>(c)) {
    Statement s = make(folded(pos(sub->SUB()->getSymbol())), sub);
    s.args.push_back(expr(sub->expr()));
    return s;
  }
  auto* a = dynamic_cast<Parser::ActionStatementContext*>(c);
  return a ? action(a->action()) : Statement{};
}

bool TreeReader::block(Parser::BlockContext* c, syntax::Block& out) {
  skip_marks(c, out);
  if (auto* l = c->label()) {
    out.number_pos = pos(l);
    out.number = text(pos(l->NUMBER()->getSymbol()));
    if (out.number.find('.') != std::string_view::npos) fail(out.number_pos, "a block number has no decimals");
  }
  for (auto* w : c->word()) word(w, out);
  if (auto* s = c->statementBlock()) {
    out.statements.push_back(statement(s->statement()));
    if (auto* r = s->repeat()) {
      syntax::Word w;
      w.pos = pos(r);
      w.address = text(pos(r->N()->getSymbol()));
      if (r->value()) value(r->value(), w, out);
      out.words.push_back(w);
    }
  }
  if (auto* t = c->COMMENT()) {
    const WordPos p = pos(t->getSymbol());
    out.comments.push_back({text(p).substr(1), p});
  }
  out.plain = out.statements.empty() && out.exprs.empty();
  return ok_;
}

}  // namespace

bool read_tree(antlr4::tree::ParseTree* tree, std::string_view line, syntax::Block& out, ParseError& error) {
  auto* block = dynamic_cast<Parser::BlockContext*>(tree);
  return block && TreeReader(line, error).block(block, out);
}

}  // namespace cnctrans::fagor
