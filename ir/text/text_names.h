// Names and tokens that the printer and the reader of the textual IR share. Only for the .cpp files of ir/.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/program.h"

namespace cnctrans::ir::detail {

inline bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
inline bool is_word_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
inline bool is_word_char(char c) {
  return is_word_start(c) || is_digit(c);
}

bool all_digits(std::string_view text);
/// Capitals, digits and `_`, beginning with a letter: can stand in the text without quotes.
bool is_capital_word(std::string_view text);
/// Length of the unsigned number ("10", "10.5", "10.", ".5") at the front; 0 when there is none.
std::size_t number_length(std::string_view text);
/// The number token `text` says exactly `value`, so that it can stand for both. `sign`: + or - may be in front.
bool says(std::string_view text, double value, bool sign);

/// By space id: the name its variables have in the text. The prefix where it is a word of capitals and the only one
/// such, `v` for the first space without prefix, else s<id>.
std::vector<std::string> space_handles(const Program& program);
/// By axis id: the name in the text; extra axes whose name is no word of capitals or not the only one are axis<id>.
std::string axis_text(const Program& program, AxisId id);
std::optional<AxisId> axis_from_text(const Program& program, std::string_view text);

/// The type a builder of ir/expr.h would give this node.
Type natural_type(const Expr& e);
/// Number::integer as the builder number() sets it.
bool natural_integer(double value);

/// `text` in double quotes: `"` and `\` with a backslash, control bytes and bytes that are no UTF-8 as \xHH.
std::string quoted(std::string_view text);

}  // namespace cnctrans::ir::detail
