#include "ir/analysis/modal_runs.h"

#include <algorithm>

#include "ir/analysis/fact_set.h"

namespace cnctrans::ir::detail {

namespace {

/// Axes that move beside the path (POS, POSA) and nothing else: no path motion, which a modal subprogram waits for.
bool beside_path(const Motion& m) {
  return !m.coords.empty() && m.centers.empty() && !m.extra &&
         std::all_of(m.coords.begin(), m.coords.end(),
                     [](const CoordWord& c) { return c.positioning != Positioning::with_path; });
}

}  // namespace

bool moves(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  return b != nullptr && ((b->has_motion && b->motion.moves() && !beside_path(b->motion)) || has_pattern(*b));
}

bool may_run_modal_call(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  return b != nullptr && path_words(*b);
}

std::vector<bool> run_modally(const Program& program, const std::vector<std::size_t>& targets) {
  std::vector<bool> inside(program.routines.size());
  std::vector<std::size_t> open = targets;
  const auto reach = [&](const RoutineName& name) {
    const Routine* r = program.find(name);
    if (r != nullptr) open.push_back(static_cast<std::size_t>(r - program.routines.data()));
  };
  while (!open.empty()) {
    const std::size_t routine = open.back();
    open.pop_back();
    if (inside[routine]) continue;
    inside[routine] = true;
    for_each_statement(program.routines[routine].body, [&](const Statement& s) {
      if (const auto* c = std::get_if<CallRoutine>(&s.node)) reach(c->routine);
      if (const auto* r = std::get_if<Repeat>(&s.node); r != nullptr && r->has_program) reach(r->program);
    });
  }
  return inside;
}

}  // namespace cnctrans::ir::detail
