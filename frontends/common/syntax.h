// The syntax model of one block: what the word scanner and the grammars both produce, so that they can be compared.
// It knows addresses, values, keywords and trees, not what they mean. All views point into the source line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/span.h"

namespace cnctrans::syntax {

enum class ExprKind : std::uint8_t {
  number,    ///< text = digits as written, number = value
  string,    ///< text = content without the quotes
  variable,  ///< text = name as the dialect spells it, folded to capitals ("P", "R", "L", "ALPHA", "$P_UIFR"); args =
             ///< index or indices
  unary,     ///< text = operator, args[0]
  binary,    ///< text = operator, args[0], args[1]
  call,      ///< text = function name in capitals; args
  name,      ///< a bare identifier that is not a variable for sure (axis name, label, keyword argument)
  missing    ///< an omitted argument: CYCLE83(10,,2)
};

/// Expression tree; precedence and associativity are the grammar's business and are gone here.
struct Expr {
  ExprKind kind = ExprKind::missing;
  std::string text;
  double number = 0;
  std::vector<Expr> args;
  WordPos pos;
  bool operator==(const Expr&) const = default;
};

/// An address with its value: `G1`, `X-10.5`, `XP100`, `X=R1*2`, `CR=5`, `X=IC(3)`, `M2=3`, `E60001=L1`.
struct Word {
  std::string_view address;     ///< letters as written, e.g. "X", "CR", "G" (a view into the line)
  std::int32_t extension = -1;  ///< numeric address extension: M2=3 -> 2, I1=.. -> 1; -1 none
  bool equals = false;          ///< an `=` was written
  bool has_value = false;       ///< false: bare address (`Z` alone)
  bool is_expression = false;   ///< value is `block.exprs[expr]`, else `number` and `number_text`
  std::int32_t expr = -1;
  double number = 0;
  std::string_view number_text;  ///< as written, sign included ("-0.500", "5.", "+3")
  WordPos pos;
  bool operator==(const Word&) const = default;
};

/// A high-level statement: keyword (capitals), arguments, nested statements (actions of an IF...).
/// The keywords of a dialect and the layout of their arguments are documented in frontends/<dialect>/README.md.
struct Statement {
  std::string keyword;
  std::vector<Expr> args;
  std::vector<Statement> children;
  std::string text;  ///< verbatim text where the statement carries one (message text, opaque call)
  WordPos pos;
  bool operator==(const Statement&) const = default;
};

struct Comment {
  std::string_view text;  ///< without the comment marks
  WordPos pos;            ///< with the marks
  bool operator==(const Comment&) const = default;
};

/// One block. Reused from line to line: `clear` keeps the memory.
struct Block {
  std::uint16_t skip_mask = 0;  ///< bit n = skip level n (0-based as in the IR)
  WordPos skip_pos;
  std::string_view number;  ///< digits of the block number as written ("0010"); empty: none
  char number_mark = 'N';   ///< 'N', or ':' for a main block
  WordPos number_pos;
  std::vector<std::string_view> labels;  ///< identifier labels before the block (`LAB:`)
  std::vector<Word> words;               ///< in source order
  std::vector<Statement> statements;     ///< in source order; interleave with words by `pos.column`
  std::vector<Expr> exprs;
  std::vector<Comment> comments;
  bool plain = false;  ///< made of words, number, skip and comments only

  void clear() {
    skip_mask = 0;
    skip_pos = {};
    number = {};
    number_mark = 'N';
    number_pos = {};
    labels.clear();
    words.clear();
    statements.clear();
    exprs.clear();
    comments.clear();
    plain = false;
  }
  bool operator==(const Block&) const = default;
};

/// Human-readable dump, one line per part: used by `--reader=both` to show a difference and by tests.
std::string dump(const Block& block);

}  // namespace cnctrans::syntax
