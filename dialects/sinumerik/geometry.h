// The geometry axes of a machine: which of X, Y and Z is the first, second and third (MD20050). The planes G17 to G19
// and the words I, J, K go by this order, not by the names of the axes.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "dialects/sinumerik/options.h"
#include "ir/axis.h"
#include "ir/modal.h"
#include "machine/profile.h"

namespace cnctrans::sinumerik {

struct GeometryAxes {
  std::array<ir::AxisId, 3> axes{ir::axis::x, ir::axis::y, ir::axis::z};

  explicit GeometryAxes(const machine::Profile& p) {
    const std::string order = options_of(p).geometry_axes;
    for (std::size_t i = 0; i < axes.size() && i < order.size(); ++i) axes[i] = ir::fixed_axis(order[i]);
  }
  /// The axis that I (0), J (1) or K (2) belongs to, and the normal of G19, G18 and G17 the same way.
  [[nodiscard]] ir::AxisId of(std::size_t n) const { return axes[n]; }
  /// 0 for the axis of I, 1 for that of J, 2 for that of K; `axis` is X, Y or Z.
  [[nodiscard]] std::size_t number(ir::AxisId axis) const { return axes[0] == axis ? 0 : axes[1] == axis ? 1 : 2; }
  /// The word of a centre, pitch or point on the way along X, Y or Z.
  [[nodiscard]] std::string_view letter(ir::AxisId axis) const {
    return std::string_view("IJK").substr(number(axis), 1);
  }
  /// The plane on this machine of a code that means `plane` where the axes stand in the order X, Y, Z.
  [[nodiscard]] ir::Plane plane(ir::Plane usual) const { return with_normal(of(ir::plane_axes(usual).w)); }
  /// The other way round: what the code of `here` means where the axes stand in the order X, Y, Z.
  [[nodiscard]] ir::Plane usual(ir::Plane here) const {
    return with_normal(static_cast<ir::AxisId>(number(ir::plane_axes(here).w)));
  }

 private:
  static ir::Plane with_normal(ir::AxisId axis) {
    return axis == ir::axis::z ? ir::Plane::xy : axis == ir::axis::y ? ir::Plane::zx : ir::Plane::yz;
  }
};

}  // namespace cnctrans::sinumerik
