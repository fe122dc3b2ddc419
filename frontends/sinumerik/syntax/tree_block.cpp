// Blocks and statements: parse tree -> syntax::Block. Layouts of the statements: README.md.
#include <charconv>

#include "base/text.h"
#include "frontends/sinumerik/syntax/tree.h"

namespace cnctrans::sinumerik {

using syntax::Block;
using syntax::Expr;
using syntax::ExprKind;
using syntax::Statement;
using syntax::Word;

namespace {

class BlockBuilder {
 public:
  BlockBuilder(std::string_view line, Block& out, ParseError& error) : line_(line), out_(out), e_(line, error) {}

  bool block(Grammar::BlockContext& tree);

 private:
  void content(Grammar::ContentContext* tree);
  bool flow(Grammar::ContentContext* tree);
  bool definitions(Grammar::ContentContext* tree);
  bool calls(Grammar::ContentContext* tree);
  void item(Grammar::ItemContext* tree);
  void word_number(Grammar::WordNumberContext* tree);
  void word_value(Grammar::WordValueContext* tree);
  void set_value(Word& word, Grammar::ExprContext* tree);
  void assign(antlr4::ParserRuleContext* tree, Expr target, Grammar::ExprContext* value);
  void call(antlr4::ParserRuleContext* tree, std::string name, Grammar::ArgumentsContext* args);

  Statement make(antlr4::ParserRuleContext* tree, std::string keyword);
  Statement jump(Grammar::JumpContext* tree);
  Statement parameter(Grammar::ParameterContext* tree);
  Statement parameter_type(Grammar::ParameterTypeContext* tree);
  void definition(Grammar::DefinitionContext* tree);
  void macro(Grammar::MacroDefinitionContext* tree);
  void repeat(Grammar::RepeatRangeContext* tree);
  void case_jump(Grammar::CaseJumpContext* tree);
  void call_text(Grammar::CallTextContext* tree);
  Expr count(Grammar::RepeatCountContext* tree);
  Expr type(antlr4::tree::TerminalNode* token, Grammar::StringLengthContext* length);
  Expr dimensions(Grammar::DimensionsContext* tree);

