// Hole cycles of the mill model (manual 25.2, 25.3) that are exactly what the neutral cycle expands to.
#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/cycle.h"
#include "ir/modal.h"

namespace cnctrans::backends::fagor {

/// Words of a cycle block. `code`: "G81"; values without a place are not written.
struct CycleWords {
  std::string_view code;
  bool has_reference = false;
  ir::Value reference;                           ///< word of the longitudinal axis
  ir::Value depth;                               ///< I: bottom, or one peck with its sign
  std::optional<ir::Value> dwell;                ///< K, seconds times 100
  double dwell_scale = 1;                        ///< value times this is seconds
  std::optional<ir::Value> count;                ///< J
  std::vector<std::pair<char, ir::Value>> more;  ///< further letters, in the printed order
  bool printed_order = false;                    ///< `more` stands as it is, else in the order of the alphabet
  bool retract_given = false;                    ///< the tool leaves to `retract`, else by the retract plane setting
  ir::Value retract;                             ///< absolute
  bool retract_is_reference = false;
};

/// nullopt: the control has no such cycle with exactly these moves. Levels are words of absolute mode unless the cycle
/// says that they follow the mode.
std::optional<CycleWords> cycle_words(const ir::Cycle& cycle);

/// For capabilities.
bool native_cycle(const ir::Cycle& cycle);

/// A cycle of the lathe in letters of its own, without a profile.
bool native_machining(const ir::Cycle& cycle);

/// Why the levels of `cycle` can't be written under this mode; empty: they can.
std::string_view level_problem(const ir::HoleCycle& cycle, std::optional<ir::Distance> distance);

}  // namespace cnctrans::backends::fagor
