// Axes of a channel by number. The nine ISO names are fixed; a program may name more (see Program::axis_names).
#pragma once

#include <cstdint>
#include <string_view>

namespace cnctrans::ir {

using AxisId = std::uint8_t;

namespace axis {
inline constexpr AxisId x = 0, y = 1, z = 2, u = 3, v = 4, w = 5, a = 6, b = 7, c = 8;
inline constexpr AxisId first_extra = 9;
inline constexpr AxisId count_max = 32;
inline constexpr AxisId none = 255;
}  // namespace axis

/// Name of a fixed axis ("X"); empty for the extra ones, whose names are in the program.
inline constexpr std::string_view fixed_axis_name(AxisId id) {
  constexpr std::string_view names = "XYZUVWABC";
  return id < axis::first_extra ? names.substr(id, 1) : std::string_view{};
}
inline constexpr AxisId fixed_axis(char letter) {
  constexpr std::string_view names = "XYZUVWABC";
  const auto at = names.find(letter);
  return at == std::string_view::npos ? axis::none : static_cast<AxisId>(at);
}
inline constexpr bool is_rotary_letter(AxisId id) {
  return id >= axis::a && id <= axis::c;
}

}  // namespace cnctrans::ir