  std::string_view line_;
  Block& out_;
  ExprBuilder e_;
};

Statement BlockBuilder::make(antlr4::ParserRuleContext* tree, std::string keyword) {
  Statement s;
  s.keyword = std::move(keyword);
  s.pos = e_.pos(tree);
  return s;
}

bool BlockBuilder::block(Grammar::BlockContext& tree) {
  if (auto* skip = tree.skip(); skip != nullptr) {
    int level = 0;
    if (skip->INTEGER() != nullptr) {
      const std::string_view digits = e_.text(*skip->INTEGER()->getSymbol());
      level = digits.size() == 1 ? digits[0] - '0' : 10;
      if (level > 9) e_.fail(skip, "skip levels go from /0 to /9");
    }
    if (level <= 9) out_.skip_mask = static_cast<std::uint16_t>(1U << static_cast<unsigned>(level));
    out_.skip_pos = e_.pos(skip);
  }
  if (auto* number = tree.blockNumber(); number != nullptr) {
    out_.number = e_.text(*number->INTEGER()->getSymbol());
    out_.number_mark = number->COLON() != nullptr ? ':' : 'N';
    out_.number_pos = e_.pos(number);
  }
  for (auto* label : tree.label()) {
    antlr4::ParserRuleContext* last = label->letter();
    if (label->name() != nullptr) last = label->name();
    const auto first = label->getStart()->getStartIndex();
    const auto stop =
        label->INTEGER() != nullptr ? label->INTEGER()->getSymbol()->getStopIndex() : last->getStop()->getStopIndex();
    out_.labels.push_back(line_.substr(first, stop + 1 - first));
  }
  if (auto* header = tree.header(); header != nullptr) {
    Statement s = make(header, "%");
    s.text = trim(e_.text(header)).substr(1);
    out_.statements.push_back(std::move(s));
  }
  if (tree.content() != nullptr) content(tree.content());
  if (auto* comment = tree.COMMENT(); comment != nullptr) {
    const antlr4::Token& t = *comment->getSymbol();
    out_.comments.push_back(syntax::Comment{e_.text(t).substr(1), ExprBuilder::pos(t, t)});
  }
  out_.plain = out_.labels.empty() && out_.statements.empty();
  for (const Word& w : out_.words) out_.plain = out_.plain && w.has_value && !w.equals && !w.is_expression;
  return !e_.failed();
}

void BlockBuilder::content(Grammar::ContentContext* tree) {
  if (auto* t = dynamic_cast<Grammar::ItemsContext*>(tree)) {
    for (auto* i : t->item()) item(i);
    return;
  }
  if (!flow(tree) && !definitions(tree)) calls(tree);
}

// --- words and assignments --------------------------------------------------------------------------------------

void BlockBuilder::word_number(Grammar::WordNumberContext* tree) {
  Word w;
  w.address = e_.text(tree->letter());
  w.has_value = true;
  w.pos = e_.pos(tree);
  const antlr4::Token& digits = *tree->number()->getStart();
  const bool touching = tree->sign == nullptr || tree->sign->getStopIndex() + 1 == digits.getStartIndex();
  const std::string_view text = e_.text(digits);
  const double v = number_value(text);
  const bool minus = tree->sign != nullptr && tree->sign->getType() == Grammar::MINUS;
  if (touching && text.find_first_of("Xx") == std::string_view::npos) {
    const std::size_t first = tree->sign != nullptr ? tree->sign->getStartIndex() : digits.getStartIndex();
    w.number_text = line_.substr(first, digits.getStopIndex() + 1 - first);
    w.number = minus ? -v : v;
  } else {  // an exponent, or blanks after the sign: the text is no number of its own
    Expr number;
    number.kind = ExprKind::number;
    number.text = text;
    number.number = v;
    number.pos = ExprBuilder::pos(digits, digits);
    if (minus) {
      Expr negative;
      negative.kind = ExprKind::unary;
      negative.text = "-";
      negative.pos = ExprBuilder::pos(*tree->sign, digits);
      negative.args.push_back(std::move(number));
      number = std::move(negative);
    }
    w.is_expression = true;
    w.expr = static_cast<std::int32_t>(out_.exprs.size());
    out_.exprs.push_back(std::move(number));
  }
  out_.words.push_back(w);
}

void BlockBuilder::set_value(Word& word, Grammar::ExprContext* tree) {
  word.equals = true;
  word.has_value = true;
  PlainNumber number;
  if (plain_number(tree, line_, number)) {
    word.number = number.value;
    word.number_text = number.text;
    return;
  }
  word.is_expression = true;
  word.expr = static_cast<std::int32_t>(out_.exprs.size());
  out_.exprs.push_back(e_.value(tree));
}

void BlockBuilder::word_value(Grammar::WordValueContext* tree) {
  Word w;
  w.address = e_.text(tree->letter());
  w.pos = e_.pos(tree);
  if (tree->INTEGER() != nullptr) {
    const std::string_view digits = e_.text(*tree->INTEGER()->getSymbol());
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), w.extension);
    if (read.ec != std::errc{}) e_.fail(tree, "the number behind the address is too large");
  }
  set_value(w, tree->expr());
  out_.words.push_back(w);
}

void BlockBuilder::assign(antlr4::ParserRuleContext* tree, Expr target, Grammar::ExprContext* value) {
  Statement s = make(tree, "=");
  s.args.push_back(std::move(target));
  s.args.push_back(e_.value(value));
  out_.statements.push_back(std::move(s));
}

void BlockBuilder::call(antlr4::ParserRuleContext* tree, std::string name, Grammar::ArgumentsContext* args) {
  Statement s = make(tree, "()");
  s.text = std::move(name);
  e_.arguments(args->argumentList(), s.args);
  out_.statements.push_back(std::move(s));
}

void BlockBuilder::item(Grammar::ItemContext* tree) {
  if (auto* t = dynamic_cast<Grammar::WordNumberContext*>(tree)) return word_number(t);
  if (auto* t = dynamic_cast<Grammar::WordValueContext*>(tree)) return word_value(t);
  if (auto* t = dynamic_cast<Grammar::CallItemContext*>(tree)) {
    return call(t, to_upper_ascii(e_.text(t->name())), t->arguments());
  }
  if (auto* t = dynamic_cast<Grammar::IndexedItemContext*>(tree)) {
    Statement s = make(t, "()");
    s.text = to_upper_ascii(e_.text(t->name()));
    e_.arguments(t->argumentList(), s.args);
    out_.statements.push_back(std::move(s));
    return;
  }
  if (auto* t = dynamic_cast<Grammar::NumberedCallContext*>(tree)) {
    std::string name = to_upper_ascii(e_.text(t->letter()));
    name += e_.text(*t->INTEGER()->getSymbol());
    return call(t, std::move(name), t->arguments());
  }
  if (auto* t = dynamic_cast<Grammar::IndexedValueContext*>(tree))
    return assign(t, e_.indexed(t->indexed()), t->expr());
  if (auto* t = dynamic_cast<Grammar::SystemValueContext*>(tree)) return assign(t, e_.system(t->SYSVAR()), t->expr());
  Word w;
  w.pos = e_.pos(tree);
  w.address = e_.text(tree);
  if (auto* t = dynamic_cast<Grammar::NameValueContext*>(tree)) {
    w.address = e_.text(t->name());
    set_value(w, t->expr());
  }
  out_.words.push_back(w);
}

