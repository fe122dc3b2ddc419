// The words of a line, for colours: by the tables of the language, without reading the program.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lsp/words/words.h"

namespace cnctrans::lsp {

/// In the order of the legend that the server sends.
enum class TokenType : std::uint8_t { comment, string, number, keyword, function, macro, variable, label, property };
struct Token {
  std::uint32_t column = 1, length = 0;  ///< in bytes
  TokenType type = TokenType::comment;
};
std::vector<Token> tokens_of(std::string_view line, const Language& language, bool lathe);

}  // namespace cnctrans::lsp
