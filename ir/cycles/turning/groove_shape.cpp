#include "ir/cycles/turning/groove_shape.h"

#include <algorithm>
#include <numbers>

namespace cnctrans::ir::cycles::detail {

namespace {

/// How far a corner element reaches from the corner: a radius, or a chamfer (negative) by its length or its width.
double reach(double element, double turn, bool by_width) {
  if (element >= 0) return element * std::tan(turn / 2);
  return by_width ? -element : -element / (2 * std::cos(turn / 2));
}

}  // namespace

double groove_passes(double total, double step) {
  constexpr double most_passes = 100'000;
  return std::clamp(std::ceil(total / step - tiny), 1.0, most_passes);
}

void corner_element(Chain& out, RolePoint at, RolePoint before, RolePoint after, double element, double far) {
  if (far < tiny) return;
  Piece x;
  x.a = {at.p - far * before.p, at.q - far * before.q};
  x.b = {at.p + far * after.p, at.q + far * after.q};
  if (element > 0) {
    x.arc = true;
    x.ccw = before.q * after.p - before.p * after.q > 0;
    const double r = x.ccw ? element : -element;
    x.c = {x.a.p + r * before.q, x.a.q - r * before.p};
  }
  out.push_back(x);
}

double depth_at(const Side& s, double u) {
  if (u < s.top - tiny) return 0;
  for (const auto& x : s.chain) {
    if (-u > x.a.q + tiny || -u < x.b.q - tiny || x.a.q - x.b.q < tiny) continue;
    if (!x.arc) return -(x.a.p + (-u - x.a.q) * (x.b.p - x.a.p) / (x.b.q - x.a.q));
    const double r = std::hypot(x.a.p - x.c.p, x.a.q - x.c.q), d = -u - x.c.q;
    const double root = std::sqrt(std::max(0.0, r * r - d * d));
    return -(x.c.p + (x.ccw ? root : -root));
  }
  return -lowest(s.chain);
}

double Shape::across() const {
  return width_ + depth_ * (std::tan(flanks_[0].angle) + std::tan(flanks_[1].angle));
}

bool knows_insert(const TurnContext& context, bool face, std::string* error) {
  if (context.nose_width <= 0)
    return *error = "the width of the grooving tool is not known: \"nose_width\" of the tool in the profile", false;
  if (face && !context.left_is_larger)
    return *error =
               "on which side of a groove in the face its start lies is not known: option "
               "\"cycle.face_groove_left\"",
           false;
  return true;
}

std::optional<Side> Shape::side(std::size_t k, double base_stock, double flank_stock, bool outer) const {
  const Flank& f = flanks_[k];
  const double deep = depth_ - base_stock, slope = std::tan(f.angle), turn = std::numbers::pi / 2 - f.angle;
  Side s;
  s.top = flank_stock / std::cos(f.angle);
  const RolePoint edge{0, -s.top}, root{-deep, -(s.top + deep * slope)}, down{-std::cos(f.angle), -std::sin(f.angle)};
  const RolePoint in{0, -1};
  const double high = outer ? reach(f.outer, turn, by_width_) : 0, low = reach(f.inner, turn, by_width_);
  const double length = std::hypot(root.p - edge.p, root.q - edge.q);
  if (high + low > length + tiny) return std::nullopt;
  corner_element(s.chain, edge, in, down, f.outer, high);
  const RolePoint a{edge.p + high * down.p, edge.q + high * down.q}, b{root.p - low * down.p, root.q - low * down.q};
  if (high + low < length - tiny) s.chain.push_back({a, b, false, false, {}});
  corner_element(s.chain, root, down, in, f.inner, low);
  s.flat = -root.q + low;
  s.middle = depth_ * slope + width_ / 2;
  s.chain.push_back({{-deep, -s.flat}, {-deep, -s.flat - width_}, false, false, {}});
  return s;
}

Insert::Insert(Roles& r, RolePoint corner, double out, double into, const TurnContext& context, bool face)
    : r_(r), corner_(corner), out_(out), into_(into), width_(context.nose_width), radius_(context.nose_radius) {
  const int edge = context.edge;
  const bool known = edge >= 1 && edge <= 4;
  const bool plus = known ? (face ? edge <= 2 : edge == 1 || edge == 4) : context.edge_at_plus;
  far_corner_ = (into > 0) == plus;
  shift_ = far_corner_ ? into * width_ : 0;
}
RolePoint Insert::place(double p, double u) const {
  return {corner_.p + out_ * p, corner_.q + into_ * u + shift_};
}
void Insert::approach(double p, double u, bool inside) {
  const RolePoint start = place(p, u);
  if (inside)
    r_.rapid({start.p, r_.here().q});
  else
    r_.rapid({r_.here().p, start.q});
  r_.rapid(start);
}
double Insert::u_of(double q, bool far, double across) const {
  return far ? across + (q + radius_) - width_ : -(q + radius_);
}
void Insert::piece(const Piece& x, bool far, double across) {
  const RolePoint to = place(x.b.p - radius_, u_of(x.b.q, far, across));
  const RolePoint centre = place(x.c.p - radius_, u_of(x.c.q, far, across));
  const bool mirrored = out_ * into_ * (far ? 1 : -1) < 0;
  if (x.arc)
    r_.arc(to, centre, x.ccw != mirrored, feed_);
  else
    r_.feed(to, feed_);
}
bool Insert::along(const Chain& side, double end, bool far, double across, double lift, std::string* error) {
  auto path = offset(side, radius_, error);
  if (!path || path->empty()) return false;
  path->back().b.q = std::min(path->back().a.q, -end - radius_);
  const RolePoint first = path->front().a;
  rapid(lift, u_of(first.q, far, across));
  feed(first.p - radius_, u_of(first.q, far, across));
  for (const auto& x : *path) piece(x, far, across);
  r_.rapid({corner_.p + out_ * lift, r_.here().q});
  return true;
}

bool Groove::set(const Shape& shape, double base_stock, double flank_stock, double width, std::string* error) {
  across = shape.across();
  for (std::size_t k = 0; k < 2; ++k) {
    const auto a = shape.side(k, base_stock, flank_stock, false), b = shape.side(k, 0, 0, true);
    if (!a || !b) return *error = "the corner elements of the groove do not fit to its flanks", false;
    rough[k] = *a;
    fine[k] = *b;
  }
  const auto room = [&](const std::array<Side, 2>& s) { return across - s[0].flat - s[1].flat - width; };
  if (room(rough) < -tiny || room(fine) < -tiny) return *error = "the groove is narrower than the tool", false;
  return true;
}
double Groove::deep(double u, double width) const {
  return std::min(depth_at(rough[0], u), depth_at(rough[1], across - u - width));
}
void Groove::plunge(Insert& tool, Roles& r, double u, bool base) const {
  const double depth = deep(u, tool.width());
  if (depth < tiny) return;
  const double levels = groove_passes(depth, step);
  tool.rapid(lift, u);
  for (double k = 1; k <= levels; ++k) {
    tool.feed(-depth * k / levels, u);
    if (k < levels) tool.rapid(-depth * k / levels + lift, u);
  }
  if (base) r.dwell(dwell);
  tool.rapid(lift, u);
}
bool Groove::rough_flanks(Insert& tool, Roles& r, std::string* error) const {
  for (std::size_t k = 0; k < 2; ++k) {
    const Side& s = rough[k];
    const double wide = s.flat - s.top;
    if (wide < tiny && flanks[k].inner == 0) continue;
    const double parts = groove_passes(std::max(wide, tiny), sideways);
    for (double i = 1; i < parts; ++i) {
      const double u = s.flat - wide * i / parts;
      plunge(tool, r, k == 0 ? u : across - u - tool.width(), false);
    }
    if (!tool.along(s.chain, s.flat, k == 1, across, lift, error)) return false;
  }
  return true;
}
bool Groove::finish(Insert& tool, double flank_stock, std::string* error) const {
  for (std::size_t k = 0; k < 2; ++k) {
    const Side &s = fine[k], &other = fine[1 - k];
    const double limit = across - other.flat - flank_stock - tool.width();
    const double end = std::max(s.flat, std::min(s.middle, limit));
    if (!tool.along(s.chain, end, k == 1, across, lift, error)) return false;
  }
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
