#include "lsp/wire.h"

#include <array>
#include <charconv>

#include "base/os/os.h"
#include "base/text.h"

namespace cnctrans::lsp {

namespace {

/// The value of Content-Length in the lines of a header; 0: it has none.
std::size_t content_length(std::string_view header) {
  constexpr std::string_view name = "CONTENT-LENGTH:";
  const std::string capitals = to_upper_ascii(header);
  const auto at = capitals.find(name);
  if (at == std::string::npos) return 0;
  const std::string_view value = trim(header.substr(at + name.size(), header.find('\r', at) - at - name.size()));
  std::size_t length = 0;
  std::from_chars(value.data(), value.data() + value.size(), length);
  return length;
}

}  // namespace

bool Wire::fill() {
  std::array<char, 1 << 16> piece;  // NOLINT(cppcoreguidelines-pro-type-member-init): it is written first
  const std::size_t got = os::read_what_comes(in_, piece.data(), piece.size());
  buffer_.append(piece.data(), got);
  return got != 0;
}

std::optional<std::string> Wire::read() {
  constexpr std::string_view gap = "\r\n\r\n";
  std::size_t end = 0;
  while ((end = buffer_.find(gap)) == std::string::npos) {
    if (!fill()) return std::nullopt;
  }
  const std::size_t begin = end + gap.size(), length = content_length(std::string_view(buffer_).substr(0, begin));
  while (buffer_.size() - begin < length) {
    if (!fill()) return std::nullopt;
  }
  std::string message = buffer_.substr(begin, length);
  buffer_.erase(0, begin + length);
  return message;
}

void Wire::write(std::string_view message) {
  const std::string header = "Content-Length: " + std::to_string(message.size()) + "\r\n\r\n";
  std::fwrite(header.data(), 1, header.size(), out_);
  std::fwrite(message.data(), 1, message.size(), out_);
  std::fflush(out_);
}

bool Wire::idle() const {
  return buffer_.empty() && os::is_quiet(in_);
}

}  // namespace cnctrans::lsp
