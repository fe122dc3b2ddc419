// M functions (§5.7). The order is the recommended setting of the M table; functions outside the table come before the
// motion. A machine profile overrides both.
#pragma once

#include <array>
#include <cstdint>

#include "ir/block.h"

namespace cnctrans::dialects::fagor {

enum class MKind : std::uint8_t {
  stop,
  optional_stop,
  program_end,
  spindle_cw,
  spindle_ccw,
  spindle_stop,
  tool_change,
  coolant_mist,
  coolant_flood,
  coolant_off,
  orient,
  gear,
  live_tool
};
/// Spindles by number: 1 the main one (G29), 2 the second one (G28), and the driven tool of M45.
inline constexpr std::uint8_t live_tool_spindle = 3;

struct MCode {
  std::int16_t code;
  MKind kind;
  ir::Order order;
};
inline constexpr std::array<MCode, 17> m_codes = {{
    {0, MKind::stop, ir::Order::after},
    {1, MKind::optional_stop, ir::Order::after},
    {2, MKind::program_end, ir::Order::after},
    {3, MKind::spindle_cw, ir::Order::before},
    {4, MKind::spindle_ccw, ir::Order::before},
    {5, MKind::spindle_stop, ir::Order::after},
    {6, MKind::tool_change, ir::Order::before},
    {7, MKind::coolant_mist, ir::Order::before},  // 7, 8, 9: usual meaning, not in the manual
    {8, MKind::coolant_flood, ir::Order::before},
    {9, MKind::coolant_off, ir::Order::before},
    {19, MKind::orient, ir::Order::before},
    {30, MKind::program_end, ir::Order::after},
    {41, MKind::gear, ir::Order::before},
    {42, MKind::gear, ir::Order::before},
    {43, MKind::gear, ir::Order::before},
    {44, MKind::gear, ir::Order::before},
    {45, MKind::live_tool, ir::Order::before},
}};

}  // namespace cnctrans::dialects::fagor
