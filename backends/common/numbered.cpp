#include "backends/common/backend.h"

namespace cnctrans::backends {

std::string numbered(const Backend& backend, const WriteOptions& options, std::string text) {
  const auto numbers = backend.block_numbers(options);
  if (numbers == nullptr) return text;
  std::string out;
  out.reserve(text.size() + text.size() / 4);
  std::string_view rest = text;
  SourceLine line;
  while (take_line(rest, line)) {
    numbers->write(line.text, out);
    out += '\n';
  }
  return out;
}

}  // namespace cnctrans::backends
