// Plunging with an inclined axis (G7, G5) under TRAANG: positions stay Cartesian (motion reference 9.4).
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"
#include "frontends/sinumerik/state/words.h"

namespace cnctrans::sinumerik {

/// G7 X Z: Z alone goes to where the line through (X, Z) along the inclined axis meets the present X. G5 X: the
/// inclined axis alone goes to X, and takes Z along.
void WordLowering::finish_inclined() {
  const bool plunge = special_g_->a == 1;
  auto& coords = out_->motion.coords;
  const std::string name = plunge ? "G5" : "G7";
  const auto at = [&](ir::AxisId axis) {
    return std::find_if(coords.begin(), coords.end(), [&](const auto& w) { return w.axis == axis; });
  };
  if (!c_.inclined)
    return refuse("motion.inclined", special_pos_, name + ": the text does not tell the angle of the inclined axis",
                  "write TRAANG with its angle before this block, without a jump or a call between");
  const auto x = at(ir::axis::x), z = at(ir::axis::z);
  const bool fits = x != coords.end() && (z != coords.end()) != plunge && coords.size() == (plunge ? 1U : 2U) &&
                    out_->motion.centers.empty();
  if (!fits) {
    failed_ = true;
    c_.error("SIN-133", special_pos_, plunge ? "G5 takes X alone: Z goes along" : "G7 takes X and Z");
    return;
  }
  if (c_.increments || std::any_of(coords.begin(), coords.end(), [](const auto& w) {
        return w.mode == ir::WordMode::incremental || w.scale != ir::WordScale::modal;
      }))
    return refuse("motion.inclined", special_pos_, name + " by increments is not carried yet",
                  "write positions under G90");
  const auto* spec = c_.machine.profile->axis(ir::axis::x);
  const bool diameter = spec != nullptr && spec->diameter &&
                        c_.diameter.value_or(c_.machine.profile->power_on.diameter) != ir::DiameterMode::radius;
  constexpr double degree = 3.14159265358979323846 / 180;
  double slope = std::tan(*c_.inclined * degree) / (diameter ? 2 : 1);
  constexpr double fine = 1e12;
  slope = std::round(slope * fine) / fine;
  if (c_.machine.options.inclined_axis == InclinedAxis::minus) slope = -slope;
  const auto here = [&](ir::AxisId axis) {
    ir::SystemRef ref;
    ref.datum = ir::Datum::programmed_position;
    ref.axis = axis;
    ref.text = "$P_EP";
    return make_expr(std::move(ref), ir::Type::real, special_pos_);
  };
  // Plunge: from here on by X - here; to its start: from the end back by here - X.
  ir::ExprPtr from = plunge ? here(ir::axis::z) : ir::as_expr(z->value);
  ir::ExprPtr way = plunge ? ir::binary(ir::BinaryOp::subtract, ir::as_expr(x->value), here(ir::axis::x))
                           : ir::binary(ir::BinaryOp::subtract, here(ir::axis::x), ir::as_expr(x->value));
  if (slope != 1) way = ir::binary(ir::BinaryOp::multiply, std::move(way), ir::number(slope));
  ir::CoordWord along;
  along.axis = ir::axis::z;
  along.value = ir::Value(ir::at(ir::binary(ir::BinaryOp::add, std::move(from), std::move(way)), special_pos_));
  along.pos = plunge ? special_pos_ : z->pos;
  if (plunge) {
    coords.insert(coords.begin(), std::move(along));  // worked out before X is where it goes
  } else {
    coords.assign(1, std::move(along));
  }
  out_->motion.kind = ir::MotionKind::linear;
  out_->motion.keeps_modal = c_.motion == ir::MotionKind::linear;
  out_->motion.explicit_code = true;
  out_->motion.code_pos = special_pos_;
  c_.warning("SIN-134", special_pos_,
             name + " is a straight move for an axis inclined by " + shortest(*c_.inclined) +
                 " degrees: for every mm of X (a " + (diameter ? "diameter" : "radius") +
                 ", positions absolute) Z goes by " + shortest(slope) + " mm; which way Z goes is machine data",
             "the option sinumerik.inclined_axis of the profile says which way");
}

}  // namespace cnctrans::sinumerik
