// Reserved words of the structured statements (10xx and later; reference 13.9, 14.4, 14.5).
#pragma once

#include <array>
#include <string_view>

namespace cnctrans::dialects::num {

/// The lexer in grammars/num knows the same words.
inline constexpr std::array<std::string_view, 21> statement_words{
    "IF",   "THEN",   "ELSE",  "ENDI", "WHILE", "DO",   "ENDW", "FOR", "TO",   "BY",  "DOWNTO",
    "ENDF", "REPEAT", "UNTIL", "EXIT", "VAR",   "ENDV", "AND",  "OR",  "PUSH", "PULL"};
/// Table and stack functions: read, carried as text, not executed.
inline constexpr std::array<std::string_view, 10> carried_words{"BUILD", "SEARCH", "CUT",  "R.OFF", "BSET",
                                                                "BCLR",  "MOVE",   "SORT", "SAVE",  "DELETE"};

}  // namespace cnctrans::dialects::num
