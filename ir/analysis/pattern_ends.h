// Where a pattern of points leaves the tool in the plane.
#pragma once

#include <map>

#include "ir/analysis/dataflow.h"
#include "ir/block.h"

namespace cnctrans::ir::detail {

/// Place of the last point along the two axes of the plane, in the coordinates and the unit in force. Empty: the block
/// has no pattern, its words are computed, a place of the tool that counts is not known, or there are other things than
/// holes at the points.
std::map<AxisId, double> pattern_end(const Block& b, const Facts& before);

}  // namespace cnctrans::ir::detail
