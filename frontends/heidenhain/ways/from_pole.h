// Where the tool stands seen from CC, wherever CC is: a subprogram that mills about the place of its call knows no
// more.
#pragma once

#include <optional>
#include <utility>

#include "frontends/heidenhain/state/flat.h"

namespace cnctrans::frontends::heidenhain {

/// Along the two axes of the plane.
using FromPole = std::pair<ir::Value, ir::Value>;

/// Behind the move `a.from`, or at the CC that it names.
std::optional<FromPole> from_pole(const Flat& flat, const Arrival& a);
/// `a` holds before the item: its `from` and `changed` become those behind it.
void follow_from_pole(const Flat& flat, int item, Arrival& a);

}  // namespace cnctrans::frontends::heidenhain
