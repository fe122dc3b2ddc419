// "1 file", "3 files".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cnctrans {

inline std::string counted(std::size_t n, std::string_view what) {
  return std::to_string(n) + ' ' + std::string(what) + (n == 1 ? "" : "s");
}

}  // namespace cnctrans
