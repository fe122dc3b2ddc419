// From the parse tree of one block to the syntax model. Internal: includes the generated parser, so only .cpp files
// here use it.
#pragma once

#include <string_view>

#include "frontends/common/syntax.h"
#include "frontends/sinumerik/syntax/parse.h"
#include "sinumerik/SinumerikParser.h"

namespace cnctrans::sinumerik {

using Grammar = cnc_sinumerik::SinumerikParser;

/// Fills `out` from `tree`. False when the tree means nothing (a list of values inside an expression ...): `error` says
/// what.
bool build_block(Grammar::BlockContext& tree, std::string_view line, syntax::Block& out, ParseError& error);

/// Turns trees of expressions into syntax::Expr. Names are folded to capitals, texts keep their bytes.
class ExprBuilder {
 public:
  ExprBuilder(std::string_view line, ParseError& error) : line_(line), error_(error) {}

  syntax::Expr expr(Grammar::ExprContext* tree);
  syntax::Expr condition(Grammar::ConditionContext* tree);
  syntax::Expr lvalue(Grammar::LvalueContext* tree);
  syntax::Expr indexed(Grammar::IndexedContext* tree);
  syntax::Expr system(antlr4::tree::TerminalNode* token);
  /// Right of `=`: also a list of values (kind call, empty text).
  syntax::Expr value(Grammar::ExprContext* tree);
  void arguments(Grammar::ArgumentListContext* tree, std::vector<syntax::Expr>& out);
  /// A name (kind name) of the given tree's text in capitals.
  syntax::Expr name(antlr4::ParserRuleContext* tree);

  [[nodiscard]] WordPos pos(antlr4::ParserRuleContext* tree) const;
  [[nodiscard]] static WordPos pos(const antlr4::Token& first, const antlr4::Token& last);
  [[nodiscard]] std::string_view text(antlr4::ParserRuleContext* tree) const;
  [[nodiscard]] std::string_view text(const antlr4::Token& token) const;
  [[nodiscard]] bool failed() const { return failed_; }
  void fail(antlr4::ParserRuleContext* tree, std::string_view message);

 private:
  syntax::Expr primary(Grammar::PrimaryContext* tree);
  syntax::Expr infix(Grammar::InfixOperationContext* tree);
  syntax::Expr number(antlr4::ParserRuleContext* tree);
  syntax::Expr based(antlr4::ParserRuleContext* tree);
  syntax::Expr letter(Grammar::LetterOperandContext* tree);
  syntax::Expr parenthesised(Grammar::ParenthesisedContext* tree, bool list_allowed);

  std::string_view line_;
  ParseError& error_;
  bool failed_ = false;
};

/// The plain number `5`, `-0.5`, `+3` that is all of `tree` (sign and digits touching); nullopt otherwise.
struct PlainNumber {
  double value = 0;
  std::string_view text;
};
bool plain_number(Grammar::ExprContext* tree, std::string_view line, PlainNumber& out);

/// Value of a number without sign as the lexer makes them (`5`, `5.`, `.5`, `8.2EX-3`).
double number_value(std::string_view digits);

}  // namespace cnctrans::sinumerik
