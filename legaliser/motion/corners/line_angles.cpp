// A line by its angle and one coordinate, for a target without such words.
#include <algorithm>

#include "legaliser/analysis/path_points.h"
#include "legaliser/early_passes.h"

namespace cnctrans::ir::passes {

void write_line_angles(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || context.target.line_angle) return;
  const auto by_angle = [](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    return b != nullptr && b->has_motion && b->motion.extra && b->motion.extra->has_line_angle;
  };
  bool any = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) { any = any || by_angle(s); });
  }
  if (!any) return;
  const FactsOf facts(program, context);
  const PathPoints points(context, facts);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      const auto path = by_angle(s) ? points.path_of(s) : std::nullopt;
      if (!path) return;  // the writer refuses it
      auto& m = std::get<Block>(s.node).motion;
      points.set_end(m, path->plane, path->e.b);
      std::stable_sort(m.coords.begin(), m.coords.end(), [](const auto& a, const auto& b) { return a.axis < b.axis; });
    });
  }
}

}  // namespace cnctrans::ir::passes
