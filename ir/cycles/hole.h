// Expansion of a hole cycle into elementary moves.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ir/cycle.h"
#include "ir/modal.h"

namespace cnctrans::ir::cycles {

/// The circumstances in which the words of a cycle are read.
struct HoleContext {
  double length_unit = 1;  ///< mm in one unit of depths, distances, pitches
  double level_unit = 1;   ///< mm (radius) in one unit of a coordinate along the tool axis
  double feed_unit = 1;    ///< factor of feed words (25.4 when they are in inches)
  Distance distance = Distance::absolute;
  double height = 0;  ///< of the tool when the cycle is defined: mm in the work frame
};

/// A hole cycle in numbers: levels are absolute along the tool axis in the work frame (mm), lengths mm, times s.
struct HoleNumbers {
  HoleKind kind = HoleKind::drill;
  double initial = 0;  ///< height when the cycle was defined
  double surface = 0, reference = 0, bottom = 0;
  bool has_retract = false;
  double retract = 0;
  double up = 1;  ///< +1: the tool leaves toward plus
  double dwell_bottom = 0, dwell_top = 0, dwell_peck = 0;
  bool dwell_in_revolutions = false;
  bool has_feed = false, has_feed_out = false;
  double feed = 0, feed_out = 0;
  PeckLaw law = PeckLaw::none;
  double first = 0, count = 0, degression = 0, minimum = 0;  ///< sizes unsigned
  double lift = 0, reapproach = 0;
  bool reapproach_automatic = false, from_surface = false, lift_rapid = false, withdraws_to_retract = false,
       approach_by_retract = false;
  double first_feed_factor = 1;
  double pitch = 0;  ///< mm per rev; 0: feed over spindle speed
  double orient_angle = 0, shift_u = 0, shift_v = 0, shift_w = 0;
  bool orient_first = false, rigid = false;
  SpindleStep spindle_before = SpindleStep::usual, spindle_bottom = SpindleStep::usual,
              spindle_after = SpindleStep::usual;
  bool spindle_after_retract = false;
  bool told_in_full = false;  ///< stops at the reference plane on the way out; a tap says each turn of its spindle
  bool has_speed = false, has_speed_out = false;
  double speed = 0, speed_out = 0;  ///< rev/min
};

/// Value of a word; nullopt when it is not known (then resolve() gives up without a text).
using Evaluate = std::function<std::optional<double>(const Value&)>;

/// nullopt with a sentence in `error` when the cycle makes no sense (no bottom, no depth, a peck of nothing), or
/// without one when `evaluate` gave up.
std::optional<HoleNumbers> resolve(const HoleCycle& cycle, const HoleContext& context, const Evaluate& evaluate,
                                   std::string* error);

enum class CycleStep : std::uint8_t {
  rapid,            ///< to `w` (and `du`, `dv`)
  feed,             ///< to `w` at feed
  thread,           ///< to `w`, `pitch` per revolution
  dwell,            ///< `amount` seconds or revolutions
  spindle_reverse,  ///< the sense opposite to the one at the start of the cycle
  spindle_restore,  ///< the sense at the start of the cycle
  spindle_stop,
  spindle_cw,
  spindle_ccw,
  spindle_speed,   ///< `amount` rev/min from here on
  spindle_orient,  ///< to `amount` degrees
  operator_stop
};
struct CycleMove {
  CycleStep step = CycleStep::rapid;
  double w = 0;           ///< height along the tool axis, mm, absolute in the work frame
  double du = 0, dv = 0;  ///< offset from the hole's place in the plane, mm
  bool has_feed = false;  ///< `feed` replaces the feed in force
  double feed = 0;
  double feed_factor = 1;  ///< times the feed
  double pitch = 0;        ///< thread; 0: feed over spindle speed
  double amount = 0;
  bool revolutions = false;
};

/// Where the tool stands after a hole: the given retract level, else the initial or the reference plane.
double retract_level(const HoleNumbers& hole, RetractPlane plane);

/// The moves of one hole; the tool stands over it at `height`. Empty and a text in `error` for a kind that is not
/// carried.
std::vector<CycleMove> expand(const HoleNumbers& hole, double height, RetractPlane plane, std::string* error);

/// The schedule of pecks over `depth` (> 0): sizes in order, their sum is `depth`. One entry when there is no law.
std::vector<double> peck_sizes(const HoleNumbers& hole, double depth);

/// The words by which a pocket names its own place in the plane; null: it lies where the tool stands.
std::pair<const Value*, const Value*> own_place(const HoleCycle& cycle);
/// A hole, or a pocket where the tool stands (`own_too`: or where its words say): the tool ends over its middle, in the
/// plane in force.
bool ends_over_its_place(const HoleCycle& cycle, bool own_too = false);

}  // namespace cnctrans::ir::cycles
