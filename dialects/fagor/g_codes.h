// G functions (§5.1 and the chapter of each): model, modal group, what it does in IR terms.
// The same number means different things on the lathe (T) and on the mill (M).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "ir/axis.h"
#include "ir/modal.h"

namespace cnctrans::dialects::fagor {

enum class Model : std::uint8_t { lathe = 1, mill = 2, both = 3 };

/// Two functions of one group don't share a block (error 7); `none` is not modal.
enum class Group : std::uint8_t {
  none,
  motion,
  corner,
  mirror,
  plane,
  feed,
  speed_mode,
  compensation,
  units,
  distance,
  diameter,
  offset,
  retract,
  length,
  other_modal
};

/// What a frontend does with it. `value` and `motion` of the row say which.
enum class Use : std::uint8_t {
  motion,           ///< G0 G1 G2 G3 G33 G34
  setting,          ///< `setting` becomes `value`
  setting_after,    ///< the same, for the blocks that follow
  compensation,     ///< G40 G41 G42; N is collision detection
  plane,            ///< G17 G18 G19
  plane_axes,       ///< G16 with two axes
  longitudinal,     ///< G15 of the mill: the axis of tool length and cycles
  c_axis,           ///< G15 of the lathe: the spindle is the C axis; R: radius of the cylinder that is unrolled
  dwell,            ///< G4
  absolute_centre,  ///< G6
  tangent_arc,      ///< G8
  three_point_arc,  ///< G9
  mirror_off,
  mirror_axis,
  mirror_axes,
  round,
  chamfer,
  tangent_entry,
  tangent_exit,
  look_ahead,           ///< G51
  soft_corner,          ///< G50
  machine_coordinates,  ///< G53
  work_offset,          ///< row `value`
  table_shift,          ///< G58 G59: row `value`, added to the offset in force
  numbered_offset,      ///< G159 N
  shift,                ///< G158
  preset,               ///< G92
  pole,                 ///< G93
  scale,                ///< G72
  rotation,             ///< G73
  inclined_plane,       ///< G49: origin, then turns about the axes
  home,                 ///< G74
  straight,             ///< G52 G75 G76: one straight move of its own; `motion`; leaves G01 and G40
  spindle_choice,       ///< G28 G29 without axes: `value` is the spindle of the blocks that follow
  spindle_couple,       ///< G30 G77S G78S: the second spindle follows the main one
  hole_cycle,           ///< `value`: the code: letters in hole_cycles
  cycle_cancel,
  cycle_change,  ///< G79
  machining,     ///< a cycle of the lathe; letters in cycle_rows
  pattern,       ///< multiple machining of the mill; letters in pattern_rows
  pocket,        ///< irregular pockets of the mill; letters in pocket_rows
  call,          ///< G180..G189, G380..G399: subroutine of the same number
  no_path,       ///< no effect on the path: carried with a note; `feature`
  refused        ///< not translated yet; `feature` is the key in the missing-features registry
};

struct GCode {
  std::int16_t code;
  Model model;
  Group group;
  Use use;
  ir::Setting setting = ir::Setting::plane;
  std::uint8_t value = 0;
  ir::MotionKind motion = ir::MotionKind::modal;
  bool alone = false;             ///< no other G function, and no words but its own
  std::string_view section = {};  ///< of the manual; "25.n": mill model
  std::string_view title = {};    ///< what it is, for messages; empty where the program says it all
  std::string_view feature = {};
};

inline constexpr int max_g_code = 399;

/// Letters of a hole cycle of the mill besides the point, the reference plane and I (25.3, 28.6).
struct HoleLetters {
  int code;
  std::string_view mandatory;
  std::string_view optional;
  std::string_view kept;  ///< read, but without a sure meaning: a block with one of them is kept as text
};
inline constexpr HoleLetters hole_letters[] = {
    {69, "B", "CDKLR", "HJ"}, {81, "", "K", ""},       {82, "K", "", ""},    {83, "J", "", ""},
    {84, "", "KR", "J"},      {85, "", "K", ""},       {86, "", "K", "QDE"}, {89, "", "K", ""},
    {87, "JKB", "CDHLV", ""}, {88, "JB", "CDHLV", ""},
};

std::span<const GCode> g_codes();
/// Row of a G function of a model; nullptr when the model has no such function.
const GCode* find_g(int code, bool lathe);

}  // namespace cnctrans::dialects::fagor
