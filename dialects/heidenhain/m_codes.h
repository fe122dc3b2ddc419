// M functions (reference 10): what they do and whether they act before or after the motion of their block. A machine
// profile may add to or change this table.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "ir/block.h"
#include "machine/profile.h"

namespace cnctrans::dialects::heidenhain {

/// What reading makes of an M function beyond its machine meaning.
enum class MUse : std::uint8_t {
  plain,             ///< by its meaning
  coolant_too,       ///< M13, M14: the coolant comes on as well
  machine_position,  ///< M91: the coordinates of the block are those of the machine
  maker_position,    ///< M92: the same, from a point that the machine maker chose
  untilted,          ///< M130: coordinates of the plane that is not tilted
  call_once,         ///< M99: the machining cycle in force, after the block
  call_modal,        ///< M89: after this and every later positioning block
  per_rev,           ///< M136
  per_minute,        ///< M137
  retract,           ///< M140: along the tool axis
  contact_feed,      ///< M109, M110: F counts at the edge of the tool on arcs
  centre_feed,       ///< M111
  kept,              ///< no effect on the programmed path: kept as text
  rotary_feed,       ///< M116: left out with a warning
  compensated,       ///< changes what the control makes of the programmed path: left out with a warning
  frames_off,        ///< M142: no shift, mirror, rotation, scale is in force behind it
  plunge_feed,       ///< M103: a share of F for what goes into the material
  shortest,          ///< M126: rotary axes the shortest way
  tip,               ///< M114, M128: the words are those of the tool's tip
  path               ///< changes the path in a way that is not carried: refused
};
struct MRow {
  std::int16_t code = -1;
  machine::MMeaning meaning = machine::MMeaning::machine_function;
  ir::Order order = ir::Order::before;
  MUse use = MUse::plain;
  std::string_view title;
};

// clang-format off
inline constexpr std::array m_codes{
    MRow{0, machine::MMeaning::stop, ir::Order::after, MUse::plain, "stop, spindle and coolant off"},
    MRow{1, machine::MMeaning::optional_stop, ir::Order::after, MUse::plain, "optional stop"},
    MRow{2, machine::MMeaning::program_end, ir::Order::after, MUse::plain, "program end"},
    MRow{3, machine::MMeaning::spindle_cw, ir::Order::before, MUse::plain, "spindle clockwise"},
    MRow{4, machine::MMeaning::spindle_ccw, ir::Order::before, MUse::plain, "spindle counter-clockwise"},
    MRow{5, machine::MMeaning::spindle_stop, ir::Order::after, MUse::plain, "spindle stop"},
    MRow{6, machine::MMeaning::tool_change, ir::Order::after, MUse::plain, "tool change"},
    MRow{8, machine::MMeaning::coolant_flood, ir::Order::before, MUse::plain, "coolant on"},
    MRow{9, machine::MMeaning::coolant_off, ir::Order::after, MUse::plain, "coolant off"},
    MRow{13, machine::MMeaning::spindle_cw, ir::Order::before, MUse::coolant_too, "M3 and M8"},
    MRow{14, machine::MMeaning::spindle_ccw, ir::Order::before, MUse::coolant_too, "M4 and M8"},
    MRow{19, machine::MMeaning::spindle_orient, ir::Order::after, MUse::plain, "spindle to the angle of cycle 13"},
    MRow{20, machine::MMeaning::spindle_orient, ir::Order::after, MUse::plain, "spindle to the angle of cycle 13"},
    MRow{30, machine::MMeaning::program_end, ir::Order::after, MUse::plain, "program end"},
    MRow{89, machine::MMeaning::none, ir::Order::after, MUse::call_modal, "cycle call after every positioning block"},
    MRow{90, machine::MMeaning::none, ir::Order::before, MUse::kept, "constant speed at corners"},
    MRow{91, machine::MMeaning::none, ir::Order::before, MUse::machine_position, "coordinates of the machine"},
    MRow{92, machine::MMeaning::none, ir::Order::before, MUse::maker_position, "coordinates from the maker's point"},
    MRow{94, machine::MMeaning::none, ir::Order::before, MUse::kept, "rotary display below 360 degrees"},
    MRow{97, machine::MMeaning::none, ir::Order::after, MUse::compensated, "small steps of a compensated contour"},
    MRow{98, machine::MMeaning::none, ir::Order::after, MUse::compensated, "open corners of a contour to their end"},
    MRow{99, machine::MMeaning::none, ir::Order::after, MUse::call_once, "cycle call"},
    MRow{101, machine::MMeaning::none, ir::Order::after, MUse::kept, "replacement tool"},
    MRow{102, machine::MMeaning::none, ir::Order::after, MUse::kept, "no replacement tool"},
    MRow{103, machine::MMeaning::none, ir::Order::before, MUse::plunge_feed, "smaller feed into the material"},
    MRow{107, machine::MMeaning::none, ir::Order::after, MUse::kept, "replacement tool may be larger"},
    MRow{108, machine::MMeaning::none, ir::Order::after, MUse::kept, "M107 off"},
    MRow{109, machine::MMeaning::none, ir::Order::before, MUse::contact_feed, "feed at the edge on all arcs"},
    MRow{110, machine::MMeaning::none, ir::Order::before, MUse::contact_feed, "feed at the edge on inner arcs"},
    MRow{111, machine::MMeaning::none, ir::Order::after, MUse::centre_feed, "feed of the tool's middle"},
    MRow{112, machine::MMeaning::none, ir::Order::before, MUse::kept, "corner transitions"},
    MRow{113, machine::MMeaning::none, ir::Order::after, MUse::kept, "M112 off"},
    MRow{114, machine::MMeaning::none, ir::Order::before, MUse::tip, "tilted axes move the linear ones along"},
    MRow{115, machine::MMeaning::none, ir::Order::after, MUse::kept, "M114 off"},
    MRow{116, machine::MMeaning::none, ir::Order::before, MUse::rotary_feed, "feed of rotary axes in mm/min"},
    MRow{117, machine::MMeaning::none, ir::Order::after, MUse::kept, "M116 off"},
    MRow{118, machine::MMeaning::none, ir::Order::before, MUse::kept, "handwheel beside the path"},
    MRow{120, machine::MMeaning::none, ir::Order::before, MUse::compensated, "contour looked ahead under compensation"},
    MRow{124, machine::MMeaning::none, ir::Order::before, MUse::compensated, "points near to one another left out"},
    MRow{126, machine::MMeaning::none, ir::Order::before, MUse::shortest, "rotary axes the shortest way"},
    MRow{127, machine::MMeaning::none, ir::Order::after, MUse::kept, "M126 off"},
    MRow{128, machine::MMeaning::none, ir::Order::before, MUse::tip, "tip stays where it is when axes tilt"},
    MRow{129, machine::MMeaning::none, ir::Order::after, MUse::kept, "M128 off"},
    MRow{130, machine::MMeaning::none, ir::Order::before, MUse::untilted, "coordinates of the plane not tilted"},
    MRow{134, machine::MMeaning::none, ir::Order::before, MUse::kept, "exact stop of rotary axes"},
    MRow{135, machine::MMeaning::none, ir::Order::after, MUse::kept, "M134 off"},
    MRow{136, machine::MMeaning::none, ir::Order::before, MUse::per_rev, "feed per revolution"},
    MRow{137, machine::MMeaning::none, ir::Order::after, MUse::per_minute, "feed per minute"},
    MRow{138, machine::MMeaning::none, ir::Order::before, MUse::path, "which axes tilt"},
    MRow{140, machine::MMeaning::none, ir::Order::before, MUse::retract, "back along the tool axis"},
    MRow{141, machine::MMeaning::none, ir::Order::before, MUse::kept, "probe not watched"},
    MRow{142, machine::MMeaning::none, ir::Order::before, MUse::frames_off, "modal program information is deleted"},
    MRow{143, machine::MMeaning::none, ir::Order::before, MUse::kept, "basic rotation is deleted"},
    MRow{144, machine::MMeaning::none, ir::Order::before, MUse::path, "kinematics counted at the block's end"},
    MRow{145, machine::MMeaning::none, ir::Order::after, MUse::kept, "M144 off"},
    MRow{148, machine::MMeaning::none, ir::Order::before, MUse::kept, "tool leaves the contour on a stop"},
    MRow{149, machine::MMeaning::none, ir::Order::after, MUse::kept, "M148 off"},
    MRow{150, machine::MMeaning::none, ir::Order::before, MUse::kept, "message of a limit switch suppressed"},
};
// clang-format on

constexpr const MRow* m_row(std::int64_t code) {
  for (const auto& r : m_codes) {
    if (r.code == code) return &r;
  }
  return nullptr;
}

}  // namespace cnctrans::dialects::heidenhain
