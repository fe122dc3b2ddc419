#include "frontends/heidenhain/syntax/tree.h"

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "dialects/heidenhain/sentences.h"

namespace cnctrans::frontends::heidenhain {

namespace {

using cnc_heidenhain::HeidenhainLexer;
using cnc_heidenhain::HeidenhainParser;
using syntax::Expr;
using syntax::ExprKind;
using syntax::Statement;
using syntax::Word;
namespace facts = dialects::heidenhain;

class LineBuilder {
 public:
  LineBuilder(std::string_view line, syntax::Block& out, ParseError& error) : line_(line), out_(out), error_(error) {}

  bool block(HeidenhainParser::BlockContext& tree);

 private:
  [[nodiscard]] WordPos pos(antlr4::Token* first, antlr4::Token* last) const {
    const auto begin = static_cast<std::uint32_t>(first->getStartIndex());
    const auto end = static_cast<std::uint32_t>(last->getStopIndex() + 1);
    return {begin + 1, end > begin ? end - begin : 0};
  }
  [[nodiscard]] WordPos pos(antlr4::ParserRuleContext& tree) const { return pos(tree.getStart(), tree.getStop()); }
  [[nodiscard]] std::string_view slice(WordPos p) const { return line_.substr(p.column - 1, p.length); }
  [[nodiscard]] std::string_view slice(antlr4::Token* t) const { return slice(pos(t, t)); }
  [[nodiscard]] std::string_view slice(antlr4::ParserRuleContext& tree) const { return slice(pos(tree)); }

  bool fail(WordPos where, std::string message) {
    error_ = {where, std::move(message)};
    return false;
  }

  [[nodiscard]] Expr number(antlr4::Token* token) const;
  [[nodiscard]] Expr variable(antlr4::Token* token) const;
  [[nodiscard]] Expr text(antlr4::Token* token) const;
  [[nodiscard]] Expr operand(HeidenhainParser::OperandContext& tree) const;
  [[nodiscard]] Expr primary(HeidenhainParser::PrimaryContext& tree) const;
  [[nodiscard]] Expr expression(HeidenhainParser::ExpressionContext& tree) const;
  static Expr negated(bool minus, Expr value, WordPos where);
  static Expr binary(std::string op, Expr a, Expr b);

  void value_into(Word& w, const std::vector<HeidenhainParser::SignContext*>& signs, antlr4::Token* number,
                  antlr4::Token* variable);
  void item(HeidenhainParser::ItemContext& tree);
  bool items(const std::vector<HeidenhainParser::ItemContext*>& list);
  void sentence(std::size_t words, const facts::SentenceRow& row);
  bool function(HeidenhainParser::FnContext& tree);
  void assign(Expr target, Expr value, WordPos where);

