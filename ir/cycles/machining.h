// Machining cycles of a lathe (stock removal, threads, grooves, drilling on the axis), carried as ir::NamedCycle with
// the names below, and their expansion into elementary moves.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/cycle.h"

namespace cnctrans::ir::cycles {

/// What a parameter is counted in.
enum class Quantity : std::uint8_t {
  cross,         ///< coordinate of X, as absolute words of it are meant (diameter or radius)
  along,         ///< coordinate of Z
  length,        ///< length in the unit in force; along X a radius
  feed,          ///< as F words
  centiseconds,  ///< hundredths of a second
  plain,         ///< degrees, counts, factors, codes, labels
  text           ///< names
};
/// What one unit of a word is in mm (radius), mm/min or mm/rev.
struct TurnUnits {
  double cross = 1, along = 1, length = 1, feed = 1;
};
double factor_of(Quantity quantity, const TurnUnits& units);
struct Parameter {
  std::string_view name;
  Quantity quantity;
};
/// The parameter; nullptr: machining cycles have none of this name.
const Parameter* find_parameter(std::string_view name);

enum class MachiningKind : std::uint8_t {
  straight,  ///< stock removal against a straight element, point to point
  arc,       ///< against an arc
  profile,   ///< against a profile of blocks, passes parallel to an axis
  copy,      ///< against a profile of blocks, passes parallel to the profile
  drill,     ///< on the axis: drilling in pecks, or tapping when the peck is 0
  thread,
  groove,      ///< plunges of equal distance
  shaped,      ///< a groove or relief whose shape the words of the cycle give
  live_drill,  ///< with a driven tool
  live_key
};
enum class CycleEnd : std::uint8_t {
  at_call,   ///< the tool is where the cycle was called
  approach,  ///< at (x, z), away from the work by the clearance
  elsewhere
};
struct MachiningCycle {
  std::string_view name;
  MachiningKind kind;
  bool face;        ///< infeed along Z, passes along X; else the other way round
  bool ends_comp;   ///< radius compensation is off afterwards
  bool ends_modes;  ///< rapid and absolute mode are in force afterwards
  CycleEnd ends = CycleEnd::at_call;
};
/// The family of cycles that machine the same part by other passes ("stock", "thread"); empty: it belongs to none.
std::string_view family_of(std::string_view cycle);
/// The cycle of a node; nullptr when the name is no machining cycle.
const MachiningCycle* find_machining(std::string_view name);

struct TurnPoint {
  double x = 0, z = 0;  ///< mm in the work frame, x as radius
};
/// One element of a profile in mm of the work frame.
struct ProfileElement {
  TurnPoint from, to;
  bool arc = false, ccw = false;  ///< the sense in the plane Z X
  TurnPoint centre;
};
/// The finished part, and the blank where it is given too.
struct TurnProfile {
  std::vector<ProfileElement> part, blank;
};
enum class TurnStep : std::uint8_t {
  rapid,
  feed,
  arc,
  thread,
  dwell,
  spindle_reverse,
  spindle_restore,
  spindle_stop,
  spindle_orient,         ///< to `start_angle`
  spindle_speed,          ///< `speed` rpm from here on, with `sense` also a command to turn
  spindle_cutting_speed,  ///< the same as a constant cutting speed, not above `limit` rpm
  live_run,               ///< the driven tool, `speed` rpm, negative: the other sense
  live_stop,
  comp_left,
  comp_right,
  comp_off
};
struct TurnMove {
  TurnStep step = TurnStep::rapid;
  TurnPoint to;
  bool has_feed = false;
  double feed = 0;  ///< replaces the feed in force
  TurnPoint centre;
  bool ccw = false;        ///< in the plane Z X
  double pitch = 0;        ///< thread: mm per rev along the axis it follows; 0: feed over spindle speed
  double start_angle = 0;  ///< degrees
  double pitch_change = 0;
  double seconds = 0;
  double speed = 0;
  double limit = 0;         ///< rpm; 0: none
  int sense = 0;            ///< +1 clockwise, -1 counter-clockwise, 0: as it turns
  bool per_minute = false;  ///< the feed in force is that of millimetres per minute, whatever the mode
  bool sharp = false;       ///< of a pass whose corners are cut sharp (exact stop), whatever path mode is in force
};
/// Parameters in mm (radius), degrees, seconds, by name; what the source left out is not there.
using TurnNumbers = std::map<std::string_view, double>;
/// What a cycle of stock removal leaves: the contour that its roughing comes down to, allowance included, and the one
/// that it finishes. In mm of the work frame; empty: it does not.
struct LeftContours {
  std::vector<ProfileElement> rough, finish;
  bool face = false;  ///< passes along X
  double out = 1;     ///< sense of X (with `face`: of Z) that leads away from the part
};
/// What the words of a cycle leave open and the machine decides.
enum class GrooveDepth : std::uint8_t { smaller, absolute, increment };
struct TurnChoices {
  bool part_at_plus = true;       ///< the part that is cut off lies toward +Z of its reference point
  bool parting_by_mode = false;   ///< a limit alone does not make the speed of parting off a cutting speed
  bool parting_stays = false;     ///< the variant may leave the tool at the final depth
  bool parting_restores = false;  ///< speed and mode of the spindle before it come back
  GrooveDepth groove_depth = GrooveDepth::smaller;
  bool groove_mirrored = false;  ///< the start of an alternating groove lies on the other side
  double groove_dwell = 0;       ///< seconds
};
struct TurnContext {
  TurnPoint start;                     ///< of the tool when the cycle is called
  double nose_width = 0;               ///< of the tool; 0: not known
  double nose_radius = 0;              ///< of the tool
  int edge = 0;                        ///< quadrant in which the tip lies (1: +Z +X, 2: -Z +X, 3: -Z -X, 4: +Z -X)
  bool edge_at_plus = false;           ///< of a grooving tool, where the quadrant is not known
  bool usual_relief = true;            ///< an undercut of an unknown edge lies outside, its shoulder toward -Z
  std::optional<bool> left_is_larger;  ///< the left start of a groove in the face lies at the larger X
  TurnChoices choices;
  std::optional<bool> longer_in_x;       ///< the tool is longer along X than along Z; nullopt: not known
  const TurnProfile* profile = nullptr;  ///< of the cycles that have one
  LeftContours* left = nullptr;          ///< wanted; stays empty for other cycles
};
/// A thread by its size, or in the words of a newer signature, as "thread.counted" with a pitch; nullopt: it is none.
std::optional<TurnNumbers> counted_thread_of(std::string_view cycle, const TurnNumbers& numbers);
/// The moves; nullopt and a sentence in `error` when the cycle makes no sense from this place or is not carried out.
std::optional<std::vector<TurnMove>> expand(const MachiningCycle& cycle, const TurnNumbers& numbers,
                                            const TurnContext& context, std::string* error);

}  // namespace cnctrans::ir::cycles