// --- jumps and structures ---------------------------------------------------------------------------------------

Statement BlockBuilder::jump(Grammar::JumpContext* tree) {
  Statement s = make(tree, to_upper_ascii(e_.text(*tree->GOTO()->getSymbol())));
  auto* target = tree->gotoTarget();
  s.args.push_back(target->expr() != nullptr ? e_.expr(target->expr()) : e_.name(target));
  return s;
}

Expr BlockBuilder::count(Grammar::RepeatCountContext* tree) {
  if (tree == nullptr) return Expr{};
  if (!iequals_ascii(e_.text(tree->letter()), "P")) e_.fail(tree, "only `P=` (how often) may follow here");
  return e_.expr(tree->expr());
}

void BlockBuilder::repeat(Grammar::RepeatRangeContext* tree) {
  Statement s = make(tree, "REPEAT");
  const auto targets = tree->target();
  if (!targets.empty() || tree->repeatCount() != nullptr) {
    s.args.push_back(targets.empty() ? Expr{} : e_.name(targets[0]));
    s.args.push_back(targets.size() > 1 ? e_.name(targets[1]) : Expr{});
    s.args.push_back(count(tree->repeatCount()));
  }
  out_.statements.push_back(std::move(s));
}

void BlockBuilder::case_jump(Grammar::CaseJumpContext* tree) {
  Statement s = make(tree, "CASE");
  s.args.push_back(e_.expr(tree->expr()));
  for (auto* arm : tree->caseArm()) {
    Statement child = make(arm, "OF");
    child.args.push_back(e_.expr(arm->expr()));
    child.children.push_back(jump(arm->jump()));
    s.children.push_back(std::move(child));
  }
  if (tree->jump() != nullptr) {
    Statement child = make(tree->jump(), "DEFAULT");
    child.children.push_back(jump(tree->jump()));
    s.children.push_back(std::move(child));
  }
  out_.statements.push_back(std::move(s));
}

bool BlockBuilder::flow(Grammar::ContentContext* tree) {
  if (auto* t = dynamic_cast<Grammar::IfBlockContext*>(tree)) {
    const auto parts = t->ifPart();
    for (auto* part : parts) {
      Statement s = make(part, "IF");
      s.args.push_back(e_.condition(part->condition()));
      if (part->jump() != nullptr) s.children.push_back(jump(part->jump()));
      if (part->jump() == nullptr && parts.size() > 1)
        e_.fail(part, "a second IF on a line needs a jump (GOTOF, GOTOB ...) before it");
      out_.statements.push_back(std::move(s));
    }
    return true;
  }
  if (auto* t = dynamic_cast<Grammar::StructureWordContext*>(tree)) {
    out_.statements.push_back(make(t, to_upper_ascii(e_.text(t))));
    return true;
  }
  if (auto* t = dynamic_cast<Grammar::ForOpenContext*>(tree)) {
    Statement s = make(t, "FOR");
    s.args.push_back(e_.lvalue(t->lvalue()));
    s.args.push_back(e_.expr(t->expr(0)));
    s.args.push_back(e_.expr(t->expr(1)));
    out_.statements.push_back(std::move(s));
    return true;
  }
  Grammar::ConditionContext* condition = nullptr;
  if (auto* t = dynamic_cast<Grammar::WhileOpenContext*>(tree)) condition = t->condition();
  if (auto* t = dynamic_cast<Grammar::UntilCloseContext*>(tree)) condition = t->condition();
  if (condition != nullptr) {
    Statement s = make(tree, to_upper_ascii(e_.text(*tree->getStart())));
    s.args.push_back(e_.condition(condition));
    out_.statements.push_back(std::move(s));
    return true;
  }
  if (auto* t = dynamic_cast<Grammar::RepeatRangeContext*>(tree)) return repeat(t), true;
  if (auto* t = dynamic_cast<Grammar::RepeatBlockContext*>(tree)) {
    Statement s = make(t, "REPEATB");
    s.args.push_back(e_.name(t->target()));
    s.args.emplace_back();
    s.args.push_back(count(t->repeatCount()));
    out_.statements.push_back(std::move(s));
    return true;
  }
  if (auto* t = dynamic_cast<Grammar::JumpOnlyContext*>(tree)) {
    out_.statements.push_back(jump(t->jump()));
    return true;
  }
  if (auto* t = dynamic_cast<Grammar::CaseJumpContext*>(tree)) return case_jump(t), true;
  return false;
}

