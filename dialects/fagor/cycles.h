// Machining cycles of the lathe (ch. 9): letters in the order the manual prints them, and the parameters they are in
// ir/cycles/machining.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace cnctrans::dialects::fagor {

struct CycleLetter {
  char letter = 0;
  std::string_view parameter = {};
  bool mandatory = true;
};
struct CycleRow {
  int code = 0;
  std::string_view cycle;  ///< name in the IR
  std::string_view section;
  std::array<CycleLetter, 18> letters;
};

inline constexpr bool optional_letter = false;
// clang-format off
inline constexpr std::array cycle_rows = {
    CycleRow{60, "face.live_drill", "9.13", {{{'X', "x"}, {'Z', "z"}, {'I', "depth"}, {'B', "peck"}, {'Q', "first_angle"}, {'A', "angle_step"},
             {'J', "count"}, {'D', "clearance", optional_letter}, {'K', "dwell", optional_letter}, {'H', "lift", optional_letter},
             {'C', "reapproach", optional_letter}, {'S', "live_speed"}, {'L', "minimum_peck", optional_letter}, {'R', "factor", optional_letter}}}},
    CycleRow{61, "side.live_drill", "9.14", {{{'X', "x"}, {'Z', "z"}, {'I', "depth"}, {'B', "peck"}, {'Q', "first_angle"}, {'A', "angle_step"},
             {'J', "count"}, {'D', "clearance", optional_letter}, {'K', "dwell", optional_letter}, {'H', "lift", optional_letter},
             {'C', "reapproach", optional_letter}, {'S', "live_speed"}, {'L', "minimum_peck", optional_letter}, {'R', "factor", optional_letter}}}},
    CycleRow{62, "side.live_key", "9.16", {{{'X', "x"}, {'Z', "z"}, {'L', "length"}, {'I', "depth"}, {'Q', "first_angle"}, {'A', "angle_step"},
             {'J', "count"}, {'D', "clearance", optional_letter}, {'F', "mill_feed"}, {'S', "live_speed"}}}},
    CycleRow{63, "face.live_key", "9.17", {{{'X', "x"}, {'Z', "z"}, {'L', "length"}, {'I', "depth"}, {'Q', "first_angle"}, {'A', "angle_step"},
             {'J', "count"}, {'D', "clearance", optional_letter}, {'F', "mill_feed"}, {'S', "live_speed"}}}},
    CycleRow{66, "turn.copy", "9.1", {{{'X', "x"}, {'Z', "z"}, {'I', "total"}, {'C', "step"}, {'A', "main_axis", optional_letter},
             {'L', "stock_x", optional_letter}, {'M', "stock_z", optional_letter}, {'H', "finish_feed", optional_letter}, {'S', "first_label"},
             {'E', "last_label"}, {'Q', "program", optional_letter}, {'J', "section", optional_letter}}}},
    CycleRow{68, "turn.profile", "9.2", {{{'X', "x"}, {'Z', "z"}, {'C', "step"}, {'D', "withdrawal", optional_letter},
             {'L', "stock_x", optional_letter}, {'M', "stock_z", optional_letter}, {'K', "groove_feed", optional_letter},
             {'F', "rough_feed", optional_letter}, {'H', "finish_feed", optional_letter}, {'S', "first_label"}, {'E', "last_label"},
             {'Q', "program", optional_letter}, {'J', "section", optional_letter}}}},
    CycleRow{69, "face.profile", "9.3", {{{'X', "x"}, {'Z', "z"}, {'C', "step"}, {'D', "withdrawal", optional_letter},
             {'L', "stock_x", optional_letter}, {'M', "stock_z", optional_letter}, {'K', "groove_feed", optional_letter},
             {'F', "rough_feed", optional_letter}, {'H', "finish_feed", optional_letter}, {'S', "first_label"}, {'E', "last_label"},
             {'Q', "program", optional_letter}}}},
    CycleRow{81, "turn.straight", "9.4", {{{'X', "x"}, {'Z', "z"}, {'Q', "x_end"}, {'R', "z_end"}, {'C', "step"}, {'D', "withdrawal", optional_letter},
             {'L', "stock_x", optional_letter}, {'M', "stock_z", optional_letter}, {'F', "rough_feed", optional_letter},
             {'H', "finish_feed", optional_letter}}}},
    CycleRow{82, "face.straight", "9.5", {{{'X', "x"}, {'Z', "z"}, {'Q', "x_end"}, {'R', "z_end"}, {'C', "step"}, {'D', "withdrawal", optional_letter},
             {'L', "stock_x", optional_letter}, {'M', "stock_z", optional_letter}, {'F', "rough_feed", optional_letter},
             {'H', "finish_feed", optional_letter}}}},
    CycleRow{83, "turn.drill", "9.6", {{{'X', "x"}, {'Z', "z"}, {'I', "depth"}, {'B', "peck"}, {'D', "clearance", optional_letter},
             {'K', "dwell", optional_letter}, {'H', "lift", optional_letter}, {'C', "reapproach", optional_letter},
             {'L', "minimum_peck", optional_letter}, {'R', "factor", optional_letter}}}},
    CycleRow{84, "turn.arc", "9.7", {{{'X', "x"}, {'Z', "z"}, {'Q', "x_end"}, {'R', "z_end"}, {'C', "step"}, {'D', "withdrawal", optional_letter},
             {'L', "stock_x", optional_letter}, {'M', "stock_z", optional_letter}, {'F', "rough_feed", optional_letter},
             {'H', "finish_feed", optional_letter}, {'I', "centre_x"}, {'K', "centre_z"}}}},
    CycleRow{85, "face.arc", "9.8", {{{'X', "x"}, {'Z', "z"}, {'Q', "x_end"}, {'R', "z_end"}, {'C', "step"}, {'D', "withdrawal", optional_letter},
             {'L', "stock_x", optional_letter}, {'M', "stock_z", optional_letter}, {'F', "rough_feed", optional_letter},
             {'H', "finish_feed", optional_letter}, {'I', "centre_x"}, {'K', "centre_z"}}}},
    CycleRow{86, "turn.thread", "9.9", {{{'X', "x"}, {'Z', "z"}, {'Q', "x_end"}, {'R', "z_end"}, {'K', "measured", optional_letter}, {'I', "depth"},
             {'B', "infeed"}, {'E', "minimum_infeed", optional_letter}, {'D', "clearance", optional_letter}, {'L', "finish_stock", optional_letter},
             {'C', "pitch"}, {'J', "exit", optional_letter}, {'A', "infeed_angle", optional_letter}, {'W', "start_angle", optional_letter},
             {'V', "starts", optional_letter}, {'M', "pitch_change", optional_letter}, {'H', "entry", optional_letter}, {'U', "repair", optional_letter}}}},
    CycleRow{87, "face.thread", "9.10", {{{'X', "x"}, {'Z', "z"}, {'Q', "x_end"}, {'R', "z_end"}, {'K', "measured_x", optional_letter}, {'I', "depth"},
             {'B', "infeed"}, {'E', "minimum_infeed", optional_letter}, {'D', "clearance", optional_letter}, {'L', "finish_stock", optional_letter},
             {'C', "pitch"}, {'J', "exit", optional_letter}, {'A', "infeed_angle", optional_letter}, {'W', "start_angle", optional_letter},
             {'V', "starts", optional_letter}, {'M', "pitch_change", optional_letter}, {'H', "entry", optional_letter}, {'U', "repair", optional_letter}}}},
    CycleRow{88, "turn.groove", "9.11", {{{'X', "x"}, {'Z', "z"}, {'Q', "x_end"}, {'R', "z_end"}, {'C', "step", optional_letter},
             {'D', "clearance", optional_letter}, {'K', "dwell", optional_letter}}}},
    CycleRow{89, "face.groove", "9.12", {{{'X', "x"}, {'Z', "z"}, {'Q', "x_end"}, {'R', "z_end"}, {'C', "step", optional_letter},
             {'D', "clearance", optional_letter}, {'K', "dwell", optional_letter}}}},
};
// clang-format on

inline constexpr const CycleRow* find_cycle(int code) {
  for (const auto& row : cycle_rows) {
    if (row.code == code) return &row;
  }
  return nullptr;
}
inline constexpr const CycleRow* find_cycle(std::string_view cycle) {
  for (const auto& row : cycle_rows) {
    if (row.cycle == cycle) return &row;
  }
  return nullptr;
}
inline constexpr const CycleLetter* find_letter(const CycleRow& row, char letter) {
  for (const auto& l : row.letters) {
    if (l.letter == letter) return &l;
  }
  return nullptr;
}

/// Cycles that end G41 and G42 like G40 (8.2.3); a finishing pass has the side that its profile says.
inline constexpr bool ends_compensation_first(int code) {
  return code == 66 || code == 68 || code == 69 || code == 83;
}

}  // namespace cnctrans::dialects::fagor
