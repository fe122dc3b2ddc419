// How deep calls may lie in each other on the target (equivalences 27 nr 10).
#include <algorithm>

#include "base/text.h"
#include "ir/analysis/call_graph.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

/// The deepest call below each routine, and the one that begins the way there.
class Depths {
 public:
  explicit Depths(const CallGraph& calls, std::size_t routines, bool levels) : calls_(calls), levels_(levels) {
    depth_.assign(routines, 0);
    // A ring of calls has no depth: as many rounds as there are routines.
    for (std::size_t round = 0; round < routines; ++round) {
      bool changed = false;
      for (const auto& site : calls_.sites()) {
        if (!site.callee || *site.callee == site.caller) continue;
        const std::size_t own = levels_ && site.level != CallLevel::new_level ? 0 : 1;
        const std::size_t deep = depth_[*site.callee] + own;
        if (deep <= depth_[site.caller]) continue;
        depth_[site.caller] = deep;
        changed = true;
      }
      if (!changed) return;
    }
    ring_ = true;
  }
  [[nodiscard]] std::size_t below(std::size_t routine) const { return ring_ ? 0 : depth_[routine]; }

 private:
  const CallGraph& calls_;
  bool levels_ = false, ring_ = false;
  std::vector<std::size_t> depth_;
};

void check(const Program& program, const LegaliseContext& context, const CallGraph& calls, bool levels,
           std::size_t most) {
  if (most == 0) return;
  const Depths depths(calls, program.routines.size(), levels);
  for (std::size_t i = 0; i < program.routines.size(); ++i) {
    const std::size_t deep = depths.below(i);
    if (program.routines[i].kind != RoutineKind::main || deep <= most) continue;
    const auto first = std::find_if(calls.sites().begin(), calls.sites().end(), [&](const CallSite& c) {
      return c.caller == i && c.callee && depths.below(*c.callee) + 1 >= deep;
    });
    const Span at = first == calls.sites().end() ? program.routines[i].header.span : first->statement->line.span;
    const std::string what = levels ? " levels of local parameters" : " calls";
    context.diagnostics.error(
        "TRN-396", at,
        std::to_string(deep) + what + " lie in each other behind this call: the target has " + std::to_string(most),
        "call some of the subprograms one after the other");
  }
}

}  // namespace

void check_call_limits(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect) return;
  const CallGraph calls(program);
  check(program, context, calls, false, static_cast<std::size_t>(std::max(0, context.target_machine.call_depth)));
  const double levels = context.target_machine.policies.calls_local_levels;
  if (context.target.local_levels && levels > 0) check(program, context, calls, true, static_cast<std::size_t>(levels));
}

}  // namespace cnctrans::ir::passes
