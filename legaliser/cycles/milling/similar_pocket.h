// Pockets as a cycle of the target that leaves the same part by other passes (equivalences 24).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ir/block.h"
#include "ir/cycle.h"

namespace cnctrans::ir::passes {

/// A pocket of the source with what is known around it, in program units.
struct PocketSource {
  HoleCycle cycle;                    ///< with absolute levels where they are known
  std::optional<Value> u, v;          ///< where the tool stands in the plane
  std::optional<Value> feed;          ///< in force
  std::optional<double> radius;       ///< of the tool
  std::optional<SpindleState> sense;  ///< of the spindle
  double clearance = 1;               ///< one millimetre
  bool mirrors = false;               ///< the program mirrors somewhere
};
struct PocketForm {
  std::vector<HoleCycle> cycles;  ///< roughing, and finishing where it is a call of its own
  std::optional<Value> u, v;      ///< the tool goes there first; empty: it stands right
  Value retract;                  ///< the height at which it is called, and to which it goes back
  std::optional<Value> feed;      ///< that the cycles work with; empty: the one in force
  std::string differs;            ///< for people: what is not the same
};
/// nullopt with a sentence in `why`: none of the target's own cycles leaves the same part.
std::optional<PocketForm> similar_pocket(const PocketSource& source, const std::function<bool(const Cycle&)>& native,
                                         std::string* why);

}  // namespace cnctrans::ir::passes
