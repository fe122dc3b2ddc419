// A groove of its own shape (flanks, corner elements, allowances), cut with an insert of a known width.
#include <algorithm>
#include <numbers>

#include "base/saturate.h"
#include "ir/cycles/turning/groove_shape.h"

namespace cnctrans::ir::cycles::detail {

namespace {

constexpr double insert_overlap = 0.95;  ///< of the insert's flat part, between two plunges

}  // namespace

bool shaped_groove(Roles& r, const TurnContext& context, bool face, std::string* error) {
  const int variant = saturate<int>(r.number("variant")), kind = variant % 10;
  if (kind < 1 || kind > 8 || variant / 10 > 1 || variant < 0)
    return *error = "the machining type of the groove is 1 to 8 or 11 to 18", false;
  const bool inside = (kind - 1) % 4 >= 2, left = kind <= 4;
  const double w = context.nose_width, width = std::abs(r.number("width")), depth = std::abs(r.number("depth"));
  if (!knows_insert(context, face, error)) return false;
  const double slope = std::fmod(r.number("slope_angle"), 180);
  if (std::abs(slope) > tiny && !(face && std::abs(slope - 90) < tiny))
    return *error = "a groove on a slope is not carried out", false;
  Groove g;
  g.flanks = {Flank{r.number("flank_1") * std::numbers::pi / 180, r.number("outer_1"), r.number("inner_1")},
              Flank{r.number("flank_2") * std::numbers::pi / 180, r.number("outer_2"), r.number("inner_2")}};
  for (const auto& f : g.flanks) {
    if (f.angle < 0 || f.angle > 89.9991 * std::numbers::pi / 180)
      return *error = "a flank angle of the groove is not within 0 and 89.999 degrees", false;
  }
  const double base_stock = std::abs(r.number("stock_base")), flank_stock = std::abs(r.number("stock_flank"));
  const double flat = w - 2 * context.nose_radius;
  g.step = std::abs(r.number("step"));
  g.lift = r.number("withdrawal") != 0 ? std::abs(r.number("withdrawal")) : 1;
  g.dwell = r.number("base_dwell");
  g.sideways = insert_overlap * flat;
  if (depth < tiny || base_stock > depth - tiny) return *error = "the groove has no depth", false;
  if (g.step < tiny) return *error = "the step of the groove is not greater than zero", false;
  if (flat < tiny) return *error = "the insert of the tool is not wider than its two corners", false;
  if (g.dwell < 0) return *error = "a dwell in revolutions at the base of a groove is not carried out", false;
  if (!g.set(Shape(width, depth, g.flanks, variant >= 10), base_stock, flank_stock, w, error)) return false;

  const double into = (face ? left != *context.left_is_larger : left) ? 1 : -1;
  Insert tool(r, r.point("x", "z"), inside ? -1 : 1, into, context, face);
  const RolePoint start = tool.place(g.lift, g.rough[0].flat);
  tool.approach(g.lift, g.rough[0].flat, inside);
  const double rest = std::max(0.0, g.across - g.rough[0].flat - g.rough[1].flat - w);
  const double gaps = rest < tiny ? 0 : groove_passes(rest, g.sideways);
  for (double k = 0; k <= gaps; ++k) g.plunge(tool, r, g.rough[0].flat + (gaps > 0 ? rest * k / gaps : 0), true);
  if (!g.rough_flanks(tool, r, error) || !g.finish(tool, flank_stock, error)) return false;
  r.rapid(start);
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
