// Places in source text.
#pragma once

#include <cstdint>

namespace cnctrans {

/// Index of a source file in a `FileTable`; 0 is "no file".
using FileId = std::uint32_t;

/// A range of bytes in one source file. Lines and columns are 1-based; columns count bytes. `line == 0` means
/// "nowhere" (text made by a pass). `end_column` is one past the last byte.
struct Span {
  FileId file = 0;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::uint32_t end_line = 0;
  std::uint32_t end_column = 0;

  [[nodiscard]] bool known() const { return line != 0; }
  bool operator==(const Span&) const = default;
};

/// The place of a word inside its line: 1-based column and length in bytes. `column == 0`: made by a pass.
struct WordPos {
  std::uint32_t column = 0;
  std::uint32_t length = 0;
  bool operator==(const WordPos&) const = default;
};

/// The span of a word of a line that starts at `line`.
inline Span word_span(const Span& line, WordPos pos) {
  if (pos.column == 0) return line;
  return Span{line.file, line.line, pos.column, line.line, pos.column + pos.length};
}

}  // namespace cnctrans
