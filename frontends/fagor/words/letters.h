// Letters of an ISO block.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "ir/axis.h"

namespace cnctrans::fagor {

/// What a letter is in an ISO block, and its place in the order the control wants (0: no place of its own).
enum class Letter : std::uint8_t { other, g, axis, m, radius };
struct LetterInfo {
  Letter kind = Letter::other;
  std::uint8_t rank = 0;
  ir::AxisId axis = ir::axis::none;
};
constexpr std::array<LetterInfo, 26> make_letters() {
  std::array<LetterInfo, 26> t{};
  for (std::size_t i = 0; i < t.size(); ++i) {
    const ir::AxisId axis = ir::fixed_axis(static_cast<char>('A' + i));
    if (axis != ir::axis::none) t[i] = {Letter::axis, 2, axis};
  }
  t['G' - 'A'] = {Letter::g, 1, ir::axis::none};
  t['F' - 'A'].rank = 3;
  t['S' - 'A'].rank = 4;
  t['T' - 'A'].rank = 5;
  t['D' - 'A'].rank = 6;
  t['M' - 'A'] = {Letter::m, 7, ir::axis::none};
  t['R' - 'A'].kind = Letter::radius;
  return t;
}
inline constexpr std::array<LetterInfo, 26> letter_info = make_letters();

constexpr std::uint32_t mask_of(std::string_view letters) {
  std::uint32_t mask = 0;
  for (const char c : letters) mask |= 1U << (c - 'A');
  return mask;
}
inline constexpr std::uint32_t technology_letters = mask_of("FSTD");
inline constexpr std::uint32_t center_letters = mask_of("IJK");
inline constexpr std::uint32_t motion_letters = mask_of("IJKQL");

inline const LetterInfo& info_of(char letter) {
  return letter_info[static_cast<std::size_t>(letter - 'A')];
}

}  // namespace cnctrans::fagor
