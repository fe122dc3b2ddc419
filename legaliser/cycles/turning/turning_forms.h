// The same lathe cycle in the words of another control (equivalences 25.5).
#pragma once

#include <optional>
#include <vector>

#include "ir/cycle.h"
#include "legaliser/cycles/turning/turning_computed.h"

namespace cnctrans::ir::passes {

struct TurnForm {
  NamedCycle cycle;
  TurnStart from;       ///< where the tool is to go in rapid before it; empty: it stands right
  bool proved = false;  ///< the same moves whatever the computed words are; else only a comparison of numbers tells
};
/// Cycles that may have the same moves, best first. `k`: words of X per length (2: diameters); `start`: where the tool
/// stands, in words; `places`: decimals that the target writes.
std::vector<TurnForm> turning_forms(const NamedCycle& cycle, double k, const TurnStart& start, int places);

}  // namespace cnctrans::ir::passes
