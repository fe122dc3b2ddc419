// Stock removal against one element, grooves, drilling and tapping on the axis of a lathe.
#include <algorithm>

#include "ir/cycles/turning_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

constexpr double most_cuts = 100'000;

/// Equal passes not above `step`.
double pass_count(double total, double step) {
  return std::clamp(std::ceil(total / step - tiny), 1.0, most_cuts);
}

/// The element between its two ends, moved by the finishing allowance: the straight line, or the arc below 180 degrees.
struct Contour {
  RolePoint first, last, centre;
  bool arc = false;
  double out = 1;  ///< sign of p away from the work

  /// q where the contour has height p; beyond the last point: q of the last point.
  [[nodiscard]] double at(double p) const {
    if (out * (p - last.p) > -tiny) return last.q;
    if (!arc) return first.q + (p - first.p) * (last.q - first.q) / (last.p - first.p);
    const double r2 = (first.p - centre.p) * (first.p - centre.p) + (first.q - centre.q) * (first.q - centre.q);
    const double root = std::sqrt(std::max(0.0, r2 - (p - centre.p) * (p - centre.p)));
    const double a = centre.q + root, b = centre.q - root;
    return on_arc({p, a}) ? a : b;
  }
  [[nodiscard]] RolePoint moved(RolePoint r, double dp, double dq) const { return {r.p + dp, r.q + dq}; }

 private:
  /// On the same side of the chord as the arc below 180 degrees: away from the centre.
  [[nodiscard]] bool on_arc(RolePoint t) const {
    const auto side = [this](RolePoint r) {
      return (last.p - first.p) * (r.q - first.q) - (last.q - first.q) * (r.p - first.p);
    };
    return side(t) * side(centre) <= tiny;
  }
};

void along(Roles& r, const Contour& c, RolePoint to, double feed) {
  if (c.arc)
    r.arc(to, c.centre, feed);
  else
    r.feed(to, feed);
}

/// Withdrawal along the contour, from the pass at the present height to the height of the pass before.
void follow(Roles& r, const Contour& c, double height) {
  const RolePoint here = r.here();
  const bool beyond = c.out * (height - c.last.p) > tiny;
  const RolePoint end = beyond ? c.last : RolePoint{height, c.at(height)};
  if (c.out * (here.p - c.last.p) < -tiny) along(r, c, end, 0);
  if (beyond) r.feed({height, c.last.q});
}

}  // namespace

bool straight_or_arc(bool arc, Roles& r, std::string* error) {
  const RolePoint a = r.here(), pi = r.point("x", "z"), pf = r.point("x_end", "z_end");
  const RolePoint stock = r.point("stock_x", "stock_z");
  const double step = r.number("step");
  if (step <= 0) return *error = "the pass of the cycle is not greater than zero", false;
  const double sp = sign(a.p - pi.p), sq = sign(a.q - pi.q);
  if (sp * (a.p - pf.p) < stock.p - tiny || sq * (a.q - pi.q) < stock.q - tiny || std::abs(a.p - pi.p) < tiny)
    return *error = "wrong tool position for the cycle: the tool does not stand outside of the element", false;
  Contour c;
  c.out = sp;
  c.arc = arc;
  c.first = {pi.p + sp * stock.p, pi.q + sq * stock.q};
  c.last = {pf.p + sp * stock.p, pf.q + sq * stock.q};
  const RolePoint centre = r.point("centre_x", "centre_z");
  c.centre = {c.first.p + centre.p, c.first.q + centre.q};
  if (arc) {
    const double r0 = std::hypot(centre.p, centre.q);
    const double r1 = std::hypot(c.last.p - c.centre.p, c.last.q - c.centre.q);
    if (r0 < tiny || std::abs(r0 - r1) > 0.02)
      return *error = "the arc of the cycle does not reach its end point", false;
  }
  const double total = std::abs(a.p - c.first.p), n = pass_count(total, step);
  double before = a.p;
  for (double k = 1; k <= n; ++k) {
    const double level = a.p - sp * total * k / n, end = c.at(level);
    r.rapid({level, a.q});
    r.feed({level, end});
    if (!r.has("withdrawal"))
      follow(r, c, before);
    else if (const double d = std::abs(r.number("withdrawal")); d > 0)
      r.rapid({level + sp * d, end + sq * d});
    r.rapid({r.here().p, a.q});
    before = level;
  }
  if (const double f = r.number("rough_feed"); f > 0) {
    r.rapid(c.first);
    along(r, c, c.last, f);
  }
  if (const double h = r.number("finish_feed"); h > 0) {
    r.rapid({a.p, r.here().q});
    r.rapid(a);
    r.rapid({pi.p, a.q});
    r.feed(pi, h);
    Contour exact = c;
    exact.centre = {pi.p + centre.p, pi.q + centre.q};
    along(r, exact, pf, h);
  }
  r.rapid({a.p, r.here().q});
  r.rapid(a);
  return true;
}

/// Plunges of equal distance over the width that the insert leaves, from the first corner on.
bool groove(Roles& r, double nose_width, std::string* error) {
  const RolePoint a = r.here(), pi = r.point("x", "z"), pf = r.point("x_end", "z_end");
  const double out = sign(pi.p - pf.p), width = std::abs(pf.q - pi.q), clearance = std::abs(r.number("clearance"));
  if (nose_width <= 0)
    return *error = "the width of the grooving tool is not known: \"nose_width\" of the tool in the profile", false;
  const double step = r.number("step", nose_width);
  if (std::abs(pi.p - pf.p) < tiny) return *error = "the groove has no depth", false;
  if (step <= 0) return *error = "the step of the groove is not greater than zero", false;
  if (width < nose_width - tiny) return *error = "the groove is narrower than the tool", false;
  if (out * (a.p - pi.p) < clearance - tiny)
    return *error = "wrong tool position for the cycle: the tool stands nearer than the safety distance", false;
  const double rest = std::max(0.0, width - nose_width), safe = pi.p + out * clearance;
  const double gaps = rest < tiny ? 0 : pass_count(rest, step);
  for (double k = 0; k <= gaps; ++k) {
    const double q = pi.q + sign(pf.q - pi.q) * (gaps > 0 ? rest * k / gaps : 0);
    r.rapid({safe, q});
    r.feed({pf.p, q});
    r.dwell(r.number("dwell"));
    r.rapid({safe, q});
  }
  r.rapid({a.p, r.here().q});
  r.rapid(a);
  return true;
}

/// On the axis (p along Z). Depth is positive toward minus.
bool axial_drill(Roles& r, std::string* error) {
  Hole hole;
  if (!hole_of(r, hole, error)) return false;
  r.rapid({hole.start, hole.q});
  if (hole.peck >= tiny) {
    pecks(r, hole, false);
    return true;
  }
  const double kind = r.number("factor");
  r.thread({hole.surface - hole.depth, hole.q});
  if (r.number("dwell") > 0) r.act(TurnStep::spindle_stop);
  r.dwell(r.number("dwell"));
  r.act(TurnStep::spindle_reverse);
  r.thread({hole.start, hole.q});
  r.act(kind == 0 ? TurnStep::spindle_restore : TurnStep::spindle_stop);
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
