#include "backends/heidenhain/tool_plan.h"

#include <algorithm>

#include "ir/analysis/flow_states.h"
#include "ir/edit/outside.h"

namespace cnctrans::backends::heidenhain {

namespace {

/// A way may come in here from elsewhere.
bool is_join(const ir::Statement& s, std::size_t routine, const LabelUse& use) {
  if (!s.line.number.empty() && use.is_target(routine, s.line.number)) return true;
  return std::any_of(s.line.labels.begin(), s.line.labels.end(),
                     [&](std::string_view l) { return use.is_target_name(routine, l); });
}

/// Neither moves nor leads elsewhere.
bool passes_by(const ir::Statement& s) {
  if (std::holds_alternative<ir::Message>(s.node) || std::holds_alternative<ir::Label>(s.node) ||
      std::holds_alternative<ir::Declare>(s.node))
    return true;
  const auto* o = std::get_if<ir::Opaque>(&s.node);
  return o != nullptr && o->harmless;
}

/// It moves in the coordinates of the program, or does what is not at hand.
bool may_move(const ir::Statement& s, const ir::Program& program, const ir::passes::CallGraph& calls) {
  if (const auto* call = std::get_if<ir::CallRoutine>(&s.node)) {
    const auto callee = call->computed ? std::nullopt : calls.index_of(call->routine);
    return call->has_range || !callee || ir::is_outside(program.routines[*callee]);
  }
  if (const auto* b = std::get_if<ir::Block>(&s.node)) {
    const bool cycle = std::any_of(b->actions.begin(), b->actions.end(),
                                   [](const ir::Action& a) { return std::holds_alternative<ir::CycleDefine>(a.data); });
    return cycle || (b->has_motion && b->motion.moves() && b->motion.frame == ir::FrameUse::normal);
  }
  const auto* o = std::get_if<ir::Opaque>(&s.node);
  return o != nullptr && !o->harmless;
}

/// A domain of FlowStates: the words that have switched the offset off, on some way, with no other since.
struct OffsetsOff {
  using State = std::set<const ir::Action*>;
  static State start(const ir::Routine& /*r*/, bool /*called*/) { return {}; }
  static void unknown(State& /*state*/) {}
  static bool join(State& a, const State& b) {
    const auto size = a.size();
    a.insert(b.begin(), b.end());
    return a.size() != size;
  }
  static bool changes(const ir::Action& a) {
    const auto* t = std::get_if<ir::ToolSelect>(&a.data);
    return std::holds_alternative<ir::ToolOffset>(a.data) || std::holds_alternative<ir::ToolChange>(a.data) ||
           (t != nullptr && t->changes);
  }
  static bool touches(const ir::Routine& r) {
    bool found = false;
    ir::for_each_statement(r.body, [&found](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      found = found || (b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), changes));
    });
    return found;
  }
  static void transfer(const ir::Statement& s, State& state) {
    const auto* b = std::get_if<ir::Block>(&s.node);
    if (b == nullptr) return;
    for (const auto& a : b->actions) {
      if (!changes(a)) continue;
      state.clear();
      const auto* o = std::get_if<ir::ToolOffset>(&a.data);
      if (o != nullptr && o->number.is(0)) state.insert(&a);
    }
  }
};

}  // namespace

ToolPlan::ToolPlan(const ir::Program& program, const LabelUse& use) : program_(program), ready_(program) {
  for (std::size_t i = 0; i < program.routines.size(); ++i) routine(i, use);
  offsets_off();
}

const ir::ToolSelect* ToolPlan::tool_of(const ir::Action& change) const {
  const auto at = tools_.find(&change);
  return at != tools_.end() ? &at->second : nullptr;
}
const ir::SetSpindle* ToolPlan::speed_of(const ir::Action& change) const {
  const auto at = speeds_.find(&change);
  return at != speeds_.end() ? at->second : nullptr;
}

