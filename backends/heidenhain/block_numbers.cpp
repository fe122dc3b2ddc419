#include "backends/heidenhain/block_numbers.h"

namespace cnctrans::backends::heidenhain {

std::string numbered_blocks(std::string_view text, std::int64_t step) {
  std::string out;
  out.reserve(text.size() + text.size() / 4);
  std::int64_t number = 0;
  bool goes_on = false;
  while (!text.empty()) {
    const auto end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const bool begins = !goes_on;
    goes_on = line.ends_with('~');
    if (begins) {
      if (line.starts_with('/')) {
        out += '/';
        line.remove_prefix(1);
        while (line.starts_with(' ')) line.remove_prefix(1);
      }
      out += std::to_string(number) + ' ';
      number += step;
    }
    out += line;
    out += '\n';
  }
  return out;
}

}  // namespace cnctrans::backends::heidenhain
