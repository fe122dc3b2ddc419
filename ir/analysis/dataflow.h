// Control-flow graph and the one dataflow analysis over it: which modal facts and positions are known before each
// statement. Where two paths disagree the fact is unknown.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ir/analysis/uncalled.h"
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
  std::optional<double> spindle;          ///< S of the spindle that is chosen
  std::optional<std::uint8_t> master{1};  ///< the spindle that is chosen (MasterSpindle)
  bool cycle_active = false, cycle_active_known = true;
  /// The active cycle is known to be a hole along the normal of the plane: it leaves the tool over the hole.
  bool cycle_is_hole = false;
  /// Statement that defined the active cycle, or changed its words last; 0: none is active, or nothing is known.
  std::uint32_t cycle_from = 0;
  /// cycle_from where the ways that lead here come with different cycles, or one of them without.
  static constexpr std::uint32_t several_cycles = ~std::uint32_t{0};
  /// Routine that a modal call in force runs after motions: its index + 1; 0: no modal call; -1: unknown.
  std::int32_t modal_call = 0;
  /// modal_call within a run of the modal subprogram: no further one is started, and the one in force stays so.
  static constexpr std::int32_t in_modal_run = -2;
  /// A motion may run a modal subprogram here.
  [[nodiscard]] bool modal_call_runs() const { return modal_call != 0 && modal_call != in_modal_run; }

  /// Nothing is known any more (reachable stays, and spindle 1 where none was chosen).
  void forget();
  bool operator==(const Facts&) const = default;
};

///
/// The id of a structured statement stands for its opening line, where the condition is evaluated; also that of an
/// Until, whose body comes next and leads both back to it and on. A label on a closing line leads to the head of the
/// loop, or past an If. A statement that block skip can leave out has its follower as successor as well. A repeated
/// range leads from its last statement back to its first and on behind its Repeat.
struct ControlFlow {
  /// successors[id] = ids of the statements that can come next, ascending (0 = routine exit).
  std::vector<std::vector<std::uint32_t>> successors;
  std::vector<const Statement*> statements;  ///< by id
};
/// Of one routine; statements must have ids. Computed jumps lead to every label their search can reach. A jump to a
/// label that is not there has no successor by that way.
ControlFlow control_flow(const Program& program, const Routine& routine);

class FactTable {
 public:
  /// Of an unreachable or unknown statement: nothing known.
  [[nodiscard]] const Facts& before(std::uint32_t id) const;
  std::vector<Facts> facts;  ///< by id
};
/// Whole program, statements must have ids. Starts at the main routine with the power-on state; a routine that nothing
/// calls starts with nothing known (a further main routine: with the power-on state). Calls are followed: the callee
/// starts with what all its callers agree on; back in a caller, what the callee cannot change is as before the call,
/// the rest as at the callee's returns. After a call of an unknown or computed routine nothing is known.
FactTable analyse(const Program& program, const ModalState& power_on, Uncalled uncalled = Uncalled::unknown);
/// Facts after a statement carried out under `facts` (transfer function). Of structured statements: their opening line.
/// A call, or a range of another routine: nothing is known after it.
void apply(const Statement& statement, Facts& facts);
/// What holds on both ways: `facts` is narrowed to what `other` says as well. True when it changed.
bool join(Facts& facts, const Facts& other);

}  // namespace cnctrans::ir
