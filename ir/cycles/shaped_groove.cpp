// A groove of its own shape (flanks, corner elements, allowances), cut with an insert of a known width.
//
// Everything is counted from the start corner: u along the pass into the groove, p out of the work. The tool has one
// programmed point, a corner of its insert; where the other corner cuts, the point is one width away from it.
#include <algorithm>
#include <array>
#include <numbers>

#include "base/saturate.h"
#include "ir/cycles/contour.h"

namespace cnctrans::ir::cycles::detail {

namespace {

constexpr double most_passes = 100'000;
constexpr double overlap = 0.95;  ///< of the insert's flat part, between two plunges

double pass_count(double total, double step) {
  return std::clamp(std::ceil(total / step - tiny), 1.0, most_passes);
}

/// One side of the groove as its shape says.
struct Flank {
  double angle = 0;  ///< radians, from the infeed
  double outer = 0, inner = 0;
};
/// Of a side, counted from its own outer corner: the contour, and where the flat part of the base begins.
struct Side {
  Chain chain;  ///< from the surface down and along the base; q is -u
  double top = 0, flat = 0, middle = 0;
};

/// How far a corner element reaches from the corner: a radius, or a chamfer (negative) by its length or its width.
double reach(double element, double turn, bool by_width) {
  if (element >= 0) return element * std::tan(turn / 2);
  return by_width ? -element : -element / (2 * std::cos(turn / 2));
}

/// Line, corner, line ..: the corner element between two directions.
void corner(Chain& out, RolePoint at, RolePoint before, RolePoint after, double element, double far) {
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

class Shape {
 public:
  Shape(double width, double depth, std::array<Flank, 2> flanks, bool by_width)
      : width_(width), depth_(depth), flanks_(flanks), by_width_(by_width) {}

  [[nodiscard]] double across() const {
    return width_ + depth_ * (std::tan(flanks_[0].angle) + std::tan(flanks_[1].angle));
  }
  /// The side with its allowances; without them also its outer corner element.
  [[nodiscard]] std::optional<Side> side(std::size_t k, double base_stock, double flank_stock, bool outer) const {
    const Flank& f = flanks_[k];
    const double deep = depth_ - base_stock, slope = std::tan(f.angle), turn = std::numbers::pi / 2 - f.angle;
    Side s;
    s.top = flank_stock / std::cos(f.angle);
    const RolePoint edge{0, -s.top}, root{-deep, -(s.top + deep * slope)}, down{-std::cos(f.angle), -std::sin(f.angle)};
    const RolePoint in{0, -1};
    const double high = outer ? reach(f.outer, turn, by_width_) : 0, low = reach(f.inner, turn, by_width_);
    const double length = std::hypot(root.p - edge.p, root.q - edge.q);
    if (high + low > length + tiny) return std::nullopt;
    corner(s.chain, edge, in, down, f.outer, high);
    const RolePoint a{edge.p + high * down.p, edge.q + high * down.q}, b{root.p - low * down.p, root.q - low * down.q};
    if (high + low < length - tiny) s.chain.push_back({a, b, false, false, {}});
    corner(s.chain, root, down, in, f.inner, low);
    s.flat = -root.q + low;
    s.middle = depth_ * slope + width_ / 2;
    s.chain.push_back({{-deep, -s.flat}, {-deep, -s.flat - width_}, false, false, {}});
    return s;
  }

 private:
  double width_, depth_;
  std::array<Flank, 2> flanks_;
  bool by_width_;
};

/// Depth of the side at u, below the surface.
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

/// Writes the moves, given from the start corner.
class Insert {
 public:
  Insert(Roles& r, RolePoint corner, double out, double into, const TurnContext& context, bool face)
      : r_(r), corner_(corner), out_(out), into_(into), width_(context.nose_width), radius_(context.nose_radius) {
    const int edge = context.edge;
    const bool known = edge >= 1 && edge <= 4;
    const bool plus = known ? (face ? edge <= 2 : edge == 1 || edge == 4) : context.edge_at_plus;
    shift_ = (into > 0) == plus ? into * width_ : 0;
  }
  /// The point of the tool when the corner of its insert that comes first stands at u.
  [[nodiscard]] RolePoint place(double p, double u) const {
    return {corner_.p + out_ * p, corner_.q + into_ * u + shift_};
  }
  void rapid(double p, double u) { r_.rapid(place(p, u)); }
  void feed(double p, double u) { r_.feed(place(p, u)); }
  /// Along a side from above its first point to `end` on the base, with the corner of the insert that cuts there.
  bool along(const Chain& side, double end, bool far, double across, double lift, std::string* error) {
    auto path = offset(side, radius_, error);
    if (!path || path->empty()) return false;
    path->back().b.q = std::min(path->back().a.q, -end - radius_);
    const auto u = [&](double q) { return far ? across + (q + radius_) - width_ : -(q + radius_); };
    const RolePoint first = path->front().a;
    rapid(lift, u(first.q));
    feed(first.p - radius_, u(first.q));
    for (const auto& x : *path) {
      const RolePoint to = place(x.b.p - radius_, u(x.b.q)), centre = place(x.c.p - radius_, u(x.c.q));
      const bool mirrored = out_ * into_ * (far ? 1 : -1) < 0;
      if (x.arc)
        r_.arc(to, centre, x.ccw != mirrored, 0);
      else
        r_.feed(to);
    }
    r_.rapid({corner_.p + out_ * lift, r_.here().q});
    return true;
  }

 private:
  Roles& r_;
  RolePoint corner_;
  double out_, into_, width_, radius_, shift_ = 0;
};

}  // namespace

bool shaped_groove(Roles& r, const TurnContext& context, bool face, std::string* error) {
  const int variant = saturate<int>(r.number("variant")), kind = variant % 10;
  if (kind < 1 || kind > 8 || variant / 10 > 1 || variant < 0)
    return *error = "the machining type of the groove is 1 to 8 or 11 to 18", false;
  const bool inside = (kind - 1) % 4 >= 2, left = kind <= 4;
  const double w = context.nose_width, width = std::abs(r.number("width")), depth = std::abs(r.number("depth"));
  if (w <= 0)
    return *error = "the width of the grooving tool is not known: \"nose_width\" of the tool in the profile", false;
  const double slope = std::fmod(r.number("slope_angle"), 180);
  if (std::abs(slope) > tiny && !(face && std::abs(slope - 90) < tiny))
    return *error = "a groove on a slope is not carried out", false;
  if (face && !context.left_is_larger)
    return *error =
               "on which side of a groove in the face its start lies is not known: option "
               "\"cycle.face_groove_left\"",
           false;
  const std::array<Flank, 2> flanks{
      Flank{r.number("flank_1") * std::numbers::pi / 180, r.number("outer_1"), r.number("inner_1")},
      Flank{r.number("flank_2") * std::numbers::pi / 180, r.number("outer_2"), r.number("inner_2")}};
  for (const auto& f : flanks) {
    if (f.angle < 0 || f.angle > 89.9991 * std::numbers::pi / 180)
      return *error = "a flank angle of the groove is not within 0 and 89.999 degrees", false;
  }
  const double base_stock = std::abs(r.number("stock_base")), flank_stock = std::abs(r.number("stock_flank"));
  const double step = std::abs(r.number("step")),
               lift = r.number("withdrawal") != 0 ? std::abs(r.number("withdrawal")) : 1;
  const double flat = w - 2 * context.nose_radius, dwell = r.number("base_dwell");
  if (depth < tiny || base_stock > depth - tiny) return *error = "the groove has no depth", false;
  if (step < tiny) return *error = "the step of the groove is not greater than zero", false;
  if (flat < tiny) return *error = "the insert of the tool is not wider than its two corners", false;
  if (dwell < 0) return *error = "a dwell in revolutions at the base of a groove is not carried out", false;
  const Shape shape(width, depth, flanks, variant >= 10);
  const double across = shape.across();
  std::array<Side, 2> rough, fine;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto a = shape.side(k, base_stock, flank_stock, false), b = shape.side(k, 0, 0, true);
    if (!a || !b) return *error = "the corner elements of the groove do not fit to its flanks", false;
    rough[k] = *a;
    fine[k] = *b;
  }
  const auto room = [&](const std::array<Side, 2>& s) { return across - s[0].flat - s[1].flat - w; };
  if (room(rough) < -tiny || room(fine) < -tiny) return *error = "the groove is narrower than the tool", false;

