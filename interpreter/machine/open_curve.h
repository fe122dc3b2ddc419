// The points of a run of spline blocks, collected until the next move of another kind closes the curve.
#pragma once

#include <cstddef>
#include <vector>

#include "base/span.h"
#include "interpreter/values/frame.h"
#include "ir/geometry/curve.h"

namespace cnctrans::interpreter {

struct OpenCurve {
  struct Block {
    FileId file = 0;
    std::uint32_t line = 0;
    double feed = 0;
    ir::FeedMode feed_mode = ir::FeedMode::per_minute;
    ir::CompSide comp = ir::CompSide::off;
    std::size_t held = 0;  ///< other events that come before its motion
  };
  ir::MotionKind kind = ir::MotionKind::spline_cubic;
  std::vector<ir::AxisId> axes, beside;  ///< of the curve; those that go along
  ir::curves::SplinePoints points;       ///< machine coordinates
  std::vector<Block> blocks;             ///< one for each point behind the first
  bool degree_given = false;
  bool first_point_said = false;  ///< a first block that stays where the curve begins
};

}  // namespace cnctrans::interpreter
