// Multiple machining of the mill (25.4): letters and the parameters they are in ir/cycles/pattern.
#pragma once

#include <array>
#include <string_view>

#include "dialects/fagor/cycles.h"

namespace cnctrans::dialects::fagor {

// clang-format off
inline constexpr std::array pattern_rows = {
    CycleRow{60, "points.line", "25.4", {{{'A', "angle", optional_letter}, {'X', "length", optional_letter}, {'I', "step", optional_letter}, {'K', "count", optional_letter},
             {'P', "skip1", optional_letter}, {'Q', "skip2", optional_letter}, {'R', "skip3", optional_letter}, {'S', "skip4", optional_letter},
             {'T', "skip5", optional_letter}, {'U', "skip6", optional_letter}, {'V', "skip7", optional_letter}}}},
    CycleRow{61, "points.outline", "25.4", {{{'A', "angle", optional_letter}, {'B', "side_angle", optional_letter}, {'X', "length", optional_letter}, {'I', "step", optional_letter},
             {'K', "count", optional_letter}, {'Y', "length2", optional_letter}, {'J', "step2", optional_letter}, {'D', "count2", optional_letter},
             {'P', "skip1", optional_letter}, {'Q', "skip2", optional_letter}, {'R', "skip3", optional_letter}, {'S', "skip4", optional_letter},
             {'T', "skip5", optional_letter}, {'U', "skip6", optional_letter}, {'V', "skip7", optional_letter}}}},
    CycleRow{62, "points.grid", "25.4", {{{'A', "angle", optional_letter}, {'B', "side_angle", optional_letter}, {'X', "length", optional_letter}, {'I', "step", optional_letter},
             {'K', "count", optional_letter}, {'Y', "length2", optional_letter}, {'J', "step2", optional_letter}, {'D', "count2", optional_letter},
             {'P', "skip1", optional_letter}, {'Q', "skip2", optional_letter}, {'R', "skip3", optional_letter}, {'S', "skip4", optional_letter},
             {'T', "skip5", optional_letter}, {'U', "skip6", optional_letter}, {'V', "skip7", optional_letter}}}},
    CycleRow{63, "points.circle", "25.4", {{{'X', "centre_u"}, {'Y', "centre_v"}, {'I', "angle_step", optional_letter}, {'K', "count", optional_letter},
             {'C', "way", optional_letter}, {'F', "way_feed", optional_letter},
             {'P', "skip1", optional_letter}, {'Q', "skip2", optional_letter}, {'R', "skip3", optional_letter}, {'S', "skip4", optional_letter},
             {'T', "skip5", optional_letter}, {'U', "skip6", optional_letter}, {'V', "skip7", optional_letter}}}},
    CycleRow{64, "points.arc", "25.4", {{{'X', "centre_u"}, {'Y', "centre_v"}, {'B', "total"}, {'I', "angle_step", optional_letter}, {'K', "count", optional_letter},
             {'C', "way", optional_letter}, {'F', "way_feed", optional_letter},
             {'P', "skip1", optional_letter}, {'Q', "skip2", optional_letter}, {'R', "skip3", optional_letter}, {'S', "skip4", optional_letter},
             {'T', "skip5", optional_letter}, {'U', "skip6", optional_letter}, {'V', "skip7", optional_letter}}}},
    CycleRow{65, "points.chord", "25.4", {{{'X', "centre_u"}, {'Y', "centre_v"}, {'A', "axis_angle", optional_letter}, {'I', "chord", optional_letter},
             {'C', "way", optional_letter}, {'F', "way_feed", optional_letter}}}},
};
// clang-format on

inline constexpr const CycleRow* find_pattern(int code) {
  for (const auto& row : pattern_rows) {
    if (row.code == code) return &row;
  }
  return nullptr;
}
inline constexpr const CycleRow* find_pattern(std::string_view name) {
  for (const auto& row : pattern_rows) {
    if (row.cycle == name) return &row;
  }
  return nullptr;
}

}  // namespace cnctrans::dialects::fagor
