// What the target machine does with the actions of a block.
#pragma once

#include "ir/edit/rewrite.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// When the target machine carries the action out, by its M table.
Order target_order(const Action& action, const machine::Profile& target);
/// False for modal settings and values: carrying them out makes no event and they wait for nothing.
bool makes_event(const Action& action);
/// Takes out what the block does after its motion; the T of a tool change comes along, a D is said there as well.
std::vector<Action> take_after(Block& block);
/// Actions whose place among the others of a block without motion counts.
bool own_block(const Action& action, const Capabilities& target);
/// True when the block moves or runs a cycle.
bool has_motion(const Block& block);

/// A straight move of one axis to a place, with its code; the motion function in force stays.
Block straight_move(MotionKind kind, AxisId axis, const Value& to);

/// G90 or G91 as an action.
Action distance_set(Distance mode);

/// A block a pass has taken everything out of becomes a mark of its line; one that shows nothing goes with `tidy`.
void settle(Statement& statement);

/// Runs `edit(editor, statement, out)` over the blocks of every routine; other statements pass through.
using BlockEdit = std::function<void(class Editor&, Statement&&, Body&)>;
void edit_blocks(Program& program, const LegaliseContext& context, const BlockEdit& edit);

/// A line that leaves nothing behind when its statement goes.
inline bool shows_nothing(const LineInfo& line) {
  return line.number.empty() && line.labels.empty() && line.comments.empty();
}

}  // namespace cnctrans::ir::passes
