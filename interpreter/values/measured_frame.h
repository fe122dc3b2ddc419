// The frame that takes three ideal points to three measured ones.
#pragma once

#include <span>

#include "interpreter/values/frame.h"

namespace cnctrans::interpreter {

/// Numbers in a row of measured points: its number and their coordinates.
inline constexpr std::size_t measured_count = 19;

struct MeasuredFrame {
  Frame frame;         ///< turn and shift; neutral where there is none
  double quality = 0;  ///< sum of the distances that are left (0: it fits exactly); -1: the ideal points lie on a line,
                       ///< -2: the measured ones do, -4: there is no turn
};
/// `points`: three ideal points, then the three measured ones, X Y Z each, all in the same unit; the shift of the
/// result is in it too. The turn is the one with the least squares of what is left (motion reference 8).
MeasuredFrame measured_frame(std::span<const double, 18> points);

}  // namespace cnctrans::interpreter
