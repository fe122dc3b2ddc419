#include "legaliser/frames/without_length.h"

#include <algorithm>

#include "ir/analysis/flow_states.h"

namespace cnctrans::ir::passes {

namespace {

/// A domain of FlowStates: on every way the last word of the tool was an offset 0.
class OffDomain {
 public:
  struct State {
    bool off = false;
  };
  [[nodiscard]] static State start(const Routine& /*r*/, bool /*called*/) { return {}; }
  static void transfer(const Statement& s, State& state) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    for (const auto& a : b->actions) {
      if (const auto* d = std::get_if<ToolOffset>(&a.data)) state.off = d->number.is(0);
      if (std::holds_alternative<ToolSelect>(a.data) || std::holds_alternative<ToolChange>(a.data)) state.off = false;
    }
  }
  static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      found = found || (b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
                          return std::holds_alternative<ToolOffset>(a.data) ||
                                 std::holds_alternative<ToolSelect>(a.data) ||
                                 std::holds_alternative<ToolChange>(a.data);
                        }));
    });
    return found;
  }
  static void unknown(State& state) { state.off = false; }
  static bool join(State& a, const State& b) {
    const bool changed = a.off && !b.off;
    a.off = a.off && b.off;
    return changed;
  }
};

/// A mill that stays where it is along its tool.
bool across(const Block& b, const Facts& facts, const LegaliseContext& context) {
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  if (context.source_machine.kind != machine::Kind::mill || plane != Plane::xy) return false;
  return std::none_of(b.motion.coords.begin(), b.motion.coords.end(),
                      [](const CoordWord& c) { return c.axis != axis::x && c.axis != axis::y; });
}

}  // namespace

WithoutLength::WithoutLength(const Program& program, const LegaliseContext& context, const FactsOf& facts) {
  std::set<const Statement*> moves;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&moves](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b != nullptr && b->has_motion && b->motion.frame == FrameUse::machine_with_length) moves.insert(&s);
    });
  }
  if (moves.empty()) return;
  const OffDomain domain;
  const FlowStates<OffDomain> states(program, domain);
  for (const Statement* s : moves) {
    const auto& b = std::get<Block>(s->node);
    const auto* before = states.before(*s);
    OffDomain::State here = before != nullptr ? *before : OffDomain::State{};
    OffDomain::transfer(*s, here);
    if (here.off || across(b, facts.before(*s), context)) found_.insert(s->id);
  }
}

}  // namespace cnctrans::ir::passes
