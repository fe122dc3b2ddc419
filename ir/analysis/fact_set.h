// Sets of facts, and what a statement can change. Only for the .cpp files of ir/.
#pragma once

#include <array>
#include <bitset>

#include "ir/analysis/dataflow.h"

namespace cnctrans::ir::detail {

// One bit a fact: settings, positions, then these.
inline constexpr std::size_t position_bit = setting_count;
inline constexpr std::size_t motion_bit = position_bit + axis::count_max;
inline constexpr std::size_t work_offset_bit = motion_bit + 1;
inline constexpr std::size_t feed_bit = motion_bit + 2;
inline constexpr std::size_t spindle_bit = motion_bit + 3;
inline constexpr std::size_t cycle_bit = motion_bit + 4;
inline constexpr std::size_t modal_call_bit = motion_bit + 5;
inline constexpr std::size_t master_bit = motion_bit + 6;
using FactSet = std::bitset<master_bit + 1>;

/// Which cycles a program has: they decide what a motion can change.
struct CyclesUsed {
  bool any = false;
  bool other_than_holes = false;
};
void note_cycles(const Statement& s, CyclesUsed& cycles);

/// What the frame statements of a program reach, and its modal cycles.
struct FrameReach {
  std::uint32_t axes = ~0U;  ///< bit n: one of them can move coordinates of axis n
  /// A preset is part of the work offset, which this machine has in force from the beginning: while the offsets are
  /// off, it says nothing of where the tool is.
  bool presets_by_offset = false;
  /// A row of the work offset table, or what is added to it, may change while the program runs: selecting the row that
  /// is in force already moves the coordinates.
  bool rows_change = true;
  std::uint32_t turned = ~0U;  ///< bit n: a rotation mixes axis n with another one
  bool cycles_turn = true;     ///< the cycle in force may run in any block, and leave a speed of its own
};
FrameReach frame_reach(const Program& program, const ModalState& power_on);
/// ir::apply() in a program where frame statements reach these axes only.
void apply(const Statement& statement, Facts& facts, const FrameReach& framed);

/// F, S or a bare motion code: such a block runs a cycle called at each motion, and on some machines a modal
/// subprogram.
bool path_words(const Block& b);
/// The block is carried out at the points of a pattern, and ends at one of them.
bool has_pattern(const Block& b);
/// Data of a tool: programmed positions are those of its tip, whatever they are.
bool is_tool_datum(Datum d);

/// A speed in rev/min: a number, or what follows from the speed in force.
std::optional<double> speed_number(const Value& v, const Facts& f);
/// A cycle with speeds of its own leaves the last of them in force, once it has run.
void take_speeds(const HoleCycle& hole, Facts& f, bool runs_now);

/// Behind a call of a routine that goes straight through its text: the places that follow from those before the call
/// by its increments, though its callers stand at different ones. `entry`: what all its callers agree on.
void displace(Facts& behind, const Facts& before, const Routine& routine, const Facts& entry, const FrameReach& framed);

/// Of the changes of a routine that gives the modal state back, those that stay. `f`, behind the call, gets the others
/// from `before` it; where the tool is remains open.
FactSet given_back(FactSet set, const Facts& before, Facts& f);

/// Which facts differ.
FactSet differing(const Facts& a, const Facts& b);
/// The facts of `from` that are in `set` replace those of `facts`.
void take(Facts& facts, const Facts& from, const FactSet& set);
/// What holds where a program begins.
Facts facts_at(const ModalState& power_on);
/// States that agree on nothing: what a statement changes shows in one of them, in each of the three planes.
std::array<Facts, 4> probes(const CyclesUsed& cycles);
/// What a statement can change, carried out under any of these states.
FactSet changed_by(const Statement& s, const std::array<Facts, 4>& states, const FrameReach& framed);

}  // namespace cnctrans::ir::detail
