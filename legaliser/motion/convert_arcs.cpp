// Arcs (equivalences 9): the centre in a form that the target has, the radius form, helix turns and pitch. Positions
// come from the dataflow, or from the words before in straight text (then the new value is an expression).
#include "legaliser/motion/arc_pass.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

void convert_arcs(Program& program, const LegaliseContext& context) {
  const FactsOf facts(program, context);
  check_radii(program, context, facts);
  ArcPass pass(program, context, facts);
  for (auto& r : program.routines) pass.routine(r);
  check_first_arcs(program, context, facts);
}

}  // namespace cnctrans::ir::passes