// --- definitions ------------------------------------------------------------------------------------------------

Expr BlockBuilder::type(antlr4::tree::TerminalNode* token, Grammar::StringLengthContext* length) {
  Expr out;
  out.kind = ExprKind::name;
  out.text = to_upper_ascii(e_.text(*token->getSymbol()));
  out.pos = ExprBuilder::pos(*token->getSymbol(), *token->getSymbol());
  if (length != nullptr) out.args.push_back(e_.expr(length->expr()));
  return out;
}

Expr BlockBuilder::dimensions(Grammar::DimensionsContext* tree) {
  Expr out;
  if (tree == nullptr) return out;
  out.kind = ExprKind::call;
  out.pos = e_.pos(tree);
  e_.arguments(tree->argumentList(), out.args);
  if (out.args.empty()) out.args.emplace_back();  // `[]`: one open dimension
  return out;
}

void BlockBuilder::definition(Grammar::DefinitionContext* tree) {
  Statement s = make(tree, "DEF");
  s.args.push_back(type(tree->TYPE(), tree->stringLength()));
  for (auto* part : tree->defPart()) {
    Statement child = make(part, "ATTR");
    child.text = to_upper_ascii(e_.text(*part->getStart()));
    if (part->number() != nullptr) {
      Expr value;
      value.kind = ExprKind::number;
      value.text = e_.text(part->number());
      value.number = number_value(value.text);
      if (part->MINUS() != nullptr) value.number = -value.number;
      value.pos = e_.pos(part->number());
      child.args.push_back(std::move(value));
    }
    s.children.push_back(std::move(child));
  }
  for (auto* variable : tree->defVariable()) {
    Statement child = make(variable, "VAR");
    child.text = e_.text(variable->anyName());
    child.args.push_back(dimensions(variable->dimensions()));
    child.args.push_back(variable->expr() != nullptr ? e_.value(variable->expr()) : Expr{});
    s.children.push_back(std::move(child));
  }
  out_.statements.push_back(std::move(s));
}

Statement BlockBuilder::parameter(Grammar::ParameterContext* tree) {
  Statement s = make(tree, "PARAM");
  s.text = e_.text(tree->anyName());
  s.args.push_back(type(tree->TYPE(), tree->stringLength()));
  Expr by_reference;
  if (tree->VAR() != nullptr) {
    by_reference.kind = ExprKind::name;
    by_reference.text = "VAR";
  }
  s.args.push_back(std::move(by_reference));
  s.args.push_back(dimensions(tree->dimensions()));
  s.args.push_back(tree->expr() != nullptr ? e_.expr(tree->expr()) : Expr{});
  return s;
}

Statement BlockBuilder::parameter_type(Grammar::ParameterTypeContext* tree) {
  Statement s = make(tree, "PARAM");
  if (tree->anyName() != nullptr) s.text = e_.text(tree->anyName());
  s.args.push_back(type(tree->TYPE(), tree->stringLength()));
  Expr by_reference;
  if (tree->VAR() != nullptr) {
    by_reference.kind = ExprKind::name;
    by_reference.text = "VAR";
  }
  s.args.push_back(std::move(by_reference));
  s.args.push_back(dimensions(tree->dimensions()));
  s.args.emplace_back();
  return s;
}

void BlockBuilder::macro(Grammar::MacroDefinitionContext* tree) {
  Statement s = make(tree, "DEFINE");
  s.args.push_back(e_.name(tree->anyName()));
  const std::size_t after = tree->AS()->getSymbol()->getStopIndex() + 1;
  const std::size_t end = s.pos.column - 1 + s.pos.length;
  if (end > after) s.text = trim(line_.substr(after, end - after));
  out_.statements.push_back(std::move(s));
}

