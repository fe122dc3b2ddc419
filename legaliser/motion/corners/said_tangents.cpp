// A tangent arc that stays in force in the source is said in every block: on other controls it holds for one block.
#include <algorithm>
#include <utility>

#include "ir/analysis/flow_states.h"
#include "ir/edit/search.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/refuse.h"

namespace cnctrans::ir::passes {

namespace {

/// A domain of FlowStates: on some way that leads here a tangent arc has stayed in force.
struct TangentInForce {
  using State = bool;
  [[nodiscard]] static State start(const Routine& /*unused*/, bool part) { return part; }
  static void transfer(const Statement& s, State& state) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b != nullptr && b->has_motion && b->motion.kind != MotionKind::modal && b->motion.keeps_modal)
      state = b->motion.kind == MotionKind::arc_tangent;
  }
  [[nodiscard]] static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      found = found || (b != nullptr && b->has_motion && b->motion.kind == MotionKind::arc_tangent);
    });
    return found;
  }
  static void unknown(State& /*state*/) {}
  static bool join(State& a, State b) { return std::exchange(a, a || b) != a; }
};

}  // namespace

void say_tangent_arcs(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect) return;
  if (std::none_of(program.routines.begin(), program.routines.end(), TangentInForce::touches)) return;
  const FactsOf facts(program, context);
  const FlowStates<TangentInForce> in_force(program, {});
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !b->has_motion || b->motion.kind != MotionKind::modal || !b->motion.moves()) return;
      const auto& motion = facts.before(s).motion;
      if (motion == MotionKind::arc_tangent) {
        b->motion.kind = MotionKind::arc_tangent;
        b->motion.explicit_code = true;
      } else if (const bool* state = in_force.before(s); !motion && state != nullptr && *state) {
        refuse(
            s, program, context, "TRN-216",
            "a tangent arc is in force here on one of the ways that lead here, and holds for one block in the target",
            "write the motion code in this block");
      }
    });
  }
}

}  // namespace cnctrans::ir::passes
