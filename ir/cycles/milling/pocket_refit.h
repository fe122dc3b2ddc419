// Exact lines and arcs for a polygon that runs along known curves.
#pragma once

#include <vector>

#include "ir/cycles/milling/pocket_area.h"

namespace cnctrans::ir::cycles::detail {

/// A line through (u, v) in the direction (du, dv) of length 1, or a circle about (u, v).
struct ExactCurve {
  bool arc = false, ccw = false;
  double u = 0, v = 0, du = 0, dv = 0, radius = 0;
};
/// The curves that bound the places at `distance` from a way, on its left: those of its elements, and the circles about
/// its corners.
void parallel_curves(const PocketWay& way, double distance, std::vector<ExactCurve>& out);
/// A closed polygon as a way along the curves that it follows within `off` mm; where it follows none, as its sides.
PocketWay refit(const std::vector<PocketPoint>& polygon, const std::vector<ExactCurve>& curves, double off);

}  // namespace cnctrans::ir::cycles::detail
