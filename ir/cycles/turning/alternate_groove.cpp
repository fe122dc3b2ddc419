// A groove whose first two plunges go down in turn, each beside the other (operating manual turning, CYCLE930): plunge,
// back, the one beside it one infeed deeper, back, the first again.. until both have reached the base; all others go
// to the base at once.
#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include "base/saturate.h"
#include "ir/cycles/turning/groove_shape.h"

namespace cnctrans::ir::cycles::detail {

namespace {

constexpr double overlap = 0.8;        ///< of the tool's width, between two plunges
constexpr double flat_overlap = 0.95;  ///< of its flat part, where that is less

/// Digit of a word that holds one decision a digit, from the right.
int digit_of(const Roles& r, std::string_view name, int place) {
  auto v = saturate<std::int64_t>(std::abs(r.number(name)));
  for (; place > 0; --place) v /= 10;
  return static_cast<int>(v % 10);
}

/// What the digits of the machining type say.
struct Variant {
  bool roughs = true, finishes = true, two_stocks = false, inside = false, left = true;
};
std::optional<Variant> variant_of(const Roles& r, std::string* error) {
  const auto d = [&](int place) { return digit_of(r, "variant", place); };
  const int what = d(1), position = d(2);
  if (r.number("variant") < 0 || r.number("variant") > 99'999 || d(0) != 0 || what < 1 || what > 3 || position < 1 ||
      position > 8 || d(3) != 0 || d(4) > 1)
    return *error = "this machining type of the groove is not carried out", std::nullopt;
  Variant v;
  v.roughs = what != 2;
  v.finishes = what != 1;
  v.two_stocks = d(4) == 1;
  v.inside = (position - 1) % 4 >= 2;
  v.left = position <= 4;
  return v;
}

/// The depth: an increment, or a coordinate of the base; where the call does not say which one, the machine's choice,
/// by default the increment unless it is the deeper cut of the two.
bool depth_of(const Roles& r, const TurnContext& context, bool face, bool inside, double& depth, std::string* error) {
  const double given = r.number("depth"), surface = face ? r.number("z") : r.number("nominal") / 2;
  const double base = face ? given : given / 2, increment = std::abs(given);
  const double down = face || !inside ? surface - base : base - surface;
  const int mode = digit_of(r, "mode", 0);
  const GrooveDepth choice = mode == 1   ? GrooveDepth::increment
                             : mode == 2 ? GrooveDepth::absolute
                                         : context.choices.groove_depth;
  if (mode > 2) return *error = "this way to give the depth of a groove is not carried out", false;
  if (choice == GrooveDepth::smaller && down > tiny && increment > down + tiny)
    return *error =
               "whether the depth of the groove is an increment or a coordinate is not sure, and the increment is "
               "the deeper one: option \"cycle.groove_depth\"",
           false;
  depth = choice == GrooveDepth::absolute ? down : increment;
  if (depth < tiny) return *error = "the groove has no depth", false;
  return true;
}

/// Width at the base, from the width at the base or at the surface.
bool width_of(const Roles& r, double opening, double& width, std::string* error) {
  const double base = std::abs(r.number("width")), top = std::abs(r.number("width_top"));
  width = base > tiny ? base : top - opening;
  if (width < tiny) return *error = "the groove has no width", false;
  if (base > tiny && top > tiny && std::abs(base + opening - top) > 0.001)
    return *error = "the widths of the groove at its base and at its surface do not fit to each other", false;
  return true;
}

bool flanks_of(const Roles& r, std::array<Flank, 2>& flanks, std::string* error) {
  flanks = {Flank{r.number("flank_1") * std::numbers::pi / 180, r.number("outer_1"), r.number("inner_1")},
            Flank{r.number("flank_2") * std::numbers::pi / 180, r.number("outer_2"), r.number("inner_2")}};
  // One digit a corner, in the order of the call: 1 is a chamfer.
  int place = 2;
  for (double* element : {&flanks[0].outer, &flanks[0].inner, &flanks[1].inner, &flanks[1].outer}) {
    const int kind = digit_of(r, "mode", place++);
    if (kind > 1) return *error = "this kind of corner of a groove is not carried out", false;
    if (kind == 1) *element = -std::abs(*element);
  }
  bool plain = true;
  for (const auto& f : flanks) {
    if (f.angle < 0 || f.angle > 89.9991 * std::numbers::pi / 180)
      return *error = "a flank angle of the groove is not within 0 and 89.999 degrees", false;
    plain = plain && f.angle == 0 && f.outer == 0 && f.inner == 0;
  }
  const double form = r.number("form");
  if (form != 0 && form != 1) return *error = "a groove on a slope is not carried out", false;
  if (form == 0 && !plain) return *error = "a groove of the plain form has no flank angles and corner elements", false;
  return true;
}

/// The first plunge in the middle and the one beside it, in turn; `step` 0: at once.
void in_turn(const Groove& g, Insert& tool, Roles& r, std::array<double, 2> u) {
  const double w = tool.width();
  std::array<double, 2> done{0, 0};
  const std::array<double, 2> deep{g.deep(u[0], w), g.deep(u[1], w)};
  for (std::size_t k = 0; done[0] < deep[0] - tiny || done[1] < deep[1] - tiny; ++k) {
    const std::size_t i = k % 2;
    if (done[i] > deep[i] - tiny) continue;
    const double next = g.step * static_cast<double>(k + 1);
    done[i] = std::min(deep[i], next);
    tool.feed(-done[i], u[i]);
    r.dwell(g.dwell);
    // Back over the other one, as far as that is cut.
    const double over = g.lift - done[1 - i];
    const bool last = done[0] > deep[0] - tiny && done[1] > deep[1] - tiny;
    tool.rapid(last ? g.lift : over, u[i]);
    if (!last && done[1 - i] < deep[1 - i] - tiny) tool.rapid(over, u[1 - i]);
  }
}

void rough_base(const Groove& g, Insert& tool, Roles& r, double middle, double room) {
  const double half = room / 2, count = half < tiny ? 0 : groove_passes(half, g.sideways);
  const double by = count > 0 ? half / count : 0;
  const auto whole = [&](double u) {
    tool.rapid(g.lift, u);
    tool.feed(-g.deep(u, tool.width()), u);
    r.dwell(g.dwell);
    tool.rapid(g.lift, u);
  };
  double first = 1;
  if (g.step < tiny) {
    whole(middle);
  } else if (count > 0) {
    tool.rapid(g.lift, middle);
    in_turn(g, tool, r, {middle, middle - by});
    first = 2;
  } else {
    g.plunge(tool, r, middle, true);
  }
  for (double k = first; k <= count; ++k) whole(middle - by * k);
  for (double k = 1; k <= count; ++k) whole(middle + by * k);
}

}  // namespace

bool alternate_groove(Roles& r, const TurnContext& context, bool face, std::string* error) {
  const auto variant = variant_of(r, error);
  if (!variant) return false;
  const double w = context.nose_width, flat = w - 2 * context.nose_radius;
  if (!knows_insert(context, face, error)) return false;
  if (flat < tiny) return *error = "the insert of the tool is not wider than its two corners", false;
  if (r.number("slope_angle") != 0) return *error = "a groove on a slope is not carried out", false;
  if (r.number("count") > 1) return *error = "a row of grooves is not carried out", false;
  if (digit_of(r, "mode", 1) != 0) return *error = "this way to give the width of a groove is not carried out", false;
  Groove g;
  double depth = 0, width = 0;
  if (!flanks_of(r, g.flanks, error) || !depth_of(r, context, face, variant->inside, depth, error)) return false;
  const double opening = depth * (std::tan(g.flanks[0].angle) + std::tan(g.flanks[1].angle));
  if (!width_of(r, opening, width, error)) return false;
  const double both = std::abs(r.number("stock"));
  const double x = std::abs(r.number("stock_x")), z = std::abs(r.number("stock_z"));
  double base_stock = !variant->two_stocks ? both : face ? z : x;
  double flank_stock = !variant->two_stocks ? both : face ? x : z;
  if (!variant->roughs) base_stock = flank_stock = 0;
  if (base_stock > depth - tiny) return *error = "the groove has no depth", false;
  g.step = std::abs(r.number("step"));
  g.lift = r.number("clearance") != 0 ? std::abs(r.number("clearance")) : 1;
  g.dwell = context.choices.groove_dwell;
  g.sideways = std::min(overlap * w, flat_overlap * flat);
  constexpr double most_plunges = 100'000;
  if (g.step >= tiny && depth / g.step > most_plunges) return *error = "the cycle has too many passes", false;
  if (!g.set(Shape(width, depth, g.flanks, true), base_stock, flank_stock, w, error)) return false;

  const bool left = variant->left != context.choices.groove_mirrored;
  const double into = (face ? left != *context.left_is_larger : left) ? 1 : -1;
  const RolePoint corner =
      face ? RolePoint{r.number("z"), r.number("nominal") / 2} : RolePoint{r.number("nominal") / 2, r.number("z")};
  Insert tool(r, corner, variant->inside ? -1 : 1, into, context, face);
  tool.feed_rate(r.number("rough_feed"));
  const double room = std::max(0.0, g.across - g.rough[0].flat - g.rough[1].flat - w);
  const double middle = g.rough[0].flat + room / 2;
  if (variant->roughs) {
    tool.approach(g.lift, middle, variant->inside);
    rough_base(g, tool, r, middle, room);
    Groove flanks = g;
    if (flanks.step < tiny) flanks.step = depth;
    if (!flanks.rough_flanks(tool, r, error)) return false;
  } else {
    tool.approach(g.lift, 0, variant->inside);
  }
  return !variant->finishes || g.finish(tool, flank_stock, error);
}

}  // namespace cnctrans::ir::cycles::detail
