#include "legaliser/technology/spindle_limits.h"

#include "ir/edit/limit_words.h"

namespace cnctrans::ir::passes {

void check_spindle_limits(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect) return;
  LimitWords words;
  for (const auto& r : program.routines) {
    const Statement* s = words.add(r);
    if (s == nullptr) continue;
    context.diagnostics.warning("TRN-640", s->line.span,
                                "the speed of the spindle is limited by another word in another program: the source "
                                "lets the lower of both limits "
                                "count, the translation the one that comes later",
                                "write both limits in one program, one behind the other");
    return;
  }
}

}  // namespace cnctrans::ir::passes
