// One line of an iTNC 530 program -> syntax::Block, by the grammar in grammars/heidenhain. The definition of the
// language; the word scanner is the shortcut for path functions.
//
// What the block holds (see frontends/common/syntax.h):
//   words       the items of the line in order: address and value (`X+10`, `IPA-45`), bare (`L`, `FMAX`, `RL`), with a
//               sign (`DR+`: has_value false, number_text the sign), a value without address (`5` of TOOL CALL 5:
//               address empty), a mark (`/` of REP 3/3: address is the mark, no value). `XQ5` and `X-QL5` are
//               expressions. A number with a comma or several signs has an empty number_text.
//   statements  at most one: the sentence that the line is, keyword = its words ("TOOL CALL", "CYCL DEF"), text = what
//               follows them; args = its texts in quotes. Or
//   "ASSIGN"    args = {variable, expression}; `Q206=FAUTO`: the expression is the name, with a value a call of it
//   "FN"        text = number; "FN" args by its form: {variable, expression}, or for a jump {comparison} with text "9";
//               `rest` of others is the text behind the colon, in children[0].text
//   "OUTLINE"   `* - text`, or a line in brackets
// Variables: text "Q", "QL", "QR", "QS" with args[0] = the number.
// A `~` at the end, or as the last character of the comment, is the statement "~" behind the others.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "frontends/common/syntax.h"

namespace cnctrans::frontends::heidenhain {

/// The first fault of a block: where (1-based column of the line), and what in words a machinist understands.
struct ParseError {
  WordPos pos;
  std::string message;
};

/// Longer lines are refused by the grammar: nesting must stay within bounds.
inline constexpr std::size_t longest_block = 1024;

/// Reads lines one after another; lexer, token stream and parser are made once. Not for several threads at once.
class BlockParser {
 public:
  BlockParser();
  ~BlockParser();
  BlockParser(const BlockParser&) = delete;
  BlockParser& operator=(const BlockParser&) = delete;

  /// False: `error` says why, `out` holds nothing. Views in `out` point into `line`. Never throws.
  bool parse(std::string_view line, syntax::Block& out, ParseError& error);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Value of a number whose decimal point may be a comma.
double number_of(std::string_view text);
/// The comment of a line that goes on in the next one has a `~` at its end: taken away, and true.
bool take_tilde(std::string_view& comment);

}  // namespace cnctrans::frontends::heidenhain
