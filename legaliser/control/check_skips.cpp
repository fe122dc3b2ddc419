// Block skip levels (equivalences 3.3).
#include <bit>

#include "ir/edit/rewrite.h"
#include "legaliser/control/skip_groups.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

void check_line(const LineInfo& line, bool structure, const LegaliseContext& context) {
  if (line.skip_mask == 0) return;
  const auto& t = context.target;
  const int highest = std::bit_width(static_cast<unsigned>(line.skip_mask)) - 1;
  if (highest >= t.skip_levels) {
    context.diagnostics.error("TRN-161", line.span,
                              "block skip level " + std::to_string(highest) + " (counted from 0): the target has " +
                                  std::to_string(t.skip_levels) + (t.skip_levels == 1 ? " level" : " levels"),
                              "use a lower level, or a jump on a variable");
  } else if (!t.skip_several && std::popcount(static_cast<unsigned>(line.skip_mask)) > 1) {
    context.diagnostics.error("TRN-162", line.span, "the target takes one skip level a block",
                              "put a jump with its own skip level before the block for each further level");
  } else if (structure && !t.skip_on_structures) {
    context.diagnostics.error("TRN-163", line.span, "the target can't skip a block with a structured statement",
                              "write the loop or condition with jumps");
  }
}

}  // namespace

void check_skips(Program& program, const LegaliseContext& context) {
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&context](const Statement& s) { check_line(s.line, is_structure(s), context); });
  }
}

}  // namespace cnctrans::ir::passes
