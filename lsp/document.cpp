#include "lsp/document.h"

#include <algorithm>
#include <filesystem>

#include "base/source.h"
#include "base/uri.h"

namespace cnctrans::lsp {

namespace {

/// Column in UTF-16 from 0 of a byte column from 1.
std::uint32_t utf16_of(std::string_view line, std::uint32_t column) {
  std::uint32_t units = 0;
  std::string_view before = line.substr(0, std::min<std::size_t>(line.size(), column == 0 ? 0 : column - 1));
  while (!before.empty()) {
    const std::size_t length = std::max<std::size_t>(1, utf8_length(before));
    units += length == 4 ? 2 : 1;
    before.remove_prefix(length);
  }
  return units;
}

std::uint32_t column_of(std::string_view line, std::uint32_t utf16) {
  std::uint32_t column = 1;
  for (std::uint32_t units = 0; units < utf16 && !line.empty();) {
    const std::size_t length = std::max<std::size_t>(1, utf8_length(line));
    units += length == 4 ? 2 : 1;
    column += static_cast<std::uint32_t>(length);
    line.remove_prefix(length);
  }
  return column;
}

}  // namespace

std::string path_of_uri(std::string_view uri) {
  constexpr std::string_view scheme = "file://";
  if (!uri.starts_with(scheme)) return std::string(uri);
  return percent_decoded(uri.substr(scheme.size())).value_or(std::string(uri));
}

std::string uri_of_file(const std::string& path) {
  std::error_code ignored;
  return uri_of_path(std::filesystem::absolute(path, ignored).lexically_normal().string());
}

Document::Document(std::string uri, std::string language, std::string text)
    : uri_(std::move(uri)), path_(path_of_uri(uri_)), language_(std::move(language)), text_(std::move(text)) {
  find_lines();
}

void Document::find_lines() {
  starts_.assign(1, 0);
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\r' && i + 1 < text_.size() && text_[i + 1] == '\n') continue;
    if (text_[i] == '\n' || text_[i] == '\r') starts_.push_back(i + 1);
  }
}

void Document::replace(std::string text) {
  text_ = std::move(text);
  find_lines();
}

void Document::edit(const Range& range, std::string_view text) {
  const std::size_t begin = offset(range.start), end = std::max(begin, offset(range.end));
  text_.replace(begin, end - begin, text);
  find_lines();
}

std::string_view Document::line(std::uint32_t number) const {
  if (number == 0 || number > starts_.size()) return {};
  const std::size_t begin = starts_[number - 1];
  std::size_t end = number < starts_.size() ? starts_[number] : text_.size();
  while (end > begin && (text_[end - 1] == '\n' || text_[end - 1] == '\r')) --end;
  return std::string_view(text_).substr(begin, end - begin);
}

std::size_t Document::offset(const Position& at) const {
  if (at.line >= starts_.size()) return text_.size();
  return starts_[at.line] + column_of(line(at.line + 1), at.character) - 1;
}

std::uint32_t Document::column(const Position& at) const {
  return column_of(line(at.line + 1), at.character);
}

Position Document::position(std::uint32_t number, std::uint32_t column) const {
  return {number == 0 ? 0 : number - 1, utf16_of(line(number), column)};
}

Range Document::range(const Span& span) const {
  if (!span.known()) return {};
  const std::uint32_t last = std::max(span.line, span.end_line);
  return {position(span.line, span.column), position(last, span.end_column)};
}

}  // namespace cnctrans::lsp
