// Modal state in which a program begins (reference 3.4).
#pragma once

#include "ir/modal.h"

namespace cnctrans::dialects::heidenhain {

/// `inch`: the word behind BEGIN PGM; nothing in a program changes it.
inline constexpr ir::ModalState power_on(bool inch = false) {
  ir::ModalState s;
  s.units = inch ? ir::Units::inch : ir::Units::metric;
  s.motion = ir::MotionKind::linear;
  s.retract_plane = ir::RetractPlane::reference;
  return s;
}

}  // namespace cnctrans::dialects::heidenhain
