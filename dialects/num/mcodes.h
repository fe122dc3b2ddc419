// M functions (reference 16): what they do and whether they act before or after the motion of their block. A machine
// profile may add to or change this table.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "ir/block.h"
#include "machine/profile.h"

namespace cnctrans::dialects::num {

struct MRow {
  std::int16_t code = -1;
  machine::MMeaning meaning = machine::MMeaning::machine_function;
  ir::Order order = ir::Order::before;
  std::int16_t argument = 0;  ///< gear number
  std::string_view title;
};

inline constexpr std::array m_codes{
    MRow{0, machine::MMeaning::stop, ir::Order::after, 0, "stop"},
    MRow{1, machine::MMeaning::optional_stop, ir::Order::after, 0, "optional stop"},
    MRow{2, machine::MMeaning::program_end, ir::Order::after, 0, "program end"},
    MRow{3, machine::MMeaning::spindle_cw, ir::Order::before, 0, "spindle clockwise"},
    MRow{4, machine::MMeaning::spindle_ccw, ir::Order::before, 0, "spindle counter-clockwise"},
    MRow{5, machine::MMeaning::spindle_stop, ir::Order::after, 0, "spindle stop"},
    MRow{6, machine::MMeaning::tool_change, ir::Order::after, 0, "tool change"},
    MRow{7, machine::MMeaning::coolant_mist, ir::Order::before, 0, "coolant 2"},
    MRow{8, machine::MMeaning::coolant_flood, ir::Order::before, 0, "coolant 1"},
    MRow{9, machine::MMeaning::coolant_off, ir::Order::after, 0, "coolants off"},
    MRow{10, machine::MMeaning::machine_function, ir::Order::after, 0, "clamp axes"},
    MRow{11, machine::MMeaning::machine_function, ir::Order::before, 0, "unclamp axes"},
    MRow{12, machine::MMeaning::stop, ir::Order::after, 0, "feed hold, spindle keeps turning"},
    MRow{19, machine::MMeaning::spindle_orient, ir::Order::before, 0, "spindle orientation to EC"},
    MRow{40, machine::MMeaning::gear, ir::Order::before, 0, "gear range"},
    MRow{41, machine::MMeaning::gear, ir::Order::before, 1, "gear range"},
    MRow{42, machine::MMeaning::gear, ir::Order::before, 2, "gear range"},
    MRow{43, machine::MMeaning::gear, ir::Order::before, 3, "gear range"},
    MRow{44, machine::MMeaning::gear, ir::Order::before, 4, "gear range"},
    MRow{45, machine::MMeaning::gear, ir::Order::before, 5, "gear range"},
    MRow{48, machine::MMeaning::none, ir::Order::after, 0, "overrides active"},
    MRow{49, machine::MMeaning::none, ir::Order::before, 0, "overrides forced to 100 %"},
    MRow{61, machine::MMeaning::machine_function, ir::Order::before, 0, "release the spindle"},
    MRow{62, machine::MMeaning::machine_function, ir::Order::before, 0, "command spindle 1"},
    MRow{63, machine::MMeaning::machine_function, ir::Order::before, 0, "command spindle 2"},
    MRow{64, machine::MMeaning::machine_function, ir::Order::before, 0, "command spindle 3"},
    MRow{65, machine::MMeaning::machine_function, ir::Order::before, 0, "command spindle 4"},
    MRow{66, machine::MMeaning::machine_function, ir::Order::before, 0, "measure spindle 1"},
    MRow{67, machine::MMeaning::machine_function, ir::Order::before, 0, "measure spindle 2"},
    MRow{68, machine::MMeaning::machine_function, ir::Order::before, 0, "measure spindle 3"},
    MRow{69, machine::MMeaning::machine_function, ir::Order::before, 0, "measure spindle 4"},
    MRow{997, machine::MMeaning::machine_function, ir::Order::before, 0, "force block concatenation"},
    MRow{998, machine::MMeaning::machine_function, ir::Order::before, 0, "allow edit, MDI and PLC calls"},
    MRow{999, machine::MMeaning::machine_function, ir::Order::before, 0, "inhibit edit, MDI and PLC calls"},
};

/// Decoded M functions that no neutral meaning tells from those of the machine builder; any number may stand together.
constexpr bool is_decoded_m(std::int64_t code) {
  return code == 10 || code == 11 || code >= 997;
}
/// Coded M functions that stay in force: the control takes one of them and one that does not per block.
constexpr bool is_modal_coded_m(std::int64_t code) {
  return code >= 61 && code <= 69;
}

}  // namespace cnctrans::dialects::num
