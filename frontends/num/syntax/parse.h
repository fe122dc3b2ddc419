// One block of NUM text -> syntax::Block, by the grammar in grammars/num. The definition of the language; the word
// scanner is the shortcut for plain blocks.
//
// What the block holds, beyond words (see syntax.h):
//   "%"      program header; args[0] = number as written ("12.2"), absent for a bare tape mark
//   "MSG"    `$ text`; text = everything after the `$`
//   "ASSIGN" args = {variable, expression}
//   "TEST"   the test of the G79 or G10 word before it; args = {comparison}; children = {ASSIGN} for `L4=L3*2>8`
//   "DECL"   a symbol standing alone (VAR block); args = {variable}
//   "INPUT"  `L1 = $text`; args = {variable}; text
//   "EQUIV"  `@X=U`; args = {name, name}
//   "IF" "WHILE" "UNTIL" args = {condition}; "FOR" args = {variable, from, to, step or missing}, text = TO or DOWNTO
//   "THEN" "ELSE" "ENDI" "DO" "ENDW" "REPEAT" "ENDF" "EXIT" "VAR" "ENDV": no arguments
//   "CARRIED" a table or stack function (PUSH, BUILD, DELETE...) kept as text
// Variables: text "L" or "E" with args[0] = the number; "[NAME]" with args = indices; "'EA" for an aliased address.
// Words: a sign without a value (`R+`, `G76-`, `E+`) has has_value = false (for `G76-` the number stays) and the sign
// as the last character of number_text. `GO` has number 0 and number_text "O".
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "frontends/common/syntax.h"

namespace cnctrans::frontends::num {

/// The first fault of a block: where (1-based column of the line), and what in words a machinist understands.
struct ParseError {
  WordPos pos;
  std::string message;
};

/// True when the block begins with a keyword of the structured statements (`IF L1`, `VAR`; not `IF100`).
bool begins_with_keyword(std::string_view line);

/// Longer lines are refused by the grammar: the control takes 118 characters, and nesting must stay within bounds.
inline constexpr std::size_t longest_block = 1024;

/// Reads blocks one after another; lexer, token stream and parser are made once. Not for several threads at once.
class BlockParser {
 public:
  /// `structured`: the control knows IF, WHILE ... (10xx and later); on a 7xx `IF` is the two words I0 F0.
  explicit BlockParser(bool structured = true);
  ~BlockParser();
  BlockParser(const BlockParser&) = delete;
  BlockParser& operator=(const BlockParser&) = delete;

  /// False: `error` says why, `out` holds nothing. Views in `out` point into `line`. Never throws.
  bool parse(std::string_view line, syntax::Block& out, ParseError& error);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cnctrans::frontends::num
