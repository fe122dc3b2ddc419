#include "backends/heidenhain/block_numbers.h"

#include <array>
#include <charconv>

namespace cnctrans::backends::heidenhain {

void NumberedBlocks::write(std::string_view line, std::string& out) {
  const bool begins = !goes_on_;
  goes_on_ = line.ends_with('~');
  if (begins) {
    if (line.starts_with('/')) {
      out += '/';
      line.remove_prefix(1);
      while (line.starts_with(' ')) line.remove_prefix(1);
    }
    std::array<char, 20> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), next_).ptr;
    out.append(digits.data(), end);
    out += ' ';
    next_ += step_;
  }
  out += line;
}

}  // namespace cnctrans::backends::heidenhain
