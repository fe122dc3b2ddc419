// Points that a block does not give by its axes: poles, and lines by their angle (language reference 14.3, 14.12).
#include <cmath>

#include "frontends/sinumerik/state/words.h"
#include "ir/geometry/contour.h"

namespace cnctrans::sinumerik {

namespace {

/// radius * function(angle)
ir::Value on_circle(const ir::Value& radius, ir::Function function, const ir::Value& angle) {
  ir::ExprPtr e = ir::binary(ir::BinaryOp::multiply, ir::as_expr(radius), ir::call(function, {ir::as_expr(angle)}));
  constexpr double places = 1e9;
  if (const auto n = ir::constant_value(e)) return ir::Value(std::nearbyint(*n * places) / places);
  return ir::Value(std::move(e));
}

}  // namespace

/// G110 from the present point, G111 from the zero point of the work frame, G112 from the last pole.
void WordLowering::finish_pole() {
  auto& coords = out_->motion.coords;
  constexpr std::uint8_t present_point = 0, zero_point = 1;
  auto at = std::make_shared<ir::FrameChange>();
  at->combine = special_g_->a == zero_point      ? ir::FrameCombine::replace
                : special_g_->a == present_point ? ir::FrameCombine::compose
                                                 : ir::FrameCombine::add;
  if (has_extra_) {
    polar_pole(*at);
    coords.clear();
    has_extra_ = false;
    extra_ = ir::MotionExtra{};
  }
  for (auto& c : coords) {
    if (c.mode != ir::WordMode::modal) {
      failed_ = true;
      c_.error("SIN-012", c.pos, "AC() and IC() have no meaning here");
    }
    at->words.push_back(ir::FrameWord{c.axis, std::move(c.value), c.scale, c.pos});
  }
  coords.clear();
  push(ir::PoleSet{std::move(at)}, Rank::setting, ir::Order::before, special_pos_);
}

/// G110 AP= RP=: the place is carried by its axes, so the plane must be known.
void WordLowering::polar_pole(ir::FrameChange& at) {
  const bool both = extra_.has_polar_radius && extra_.has_polar_angle;
  if (!both || !out_->motion.coords.empty() || extra_.polar_mode != ir::WordMode::modal ||
      extra_.polar_angle_mode != ir::WordMode::modal) {
    failed_ = true;
    c_.error("SIN-012", special_pos_,
             "a pole is given by the axes of the plane, or by AP= and RP= alone, without AC() and IC()");
    return;
  }
  std::optional<ir::Plane> plane = c_.plane;
  for (const auto& a : out_->actions) {
    const auto* m = std::get_if<ir::ModalSet>(&a.data);
    if (m != nullptr && m->setting == ir::Setting::plane) plane = static_cast<ir::Plane>(m->value);
  }
  if (!plane) {
    return refuse("motion.geometry", special_pos_, "a pole in polar words, and the text does not tell the plane here",
                  "write G17, G18 or G19 in this block");
  }
  const auto axes = ir::plane_axes(*plane);
  const ir::Value &radius = extra_.polar_radius, &angle = extra_.polar_angle;
  at.words.push_back(
      ir::FrameWord{axes.u, on_circle(radius, ir::Function::cos, angle), ir::WordScale::radius, special_pos_});
  at.words.push_back(
      ir::FrameWord{axes.v, on_circle(radius, ir::Function::sin, angle), ir::WordScale::radius, special_pos_});
}

/// `ANG=` without an end point: the next block gives it with its own angle, the point between is where the two lines
/// meet.
void WordLowering::open_line() {
  const ir::MotionKind kind = motion_kind();
  const bool straight = kind == ir::MotionKind::rapid || kind == ir::MotionKind::linear;
  if (!has_extra_ || !extra_.has_line_angle || !straight || !out_->motion.coords.empty()) return;
  push(ir::OpaqueWord{ir::contour::mark::secant}, Rank::setting, ir::Order::before, special_pos_, false);
}

}  // namespace cnctrans::sinumerik
