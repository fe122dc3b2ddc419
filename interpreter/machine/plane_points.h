// Points of a plane, and what counts as the same place.
#pragma once

#include "interpreter/machine/block_machine.h"

namespace cnctrans::interpreter {

inline constexpr double no_move = 1e-9;  ///< mm or degrees: less is no motion

inline Vec at(const Axes& p, const ir::PlaneAxes& plane) {
  return {p[plane.u], p[plane.v]};
}

}  // namespace cnctrans::interpreter
