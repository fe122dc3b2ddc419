// Values of type frame: they are evaluated from the tree as it stands, since they are rare.
#include <cmath>

#include "base/saturate.h"
#include "interpreter/trace/run_codes.h"
#include "interpreter/values/expressions.h"
#include "interpreter/values/frame_parts.h"

namespace cnctrans::interpreter {

bool Evaluator::axis_of(const ir::ExprPtr& e, ir::AxisId& out) {
  const double a = e ? std::round(number_of(e)) : -1;
  if (failure_.set) return false;
  if (!(a >= 0 && a < ir::axis::count_max)) return failure_.fail(code::wrong_type, "an axis is needed here");
  out = static_cast<ir::AxisId>(a);
  return true;
}

Frame Evaluator::frame(const ir::Expr& e) {
  if (const auto* c = std::get_if<ir::Call>(&e.node)) return frame_call(*c);
  Frame out;
  if (const auto* s = std::get_if<ir::SystemRef>(&e.node)) {
    const auto args = arguments(*s);
    if (!failure_.set) system_->read_frame(*s, args, out);
    return out;
  }
  if (const auto* v = std::get_if<ir::VarRef>(&e.node)) {
    Place p;
    if (!place(*v, *scope_, p)) return out;
    if (p.named != nullptr && p.named->is_frame()) return p.named->frame[p.index];
  }
  failure_.fail(code::wrong_type, "a frame is needed here");
  return out;
}

Frame Evaluator::frame_call(const ir::Call& c) {
  using F = ir::Function;
  Frame out;
  if (c.function == F::frame_chain) {
    const Frame outer = frame(*c.args[0]);
    const Frame inner = failure_.set ? Frame{} : frame(*c.args[1]);
    return compose(outer, inner);
  }
  if (c.function == F::frame_inverse) {
    if (!invert(frame(*c.args[0]), out) && !failure_.set) failure_.fail(code::frame, "a scale of zero");
    return out;
  }
  if (c.function == F::frame_with) {
    const Frame f = frame(*c.args[0]);
    ir::AxisId axis = 0;
    if (failure_.set || !axis_of(c.args[1], axis)) return out;
    const auto part = static_cast<ir::FramePart>(saturate<int>(number_of(c.args[2])));
    double value = number_of(c.args[3]);
    if (part == ir::FramePart::shift || part == ir::FramePart::fine) value = system_->length_of(axis, value);
    if (part == ir::FramePart::scale && value == 0) failure_.fail(code::frame, "a scale of zero");
    return failure_.set ? out : with_part(f, axis, part, value);
  }
  std::array<double, 3> turn{};
  std::array<bool, 3> given{};
  FrameParts parts;
  const std::size_t step = c.function == F::frame_mirror ? 1 : 2;
  for (std::size_t i = 0; i + step <= c.args.size(); i += step) {
    ir::AxisId axis = 0;
    if (!axis_of(c.args[i], axis)) return out;
    const double value = step == 2 ? number_of(c.args[i + 1]) : 1;
    if (failure_.set) return out;
    switch (c.function) {
      case F::frame_shift:
      case F::frame_fine: parts.shift[axis] = system_->length_of(axis, value); break;
      case F::frame_stretch: parts.scale[axis] = value; break;
      case F::frame_mirror: parts.mirrored[axis] = true; break;
      default:
        if (axis > ir::axis::z) {
          failure_.fail(code::frame, "only X, Y and Z can be turned about");
          return out;
        }
        turn[axis] = value;
        given[axis] = true;
    }
  }
  if (c.function == F::frame_turn) return turn_frame(turn[0], turn[1], turn[2]);
  if (c.function == F::frame_solid_turn) {
    if (given[0] && given[1] && given[2]) failure_.fail(code::frame, "a plane is inclined by two angles at most");
    if (given[0] && given[1]) return solid_turn(0, turn[0], 1, turn[1]);
    if (given[1] && given[2]) return solid_turn(1, turn[1], 2, turn[2]);
    if (given[2] && given[0]) return solid_turn(2, turn[2], 0, turn[0]);
    return turn_frame(turn[0], turn[1], turn[2]);
  }
  return frame_of(parts);
}

double Evaluator::frame_part(const ir::Call& c) {
  const Frame f = frame(*c.args[0]);
  ir::AxisId axis = 0;
  if (failure_.set || !axis_of(c.args[1], axis)) return 0;
  const auto part = static_cast<ir::FramePart>(saturate<int>(number_of(c.args[2])));
  const double value = part_of(f, axis, part);
  if (part != ir::FramePart::shift && part != ir::FramePart::fine) return value;
  return value / system_->length_of(axis, 1);
}

}  // namespace cnctrans::interpreter
