// Digits after the point of a number that is written as the source spells it.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "backends/common/numbers.h"

namespace cnctrans::backends {

inline constexpr int no_number = 1000;

/// Digits after the point of unsigned digits; no_number when it is anything else.
inline int places_of_digits(std::string_view digits) {
  const std::size_t size = digits.size();
  if (std::endian::native == std::endian::little && size >= 4 &&
      size <= 8) {  // all bytes at once: a byte that is no digit becomes one set bit
    std::uint32_t head, tail;
    std::memcpy(&head, digits.data(), 4);
    std::memcpy(&tail, digits.data() + size - 4, 4);
    constexpr std::uint64_t zeros = 0x3030303030303030U, high = 0x8080808080808080U, ten = 0x7676767676767676U;
    const std::uint64_t bytes = head | std::uint64_t{tail} << (8 * (size - 4));
    const std::uint64_t x = (bytes ^ zeros) & (~std::uint64_t{0} >> (8 * (8 - size)));
    const std::uint64_t others = (((x & ~high) + ten) | x) & high;
    if (others == 0) return 0;
    const auto at = static_cast<std::size_t>(std::countr_zero(others)) / 8;
    const bool one_point = (others & (others - 1)) == 0 && digits[at] == '.';
    return one_point ? static_cast<int>(size - at - 1) : no_number;
  }
  if (!plain_number(digits) || digits[0] == '-' || digits[0] == '+') return no_number;
  return decimals_of(digits);
}
inline int places_of(std::string_view text) {
  const bool minus = text.substr(0, 1) == "-";
  return places_of_digits(minus ? text.substr(1) : text);
}

}  // namespace cnctrans::backends
