// Milling cycles (pockets, slots, faces, bosses): shapes and their parameters, and their expansion into elementary
// moves. A milling cycle is a HoleCycle of kind `mill`: its levels are those of a hole, its words are `MillWords`.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ir/cycles/hole.h"

namespace cnctrans::ir::cycles {

struct MillContour;

/// What a parameter is counted in.
enum class MillQuantity : std::uint8_t {
  place_u,  ///< coordinate of the plane's first axis in the work frame
  place_v,  ///< of its second axis
  length,   ///< length in the unit in force
  feed,     ///< as F words
  plain     ///< degrees, counts, codes, factors, rev/min
};
struct MillParameter {
  std::string_view name;
  MillQuantity quantity;
  std::string_view meaning;
};
std::span<const MillParameter> mill_parameters();
/// nullptr: milling cycles have none of this name.
const MillParameter* find_mill_parameter(std::string_view name);

enum class MillKind : std::uint8_t {
  rectangle,
  circle,
  slot,
  long_hole,
  ring_slot,
  face,
  boss,
  round_boss,
  thread,
  helix_bore,
  helix_thread,  ///< by the pitch, from the middle
  path,
  contour_pocket,
  chased  ///< a thread by a single point, pass by pass along the tool axis
};
struct MillShape {
  std::string_view name;  ///< `MillWords::shape`
  MillKind kind;
  std::string_view parameters;  ///< separated by one comma each
  std::string_view title;       ///< for people
};
std::span<const MillShape> mill_shapes();
/// nullptr: no such shape.
const MillShape* find_mill_shape(std::string_view name);

/// What one unit of a word is in mm (mm/min for feeds).
struct MillUnits {
  double u = 1, v = 1, length = 1, feed = 1;
};
/// Parameters in mm, degrees and mm/min by name; what the source left out is not there.
struct MillNumbers {
  const MillShape* shape = nullptr;
  std::map<std::string_view, double> words;
  std::optional<double> tool_radius;  ///< mm, where the program itself says it: before what a table of tools says
};
/// nullopt with a sentence in `error`: no such shape or parameter; without one: `evaluate` gave up.
std::optional<MillNumbers> resolve(const MillWords& words, const MillUnits& units, const Evaluate& evaluate,
                                   std::string* error);

/// A word that a control's own cycle is written with and that changes no move ("kept.DMODE").
inline constexpr std::string_view kept_word = "kept.";
/// MillNumbers::tool_radius, a number in mm.
inline constexpr std::string_view tool_radius_word = "kept.tool_radius";
inline bool is_kept_word(std::string_view word) {
  return word.starts_with(kept_word);
}

/// Which way round the tool goes follows from `sense` (the shape has walls).
bool has_sense(const MillNumbers& mill);

/// How much the moves depend on the radius of the tool.
enum class RadiusNeed : std::uint8_t {
  none,
  lead,  ///< the way onto the contour and off it: without one it is counted from the tool's middle
  moves
};
RadiusNeed needs_radius(const MillNumbers& mill);

enum class MillStep : std::uint8_t {
  rapid,
  feed,
  arc,
  speed,          ///< `amount` rev/min from here on
  restore_speed,  ///< the speed before the cycle
  comp_left,      ///< radius compensation from the next move on
  comp_right,
  comp_off,
  thread,   ///< at the pitch `amount` (mm/rev), from the spindle angle `angle`
  orient,   ///< the spindle stops at `angle`
  reverse,  ///< the other sense than before the cycle
  restart   ///< the sense before the cycle
};
struct MillMove {
  MillStep step = MillStep::rapid;
  double u = 0, v = 0, w = 0;  ///< end point in the work frame, mm
  double cu = 0, cv = 0;       ///< arc: centre in the plane; an arc that ends where it starts is a full circle
  bool ccw = false;            ///< seen against the third axis of the plane
  bool has_feed = false;       ///< `feed` replaces the feed in force
  double feed = 0;
  double feed_factor = 1;  ///< times the feed
  double amount = 0;
  double angle = 0;  ///< degrees
};
struct MillContext {
  double u = 0, v = 0, w = 0;  ///< of the tool when the cycle runs, mm in the work frame; NaN: not known
  double tool_radius = 0;      ///< mm, greater than 0 where needs_radius() says so
  bool spindle_ccw = false;    ///< climb milling goes the other way round
  RetractPlane plane = RetractPlane::initial;
  const std::vector<MillContour>* contours = nullptr;  ///< of the shapes that have some
  double tolerance = 0.001;                            ///< mm: of arcs in the area of a contour pocket
  bool links_at_depth = true;  ///< contour pocket: from ring to ring through the area, not over the reference plane
  bool entry_on_arc = true;    ///< contour pocket: onto the wall and off it on a quadrant
};
/// The moves of one machining; nullopt with a sentence in `error` when it makes no sense (tool too large, no size,
/// nothing to take away) or is not carried. Moves to where the tool already stands are not listed.
std::optional<std::vector<MillMove>> expand(const MillNumbers& mill, const HoleNumbers& levels,
                                            const MillContext& context, std::string* error);

}  // namespace cnctrans::ir::cycles
