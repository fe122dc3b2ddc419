// Slots as the pockets that they are (equivalences 24).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ir/cycle.h"

namespace cnctrans::ir::passes {

struct SinglePockets {
  std::vector<HoleCycle> pockets;              ///< in the order in which they are machined
  std::optional<std::pair<Value, Value>> end;  ///< in the plane, where the source leaves the tool; none: in the middle
};
/// A pocket by itself; slots each as a rectangle whose corners are half as large as it is wide. nullopt: it is neither,
/// or, with a sentence in `why`, can't be told here.
std::optional<SinglePockets> single_pockets(const HoleCycle& cycle, std::string* why);

}  // namespace cnctrans::ir::passes
