// A tangent arc that stays in force in the source is said in every block: on other controls it holds for one block.
#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

void say_tangent_arcs(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect) return;
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      found = found || (b != nullptr && b->has_motion && b->motion.kind == MotionKind::arc_tangent);
    });
  }
  if (!found) return;
  const FactsOf facts(program, context);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&facts](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !b->has_motion || b->motion.kind != MotionKind::modal || !b->motion.moves()) return;
      if (facts.before(s).motion != MotionKind::arc_tangent) return;
      b->motion.kind = MotionKind::arc_tangent;
      b->motion.explicit_code = true;
    });
  }
}

}  // namespace cnctrans::ir::passes
