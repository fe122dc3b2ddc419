// The plane, G90 or G91, the motion function, the unit and the cycle are modal over calls and block ranges (reference
// 13.2): a block is read with what the ways of the program bring to it, not with what stands above it in the text. The
// ways are known when the file has been read; where they bring something else, it is read once more.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::frontends::num {

/// What is in force before a line. nullopt: nobody knows, or the ways differ.
struct Arrival {
  std::optional<ir::Plane> plane;
  std::optional<ir::Distance> distance;
  std::optional<ir::MotionKind> motion;
  std::optional<bool> inch;
  std::optional<std::uint32_t> cycle_line;  ///< where the hole cycle was defined or changed last; 0: none in force
  bool several_cycles = false;              ///< the ways come with different cycles
};
using Arrivals = std::map<std::uint32_t, Arrival>;  ///< by line

/// Facts that the reading of a block can depend on, as bits.
enum class Modal : std::uint8_t { plane = 1, distance = 2, motion = 4, unit = 8, cycle = 16 };

/// A block that was read with facts of the lines above it.
struct ModalUse {
  Span where;
  std::uint8_t facts = 0;  ///< of Modal
  Arrival taken;
};

/// The file among the programs that call it and are called with it.
struct Ways {
  ir::Program whole;
  std::size_t own = 0;    ///< index of the file's first routine
  bool straight = false;  ///< the only way is that of the text
};
/// `callers`: the main program first; null: the file stands alone.
Ways ways_of(const ir::Program& file, const std::vector<const ir::Program*>* callers);
/// What the ways bring to the lines of `uses`, as far as it is known. Empty where the only way is that of the text.
Arrivals arrivals_at(const Ways& ways, const std::vector<ModalUse>& uses, const ir::ModalState& power_on);
/// Every use has taken what the ways bring.
bool agrees(const std::vector<ModalUse>& uses, const Arrivals& arrivals);
/// NUM-070 at each block that the ways reach with different facts.
void judge_uses(const Ways& ways, const std::vector<ModalUse>& uses, const Arrivals& arrivals,
                Diagnostics& diagnostics);

}  // namespace cnctrans::frontends::num
