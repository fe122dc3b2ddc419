// Kinds of motion by what they have in common.
#pragma once

#include "ir/modal.h"

namespace cnctrans::ir {

/// Part of a circle, however it is said.
constexpr bool is_any_arc(MotionKind k) {
  return k == MotionKind::arc_cw || k == MotionKind::arc_ccw || k == MotionKind::arc_through_point ||
         k == MotionKind::arc_tangent;
}

/// The function behind a block of this one: probing moves and moves to a stop leave the straight line in force.
constexpr MotionKind left_in_force(MotionKind k) {
  const bool once = k == MotionKind::probe_toward || k == MotionKind::probe_away || k == MotionKind::to_stop;
  return once ? MotionKind::linear : k;
}

/// Where the move ends is the machine's affair: at a place of its own, at what a probe touches, at a stop.
constexpr bool ends_at_the_machine(MotionKind k) {
  return k == MotionKind::reference_point || k == MotionKind::fixed_point || k == MotionKind::probe_toward ||
         k == MotionKind::probe_away || k == MotionKind::to_stop;
}

}  // namespace cnctrans::ir
