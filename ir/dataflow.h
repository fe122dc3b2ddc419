// Control-flow graph and the one dataflow analysis over it: which modal facts and positions are known before each
// statement. Where two paths disagree the fact is unknown.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ir/program.h"

namespace cnctrans::ir {

/// What is known before a statement. nullopt = paths disagree, or nothing is known.
struct Facts {
  bool reachable = false;
  std::array<std::optional<std::uint8_t>, setting_count> settings{};
  std::optional<MotionKind> motion;
  std::optional<std::int32_t> work_offset;
  /// Last programmed coordinate of an axis in the current work frame (program units; the axis' own word scale resolved
  /// to radius), when it is a known number.
  std::array<std::optional<double>, axis::count_max> position{};
  std::optional<double> feed;
  std::optional<double> spindle;
  bool cycle_active = false, cycle_active_known = true;
};

struct ControlFlow {
  /// successors[id] = ids of the statements that can come next (0 = routine exit).
  std::vector<std::vector<std::uint32_t>> successors;
  std::vector<const Statement*> statements;  ///< by id
};
/// Of one routine; statements must have ids. Computed jumps lead to every label of the routine.
ControlFlow control_flow(const Program& program, const Routine& routine);

class FactTable {
 public:
  [[nodiscard]] const Facts& before(std::uint32_t id) const;
  std::vector<Facts> facts;
};
/// Whole program: calls are followed (callee facts flow back to the caller; recursion and unknown callees: all unknown).
FactTable analyse(const Program& program, const ModalState& power_on);
/// Facts after a statement carried out under `before` (transfer function; calls excluded).
void apply(const Statement& statement, Facts& facts);

}  // namespace cnctrans::ir
