// A block that is carried out a computed number of times: with 0 it moves once and leaves the active machining out.
// Only the run knows which of the two it is, so both stand in the program.
#include <cmath>

#include "legaliser/analysis/head_constants.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

bool has_computed_counts(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      found = found || (b != nullptr && b->repeat_given != 0 && !b->repeat.literal());
    });
  }
  return found;
}

/// The block so many times where the count is 1 or more, else its move alone.
Statement branched(Statement&& s) {
  Block runs = std::get<Block>(std::move(s.node)), moves = runs;
  moves.repeat = Value(0);
  If branch;
  branch.condition = binary(BinaryOp::ge, runs.repeat.expr, number(0.5));  // it is rounded
  branch.has_else = true;
  branch.then_body.push_back(made(s.line, std::move(runs)));
  branch.else_body.push_back(made(s.line, std::move(moves)));
  s.node = std::move(branch);
  return std::move(s);
}

}  // namespace

void branch_block_counts(Program& program, const LegaliseContext& context) {
  if (context.target.block_repeat || !has_computed_counts(program)) return;
  const HeadConstants constants(program);
  edit_blocks(program, context, [&constants](Editor& editor, Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    if (b.repeat_given == 0 || b.repeat.literal()) return out.push_back(std::move(s));
    const Value known = constants.fold(b.repeat, editor.routine, s);
    const auto n = known.literal() ? std::optional(known.number) : constant_value(known.expr);
    if (!n) return out.push_back(branched(std::move(s)));
    if (std::round(*n) == 0) b.repeat = Value(0);
    out.push_back(std::move(s));
  });
}

}  // namespace cnctrans::ir::passes