bool BlockBuilder::definitions(Grammar::ContentContext* tree) {
  if (auto* t = dynamic_cast<Grammar::DefinitionContext*>(tree)) return definition(t), true;
  if (auto* t = dynamic_cast<Grammar::MacroDefinitionContext*>(tree)) return macro(t), true;
  if (auto* t = dynamic_cast<Grammar::RedefinitionContext*>(tree)) {
    Statement s = make(t, "REDEF");
    s.text = trim(e_.text(t).substr(5));
    out_.statements.push_back(std::move(s));
    return true;
  }
  if (auto* t = dynamic_cast<Grammar::AccessRightsContext*>(tree)) {
    Statement s = make(t, "RIGHTS");
    s.text = e_.text(t);
    out_.statements.push_back(std::move(s));
    return true;
  }
  if (auto* t = dynamic_cast<Grammar::ExternDeclarationContext*>(tree)) {
    Statement s = make(t, "EXTERN");
    s.text = e_.text(t->anyName());
    for (auto* p : t->parameterType()) s.children.push_back(parameter_type(p));
    out_.statements.push_back(std::move(s));
    return true;
  }
  if (auto* t = dynamic_cast<Grammar::ProcHeadContext*>(tree)) {
    Statement s = make(t, "PROC");
    s.text = e_.text(t->procName());
    for (auto* attribute : t->name()) s.args.push_back(e_.name(attribute));
    for (auto* p : t->parameter()) s.children.push_back(parameter(p));
    out_.statements.push_back(std::move(s));
    return true;
  }
  return false;
}

// --- calls ------------------------------------------------------------------------------------------------------

void BlockBuilder::call_text(Grammar::CallTextContext* tree) {
  Statement s = make(tree, "CALL");
  const auto exprs = tree->expr();
  std::size_t at = 0;
  const bool range = tree->BLOCK() != nullptr;
  const std::size_t named = exprs.size() - (range ? 2 : 0);
  s.args.push_back(named != 0 ? e_.expr(exprs[at++]) : Expr{});
  s.args.push_back(range ? e_.expr(exprs[at++]) : Expr{});
  s.args.push_back(range ? e_.expr(exprs[at]) : Expr{});
  s.args.push_back(count(tree->repeatCount()));
  if (named == 0 && !range) e_.fail(tree, "CALL needs the name of a program");
  out_.statements.push_back(std::move(s));
}

bool BlockBuilder::calls(Grammar::ContentContext* tree) {
  if (auto* t = dynamic_cast<Grammar::CallTextContext*>(tree)) return call_text(t), true;
  if (auto* t = dynamic_cast<Grammar::CallExternalContext*>(tree)) {
    Statement s = make(t, to_upper_ascii(e_.text(*t->TEXTCALL()->getSymbol())));
    s.args.push_back(e_.expr(t->expr()));
    out_.statements.push_back(std::move(s));
    return true;
  }
  if (auto* t = dynamic_cast<Grammar::CallPathContext*>(tree)) {
    Statement s = make(t, "PCALL");
    const auto parts = t->pathPart();
    const std::size_t first = t->PCALL()->getSymbol()->getStopIndex() + 1;
    const std::size_t end = parts.back()->getStop()->getStopIndex() + 1;
    s.text = trim(line_.substr(first, end - first));
    if (t->arguments() != nullptr) e_.arguments(t->arguments()->argumentList(), s.args);
    out_.statements.push_back(std::move(s));
    return true;
  }
  if (auto* t = dynamic_cast<Grammar::ModalCallContext*>(tree)) {
    Statement s = make(t, "MCALL");
    if (t->name() != nullptr) s.text = to_upper_ascii(e_.text(t->name()));
    if (t->letter() != nullptr) {
      s.text = to_upper_ascii(e_.text(t->letter()));
      s.text += e_.text(*t->INTEGER()->getSymbol());
    }
    if (t->arguments() != nullptr) e_.arguments(t->arguments()->argumentList(), s.args);
    out_.statements.push_back(std::move(s));
    return true;
  }
  if (auto* t = dynamic_cast<Grammar::SyncActionContext*>(tree)) {
    Statement s = make(t, "SYNC");
    s.text = e_.text(t);
    out_.statements.push_back(std::move(s));
    return true;
  }
  return false;
}

}  // namespace

bool build_block(Grammar::BlockContext& tree, std::string_view line, Block& out, ParseError& error) {
  out.clear();
  return BlockBuilder(line, out, error).block(tree);
}

}  // namespace cnctrans::sinumerik
