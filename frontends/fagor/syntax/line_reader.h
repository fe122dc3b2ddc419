// One line to the syntax model: the word scanner where it can, the grammar for the rest, both to compare them.
#pragma once

#include <memory>
#include <string_view>

#include "base/source.h"
#include "frontends/common/frontend.h"
#include "frontends/common/syntax.h"
#include "frontends/fagor/state/state.h"
#include "frontends/fagor/syntax/parse.h"
#include "ir/statement.h"

namespace cnctrans::fagor {

class LineReader {
 public:
  explicit LineReader(frontends::Reader mode) : mode_(mode) {}
  /// False: not a block; `error` says why. Differences between the two readers are reported to `state`.
  bool read(std::string_view line, syntax::Block& block, ParseError& error, LowerState& state);
  /// The last block came from the word scanner.
  [[nodiscard]] bool scanned() const { return scanned_; }

 private:
  frontends::Reader mode_;
  bool scanned_ = false;
  std::unique_ptr<BlockParser> parser_;  ///< made when the first line needs it
  syntax::Block other_;
};

/// The line without control characters of tapes and transfers (NUL, ETX, EOT, ^Z, ESC) at its ends.
std::string_view without_control(std::string_view line);
/// Place, number, skip level and comments of a block.
void fill_line(const syntax::Block& block, const Span& span, ir::LineInfo& line);
Span line_span(FileId file, const SourceLine& line);

/// The file's first line: `%title ,attributes,`. False: not of that form (title and attributes hold what there is).
bool read_header(std::string_view line, std::string& title, std::string& attributes);

}  // namespace cnctrans::fagor
