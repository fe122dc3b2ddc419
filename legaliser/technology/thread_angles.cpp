// The start angle of a thread where it stays in force on one of the two controls and holds for one block on the other
// (motion reference 14.3 of the former): each thread says its own.
#include <algorithm>

#include "ir/analysis/flow_states.h"
#include "ir/analysis/one_value.h"
#include "ir/edit/rewrite.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"

namespace cnctrans::ir::passes {

namespace {

/// A domain of FlowStates: the angle said last; none: the ways that lead here do not agree, or it is computed.
class AngleDomain : public OneValue<double> {
 public:
  [[nodiscard]] static State start(const Routine& r, bool /*called*/) {
    return r.kind == RoutineKind::main ? State{0.0} : State{};
  }
  static const Value* said(const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    const bool says = b != nullptr && b->has_motion && b->motion.extra != nullptr && b->motion.extra->has_start_angle;
    return says ? &b->motion.extra->start_angle : nullptr;
  }
  static void transfer(const Statement& s, State& state) {
    const Value* v = said(s);
    if (v != nullptr) state.value = v->literal() ? std::optional(v->number) : std::nullopt;
  }
  static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      const Value* v = said(s);
      found = found || (v != nullptr && !v->is(0));
    });
    return found;
  }
};

bool is_thread(const Statement& s, const FactsOf& facts) {
  const auto* b = std::get_if<Block>(&s.node);
  const auto kind = b != nullptr && b->has_motion ? motion_in(*b, facts.before(s)) : std::nullopt;
  return kind == MotionKind::thread || kind == MotionKind::thread_variable;
}

/// Under continuous path a thread right behind another goes on with its angle.
bool joined(const Statement* before, const Statement& s, const FactsOf& facts) {
  const auto* b = std::get_if<Block>(&s.node);
  return before != nullptr && b != nullptr && labels_on(s.line).empty() && is_thread(*before, facts) &&
         setting_in<PathMode>(*b, facts.before(s), Setting::path_mode) == PathMode::continuous;
}

Value angle_of(const Statement& thread) {
  const auto& extra = std::get<Block>(thread.node).motion.extra;
  return extra && extra->has_start_angle ? extra->start_angle : Value(0.0);
}

/// The thread of the statement where it has no start angle of its own; null: it is none, or has.
Motion* bare_thread(Statement& s, const FactsOf& facts) {
  auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || !b->has_motion || b->motion.coords.empty() || AngleDomain::said(s) != nullptr) return nullptr;
  const auto kind = motion_in(*b, facts.before(s));
  return kind == MotionKind::thread || kind == MotionKind::thread_variable ? &b->motion : nullptr;
}

void say(Motion& m, const Value& angle) {
  auto extra = m.extra ? std::make_shared<MotionExtra>(*m.extra) : std::make_shared<MotionExtra>();
  extra->has_start_angle = true;
  extra->start_angle = angle;
  m.extra = std::move(extra);
}

/// It stays in force in the source.
void carry_on(Program& program, const LegaliseContext& context, const FactsOf& facts) {
  const AngleDomain domain;
  const FlowStates<AngleDomain> states(program, domain);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      Motion* m = bare_thread(s, facts);
      const auto* state = m != nullptr ? states.before(s) : nullptr;
      if (state == nullptr) return;
      if (state->value && *state->value != 0) say(*m, Value{*state->value});
      if (state->value) return;
      context.diagnostics.warning(
          "TRN-610", s.line.span,
          "the start angle of a thread stays in force in the source, and the way of the program "
          "does not tell which one holds here: this thread starts at 0 degrees",
          "say the start angle in this block");
    });
  }
}

}  // namespace

void write_thread_angles(Program& program, const LegaliseContext& context) {
  const auto stays = [](const machine::Profile& m) {
    return m.policies.thread_start_angle == machine::ThreadStartAngle::modal;
  };
  const bool from = stays(context.source_machine), to = stays(context.target_machine);
  if (from == to || std::none_of(program.routines.begin(), program.routines.end(), AngleDomain::touches)) return;
  const FactsOf facts(program, context);
  if (from) return carry_on(program, context, facts);
  for (auto& r : program.routines) {
    const Statement* before = nullptr;
    for_each_statement(r.body, [&](Statement& s) {
      Motion* m = bare_thread(s, facts);
      if (m != nullptr) say(*m, joined(before, s, facts) ? angle_of(*before) : Value(0.0));
      before = &s;
    });
  }
}

}  // namespace cnctrans::ir::passes
