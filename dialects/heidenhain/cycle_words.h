// The Q parameters of cycles (reference 16): what each number says, by which parameter of the IR, and the text that the
// editor shows behind it. A number says the same in every cycle, but for the rows that name their cycle.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cnctrans::dialects::heidenhain {

/// How the number of a parameter becomes what the IR has under `parameter`, and back.
enum class Role : std::uint8_t {
  // Levels along the tool axis
  surface,           ///< Q203: coordinate
  clearance,         ///< Q200: the reference plane lies so much above the surface; unsigned
  depth,             ///< Q201: from the surface to the bottom; negative goes into the work
  second_clearance,  ///< Q204: retract so much above the surface, where that is more than the clearance
  // Hole cycles
  feed,          ///< ir::HoleCycle::feed
  feed_out,      ///< ir::HoleCycle::feed_out; 0: the feed; FMAX or 99999: rapid
  dwell_bottom,  ///< seconds
  dwell_top,     ///< seconds after each full retract
  peck,          ///< ir::Pecks::first, unsigned
  degression,    ///< each peck smaller by it
  least_peck,    ///< not below
  chip_breaks,   ///< full retract after so many short lifts
  break_depth,   ///< a short lift after so much depth; 0: none
  lift,          ///< height of the short lift
  lift_factor,   ///< the same in pitches; 0: full retract
  first_stop,    ///< distance above the last depth where feeding starts again, first peck
  last_stop,     ///< ... last peck
  deeper_start,  ///< the hole is there already down to so much below the surface
  tip,           ///< 0: the depth is that of the tip, 1: of the full diameter (needs the point angle)
  pitch,         ///< mm, + right hand, - left hand
  orient,        ///< spindle angle
  freed_side,    ///< 0 none, 1 -main, 2 -minor, 3 +main, 4 +minor axis
  speed_factor,  ///< of the retract, times the speed
  choice,        ///< 0 or 1: which of two others counts
  countersink,   ///< diameter that the point of the tool makes; the sign is the direction
  // Milling cycles (HoleKind::mill): `parameter` is that of ir/cycles/milling/milling
  mill,            ///< as it is
  mill_half,       ///< a diameter, of which the IR has the radius
  mill_overlap,    ///< times the tool's radius is the step: half of `step_factor`
  mill_climb,      ///< +1 climb -> sense 0, -1 conventional -> sense 1
  mill_blank,      ///< what is there before finishing: from the other sizes
  mill_feed_word,  ///< a feed; 0, FMAX and 99999 are no feed of milling
  place,           ///< Q367: where in the shape the tool stands
  plunge_way,      ///< 0 straight down, 1 helix, 2 ramp
  // Patterns: `parameter` is that of ir/cycles/pattern
  pattern,
  pattern_half,
  arc_way,         ///< 0 straight from point to point, 1 along the circle
  height_between,  ///< 0 on the clearance, 1 on the second clearance
  stop_angle,      ///< Q246: counts where the step is 0
  // Others
  other  ///< by the cycle itself
};

struct QWord {
  std::int16_t number;
  Role role;
  std::string_view parameter;  ///< in the IR
  std::string_view text;       ///< behind `;` in the editor
  std::int16_t cycle = 0;      ///< only in this cycle; 0: in all others
};

