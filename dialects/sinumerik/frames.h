// Frames of the control by their names (motion reference 7.4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "ir/frame_rows.h"

namespace cnctrans::sinumerik {

/// A frame that is a row of the table of frames but no settable one.
struct RowFrame {
  std::string_view name;  ///< capitals
  std::int32_t row;       ///< of its first frame
  bool indexed;           ///< 0 to 7 of them, in brackets
};
inline constexpr std::int32_t row_frames_each = 8;
namespace rows = ir::frame_rows;
inline constexpr RowFrame row_frames[] = {
    {"$P_NCBFR", rows::stored_base, true},         {"$P_CHBFR", rows::stored_base + 10, true},
    {"$P_UBFR", rows::stored_base + 10, false},    {"$P_NCBFRAME", rows::active_base, true},
    {"$P_CHBFRAME", rows::active_base + 10, true}, {"$P_BFRAME", rows::active_base + 10, false},
    {"$P_ACTBFRAME", rows::total_base, false},     {"$P_PARTFRAME", rows::neutral, false},
    {"$P_SETFRAME", rows::neutral + 1, false},     {"$P_EXTFRAME", rows::neutral + 2, false},
    {"$P_TOOLFRAME", rows::neutral + 3, false},    {"$P_WPFRAME", rows::neutral + 4, false},
    {"$P_TRAFRAME", rows::neutral + 5, false},     {"$P_CYCFRAME", rows::neutral + 6, false},
};

/// Null when it is none of these.
constexpr const RowFrame* row_frame(std::string_view capitals) {
  for (const auto& r : row_frames) {
    if (r.name == capitals) return &r;
  }
  return nullptr;
}

}  // namespace cnctrans::sinumerik