  std::string_view line_;
  syntax::Block& out_;
  ParseError& error_;
  std::vector<Expr> texts_;  ///< in quotes
};

Expr LineBuilder::number(antlr4::Token* token) const {
  Expr e;
  e.kind = ExprKind::number;
  e.text = slice(token);
  e.number = number_of(e.text);
  std::replace(e.text.begin(), e.text.end(), ',', '.');
  e.pos = pos(token, token);
  return e;
}

Expr LineBuilder::variable(antlr4::Token* token) const {
  const std::string_view whole = slice(token);
  const std::size_t digits = whole.find_first_of("0123456789");
  Expr e;
  e.kind = ExprKind::variable;
  e.text = to_upper_ascii(whole.substr(0, digits));
  e.pos = pos(token, token);
  Expr n;
  n.kind = ExprKind::number;
  n.text = whole.substr(digits);
  n.number = number_of(n.text);
  n.pos = {e.pos.column + static_cast<std::uint32_t>(digits), static_cast<std::uint32_t>(n.text.size())};
  e.args.push_back(std::move(n));
  return e;
}

/// Without its quotes, of which a typographic one is up to three bytes long.
Expr LineBuilder::text(antlr4::Token* token) const {
  std::string_view whole = slice(token);
  const auto quote = [](std::string_view at) -> std::size_t { return at.substr(0, 2) == "\xE2\x80" ? 3 : 1; };
  whole.remove_prefix(quote(whole));
  const bool wide = whole.size() >= 3 && whole.substr(whole.size() - 3, 2) == "\xE2\x80";
  whole.remove_suffix(wide ? 3 : 1);
  Expr e;
  e.kind = ExprKind::string;
  e.text = whole;
  e.pos = pos(token, token);
  return e;
}

Expr LineBuilder::negated(bool minus, Expr value, WordPos where) {
  if (!minus) {
    value.pos = where;
    return value;
  }
  Expr u;
  u.kind = ExprKind::unary;
  u.text = "-";
  u.pos = where;
  u.args.push_back(std::move(value));
  return u;
}

Expr LineBuilder::binary(std::string op, Expr a, Expr b) {
  Expr e;
  e.kind = ExprKind::binary;
  e.text = std::move(op);
  e.pos = {a.pos.column, b.pos.column + b.pos.length - a.pos.column};
  e.args.push_back(std::move(a));
  e.args.push_back(std::move(b));
  return e;
}

Expr LineBuilder::operand(HeidenhainParser::OperandContext& tree) const {
  Expr e = tree.NUMBER() != nullptr ? number(tree.NUMBER()->getSymbol()) : variable(tree.VARIABLE()->getSymbol());
  if (tree.sign() == nullptr) return e;
  return negated(tree.sign()->MINUS() != nullptr, std::move(e), pos(tree));
}

Expr LineBuilder::primary(HeidenhainParser::PrimaryContext& tree) const {
  if (auto* n = dynamic_cast<HeidenhainParser::NumberContext*>(&tree)) return number(n->NUMBER()->getSymbol());
  if (auto* v = dynamic_cast<HeidenhainParser::VariableContext*>(&tree)) return variable(v->VARIABLE()->getSymbol());
  if (auto* t = dynamic_cast<HeidenhainParser::TextContext*>(&tree)) return text(t->STRING()->getSymbol());
  Expr e;
  e.pos = pos(tree);
  if (auto* f = dynamic_cast<HeidenhainParser::PrefixedContext*>(&tree)) {
    e.kind = ExprKind::call;
    e.text = to_upper_ascii(slice(f->WORD()->getSymbol()));
    Expr inner = primary(*f->primary());
    if (inner.kind == ExprKind::call && inner.text.empty()) {
      e.args = std::move(inner.args);  // SUBSTR ( SRC_QS10 BEG2 LEN4 )
    } else if (f->sign() != nullptr) {
      e.args.push_back(
          negated(f->sign()->MINUS() != nullptr, std::move(inner), pos(f->sign()->getStart(), tree.getStop())));
    } else {
      e.args.push_back(std::move(inner));
    }
    return e;
  }
  if (auto* p = dynamic_cast<HeidenhainParser::ParenthesisedContext*>(&tree)) {
    const auto inner = p->expression();
    if (inner.size() == 1) {
      Expr only = expression(*inner[0]);
      only.pos = e.pos;
      return only;
    }
    e.kind = ExprKind::call;  // without a name: what a function of texts is given
    for (auto* i : inner) e.args.push_back(expression(*i));
    return e;
  }
  e.kind = ExprKind::name;
  e.text = "PI";
  return e;
}

Expr LineBuilder::expression(HeidenhainParser::ExpressionContext& tree) const {
  if (auto* o = dynamic_cast<HeidenhainParser::OperandOnlyContext*>(&tree)) return primary(*o->primary());
  if (auto* s = dynamic_cast<HeidenhainParser::SignedContext*>(&tree))
    return negated(s->sign()->MINUS() != nullptr, expression(*s->expression()), pos(tree));
  auto& i = dynamic_cast<HeidenhainParser::InfixContext&>(tree);
  Expr e = binary(i.op->getText(), expression(*i.expression(0)), expression(*i.expression(1)));
  e.pos = pos(tree);
  return e;
}

void LineBuilder::value_into(Word& w, const std::vector<HeidenhainParser::SignContext*>& signs,
                             antlr4::Token* number_token, antlr4::Token* variable_token) {
  const bool minus = std::count_if(signs.begin(), signs.end(), [](auto* s) { return s->MINUS() != nullptr; }) % 2 != 0;
  w.has_value = true;
  antlr4::Token* last = number_token != nullptr ? number_token : variable_token;
  const WordPos where = signs.empty() ? pos(last, last) : pos(signs.front()->getStart(), last);
  if (variable_token != nullptr) {
    w.is_expression = true;
    w.expr = static_cast<std::int32_t>(out_.exprs.size());
    out_.exprs.push_back(negated(minus, variable(variable_token), where));
    return;
  }
  const double n = number_of(slice(number_token));
  w.number = minus ? -n : n;
  const std::string_view written = slice(where);
  const bool plain = signs.size() < 2 && written.find_first_of(", \t") == std::string_view::npos;
  if (plain) w.number_text = written;
}

void LineBuilder::item(HeidenhainParser::ItemContext& tree) {
  Word w;
  w.pos = pos(tree);
  if (auto* v = dynamic_cast<HeidenhainParser::ValueWordContext*>(&tree)) {
    w.address = slice(v->WORD()->getSymbol());
    value_into(w, v->sign(), v->NUMBER() != nullptr ? v->NUMBER()->getSymbol() : nullptr,
               v->VARIABLE() != nullptr ? v->VARIABLE()->getSymbol() : nullptr);
  } else if (auto* s = dynamic_cast<HeidenhainParser::SignWordContext*>(&tree)) {
    w.address = slice(s->WORD()->getSymbol());
    w.number_text = slice(*s->sign());
  } else if (auto* b = dynamic_cast<HeidenhainParser::BareValueContext*>(&tree)) {
    value_into(w, b->sign(), b->NUMBER() != nullptr ? b->NUMBER()->getSymbol() : nullptr,
               b->VARIABLE() != nullptr ? b->VARIABLE()->getSymbol() : nullptr);
  } else if (auto* q = dynamic_cast<HeidenhainParser::QuotedContext*>(&tree)) {
    texts_.push_back(text(q->STRING()->getSymbol()));
    return;
  } else {
    w.address = slice(tree);
  }
  out_.words.push_back(w);
}

/// The first words of the line are the beginning of a sentence.
void LineBuilder::sentence(std::size_t words, const facts::SentenceRow& row) {
  Statement s;
  s.keyword = row.words.substr(0, 5) == "CYCLE" ? "CYCL DEF" : std::string(row.words);
  s.args = std::move(texts_);
  Word& last = out_.words[words - 1];
  const auto end = last.pos.column - 1 + static_cast<std::uint32_t>(last.address.size());
  const std::uint32_t begin = out_.words.front().pos.column;
  s.pos = {begin, end + 1 - begin};
  std::string_view rest = line_.substr(end);
  if (!out_.comments.empty()) rest = line_.substr(end, out_.comments.front().pos.column - 1 - end);
  s.text = std::string(trim(rest));
  if (last.has_value || !last.number_text.empty()) {  // `CALL 5` of TOOL CALL 5: the value stands by itself
    const auto value = static_cast<std::uint32_t>(line_.find_first_not_of(" \t", end));
    last.pos = {value + 1, last.pos.column + last.pos.length - value - 1};
    last.address = {};
    out_.words.erase(out_.words.begin(), out_.words.begin() + static_cast<std::ptrdiff_t>(words) - 1);
  } else {
    out_.words.erase(out_.words.begin(), out_.words.begin() + static_cast<std::ptrdiff_t>(words));
  }
  out_.statements.push_back(std::move(s));
}

bool LineBuilder::items(const std::vector<HeidenhainParser::ItemContext*>& list) {
  if (slice(*list.front()) == "(") {
    Statement remark;
    remark.keyword = "OUTLINE";
    remark.pos = pos(list.front()->getStart(), list.back()->getStop());
    remark.text = slice(remark.pos);
    out_.statements.push_back(std::move(remark));
    return true;
  }
  for (auto* i : list) item(*i);
  for (const auto& row : facts::sentences) {
    std::string_view rest = row.words;
    std::size_t n = 0;
    bool same = true;
    while (same && !rest.empty()) {
      const auto blank = std::min(rest.find(' '), rest.size());
      same = n < out_.words.size() && iequals_ascii(out_.words[n].address, rest.substr(0, blank)) &&
             (blank == rest.size() || (!out_.words[n].has_value && out_.words[n].number_text.empty()));
      ++n;
      rest.remove_prefix(std::min(blank + 1, rest.size()));
    }
    if (!same) continue;
    sentence(n, row);
    return true;
  }
  if (!texts_.empty()) return fail(texts_.front().pos, "a text in quotes has no sentence before it");
  out_.plain = std::none_of(out_.words.begin(), out_.words.end(), [](const Word& w) { return w.is_expression; });
  return true;
}

void LineBuilder::assign(Expr target, Expr value, WordPos where) {
  Statement s;
  s.keyword = "ASSIGN";
  s.args.push_back(std::move(target));
  s.args.push_back(std::move(value));
  s.pos = where;
  out_.statements.push_back(std::move(s));
}

bool LineBuilder::function(HeidenhainParser::FnContext& tree) {
  Statement s;
  s.keyword = "FN";
  s.text = slice(tree.NUMBER()->getSymbol());
  s.pos = pos(tree);
  auto* f = tree.function();
  if (auto* a = dynamic_cast<HeidenhainParser::FnAssignContext*>(f)) {
    s.args = {variable(a->VARIABLE()->getSymbol()), operand(*a->operand())};
  } else if (auto* b = dynamic_cast<HeidenhainParser::FnBinaryContext*>(f)) {
    s.args = {variable(b->VARIABLE()->getSymbol()),
              binary(to_upper_ascii(slice(b->op)), operand(*b->operand(0)), operand(*b->operand(1)))};
  } else if (auto* p = dynamic_cast<HeidenhainParser::FnPrefixContext*>(f)) {
    Expr call;
    call.kind = ExprKind::call;
    call.text = to_upper_ascii(slice(p->WORD()->getSymbol()));
    call.pos = pos(p->WORD()->getSymbol(), p->getStop());
    call.args.push_back(operand(*p->operand()));
    s.args = {variable(p->VARIABLE()->getSymbol()), std::move(call)};
  } else if (auto* j = dynamic_cast<HeidenhainParser::FnJumpContext*>(f)) {
    s.args = {binary(to_upper_ascii(slice(j->WORD()->getSymbol())), operand(*j->operand(0)), operand(*j->operand(1)))};
    for (auto* i : j->item()) item(*i);  // LBL and its name
    for (auto& t : texts_) s.args.push_back(std::move(t));
  } else {
    Statement rest;
    rest.text = slice(*f);
    rest.pos = pos(*f);
    s.children.push_back(std::move(rest));
  }
  out_.statements.push_back(std::move(s));
  return true;
}

bool LineBuilder::block(HeidenhainParser::BlockContext& tree) {
  if (const auto slashes = tree.SLASH(); !slashes.empty()) {  // before the number or behind it
    out_.skip_mask = 1;
    out_.skip_pos = pos(slashes.front()->getSymbol(), slashes.front()->getSymbol());
  }
  if (auto* n = tree.blockNumber()) {
    out_.number_pos = pos(*n);
    out_.number = slice(out_.number_pos);
    if (out_.number.find_first_of(".,") != std::string_view::npos)
      return fail(out_.number_pos, "a block number has no decimal point");
  }
  bool goes_on = tree.TILDE() != nullptr;
  if (auto* c = tree.COMMENT()) {
    const WordPos where = pos(c->getSymbol(), c->getSymbol());
    std::string_view text = slice(where).substr(1);
    goes_on = take_tilde(text) || goes_on;
    out_.comments.push_back({text, where});
  }
  auto* content = tree.content();
  if (content == nullptr) {
    out_.plain = true;
  } else if (auto* s = dynamic_cast<HeidenhainParser::SentenceContext*>(content)) {
    if (!items(s->item())) return false;
  } else if (auto* a = dynamic_cast<HeidenhainParser::AssignmentContext*>(content)) {
    assign(variable(a->VARIABLE()->getSymbol()), expression(*a->expression()), pos(*a));
  } else if (auto* d = dynamic_cast<HeidenhainParser::DeclarationContext*>(content)) {
    const bool declares = iequals_ascii(slice(d->WORD(0)->getSymbol()), "DECLARE") &&
                          iequals_ascii(slice(d->WORD(1)->getSymbol()), "STRING");
    if (!declares) return fail(pos(*d), "`" + std::string(slice(*d)) + "` is no sentence");
    assign(variable(d->VARIABLE()->getSymbol()), expression(*d->expression()), pos(*d));
  } else if (auto* n = dynamic_cast<HeidenhainParser::NamedContext*>(content)) {
    Expr name;
    name.kind = ExprKind::name;
    name.text = to_upper_ascii(slice(n->WORD()->getSymbol()));
    name.pos = pos(n->WORD()->getSymbol(), n->getStop());
    assign(variable(n->VARIABLE(0)->getSymbol()), std::move(name), pos(*n));
  } else if (auto* f = dynamic_cast<HeidenhainParser::FnContext*>(content)) {
    if (!function(*f)) return false;
  } else {
    Statement outline;
    outline.keyword = "OUTLINE";
    outline.text = slice(*content);
    outline.pos = pos(*content);
    out_.statements.push_back(std::move(outline));
  }
  if (goes_on) {
    Statement tilde;
    tilde.keyword = "~";
    tilde.pos = {static_cast<std::uint32_t>(line_.size()), 1};
    out_.statements.push_back(std::move(tilde));
    out_.plain = false;
  }
  return true;
}

}  // namespace

bool build_block(HeidenhainParser::BlockContext& tree, std::string_view line, syntax::Block& out, ParseError& error) {
  return LineBuilder(line, out, error).block(tree);
}

}  // namespace cnctrans::frontends::heidenhain
