// A groove by plunges side by side, between the place of the tool and the opposite corner of the groove.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ir/cycles/turning_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

constexpr double most_plunges = 100'000;

/// How far from the tool's first wall each plunge lies.
std::vector<double> places(double rest, double step, bool equal) {
  std::vector<double> out;
  const double gaps = rest < tiny ? 0 : std::ceil(rest / step - tiny);
  for (double k = 0; k <= gaps; ++k) out.push_back(equal && gaps > 0 ? rest * k / gaps : std::min(rest, step * k));
  return out;
}

}  // namespace

/// "variant": units 1 from the far wall on, tens 1 whole steps and a last smaller one, hundreds 1 back at the feed.
bool plunged_groove(Roles& r, double nose_width, bool face, std::string* error) {
  const RolePoint a = r.here(), end = r.point("x_end", "z_end");
  const double step = std::abs(r.number(r.has("axial_step") ? "axial_step" : "step"));
  const int variant = static_cast<int>(std::clamp(r.number("variant"), 0.0, 999.0));
  const bool from_end = variant % 10 == 1, equal = variant / 10 % 10 == 0, feeds_back = variant / 100 == 1;
  const double width = r.has("width") ? std::abs(r.number("width")) : nose_width;
  if (width <= 0 && !r.has("assumed_width"))
    return *error =
               "the width of the grooving tool is not known: \"nose_width\" of the tool in the profile, or the option "
               "num.g66_width",
           false;
  if (step < tiny) return *error = "the step of the groove is not greater than zero", false;
  if (width > 0 && step > width + tiny) return *error = "the step of the groove is wider than the tool", false;
  const double across = std::abs(end.q - a.q), out = sign(a.p - end.p), dir = sign(end.q - a.q);
  if (across < width - tiny) return *error = "the groove is narrower than the tool", false;
  if (across > width + step * most_plunges) return *error = "the cycle has too many passes", false;
  double slope = 0;  // of the base, along the pass
  if (const double angle = r.number("slope_angle"); r.has("slope_angle")) {
    const double c = std::cos(angle * std::numbers::pi / 180), s = std::sin(angle * std::numbers::pi / 180);
    if (std::abs(face ? s : c) < 1e-6) return *error = "the base of the groove lies along the plunge", false;
    slope = face ? c / s : s / c;
    if (std::abs(slope) < tiny) slope = 0;
  }
  const auto base = [&](double q) { return end.p + (q - end.q) * slope; };
  auto list = places(std::max(0.0, across - width), step, equal);
  if (from_end) std::reverse(list.begin(), list.end());
  for (const double s : list) {
    const double q = a.q + dir * s;
    // Neither edge cuts below the base.
    const double at = base(q), other = base(q + dir * width), p = out > 0 ? std::max(at, other) : std::min(at, other);
    if (out * (a.p - p) < tiny) return *error = "the groove has no depth", false;
    r.rapid({a.p, q});
    r.feed({p, q});
    r.dwell(r.number("base_dwell"));
    if (feeds_back)
      r.feed({a.p, q});
    else
      r.rapid({a.p, q});
  }
  r.rapid(a);
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
