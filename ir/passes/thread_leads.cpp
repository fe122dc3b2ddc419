#include "ir/passes/thread_leads.h"

#include <algorithm>

#include "ir/passes/facts.h"
#include "ir/passes/flow_states.h"

namespace cnctrans::ir::passes {

namespace {

/// A domain of FlowStates: the pitch said last.
class LeadDomain {
 public:
  struct State {
    std::optional<double> lead;
    AxisId axis = axis::none;
  };
  [[nodiscard]] static State start(const Routine& /*r*/, bool /*called*/) { return {}; }
  static bool says(const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    return b != nullptr && b->has_motion && b->motion.extra != nullptr && b->motion.extra->has_lead;
  }
  static void transfer(const Statement& s, State& state) {
    if (const auto* b = std::get_if<Block>(&s.node)) {
      for (const auto& a : b->actions) {
        const auto* m = std::get_if<ModalSet>(&a.data);
        if (m != nullptr && m->setting == Setting::units) state.lead.reset();  // it counted in other units
      }
    }
    if (!says(s)) return;
    const MotionExtra& e = *std::get<Block>(s.node).motion.extra;
    state.lead = e.lead.literal() ? std::optional(e.lead.number) : std::nullopt;
    state.axis = e.lead_axis;
  }
  static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) { found = found || says(s); });
    return found;
  }
  static void unknown(State& state) { state.lead.reset(); }
  static bool join(State& a, const State& b) {
    if (!a.lead || (a.lead == b.lead && a.axis == b.axis)) return false;
    a.lead.reset();
    return true;
  }
};

}  // namespace

void write_thread_leads(Program& program, const LegaliseContext& context) {
  if (context.target_machine.option("thread.pitch") != "each_block") return;
  if (std::none_of(program.routines.begin(), program.routines.end(), LeadDomain::touches)) return;
  const FactsOf facts(program, context);
  const LeadDomain domain;
  const FlowStates<LeadDomain> states(program, domain);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !b->has_motion || b->motion.coords.empty() || LeadDomain::says(s)) return;
      const auto* state = states.before(s);
      if (state == nullptr || !state->lead || motion_in(*b, facts.before(s)) != MotionKind::thread) return;
      auto extra = b->motion.extra ? std::make_shared<MotionExtra>(*b->motion.extra) : std::make_shared<MotionExtra>();
      extra->has_lead = true;
      extra->lead = Value{*state->lead};
      extra->lead_axis = state->axis;
      const bool along = std::any_of(b->motion.coords.begin(), b->motion.coords.end(),
                                     [&](const CoordWord& c) { return c.axis == state->axis; });
      b->motion.extra = std::move(extra);
      if (along) return;
      context.diagnostics.warning("TRN-479", s.line.span,
                                  "this thread has no pitch of its own, and the one said last belongs to an axis that "
                                  "does not move here: it is written as the pitch of this move",
                                  "say the pitch in the block");
    });
  }
}

}  // namespace cnctrans::ir::passes
