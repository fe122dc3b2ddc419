// A cycle definition and the place of its call -> the neutral cycle.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "frontends/common/report.h"
#include "frontends/heidenhain/state/flat.h"

namespace cnctrans::frontends::heidenhain {

struct CycleContext {
  /// The value of a Q parameter at the call.
  std::function<ir::Value(std::int16_t)> value;
  std::optional<ir::Value> shift;  ///< CYCL CALL POS: added to the surface
  bool inch = false;               ///< the unit of the program; lengths of the control itself are mm
};

/// Null: the cycle is skipped (depth 0), or was refused (see `report`).
ir::CyclePtr build_cycle(const CycleDefinition& cycle, const CycleContext& context, Report& report);

/// The points of 220 and 221 and their heights: every point is a pair of coordinates in the plane. Empty after a
/// refusal.
struct PatternPoint {
  double u = 0, v = 0;
};
std::vector<PatternPoint> pattern_points(const CycleDefinition& cycle, Report& report);

}  // namespace cnctrans::frontends::heidenhain