  const double into = (face ? left != *context.left_is_larger : left) ? 1 : -1;
  Insert tool(r, r.point("x", "z"), inside ? -1 : 1, into, context, face);
  const RolePoint start = tool.place(lift, rough[0].flat);
  if (inside)
    r.rapid({start.p, r.here().q});
  else
    r.rapid({r.here().p, start.q});
  r.rapid(start);

  const auto plunge = [&](double u, bool base) {
    const double deep = std::min(depth_at(rough[0], u), depth_at(rough[1], across - u - w));
    if (deep < tiny) return;
    const double levels = pass_count(deep, step);
    tool.rapid(lift, u);
    for (double k = 1; k <= levels; ++k) {
      tool.feed(-deep * k / levels, u);
      if (k < levels) tool.rapid(-deep * k / levels + lift, u);
    }
    if (base) r.dwell(dwell);
    tool.rapid(lift, u);
  };
  const double rest = std::max(0.0, room(rough)), gaps = rest < tiny ? 0 : pass_count(rest, overlap * flat);
  for (double k = 0; k <= gaps; ++k) plunge(rough[0].flat + (gaps > 0 ? rest * k / gaps : 0), true);
  for (std::size_t k = 0; k < 2; ++k) {
    const Side& s = rough[k];
    const double wide = s.flat - s.top;
    if (wide < tiny && flanks[k].inner == 0) continue;
    const double parts = pass_count(std::max(wide, tiny), overlap * flat);
    for (double i = 1; i < parts; ++i) {
      const double u = s.flat - wide * i / parts;
      plunge(k == 0 ? u : across - u - w, false);
    }
    if (!tool.along(s.chain, s.flat, k == 1, across, lift, error)) return false;
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const Side &s = fine[k], &other = fine[1 - k];
    const double limit = across - other.flat - flank_stock - w;
    const double end = std::max(s.flat, std::min(s.middle, limit));
    if (!tool.along(s.chain, end, k == 1, across, lift, error)) return false;
  }
  r.rapid(start);
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
