// A cycle definition and the place of its call -> the neutral cycle.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "frontends/common/report.h"
#include "frontends/heidenhain/state/flat.h"

namespace cnctrans::frontends::heidenhain {

/// Of a move in the plane.
struct PlaneMove {
  ir::Value u, v;                                      ///< from where the tool stands
  bool absolute = false;                               ///< ... or from the datum
  ir::Value cu, cv;                                    ///< of an arc: its centre from its start
  std::optional<ir::AxisId> u_axis = {}, v_axis = {};  ///< other ones than those of the plane
};
/// A step of a cycle that is told by what it does.
struct CycleMove {
  enum class Kind : std::uint8_t {
    rapid,
    feed,
    arc_cw,
    arc_ccw,
    thread,  ///< by `w` along the tool axis from where it stands
    dwell,
    spindle,
    spindle_stop,
    function,
    cycle
  } kind = Kind::rapid;
  std::optional<ir::Value> w;      ///< height, absolute
  std::optional<PlaneMove> plane;  ///< a move in the plane, too
  ir::Value lead;                  ///< of a thread
  double amount = 0;               ///< feed, seconds, rev/min, or the number of the M function
  int code = 0;                    ///< spindle: 3, 4 or 5 as the M functions
  ir::CyclePtr cycle;
};
struct CycleContext {
  /// The value of a Q parameter at the call.
  std::function<ir::Value(std::int16_t)> value;
  std::optional<ir::Value> shift;  ///< CYCL CALL POS: added to the surface
  /// Where the cycle is no neutral one: its moves.
  std::vector<CycleMove>* moves = nullptr;
  /// The speed that is in force again behind the cycle, where it leaves another.
  std::optional<ir::Value>* speed_after = nullptr;
  std::optional<double> tool_radius;                           ///< mm
  const std::map<std::int64_t, double>* tool_radii = nullptr;  ///< of TOOL DEF, in the unit of the program
  std::optional<ir::Value> height;                             ///< of the tool at the call, where it is known
  std::size_t area = 0;                                        ///< which of the pockets of cycle 14
  bool inch = false;  ///< the unit of the program; lengths of the control itself are mm
};

/// Null: the cycle is skipped (depth 0), was refused (see `report`), or is told by its moves.
ir::CyclePtr build_cycle(const CycleDefinition& cycle, const CycleContext& context, Report& report);

/// 241, 203 and 205 with pecks that no neutral cycle has; empty: its parameters are not all numbers.
std::vector<CycleMove> peck_moves(const CycleDefinition& cycle, const CycleContext& context);

/// The points of 220 and 221 and their heights: every point is a pair of coordinates in the plane. Empty after a
/// refusal.
struct PatternPoint {
  double u = 0, v = 0;
};
std::vector<PatternPoint> pattern_points(const CycleDefinition& cycle, Report& report);

/// The points of PATTERN DEF in their order. Empty after a refusal.
struct Place {
  ir::Value u, v;
  ir::Value height;  ///< added to the surface of the cycle
};
std::vector<Place> figure_places(const Pattern& pattern, Report& report);

}  // namespace cnctrans::frontends::heidenhain
