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
inline constexpr std::int32_t channel_base = rows::own_base + 10;
inline constexpr RowFrame row_frames[] = {
    {"$P_PARTFR", rows::stored_base, false},
    {"$P_SETFR", rows::stored_base + 1, false},
    {"$P_EXTFR", rows::stored_base + 2, false},
    {"$P_PARTFRAME", rows::active_base, false},
    {"$P_SETFRAME", rows::active_base + 1, false},
    {"$P_EXTFRAME", rows::active_base + 2, false},
    {"$P_NCBFR", rows::stored_base + rows::own_base, true},
    {"$P_CHBFR", rows::stored_base + channel_base, true},
    {"$P_UBFR", rows::stored_base + channel_base, false},
    {"$P_NCBFRAME", rows::active_base + rows::own_base, true},
    {"$P_CHBFRAME", rows::active_base + channel_base, true},
    {"$P_BFRAME", rows::active_base + channel_base, false},
    {"$P_ACTBFRAME", rows::total_base, false},
    {"$P_TOOLFRAME", rows::neutral + 3, false},
    {"$P_WPFRAME", rows::neutral + 4, false},
    {"$P_TRAFRAME", rows::neutral + 5, false},
    {"$P_CYCFRAME", rows::neutral + 6, false},
};

/// Null when it is none of these.
constexpr const RowFrame* row_frame(std::string_view capitals) {
  for (const auto& r : row_frames) {
    if (r.name == capitals) return &r;
  }
  return nullptr;
}

/// Frames of the control that the chain has only where machine data say so (MD28082, bit by bit).
struct ControlFrame {
  std::string_view active, stored;  ///< capitals
  unsigned bit;
};
inline constexpr ControlFrame control_frames[] = {
    {"$P_SETFRAME", "$P_SETFR", 0},   {"$P_EXTFRAME", "$P_EXTFR", 1}, {"$P_PARTFRAME", "$P_PARTFR", 2},
    {"$P_TOOLFRAME", "$P_TOOLFR", 3}, {"$P_WPFRAME", "$P_WPFR", 4},   {"$P_CYCFRAME", "$P_CYCFR", 5},
    {"$P_TRAFRAME", "$P_TRAFR", 6},
};
inline constexpr std::string_view control_frames_datum = "$MC_MM_SYSTEM_FRAME_MASK";
inline constexpr unsigned usual_control_frames = 0x21;  ///< those of set actual value and of cycles

}  // namespace cnctrans::sinumerik
