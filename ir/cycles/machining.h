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
  plain          ///< degrees, counts, factors, codes, labels
};
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
  groove,
  live_drill,  ///< with a driven tool
  live_key
};
struct MachiningCycle {
  std::string_view name;
  MachiningKind kind;
  bool face;        ///< infeed along Z, passes along X; else the other way round
  bool ends_comp;   ///< radius compensation is off afterwards
  bool ends_modes;  ///< rapid and absolute mode are in force afterwards
};
/// The cycle of a node; nullptr when the name is no machining cycle.
const MachiningCycle* find_machining(std::string_view name);

struct TurnPoint {
  double x = 0, z = 0;  ///< mm in the work frame, x as radius
};
enum class TurnStep : std::uint8_t { rapid, feed, arc, thread, dwell, spindle_reverse, spindle_restore, spindle_stop };
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
};
/// Parameters in mm (radius), degrees, seconds, by name; what the source left out is not there.
using TurnNumbers = std::map<std::string_view, double>;
struct TurnContext {
  TurnPoint start;        ///< of the tool when the cycle is called
  double nose_width = 0;  ///< of the tool; 0: not known
};
/// The moves; nullopt and a sentence in `error` when the cycle makes no sense from this place or is not carried out.
std::optional<std::vector<TurnMove>> expand(const MachiningCycle& cycle, const TurnNumbers& numbers,
                                            const TurnContext& context, std::string* error);

}  // namespace cnctrans::ir::cycles
