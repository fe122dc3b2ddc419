// One line of text -> the syntax model, by the word scanner, by the grammar, or by both with a comparison.
#pragma once

#include <optional>

#include "frontends/common/frontend.h"
#include "frontends/sinumerik/syntax/parse.h"

namespace cnctrans::sinumerik {

class LineReader {
 public:
  explicit LineReader(frontends::Reader reader) : reader_(reader) {}

  enum class Result : std::uint8_t { plain, parsed, unread };
  /// `plain`: only words, and the scanner may have read it. `unread`: `error()` says why.
  Result read(std::string_view line, syntax::Block& out);

  [[nodiscard]] const ParseError& error() const { return error_; }
  /// A difference between the two readers (Reader::both): a dump of both; empty when there is none.
  [[nodiscard]] const std::string& difference() const { return difference_; }
  [[nodiscard]] bool scanned() const { return scanned_; }

 private:
  BlockParser& parser();

  frontends::Reader reader_;
  std::optional<BlockParser> parser_;  ///< made when first needed: its tables are large
  syntax::Block other_;
  ParseError error_;
  std::string difference_;
  bool scanned_ = false;
};

/// What a line carries besides its meaning. Views point into the line.
void fill_line_info(const syntax::Block& block, const Span& span, ir::LineInfo& out);

}  // namespace cnctrans::sinumerik
