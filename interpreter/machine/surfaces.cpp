// Work with the C axis: Cartesian coordinates on the face of a turning part, and the unrolled cylinder.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/machine/block_machine.h"
#include "interpreter/trace/run_codes.h"

namespace cnctrans::interpreter {

namespace {
constexpr ir::AxisId x = ir::axis::x, y = ir::axis::y, c = ir::axis::c;
}

/// A machine that has no Y axis shows Y while it is a coordinate of the face or the cylinder.
void BlockMachine::y_axis(bool present) {
  axis_[y] = AxisState{};
  axis_[y].present = present;
  if (present) {
    axes_.insert(std::upper_bound(axes_.begin(), axes_.end(), y), y);
    path_event_.to.known |= 1U << y;
  } else {
    std::erase(axes_, y);
    path_event_.to.known &= ~(1U << y);
    path_event_.to.value[y] = 0;
  }
  set_units();
}

/// The slides and the C axis where the point of the surface in force puts them: X is the distance from the axis of
/// turning, C the angle of the point; on the cylinder the arc Y is the angle Y * 360 / (pi * diameter).
void BlockMachine::leave_surface(Axes& machine) {
  if (modal_.surface == ir::Surface::face && (machine[x] != 0 || machine[y] != 0)) {
    machine[c] = std::atan2(machine[y], machine[x]) * 180 / std::numbers::pi;
    machine[x] = std::hypot(machine[x], machine[y]);
  } else if (modal_.surface == ir::Surface::cylinder) {
    machine[c] = machine[y] * 360 / (std::numbers::pi * surface_.cylinder);
  }
  machine[y] = surface_.y_beneath;
}

void BlockMachine::enter_surface(ir::Surface surface, Axes& machine) {
  surface_.y_beneath = machine[y];
  if (surface == ir::Surface::face) {
    machine[y] = machine[x] * sin_degrees(machine[c]);
    machine[x] *= cos_degrees(machine[c]);
  } else {
    machine[y] = machine[c] * std::numbers::pi * surface_.cylinder / 360;
  }
}

/// The machine stands still and makes no event.
bool BlockMachine::set_surface(const ir::SurfaceSet& s) {
  const bool by_x = s.diameter.literal() && s.diameter.number == 0;
  const double diameter = s.surface != ir::Surface::cylinder ? 0
                          : by_x                             ? 2 * std::abs(frame_.apply(p_)[x])
                                                             : value(s.diameter) * unit();
  if (failure_.set) return false;
  if (s.surface == ir::Surface::cylinder && !(diameter > 0))
    return failure_.fail(code::surface, "the radius of the cylinder is not greater than zero");
  if (s.surface == modal_.surface && diameter == surface_.cylinder) return true;
  if (pending_ || !contour_.elements.empty())
    return failure_.fail(code::surface, "a corner or an open contour stands before this change of the coordinates");
  if (curve_.open && !split_curve()) return false;
  const bool turned = ir::turns_part(modal_.surface), turns = ir::turns_part(s.surface);
  const auto shifted = [this](ir::AxisId a) { return frame_.t[a] != 0; };
  if (turns && axis_[c].present && shifted(c))
    return failure_.fail(code::surface, "a zero offset or shift of the C axis under work on the face or the cylinder");
  Axes machine = frame_.apply(p_);
  if (turned) leave_surface(machine);
  if (!turns && surface_.y_lent) {
    y_axis(false);
    surface_.y_lent = false;
  } else if (turns && !axis_[y].present) {
    y_axis(true);
    surface_.y_lent = true;
  }
  surface_.cylinder = diameter;
  if (turns) enter_surface(s.surface, machine);
  modal_.surface = s.surface;
  if (!turned && !turns) {  // the point stays what it is; increments count from it (frames.cpp)
    increments_.pending = 0;
    return true;
  }
  for (const ir::AxisId a : {x, y, c}) {
    if (axis_[a].present) path_event_.to.value[a] = machine[a];
    increments_.pending &= ~(1U << a);
  }
  p_ = inverse_.apply(machine);
  last_.known = false;
  ++frame_serial_;
  return true;
}

/// The C axis follows the coordinates of the surface: it has no words of its own.
bool BlockMachine::surface_axis(ir::AxisId a) {
  if (!ir::turns_part(modal_.surface) || a != c) return true;
  return failure_.fail(code::surface, "a word of the C axis while it follows the face or the cylinder");
}

}  // namespace cnctrans::interpreter
