// GEOAX(3,W): an axis of the channel takes the place of a geometry axis (language reference 14.2).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/analysis/domains/axis_exchange.h"

namespace cnctrans::sinumerik {

/// One pair of GEOAX(): the number of the geometry axis, 1 to 3, and the name of the axis of the channel in capitals.
struct GeometryAxis {
  int number = 0;
  std::string channel_axis;
};
/// Of the text of a call, GEOAX(3,W,1,U); empty for GEOAX(); nullopt when it is none or its pairs are not written so.
std::optional<std::vector<GeometryAxis>> geometry_axes(std::string_view text);
/// The axis of the channel that is this geometry axis by itself: X1, XX or X for X.
bool is_own_axis(const GeometryAxis& a);

/// Of a block with GEOAX(); `names` are those of the axes from ir::axis::first_extra on.
std::optional<ir::passes::AxisExchange> geometry_exchange(const ir::Statement& s,
                                                          const std::vector<std::string>& names);

}  // namespace cnctrans::sinumerik
