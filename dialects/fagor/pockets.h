// Irregular pockets of the mill (25.5): letters of the call and of its operations, and the words they are in
// ir/cycles/milling/pocket_call.
#pragma once

#include <array>
#include <string_view>

#include "dialects/fagor/cycles.h"

namespace cnctrans::dialects::fagor {

// clang-format off
inline constexpr std::array pocket_rows = {
    CycleRow{66, "pocket.call", "25.5", {{{'D', "drill_first_label", optional_letter}, {'H', "drill_last_label", optional_letter},
             {'R', "rough_first_label", optional_letter}, {'I', "rough_last_label", optional_letter},
             {'C', "semi_first_label", optional_letter}, {'J', "semi_last_label", optional_letter},
             {'F', "finish_first_label", optional_letter}, {'K', "finish_last_label", optional_letter},
             {'S', "first_label"}, {'E', "last_label"}, {'Q', "program", optional_letter}}}},
    CycleRow{67, "pocket.rough", "25.5", {{{'A', "pass_angle", optional_letter}, {'B', "signed_infeed"}, {'C', "step", optional_letter},
             {'I', "bottom", optional_letter}, {'R', "reference", optional_letter}, {'K', "intersection", optional_letter},
             {'V', "plunge_feed", optional_letter}, {'Q', "plunge_angle", optional_letter}}}},
    CycleRow{68, "pocket.finish", "25.5", {{{'B', "signed_infeed", optional_letter}, {'L', "wall_stock", optional_letter},
             {'Q', "direction", optional_letter}, {'J', "tip_radius", optional_letter}, {'I', "bottom", optional_letter},
             {'R', "reference", optional_letter}, {'K', "intersection", optional_letter}, {'V', "plunge_feed", optional_letter}}}},
};
// clang-format on

inline constexpr const CycleRow* find_pocket(int code) {
  for (const auto& row : pocket_rows) {
    if (row.code == code) return &row;
  }
  return nullptr;
}
inline constexpr const CycleRow* find_pocket(std::string_view name) {
  for (const auto& row : pocket_rows) {
    if (row.cycle == name) return &row;
  }
  return nullptr;
}
/// Letters of the call that go with another one only (error 34).
inline constexpr std::string_view pocket_pairs = "DHRICJFK";

}  // namespace cnctrans::dialects::fagor