void ToolPlan::routine(std::size_t index, const LabelUse& use) {
  const ir::Routine& r = program_.routines[index];
  const ir::Action* waiting = nullptr;  // a choice with nothing behind it yet
  std::uint32_t waits_under = 0;        // its skip levels
  for (std::size_t i = 0; i < r.body.size(); ++i) {
    const ir::Statement& s = r.body[i];
    if (is_join(s, index, use) || s.line.skip_mask != waits_under) waiting = nullptr;
    waits_under = s.line.skip_mask;
    const auto* b = std::get_if<ir::Block>(&s.node);
    if (b == nullptr) {
      if (!passes_by(s)) waiting = nullptr;
      continue;
    }
    // In a block of its own order: the choice counts for the change beside it.
    auto selected = ready_.before(s).tool;
    for (const auto& a : b->actions) {
      const auto* t = std::get_if<ir::ToolSelect>(&a.data);
      if (t == nullptr) continue;
      selected = *t;
      waiting = t->changes ? nullptr : &a;
    }
    for (std::size_t k = 0; k < b->actions.size(); ++k) {
      const ir::Action& a = b->actions[k];
      const auto* t = std::get_if<ir::ToolSelect>(&a.data);
      const bool changes = std::holds_alternative<ir::ToolChange>(a.data) || (t != nullptr && t->changes);
      if (!changes) continue;
      if (selected) tools_[&a] = *selected;
      if (waiting != nullptr) said_.insert(waiting);
      waiting = nullptr;
      find_speed(r.body, i, k, index, use);
    }
    const bool cycle = std::any_of(b->actions.begin(), b->actions.end(),
                                   [](const ir::Action& a) { return std::holds_alternative<ir::CycleDefine>(a.data); });
    if (cycle || (b->has_motion && b->motion.moves())) waiting = nullptr;
  }
}

/// The speed that the program gives before anything moves or turns.
void ToolPlan::find_speed(const ir::Body& body, std::size_t at, std::size_t action, std::size_t routine,
                          const LabelUse& use) {
  const auto& own = std::get<ir::Block>(body[at].node).actions;
  const auto take = [&](const ir::Action& a) {
    const auto* s = std::get_if<ir::SetSpindle>(&a.data);
    if (s == nullptr || s->number != 1) return false;
    speeds_[&own[action]] = s;
    said_.insert(&a);
    return true;
  };
  for (const auto& a : own) {
    if (take(a)) return;
  }
  const auto& change_line = body[at].line;
  for (std::size_t i = at + 1; i < body.size(); ++i) {
    const ir::Statement& s = body[i];
    if (is_join(s, routine, use) || s.line.skip_mask != change_line.skip_mask) return;
    const auto* b = std::get_if<ir::Block>(&s.node);
    if (b == nullptr && passes_by(s)) continue;
    if (b == nullptr) return;
    for (const auto& a : b->actions) {
      const auto* speed = std::get_if<ir::SetSpindle>(&a.data);
      if (speed != nullptr) {
        if (a.order != ir::Order::after && speed->value.literal()) take(a);
        return;
      }
      if (std::holds_alternative<ir::SpindleRun>(a.data) || std::holds_alternative<ir::ToolChange>(a.data) ||
          std::holds_alternative<ir::ToolSelect>(a.data) || std::holds_alternative<ir::CycleDefine>(a.data) ||
          std::holds_alternative<ir::Stop>(a.data) || std::holds_alternative<ir::Dwell>(a.data)) {
        // The speed may stand behind the sense in the same block.
        if (!std::holds_alternative<ir::SpindleRun>(a.data)) return;
        const auto later = std::find_if(b->actions.begin(), b->actions.end(), [](const ir::Action& x) {
          return std::holds_alternative<ir::SetSpindle>(x.data);
        });
        if (later != b->actions.end() && std::get<ir::SetSpindle>(later->data).value.literal()) take(*later);
        return;
      }
    }
    if (b->has_motion && b->motion.moves()) return;
  }
}

/// D0: may a move follow before the next tool or offset, on some way?
void ToolPlan::offsets_off() {
  const OffsetsOff domain;
  const ir::passes::FlowStates<OffsetsOff> states(program_, domain);
  const ir::passes::CallGraph calls(program_);
  for (const auto& r : program_.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const OffsetsOff::State* before = states.before(s);
      if (before == nullptr) return;
      OffsetsOff::State off = *before;
      OffsetsOff::transfer(s, off);
      if (may_move(s, program_, calls)) matters_.merge(off);
    });
  }
  for (std::size_t i = 0; i < program_.routines.size(); ++i) {  // its callers are not at hand
    const OffsetsOff::State* left = program_.routines[i].kind == ir::RoutineKind::main ? nullptr : states.behind(i);
    if (left != nullptr && !states.called(i)) matters_.insert(left->begin(), left->end());
  }
}

}  // namespace cnctrans::backends::heidenhain
