// Axes by the machine's own names, axes that are spindles, and turns in a plane by its number (language reference 9.6,
// motion reference 7.2).
#include <algorithm>

#include "base/saturate.h"
#include "frontends/sinumerik/state/expr.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

Expr ExprLowering::channel_axis(const Expr& e) const {
  const std::string& own = e.text;
  if (e.kind != ExprKind::name || own.size() < 2 || c_.symbol(own) != nullptr || c_.machine.axis(own) != ir::axis::none)
    return e;
  const std::size_t digits = own.find_first_of("0123456789");
  if (digits == std::string::npos || own.find_first_not_of("0123456789", digits) != std::string::npos) return e;
  const std::string_view letters = std::string_view(own).substr(0, digits);
  const std::string_view number = std::string_view(own).substr(digits);
  Expr out = e;
  const auto& axes = c_.machine.profile->axes;
  if (letters == "AX" && number.size() <= 2) {  // AX1: the first axis of the machine
    const auto n = static_cast<std::size_t>(std::stoi(std::string(number)));
    if (n == 0 || n > axes.size()) return e;
    out.text = axes[n - 1].name;
  } else if (letters.size() == 1 && number == "1" && c_.machine.axis(letters) != ir::axis::none) {
    out.text = letters;
  } else {
    return e;
  }
  c_.warning("SIN-101", e.pos, own + " is a name of the machine's own (MD10000): taken as the axis " + out.text,
             "name the axis of the program, or add one called " + own + " to the profile of the machine");
  return out;
}

/// CRPL(n, angle): 0 is the plane in force, 1 to 3 are G17, G18 and G19.
ir::ExprPtr ExprLowering::turn_in_plane(const Expr& e) {
  const bool fits = e.args.size() == 2 && e.args[0].kind == ExprKind::number && e.args[0].number >= 0 &&
                    e.args[0].number <= 3 && e.args[0].number == saturate<int>(e.args[0].number);
  if (!fits) {
    c_.keep("SIN-008", e.pos, "CRPL() is carried with the number of a plane (0 to 3) and an angle only");
    return nullptr;
  }
  ir::AxisId normal = ir::axis::none;
  if (e.args[0].number != 0) {
    normal = c_.machine.geometry.of(3 - static_cast<std::size_t>(e.args[0].number));
  } else if (c_.plane) {
    normal = ir::plane_axes(*c_.plane).w;
  } else {
    c_.keep("SIN-008", e.pos, "CRPL(0) turns in the plane in force, and the text does not tell it here",
            "write CRPL(1) for G17, CRPL(2) for G18, CRPL(3) for G19");
    return nullptr;
  }
  auto axis = make_expr(ir::AxisName{normal}, ir::Type::axis, e.pos);
  auto angle = lower_as(e.args[1], ir::Type::real);
  if (!angle) return nullptr;
  return make_expr(ir::Call{ir::Function::frame_turn, {std::move(axis), std::move(angle)}}, ir::Type::frame, e.pos);
}

/// AXTOSPI(C): the number of the spindle that works as this axis, the datum AXTOSPI[C].
ir::ExprPtr ExprLowering::spindle_of_axis(const Expr& e) {
  const auto axis = axis_operand(e.args[0]);
  const auto* literal = axis ? std::get_if<ir::AxisName>(&axis->node) : nullptr;
  if (axis && literal == nullptr) c_.keep("SIN-007", e.pos, "AXTOSPI() of an axis in a variable is not carried yet");
  if (literal == nullptr) return nullptr;
  ir::SystemRef number;
  number.text = "AXTOSPI";
  number.args.push_back(ir::string_literal(c_.machine.profile->axis(literal->axis)->name));
  if (c_.first_time(number.text)) {
    c_.warning(
        "SIN-015", e.pos,
        "AXTOSPI(): which spindle an axis belongs to is known to the machine only: a run takes the profile's value, "
        "or stops where it is read",
        "--set \"AXTOSPI[C]=1\" gives it");
  }
  return make_expr(std::move(number), ir::Type::integer, e.pos);
}

}  // namespace cnctrans::sinumerik
