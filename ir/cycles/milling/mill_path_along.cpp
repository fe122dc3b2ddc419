// Milling along a contour: approach, the contour on every level under radius compensation, retract.
#include <cmath>

#include "ir/cycles/milling/mill_contour.h"
#include "ir/cycles/milling/mill_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

/// The way onto the contour, or off it: the tool's middle at `tool` without compensation is where compensation puts it
/// for a way from or to `outer`. Without a known radius it stands far enough from there for any tool that fits.
struct Lead {
  double tool_u = 0, tool_v = 0;
  double outer_u = 0, outer_v = 0;
  bool arc = false, ccw = false;
  double cu = 0, cv = 0;
};

/// `out`: behind the contour's end. `length`: from the tool's edge to the contour (line), or radius of the way of the
/// tool's middle (arc).
Lead lead_of(const MillElement& e, bool out, int way, double length, double tool_radius, int side) {
  const double u = out ? e.u1 : e.u0, v = out ? e.v1 : e.v0;
  const Direction t = direction_at(e, out);
  const double r = side == 0 ? 0 : tool_radius, far = length + r;
  const double aside = side == 0 ? 0 : r > 0 ? r : length;
  const double ahead = out ? 1 : -1;  // along the way
  Direction n = t.left();             // to the tool's side
  if (side < 0) n = {-n.u, -n.v};
  Lead lead;
  if (way == 1) {
    lead.outer_u = u + ahead * far * t.u;
    lead.outer_v = v + ahead * far * t.v;
    lead.tool_u = lead.outer_u + aside * n.u;
    lead.tool_v = lead.outer_v + aside * n.v;
    return lead;
  }
  lead.arc = true;
  lead.ccw = side > 0;
  lead.cu = u + far * n.u;
  lead.cv = v + far * n.v;
  const Direction from = way == 2 ? Direction{ahead * t.u, ahead * t.v} : n;
  lead.outer_u = lead.cu + far * from.u;
  lead.outer_v = lead.cv + far * from.v;
  lead.tool_u = lead.cu + (far - aside) * from.u;
  lead.tool_v = lead.cv + (far - aside) * from.v;
  return lead;
}

struct ContourPlan {
  std::vector<MillElement> way;
  std::vector<double> heights;  ///< of the contour itself
  Lead in, out;
  int side = 0;  ///< 1 left, -1 right
  bool rough = true, feed_links = false, spatial_in = false, spatial_out = false;
  int lift = 0;
};

/// From and to `w`: the height of the contour, where it has none of its own.
void once_along(MillPath& path, const ContourPlan& plan, double w, double clear) {
  path.plunge(plan.spatial_in ? clear : w);
  if (plan.side != 0) path.compensate(plan.side);
  path.mill(plan.in.outer_u, plan.in.outer_v);
  const auto& first = plan.way.front();
  if (plan.in.arc)
    path.mill_arc_to(first.u0, first.v0, w, plan.in.cu, plan.in.cv, plan.in.ccw);
  else
    path.mill_to(first.u0, first.v0, w);
  for (std::size_t i = 0; i < plan.way.size(); ++i) {
    const auto& e = plan.way[i];
    const double end = plan.heights.empty() ? w : plan.heights[i + 1];
    if (e.arc)
      path.mill_arc_to(e.u1, e.v1, end, e.cu, e.cv, e.ccw);
    else
      path.mill_to(e.u1, e.v1, end);
  }
  const double up = plan.spatial_out ? clear : plan.heights.empty() ? w : plan.heights.back();
  if (plan.out.arc)
    path.mill_arc_to(plan.out.outer_u, plan.out.outer_v, up, plan.out.cu, plan.out.cv, plan.out.ccw);
  else
    path.mill_to(plan.out.outer_u, plan.out.outer_v, up);
  if (plan.side != 0) path.compensate(0);
  path.mill(plan.out.tool_u, plan.out.tool_v);
}

bool read_plan(MillPath& path, const MillContour& contour, ContourPlan& plan, std::string* error) {
  plan.rough = path.operation(error) == Operation::rough;
  const double side = path.get("side"), variant = path.get("variant");
  if (side != 40 && side != 41 && side != 42) *error = "the side of the contour is 40 (on it), 41 (left) or 42 (right)";
  plan.side = side == 41 ? 1 : side == 42 ? -1 : 0;
  plan.feed_links = digit(variant, 1) == 1;
  plan.lift = digit(variant, 2);
  const double stock = plan.rough ? std::abs(path.get("wall_stock")) : 0;
  if (plan.side == 0 && stock > 0) *error = "an allowance at the wall needs the side of the contour: left or right";
  const int in = digit(path.get("approach"), 0), out = digit(path.get("leave"), 0);
  if (in < 1 || in > 3 || out < 1 || out > 3)
    *error = "the way onto and off the contour is 1 (line), 2 (quadrant) or 3 (semicircle)";
  if (plan.side == 0 && (in != 1 || out != 1)) *error = "an approach on an arc needs the side of the contour";
  plan.spatial_in = digit(path.get("approach"), 1) == 1;
  plan.spatial_out = digit(path.get("leave"), 1) == 1;
  const double in_length = std::abs(path.get("approach_length")), out_length = std::abs(path.get("leave_length"));
  if (in_length < least_mm || out_length < least_mm)
    *error = "the way onto or off the contour has no length (alarm 61116)";
  if (!error->empty()) return false;
  if (contour.elements.empty()) return *error = "the contour has no elements", false;
  if (!contour.heights.empty() && stock > 0)
    return *error = "an allowance at the wall of a contour with heights of its own is not carried out", false;
  auto way = parallel(contour.elements, stock, plan.side > 0, error);
  if (!way) return false;
  plan.way = *std::move(way);
  plan.heights = contour.heights;
  const double r = path.tool_radius();
  plan.in = lead_of(plan.way.front(), false, in, in_length, r, plan.side);
  plan.out = lead_of(plan.way.back(), true, out, out_length, r, plan.side);
  return true;
}

}  // namespace

bool contour_path(MillPath& path, const std::vector<MillContour>* contours, std::string* error) {
  if (contours == nullptr || contours->size() != 1) return *error = "the cycle needs its contour", false;
  ContourPlan plan;
  if (!read_plan(path, contours->front(), plan, error)) return false;
  const auto& n = path.levels();
  const double safe = std::abs(n.reference - n.surface);
  const double link = path.get("link_feed", path.get("mill_feed"));
  path.frame(0, 0, 0);
  path.approach(plan.in.tool_u, plan.in.tool_v);
  const auto depths =
      plan.heights.empty()
          ? path.depths(n.surface, n.bottom + n.up * (plan.rough ? std::abs(path.get("floor_stock")) : 0))
          : std::vector<double>{plan.heights.front()};
  const auto rise = [&](double w) {
    if (plan.feed_links)
      path.link(plan.out.tool_u, plan.out.tool_v, w, link);
    else
      path.rapid_to(w);
  };
  for (std::size_t k = 0; k < depths.size(); ++k) {
    const double above = depths[k] + n.up * safe;
    once_along(path, plan, depths[k], above);
    if (k + 1 == depths.size()) break;
    if (plan.lift == 0) rise(n.has_retract ? n.retract : n.reference);
    if (plan.lift == 1) rise(n.reference);
    if (plan.lift == 2) rise(above);
    if (plan.feed_links)
      path.link(plan.in.tool_u, plan.in.tool_v, path.height(), link);
    else
      path.rapid(plan.in.tool_u, plan.in.tool_v);
    if (plan.lift == 0) path.rapid_to(n.reference);
  }
  path.retract();
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
