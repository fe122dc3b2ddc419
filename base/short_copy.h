// Copies of short texts: two overlapping moves of a fixed size beat a call.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

namespace cnctrans {

/// Copies `from` to `to`, which has room for it; the end of the copy.
inline char* copy_short(char* to, std::string_view from) {
  const char* const p = from.data();
  const std::size_t n = from.size();
  if (n >= 8 && n <= 16) {
    std::uint64_t head, tail;
    std::memcpy(&head, p, 8);
    std::memcpy(&tail, p + n - 8, 8);
    std::memcpy(to, &head, 8);
    std::memcpy(to + n - 8, &tail, 8);
  } else if (n >= 4 && n < 8) {
    std::uint32_t head, tail;
    std::memcpy(&head, p, 4);
    std::memcpy(&tail, p + n - 4, 4);
    std::memcpy(to, &head, 4);
    std::memcpy(to + n - 4, &tail, 4);
  } else if (n < 4) {
    for (std::size_t i = 0; i < n; ++i) to[i] = p[i];
  } else {
    std::memcpy(to, p, n);
  }
  return to + n;
}

}  // namespace cnctrans