// clang-format off
inline constexpr std::array q_words{
    // Levels
    QWord{200, Role::clearance, "reference", "SET-UP CLEARANCE"},
    QWord{201, Role::depth, "bottom", "DEPTH"},
    QWord{203, Role::surface, "surface", "SURFACE COORDINATE"},
    QWord{204, Role::second_clearance, "retract", "2ND SET-UP CLEARANCE"},
    // Holes
    QWord{202, Role::peck, "infeed", "PLUNGING DEPTH"},
    QWord{202, Role::mill, "finish_infeed", "PLUNGING DEPTH", 212},
    QWord{202, Role::mill, "finish_infeed", "PLUNGING DEPTH", 214},
    QWord{206, Role::feed, "plunge_feed", "FEED RATE FOR PLNGNG"},
    QWord{208, Role::feed_out, "", "RETRACTION FEED RATE"},
    QWord{210, Role::dwell_top, "", "DWELL TIME AT TOP"},
    QWord{211, Role::dwell_bottom, "", "DWELL TIME AT DEPTH"},
    QWord{212, Role::degression, "", "DECREMENT"},
    QWord{205, Role::least_peck, "", "MIN. PLUNGING DEPTH"},
    QWord{213, Role::chip_breaks, "", "NR OF BREAKS"},
    QWord{214, Role::freed_side, "", "DISENGAGING DIRECTN"},
    QWord{239, Role::pitch, "pitch", "THREAD PITCH"},
    QWord{249, Role::depth, "", "DEPTH OF COUNTERBORE"},
    QWord{250, Role::other, "", "MATERIAL THICKNESS"},
    QWord{251, Role::other, "", "OFF-CENTER DISTANCE"},
    QWord{252, Role::other, "", "TOOL EDGE HEIGHT"},
    QWord{253, Role::other, "", "F PRE-POSITIONING"},
    QWord{254, Role::feed, "", "F COUNTERBORING"},
    QWord{255, Role::dwell_bottom, "", "DWELL TIME"},
    QWord{256, Role::lift, "", "DIST FOR CHIP BRKNG"},
    QWord{256, Role::lift_factor, "", "DIST FOR CHIP BRKNG", 209},
    QWord{257, Role::break_depth, "", "DEPTH FOR CHIP BRKNG"},
    QWord{258, Role::first_stop, "", "UPPER ADV STOP DIST"},
    QWord{259, Role::last_stop, "", "LOWER ADV STOP DIST"},
    QWord{334, Role::mill, "pitch", "PLUNGING DEPTH"},
    QWord{335, Role::mill, "diameter", "NOMINAL DIAMETER"},
    QWord{336, Role::orient, "", "ANGLE OF SPINDLE"},
    QWord{342, Role::other, "", "ROUGHING DIAMETER"},
    QWord{343, Role::choice, "", "SELECT DEPTH/DIA."},
    QWord{344, Role::countersink, "", "DIAMETER"},
    QWord{379, Role::deeper_start, "", "STARTING POINT"},
    QWord{395, Role::tip, "", "DEPTH REFERENCE"},
    QWord{403, Role::speed_factor, "", "RPM FACTOR"},
    QWord{426, Role::other, "", "DIR. OF SPINDLE ROT."},
    QWord{427, Role::other, "", "ROT.SPEED INFEED/OUT"},
    QWord{428, Role::other, "", "ROT. SPEED DRILLING"},
    QWord{429, Role::other, "", "COOLANT ON"},
    QWord{430, Role::other, "", "COOLANT OFF"},
    QWord{435, Role::other, "", "DWELL DEPTH"},
    // Threads
    QWord{355, Role::other, "", "THREADS PER STEP"},
    QWord{356, Role::other, "", "COUNTERSINKING DEPTH"},
    QWord{357, Role::other, "", "CLEARANCE TO SIDE"},
    QWord{358, Role::other, "", "DEPTH AT FRONT"},
    QWord{359, Role::other, "", "OFFSET AT FRONT"},
    QWord{360, Role::other, "", "COUNTERSINKING"},
    QWord{512, Role::other, "", "FEED FOR APPROACH"},
    // Pockets, slots, studs
    QWord{207, Role::mill_feed_word, "mill_feed", "FEED RATE FOR MILLING"},
    QWord{215, Role::mill, "operation", "MACHINING OPERATION"},
    QWord{218, Role::mill, "length", "FIRST SIDE LENGTH"},
    QWord{218, Role::mill, "length", "SLOT LENGTH", 253},
    QWord{219, Role::mill, "width", "SECOND SIDE LENGTH"},
    QWord{219, Role::mill, "width", "SLOT WIDTH", 253},
    QWord{219, Role::mill, "width", "SLOT WIDTH", 254},
    QWord{220, Role::mill, "corner", "CORNER RADIUS"},
    QWord{221, Role::mill, "wall_stock", "ALLOWANCE IN 1ST AX."},
    QWord{221, Role::mill_blank, "", "ALLOWANCE IN 1ST AX.", 213},
    QWord{222, Role::mill, "blank_diameter", "WORKPIECE BLANK DIA."},
    QWord{222, Role::mill_blank, "", "WORKPIECE BLANK DIA.", 214},
    QWord{223, Role::mill_half, "radius", "CIRCLE DIAMETER"},
    QWord{223, Role::mill, "diameter", "FINISHED PART DIA.", 257},
    QWord{223, Role::mill, "diameter", "FINISHED PART DIA.", 215},
    QWord{224, Role::mill, "angle", "ANGLE OF ROTATION"},
    QWord{224, Role::pattern, "angle", "ANGLE OF ROTATION", 221},
    QWord{248, Role::mill, "opening", "ANGULAR LENGTH"},
    QWord{338, Role::mill, "finish_infeed", "INFEED FOR FINISHING"},
    QWord{351, Role::mill_climb, "sense", "CLIMB OR UP-CUT"},
    QWord{366, Role::plunge_way, "", "PLUNGE"},
    QWord{367, Role::place, "", "POCKET POSITION"},
    QWord{367, Role::place, "", "SLOT POSITION", 253},
    QWord{367, Role::place, "", "REF. SLOT POSITION", 254},
    QWord{367, Role::place, "", "STUD POSITION", 256},
    QWord{368, Role::mill, "wall_stock", "ALLOWANCE FOR SIDE"},
    QWord{369, Role::mill, "floor_stock", "ALLOWANCE FOR FLOOR"},
    QWord{370, Role::mill_overlap, "step_factor", "TOOL PATH OVERLAP"},
    QWord{374, Role::mill, "angle", "ANGLE OF ROTATION"},
    QWord{375, Role::mill_half, "radius", "PITCH CIRCLE DIA."},
    QWord{376, Role::mill, "angle", "STARTING ANGLE"},
    QWord{377, Role::mill, "count", "NR OF REPETITIONS"},
    QWord{378, Role::mill, "angle_step", "STEPPING ANGLE"},
    QWord{385, Role::mill_feed_word, "finish_feed", "FINISHING FEED RATE"},
    QWord{424, Role::mill, "blank_length", "WORKPC. BLANK SIDE 1"},
    QWord{425, Role::mill, "blank_width", "WORKPC. BLANK SIDE 2"},
    QWord{437, Role::other, "", "APPROACH POSITION"},
    QWord{439, Role::other, "", "FEED RATE REFERENCE"},
    // Patterns
    QWord{216, Role::mill, "u", "CENTER IN 1ST AXIS"},
    QWord{216, Role::pattern, "u", "CENTER IN 1ST AXIS", 220},
    QWord{217, Role::mill, "v", "CENTER IN 2ND AXIS"},
    QWord{217, Role::pattern, "v", "CENTER IN 2ND AXIS", 220},
    QWord{225, Role::pattern, "u", "STARTNG PNT 1ST AXIS"},
    QWord{226, Role::pattern, "v", "STARTNG PNT 2ND AXIS"},
    QWord{237, Role::pattern, "step", "SPACING IN 1ST AXIS"},
    QWord{238, Role::pattern, "step2", "SPACING IN 2ND AXIS"},
    QWord{241, Role::pattern, "count", "NR OF REPETITIONS"},
    QWord{242, Role::pattern, "count", "NUMBER OF COLUMNS"},
    QWord{243, Role::pattern, "count2", "NUMBER OF LINES"},
    QWord{244, Role::pattern_half, "radius", "PITCH CIRCLE DIA."},
    QWord{244, Role::mill_half, "radius", "PITCH CIRCLE DIA.", 211},
    QWord{245, Role::pattern, "angle", "STARTING ANGLE"},
    QWord{245, Role::mill, "angle", "STARTING ANGLE", 211},
    QWord{246, Role::stop_angle, "", "STOPPING ANGLE"},
    QWord{247, Role::pattern, "angle_step", "STEPPING ANGLE"},
    QWord{301, Role::height_between, "", "MOVE TO CLEARANCE"},
    QWord{365, Role::arc_way, "", "TYPE OF TRAVERSE"},
    // Faces
    QWord{209, Role::other, "", "CROSS FEED RATE"},
    QWord{227, Role::surface, "surface", "STARTNG PNT 3RD AXIS"},
    QWord{228, Role::other, "", "2ND POINT 1ST AXIS"},
    QWord{229, Role::other, "", "2ND POINT 2ND AXIS"},
    QWord{230, Role::other, "", "2ND POINT 3RD AXIS"},
    QWord{231, Role::other, "", "3RD POINT 1ST AXIS"},
    QWord{232, Role::other, "", "3RD POINT 2ND AXIS"},
    QWord{233, Role::other, "", "3RD POINT 3RD AXIS"},
    QWord{234, Role::other, "", "4TH POINT 1ST AXIS"},
    QWord{235, Role::other, "", "4TH POINT 2ND AXIS"},
    QWord{236, Role::other, "", "4TH POINT 3RD AXIS"},
    QWord{240, Role::other, "", "NUMBER OF CUTS"},
    QWord{386, Role::other, "", "END POINT 3RD AXIS"},
    QWord{389, Role::other, "", "STRATEGY"},
    QWord{339, Role::other, "", "DATUM NUMBER"},
    // Contour pockets (SL)
    QWord{1, Role::depth, "bottom", "MILLING DEPTH"},
    QWord{2, Role::mill_overlap, "step_factor", "TOOL PATH OVERLAP"},
    QWord{3, Role::mill, "wall_stock", "ALLOWANCE FOR SIDE"},
    QWord{4, Role::mill, "floor_stock", "ALLOWANCE FOR FLOOR"},
    QWord{5, Role::surface, "surface", "SURFACE COORDINATE"},
    QWord{6, Role::clearance, "reference", "SET-UP CLEARANCE"},
    QWord{7, Role::other, "retract", "CLEARANCE HEIGHT"},
    QWord{8, Role::other, "", "ROUNDING RADIUS"},
    QWord{9, Role::mill_climb, "sense", "ROTATIONAL DIRECTION"},
    QWord{10, Role::mill, "infeed", "PLUNGING DEPTH"},
    QWord{11, Role::mill_feed_word, "plunge_feed", "FEED RATE FOR PLNGNG"},
    QWord{12, Role::mill_feed_word, "mill_feed", "FEED RATE FOR ROUGHNG"},
    QWord{13, Role::other, "tool", "ROUGH-OUT TOOL"},
    QWord{14, Role::mill, "wall_stock", "ALLOWANCE FOR SIDE"},
    QWord{15, Role::other, "", "CLIMB OR UP-CUT"},
    QWord{18, Role::other, "", "COARSE ROUGHING TOOL"},
    QWord{19, Role::other, "", "FEED RATE FOR RECIP."},
    QWord{401, Role::other, "", "FEED RATE FACTOR"},
    QWord{404, Role::other, "", "FINE ROUGH STRATEGY"},
    QWord{438, Role::other, "", "ROUGH-OUT TOOL"},
    QWord{446, Role::other, "", "RESIDUAL MATERIAL"},
    QWord{447, Role::other, "", "CONNECTION DISTANCE"},
    QWord{448, Role::other, "", "PATH EXTENSION"},
    QWord{390, Role::other, "", "TYPE OF APPROACH"},
    QWord{391, Role::other, "", "RADIUS COMPENSATION"},
    QWord{392, Role::other, "", "RADIUS"},
    QWord{393, Role::other, "", "CENTER ANGLE"},
    QWord{394, Role::other, "", "DISTANCE"},
};
// clang-format on

/// The row of parameter Q`number` in `cycle`; nullptr: no cycle has it.
constexpr const QWord* find_q_word(std::int64_t number, std::int64_t cycle) {
  const QWord* found = nullptr;
  for (const auto& w : q_words) {
    if (w.number != number) continue;
    if (w.cycle == cycle) return &w;
    if (w.cycle == 0) found = &w;
  }
  return found;
}

}  // namespace cnctrans::dialects::heidenhain
