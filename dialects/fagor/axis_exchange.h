// G28 and G29 with axes (§7.8): pairs of axes that change places.
#pragma once

#include <optional>

#include "ir/analysis/domains/axis_exchange.h"

namespace cnctrans::dialects::fagor {

/// Of a block that is kept as text; nullopt: it is no G28 or G29 with axes.
std::optional<ir::passes::AxisExchange> axis_exchange(const ir::Statement& s);

}  // namespace cnctrans::dialects::fagor
