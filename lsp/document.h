// A text that a client edits. Lines and columns of the protocol count from 0, columns in UTF-16; the house counts from
// 1, in bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/span.h"

namespace cnctrans::lsp {

struct Position {
  std::uint32_t line = 0, character = 0;
};
struct Range {
  Position start, end;
};

class Document {
 public:
  Document(std::string uri, std::string language, std::string text);
  [[nodiscard]] const std::string& uri() const { return uri_; }
  [[nodiscard]] const std::string& path() const { return path_; }  ///< of a file; else the URI
  [[nodiscard]] const std::string& language() const { return language_; }
  [[nodiscard]] const std::string& text() const { return text_; }
  void replace(std::string text);
  void edit(const Range& range, std::string_view text);

  [[nodiscard]] std::uint32_t line_count() const { return static_cast<std::uint32_t>(starts_.size()); }
  /// Of a line from 1, without its end.
  [[nodiscard]] std::string_view line(std::uint32_t number) const;
  /// Column in bytes, from 1, of a place in a line.
  [[nodiscard]] std::uint32_t column(const Position& at) const;
  [[nodiscard]] Position position(std::uint32_t line, std::uint32_t column) const;
  [[nodiscard]] Range range(const Span& span) const;

 private:
  void find_lines();
  [[nodiscard]] std::size_t offset(const Position& at) const;
  std::string uri_, path_, language_, text_;
  std::vector<std::size_t> starts_;  ///< offset of each line
};

std::string path_of_uri(std::string_view uri);
/// Of a file, whatever folder its path counts from.
std::string uri_of_file(const std::string& path);

}  // namespace cnctrans::lsp
