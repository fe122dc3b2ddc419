// Groups of addresses that resolve.cpp and the files beside it ask for together.
#pragma once

#include <memory>
#include <utility>

#include "frontends/num/state/lower.h"

namespace cnctrans::frontends::num {

namespace slot {
constexpr std::uint64_t bit(int s) {
  return std::uint64_t{1} << s;
}
inline constexpr std::uint64_t arc_slots = bit(letter('I')) | bit(letter('J')) | bit(letter('K')) | bit(letter('R'));
inline constexpr std::uint64_t cycle_slots =
    bit(e('R')) | bit(e('H')) | bit(e('F')) | bit(e('P')) | bit(e('S')) | bit(letter('P')) | bit(letter('Q'));
inline constexpr std::uint64_t geometry_slots = bit(e('A')) | bit(e('S')) | bit(e('T')) | bit(letter('E'));
}  // namespace slot

constexpr bool is_arc(ir::MotionKind k) {
  return k == ir::MotionKind::arc_cw || k == ir::MotionKind::arc_ccw;
}
constexpr bool is_straight(ir::MotionKind k) {
  return k == ir::MotionKind::rapid || k == ir::MotionKind::linear;
}

struct PlaneLetters {
  char u, v, w;
};
constexpr PlaneLetters centre_letters(ir::Plane p) {
  if (p == ir::Plane::zx) return {'K', 'I', 'J'};
  return p == ir::Plane::yz ? PlaneLetters{'J', 'K', 'I'} : PlaneLetters{'I', 'J', 'K'};
}
constexpr ir::AxisId centre_axis(char c) {
  return c == 'I' ? ir::axis::x : c == 'J' ? ir::axis::y : ir::axis::z;
}

inline ir::FrameOp frame_op(ir::FrameChange change) {
  return {std::make_shared<const ir::FrameChange>(std::move(change))};
}

}  // namespace cnctrans::frontends::num
