#include "frontends/common/control_bytes.h"

#include <algorithm>

namespace cnctrans::frontends {

std::size_t find_control_byte(std::string_view line, char to_end, char open, char close) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == to_end) return std::string_view::npos;
    if (c == open) {
      i = std::min(line.find(close, i + 1), line.size());
    } else if (static_cast<unsigned char>(c) < 0x20 && c != '\t') {
      return i;
    }
  }
  return std::string_view::npos;
}

}  // namespace cnctrans::frontends
