// Spigots, and threads milled on a helix.
#include <algorithm>
#include <cmath>

#include "ir/cycles/milling/mill_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

/// In from the outside, or out again, on a half circle between (a, 0) and (far, 0); tangent to a way round that is
/// clockwise when the half circle is not.
void half_circle(MillPath& path, double to, double other, bool ccw) {
  path.mill_arc(to, 0, (to + other) / 2, 0, ccw);
}

/// Travel round the outside is counter-clockwise.
bool outside_ccw(const MillPath& path, std::string* error) {
  const bool inside = path.inside_ccw(error);
  return path.get("sense") >= 2 ? inside : !inside;
}
double clearance(const MillPath& path) {
  return std::abs(path.levels().reference - path.levels().surface);
}

}  // namespace

bool boss(MillPath& path, bool circle, std::string* error) {
  const double r = path.tool_radius();
  double a = std::abs(path.get("length")) / 2, b = std::abs(path.get("width")) / 2;
  double corner = std::abs(path.get("corner"));
  double blank_a = std::abs(path.get("blank_length")) / 2, blank_b = std::abs(path.get("blank_width")) / 2;
  if (circle) {
    a = b = corner = std::abs(path.get("radius", path.get("diameter") / 2));
    blank_a = blank_b = std::abs(path.get("blank_radius", path.get("blank_diameter") / 2));
  }
  const Operation operation = path.operation(error);
  const bool ccw = outside_ccw(path, error);
  if (a < least_mm || b < least_mm) *error = "a spigot needs its size";
  if (corner > std::min(a, b) + least_mm) *error = "the corners of the spigot are larger than the spigot";
  if (!error->empty()) return false;
  const bool rough = operation == Operation::rough;
  const double stock = std::abs(path.get("wall_stock"));
  const double left = rough ? stock : 0;
  double taken = 0;  // thickness of what is taken away, at its thickest
  if (rough) taken = std::max({blank_a - a - left, blank_b - b - left, 0.0});
  const auto rounds = path.times(taken / (usual_step * 2 * r));
  const auto out = [&](long k) {  // of the round beyond the finished wall
    return left + taken * static_cast<double>(rounds - k) / static_cast<double>(rounds);
  };
  const double edge = rough ? std::max(blank_a, a + left) : a + stock;
  const double first = a + r + out(1);
  const double far = std::max(first + 2 * r, edge + r + clearance(path));
  const auto& n = path.levels();
  const double floor = rough ? std::abs(path.get("floor_stock")) : 0;
  const auto [u, v] = path.place();
  path.frame(u, v, circle ? 0 : path.get("angle"));
  path.approach(far, 0);
  for (const double w : path.depths(n.surface, n.bottom + n.up * floor)) {
    path.plunge(w);
    half_circle(path, first, far, !ccw);
    for (long k = 1; k <= rounds; ++k) {
      const double by = r + out(k);
      path.mill(a + by, 0);
      round_rectangle(path, a + by, b + by, corner + by, ccw);
    }
    half_circle(path, far, a + r + out(rounds), !ccw);
  }
  path.retract();
  return true;
}

bool milled_thread(MillPath& path, std::string* error) {
  const double r = path.tool_radius();
  const double outer = std::abs(path.get("diameter")) / 2, core = std::abs(path.get("core")) / 2;
  const double pitch = std::abs(path.get("pitch"));
  const bool external = path.says("external");
  const auto& n = path.levels();
  if (pitch < least_mm || outer < least_mm || (external && core < least_mm))
    *error = "a milled thread needs its pitch and its diameters";
  if (!external && (r > outer - least_mm || (core > 0 && r > core - least_mm)))
    *error = "the tool is too large for the thread";
  const bool ccw = external ? outside_ccw(path, error) : path.inside_ccw(error);
  if (!error->empty()) return false;
  const double depth = std::abs(n.surface - n.bottom);
  const auto turns = path.times(depth / pitch);
  const double top = n.bottom + n.up * static_cast<double>(turns) * pitch;
  const double round = external ? core + r : outer - r;
  const double far = external ? std::max(round + 2 * r, outer + r + clearance(path)) : 0;
  path.scale_feed(round / (external ? core : outer));  // it is that of the contour
  const auto [u, v] = path.place();
  path.frame(u, v, 0);
  path.approach(far, 0);
  path.rapid_to(top);
  half_circle(path, round, far, external ? !ccw : ccw);
  for (long k = 1; k <= turns; ++k) path.mill_circle(0, 0, top - n.up * static_cast<double>(k) * pitch, ccw);
  half_circle(path, far, round, external ? !ccw : ccw);
  path.retract();
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
