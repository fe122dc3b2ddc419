#include "legaliser/technology/thread_leads.h"

#include <algorithm>
#include <memory>

#include "ir/analysis/flow_states.h"
#include "ir/edit/rewrite.h"
#include "legaliser/analysis/facts.h"

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

/// A domain of FlowStates: the thread that the next one joins.
class JoinDomain {
 public:
  struct State {
    bool joins = false;          ///< the statement before is a thread
    std::optional<Value> angle;  ///< at which its chain has begun; nullopt: not known here
    bool operator==(const State& o) const {
      return joins == o.joins && angle.has_value() == o.angle.has_value() && (!angle || equal(*angle, *o.angle));
    }
  };
  explicit JoinDomain(const FactsOf& facts) : facts_(facts) {}
  [[nodiscard]] static State start(const Routine& /*r*/, bool /*called*/) { return {}; }
  [[nodiscard]] bool thread(const Statement& s) const {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr || !b->has_motion || b->motion.coords.empty()) return false;
    const auto kind = motion_in(*b, facts_.before(s));
    return kind == MotionKind::thread || kind == MotionKind::thread_variable;
  }
  [[nodiscard]] static const Value* angle(const Statement& s) {
    const auto& m = std::get<Block>(s.node).motion;
    return m.extra != nullptr && m.extra->has_start_angle ? &m.extra->start_angle : nullptr;
  }
  void transfer(const Statement& s, State& state) const {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr && state.angle && !state.angle->literal()) {
      each_target(s, [&state](const VarRef&) { state.angle.reset(); });
      return;
    }
    if (b == nullptr || (!b->has_motion && b->actions.empty())) return;
    if (!thread(s)) {
      state = {};
      return;
    }
    const Value* own = angle(s);
    if (state.joins && own == nullptr) return;
    state.joins = true;
    state.angle = own == nullptr ? Value(0.0) : *own;
  }
  [[nodiscard]] bool touches(const Routine& r) const {
    bool found = false;
    for_each_statement(r.body, [&](const Statement& s) { found = found || thread(s); });
    return found;
  }
  static void unknown(State& state) { state = {}; }
  static bool join(State& a, const State& b) {
    if (a == b || (!a.joins && !a.angle)) return false;
    a = {};
    return true;
  }

 private:
  const FactsOf& facts_;
};

bool has_angles(const Routine& r) {
  bool found = false;
  for_each_statement(r.body, [&found](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    found = found || (b != nullptr && b->has_motion && JoinDomain::angle(s) != nullptr);
  });
  return found;
}

/// A thread that joins another (in continuous path mode) goes on in its groove: the control takes the angle of the
/// start in the first only.
void leave_out_joined_angles(Program& program, const LegaliseContext& context) {
  if (context.target_machine.policies.thread_start_angle != machine::ThreadStartAngle::block) return;
  if (std::none_of(program.routines.begin(), program.routines.end(), has_angles)) return;
  const FactsOf facts(program, context);
  const JoinDomain domain(facts);
  const FlowStates<JoinDomain> states(program, domain);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      if (!std::holds_alternative<Block>(s.node) || !domain.thread(s)) return;
      const Value* own = JoinDomain::angle(s);
      const auto* state = states.before(s);
      if (own == nullptr || state == nullptr || !state->joins) return;
      const auto mode = setting_in<PathMode>(std::get<Block>(s.node), facts.before(s), Setting::path_mode);
      if (mode != PathMode::continuous) return;  // with an exact stop between them each begins anew
      if (!state->angle || !equal(*state->angle, *own)) {
        context.diagnostics.error("TRN-600", s.line.span,
                                  "this thread joins the one before it and has another start angle, which the target "
                                  "takes in the first of joined threads only",
                                  "leave the angle out, or move between the two threads");
        return;
      }
      auto& motion = std::get<Block>(s.node).motion;
      auto extra = std::make_shared<MotionExtra>(*motion.extra);
      extra->has_start_angle = false;
      motion.extra = std::move(extra);
    });
  }
}

}  // namespace

void write_thread_leads(Program& program, const LegaliseContext& context) {
  leave_out_joined_angles(program, context);
  if (context.target_machine.policies.thread_pitch != machine::ThreadPitch::each_block) return;
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
      const bool along =
          state->axis == axis::none || std::any_of(b->motion.coords.begin(), b->motion.coords.end(),
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
