// Modal state after power-on, M02/M30, emergency and reset (§5.1 table). What a machine parameter chooses has the usual
// value of a mill or a lathe here; profiles say otherwise.
#pragma once

#include "ir/modal.h"

namespace cnctrans::dialects::fagor {

inline constexpr ir::ModalState power_on(bool lathe) {
  ir::ModalState s;
  s.plane = lathe ? ir::Plane::zx : ir::Plane::xy;                             // IPLANE
  s.distance = ir::Distance::absolute;                                         // ISYSTEM
  s.units = ir::Units::metric;                                                 // INCHES
  s.diameter = lathe ? ir::DiameterMode::diameter : ir::DiameterMode::radius;  // DFORMAT of X
  s.feed_mode = ir::FeedMode::per_minute;                                      // IFEED
  s.path_mode = ir::PathMode::continuous;                                      // ICORNER: G05
  s.motion = ir::MotionKind::rapid;                                            // IMOVE: G00
  s.length_comp = lathe ? ir::OnOff::on : ir::OnOff::off;                      // lathe: always; mill: G43
  return s;
}

}  // namespace cnctrans::dialects::fagor
