// What the passes of a turning cycle leave over a contour: one measure for the pass that offers the target's own cycle
// and for the verifier that compares the two.
#pragma once

#include <optional>
#include <vector>

#include "ir/cycles/machining.h"

namespace cnctrans::ir::cycles {

/// By role: `p` leads away from the part, the tool comes from plus q.
struct RolePoint {
  double p = 0, q = 0;
};
using RoleLine = std::vector<RolePoint>;

struct TurnRole {
  bool face = false;  ///< passes along X
  double out = 1, back = 1;
  [[nodiscard]] RolePoint of(double x, double z) const { return {out * (face ? z : x), back * (face ? x : z)}; }
  [[nodiscard]] RolePoint of(const TurnPoint& t) const { return of(t.x, t.z); }
  /// The tool comes from the lower end of the contour.
  void come_from_the_low_end(const RoleLine& contour);
};

/// Between the points at which a path is looked at, mm.
inline constexpr double role_step = 0.05;
/// Points close to each other, `from` included.
RoleLine role_straight(const TurnRole& role, TurnPoint from, TurnPoint to);
/// `ccw`: in the plane Z X. A whole circle where `to` is `from`.
RoleLine role_arc(const TurnRole& role, TurnPoint from, TurnPoint to, TurnPoint centre, bool ccw);

struct RoleMove {
  RoleLine points;
  bool cuts = false;
  bool finishing = false;  ///< with radius compensation
};

struct MaterialFault {
  bool in_rapid = false;  ///< a rapid move goes through material that is not cut yet; else more is left
  RolePoint at;
};
/// What the moves of `there` cut is taken for the blank over `bound`: `here` may leave no more of it, and may not move
/// through it in rapid. `room`: how far contours may lie apart, mm.
std::optional<MaterialFault> material_fault(const RoleLine& bound, const std::vector<RoleMove>& there,
                                            const std::vector<RoleMove>& here, double room);

}  // namespace cnctrans::ir::cycles
