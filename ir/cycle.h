// Canned cycles as one node each, with a complete, controller-neutral parameter set. Expansion: ir/cycles.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ir/axis.h"
#include "ir/value.h"

namespace cnctrans::ir {

/// From where a level along the tool axis is measured.
enum class LevelBase : std::uint8_t {
  absolute,        ///< coordinate in the current work frame
  from_initial,    ///< added to the height of the tool when the cycle starts
  from_reference,  ///< added to the reference (R) plane
  from_surface,    ///< added to the surface
  distance_mode    ///< absolute or added to `otherwise`, by the distance mode in force
};
struct Level {
  Value value;
  LevelBase base = LevelBase::absolute;
  LevelBase otherwise = LevelBase::from_initial;  ///< with `distance_mode`: the base under incremental
  bool given = false;
};

enum class HoleKind : std::uint8_t {
  drill,       ///< feed to the bottom, (dwell,) rapid out
  peck_full,   ///< pecks with full retract
  peck_break,  ///< pecks with a short lift
  tap,
  tap_floating,
  ream,
  bore,
  bore_stop,
  bore_shift,
  back_bore,
  bore_manual,
  mill  ///< pockets, slots, faces and bosses: see `MillWords`
};
/// What a cycle does with the spindle at one of its steps.
enum class SpindleStep : std::uint8_t {
  usual,  ///< what the kind does by itself
  none,   ///< nothing
  cw,
  ccw,
  off
};
/// How the pecks shrink.
enum class PeckLaw : std::uint8_t {
  none,
  constant,    ///< equal pecks, the last is the remainder
  count,       ///< `count` equal pecks: the bottom is reference + count * first
  arithmetic,  ///< each peck smaller by `degression`
  geometric,   ///< each peck the former times `degression`
  linear,      ///< from `first` evenly to `minimum` over n = max(2, ceil(2 D / (first + minimum))) pecks, D the depth
               ///< below the reference; then all times one factor, so that they end at the bottom
  balanced     ///< constant, but a last remainder below two pecks is shared between the last two
};
struct Pecks {
  PeckLaw law = PeckLaw::none;
  Value first;     ///< size of the first peck, unsigned (law `count`: signed along the axis)
  Level first_to;  ///< or: first peck ends at this level (when given)
  Value count;
  Value degression;
  Value minimum;
  Value lift;        ///< peck_break: height of the short lift; peck_full: 0
  Value reapproach;  ///< distance above the last bottom where feeding starts again
  bool reapproach_automatic =
      false;  ///< reapproach by rule of the source (0.6 mm up to depth 30, else depth/50, at most 7)
  bool withdraws_to_retract = false;  ///< peck_full: between the pecks up to the retract level, not the reference plane
  bool first_from_surface = false;    ///< pecks are counted from the surface, not from the reference plane
  bool lift_rapid = false;            ///< peck_break: the lift is a rapid, then rapid to `reapproach`; else at feed
  Value dwell;                        ///< seconds (after `dwell_scale`) after every peck but the last
  Value first_feed_factor;            ///< the first peck's feed is the feed times this, when `has_first_feed_factor`
  bool has_first_feed_factor = false;
};

/// What brings a modal cycle to life after its definition.
enum class CycleTrigger : std::uint8_t {
  plane_axis_word,  ///< every later block with a word of a plane axis
  path_motion       ///< every later block with path motion
};

/// Kind `mill`: a row of ir/cycles/milling/milling.h and its parameters by name.
struct MillWords {
  std::string shape;
  std::vector<std::pair<std::string, Value>> words;
};

struct HoleCycle {
  HoleKind kind = HoleKind::drill;
  AxisId axis = axis::none;  ///< tool axis; none: the normal of the plane in force
  Level surface;
  Level reference;  ///< R plane: rapid to here, feed from here
  Level bottom;
  Level retract;           ///< not given: by the retract plane setting (initial or reference)
  Value dwell_bottom;      ///< seconds (after `dwell_scale`); 0: none
  double dwell_scale = 1;  ///< the word's value times this is seconds (0.01: hundredths)
  bool dwell_in_revolutions = false;
  Value dwell_top;
  Value feed;  ///< feed into the hole when `has_feed`, else the feed in force
  bool has_feed = false;
  Value feed_out;
  bool has_feed_out = false;
  Pecks pecks;
  Value pitch;  ///< taps: mm per rev, + right hand
  bool rigid = false;
  Value orient_angle, shift_u, shift_v, shift_w;
  bool reference_may_be_below = false;
  bool approach_by_retract = false;  ///< first rapid to the retract level, then to the reference plane
  bool keeps_initial = false;        ///< changes words of the cycle in force, whose initial plane stays; does not run
  bool orient_first = false;         ///< taps: the spindle is oriented to `orient_angle` on the reference plane
  SpindleStep spindle_before = SpindleStep::usual;  ///< on the reference plane, before the feed; usual: nothing
  SpindleStep spindle_bottom = SpindleStep::usual;  ///< usual: taps reverse, spindle-stop boring stops
  SpindleStep spindle_after = SpindleStep::usual;   ///< usual: back to the sense before the cycle
  bool spindle_after_retract = false;               ///< `spindle_after` acts behind the retract, not before it
  Value speed;                                      ///< rev/min of the spindle in the cycle when `has_speed`
  bool has_speed = false;
  Value speed_out;  ///< rev/min on the way out when `has_speed_out`
  bool has_speed_out = false;
  MillWords mill;
};

/// A cycle that the IR carries by its source's own name and words until its node is written; see missing_features.
struct NamedCycle {
  std::string name;
  std::vector<std::pair<std::string, Value>> words;
};

struct Cycle {
  std::variant<HoleCycle, NamedCycle> node;
};
using CyclePtr = std::shared_ptr<const Cycle>;

std::string_view name(HoleKind k);
std::string_view name(LevelBase b);
std::string_view name(PeckLaw l);

}  // namespace cnctrans::ir
