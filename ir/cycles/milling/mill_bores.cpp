// Bores and threads milled on a helix, from the middle out and back.
#include <cmath>

#include "ir/cycles/milling/mill_moves.h"

namespace cnctrans::ir::cycles::detail {

/// From the reference plane: a half circle out, round down to the bottom in equal turns not above `pitch`, once round
/// there, a half circle back. A tool of the bore's size goes straight down.
bool helix_bore(MillPath& path, std::string* error) {
  const double out = std::abs(path.get("diameter")) / 2 - path.tool_radius();
  const double pitch = std::abs(path.get("pitch"));
  if (out < -least_mm) *error = "the tool is larger than the bore";
  if (out > least_mm && pitch < least_mm) *error = "a bore on a helix needs its pitch";
  const bool ccw = path.inside_ccw(error);
  if (!error->empty()) return false;
  const auto& n = path.levels();
  const auto [u, v] = path.place();
  path.frame(u, v, 0);
  path.rapid(0, 0);
  path.rapid_to(n.reference);
  if (out <= least_mm) {
    path.plunge(n.bottom);
  } else {
    const double height = std::abs(n.reference - n.bottom);
    const auto turns = path.times(height / pitch);
    path.mill_arc(out, 0, out / 2, 0, ccw);
    for (long k = 1; k <= turns; ++k)
      path.mill_circle(0, 0, n.reference - n.up * height * static_cast<double>(k) / static_cast<double>(turns), ccw);
    path.mill_circle(0, 0, n.bottom, ccw);
    path.mill_arc(0, 0, out / 2, 0, ccw);
  }
  path.rapid_to(n.reference);
  path.retract();
  return true;
}

/// Turns of one pitch each at the bottom (`per_step` 0), over the whole depth (1), or one for every `per_step` pitches.
/// A half circle leads onto the helix and off it, half a pitch high each. `pitch`: + right hand, - left hand.
bool helix_thread(MillPath& path, std::string* error) {
  const bool external = path.says("external");
  const double nominal = std::abs(path.get("diameter")) / 2, signed_pitch = path.get("pitch");
  const double pitch = std::abs(signed_pitch), per_step = std::floor(std::abs(path.get("per_step")));
  const double round = external ? nominal + path.tool_radius() : nominal - path.tool_radius();
  if (pitch < least_mm || nominal < least_mm) *error = "a milled thread needs its pitch and its diameter";
  if (error->empty() && round < least_mm) *error = "the tool is too large for the thread";
  const bool inside = path.inside_ccw(error);
  if (!error->empty()) return false;
  const bool ccw = external ? !inside : inside;  // climb milling has the material on the other side
  const auto& n = path.levels();
  const double depth = std::abs(n.surface - n.bottom);
  const bool upward = ccw == (signed_pitch > 0);  // a right hand rises counter-clockwise
  const long turns = per_step == 1 ? path.times(depth / pitch) : 1;
  const long steps = per_step > 1 ? path.times(depth / (per_step * pitch)) : 1;
  const double far = external ? round + path.tool_radius() + pitch : 0;
  path.scale_feed(round / nominal);  // the feed is that of the edge
  const auto [u, v] = path.place();
  path.frame(u, v, 0);
  path.rapid(0, 0);
  path.rapid_to(n.reference);
  path.rapid(far, 0);
  const double height = static_cast<double>(turns) * pitch;
  const bool half = external ? !ccw : ccw;
  for (long k = 0; k < steps; ++k) {
    const double low =
        n.bottom + n.up * static_cast<double>(upward ? k : steps - 1 - k) * std::max(per_step, 1.0) * pitch;
    const double first = upward ? low : low + n.up * height, way = upward ? n.up * pitch : -n.up * pitch;
    path.link(far, 0, first - way / 2, path.get("plunge_feed"));
    path.lead_arc_to(round, 0, first, (round + far) / 2, 0, half);
    for (long t = 1; t <= turns; ++t) path.mill_circle(0, 0, first + static_cast<double>(t) * way, ccw);
    const double last = first + static_cast<double>(turns) * way;
    path.mill_arc_to(far, 0, last + way / 2, (round + far) / 2, 0, half);
  }
  path.retract();
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
