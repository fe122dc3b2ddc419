// Modal state after power-on, M02 and reset (reference 4.3, 4.4).
#pragma once

#include "ir/modal.h"

namespace cnctrans::dialects::num {

inline constexpr ir::ModalState power_on(bool lathe) {
  ir::ModalState s;
  s.plane = lathe ? ir::Plane::zx : ir::Plane::xy;  // G17; G18 on a lathe is not in the course book
  s.diameter = lathe ? ir::DiameterMode::diameter : ir::DiameterMode::radius;
  s.feed_mode = ir::FeedMode::per_minute;  // G94 F1000, on lathes too
  s.path_mode = ir::PathMode::continuous;
  s.motion = ir::MotionKind::linear;  // G01
  s.work_offset = 1;                  // G54: PREF and DEC1 count
  return s;
}

}  // namespace cnctrans::dialects::num
