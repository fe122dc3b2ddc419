// The grammar reader of one Sinumerik block: text -> syntax::Block. The layouts of the statements are in README.md.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "frontends/common/syntax.h"

namespace cnctrans::sinumerik {

/// Why a block can't be read: 1-based column in bytes, length of the offending part (at least 1), and a text for
/// people.
struct ParseError {
  std::uint32_t column = 1;
  std::uint32_t length = 1;
  std::string message;
};

/// Reads blocks by the ANTLR grammar. One object reads many lines; the lexer, the parser and their tables are reused.
/// Not thread safe.
class BlockParser {
 public:
  BlockParser();
  ~BlockParser();
  BlockParser(BlockParser&&) noexcept;
  BlockParser& operator=(BlockParser&&) noexcept;

  /// Reads one line (without its line end). `out` is cleared first; its views point into `line`. False: `error` says
  /// why, and `out` holds only what stands before the block (skip mark, number, comment) as far as it could be seen.
  [[nodiscard]] bool parse_block(std::string_view line, syntax::Block& out, ParseError& error);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A block of more code bytes than this is refused (the control's limit is 512 characters).
inline constexpr std::size_t max_block_bytes = 8192;
/// A block of more words, operators and brackets is refused: its tree would need a deep stack.
inline constexpr std::size_t max_block_tokens = 1500;
/// Brackets and signs nested deeper than this are refused.
inline constexpr int max_nesting = 100;

}  // namespace cnctrans::sinumerik
