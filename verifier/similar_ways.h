// What holds for every two cycles that are compared by the part they leave: where rapid moves may go, what is commanded
// beside the moves, how deep a pass may cut.
#pragma once

#include <string>

#include "verifier/similar.h"

namespace cnctrans::verifier {

/// Empty: each rapid move of the translation ends inside of the hull of the source's moves and contour, or less than 1
/// mm outside, so that it goes nowhere where the source's tool does not go. In the plane X Z (`turned`) the hull is
/// convex, else a box.
[[nodiscard]] std::string way_difference(const CyclePasses& source, const CyclePasses& target, bool turned);
/// Empty: on its way to the cycle the tool goes across the cycle's axis no lower than in the source: a clamp stands in
/// the way of one that comes down first.
[[nodiscard]] std::string crossing_difference(const CyclePasses& source, const CyclePasses& target);
/// Empty: other things than moves that a cycle does are the same. The sense and the dwells of a tap follow from it.
[[nodiscard]] std::string beside_the_moves(const CyclePasses& source, const CyclePasses& target);
/// An infeed that is not much deeper than the source's comes from another law of the same cycle.
[[nodiscard]] inline bool too_deep(double here, double there) {
  constexpr double by = 1.3, room = 0.01;
  return here > there * by + room;
}

}  // namespace cnctrans::verifier
