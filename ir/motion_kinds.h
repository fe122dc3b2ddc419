// Kinds of motion by what they have in common.
#pragma once

#include "ir/modal.h"

namespace cnctrans::ir {

/// Part of a circle, however it is said.
constexpr bool is_any_arc(MotionKind k) {
  return k == MotionKind::arc_cw || k == MotionKind::arc_ccw || k == MotionKind::arc_through_point ||
         k == MotionKind::arc_tangent;
}

}  // namespace cnctrans::ir
