// One Fagor block through the grammar: line in, syntax model out.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/span.h"
#include "frontends/common/syntax.h"

namespace cnctrans::fagor {

/// Why a line is not a block, in a machinist's words. `pos` is the first place that does not fit.
struct ParseError {
  WordPos pos;
  std::string message;
};

/// Reads one block at a time; lexer, parser and their caches are kept from line to line. Not for `%` lines.
class BlockParser {
 public:
  BlockParser();
  ~BlockParser();
  BlockParser(const BlockParser&) = delete;
  BlockParser& operator=(const BlockParser&) = delete;

  /// `line` without its line end. Fills `out` with views into `line`; false and `error` when the line is no block
  /// (`out` is undefined then).
  [[nodiscard]] bool parse_block(std::string_view line, syntax::Block& out, ParseError& error);

  /// High-level blocks longer than this, or with deeper brackets, are refused.
  static constexpr std::size_t max_statement_length = 4096;
  static constexpr int max_nesting = 100;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cnctrans::fagor
