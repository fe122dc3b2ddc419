#include "legaliser/control/modal_callees.h"

#include <algorithm>

#include "ir/analysis/domains/kept_values.h"
#include "legaliser/cycles/parts/cycle_parts.h"

namespace cnctrans::ir::passes {

namespace {

std::optional<std::size_t> callee_of(const CallGraph& calls, const CallRoutine& call) {
  return call.computed ? std::nullopt : calls.index_of(call.routine);
}

/// Some statement of the called routine, or of one below it, for which `test` is true.
template <class Test>
bool any_below(const Program& program, const CallGraph& calls, const CallRoutine& call, const Test& test) {
  const auto callee = callee_of(calls, call);
  if (!callee) return false;
  bool found = false;
  for (const auto r : reached_from(calls, *callee)) {
    for_each_statement(program.routines[r].body, [&](const Statement& s) { found = found || test(s); });
  }
  return found;
}

template <class Test>
bool any_action_of(const Statement& s, const Test& test) {
  const auto* b = std::get_if<Block>(&s.node);
  return b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), test);
}

}  // namespace

bool has_modal_call(const Routine& r) {
  bool found = false;
  for_each_statement(r.body,
                     [&found](const Statement& s) { found = found || std::holds_alternative<ModalCall>(s.node); });
  return found;
}

bool changes_modal_calls(const Program& program, const CallGraph& calls, const CallRoutine& call) {
  return any_below(program, calls, call, [](const Statement& s) { return std::holds_alternative<ModalCall>(s.node); });
}

bool defines_cycle(const Program& program, const CallGraph& calls, const CallRoutine& call) {
  return any_below(program, calls, call, [](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    return b != nullptr && pattern_in(*b) == nullptr &&
           any_action_of(s, [](const Action& a) { return std::holds_alternative<CycleDefine>(a.data); });
  });
}

bool may_move(const Program& program, const CallGraph& calls, const CallRoutine& call) {
  return !callee_of(calls, call) || any_below(program, calls, call, [&calls](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    const auto* inner = std::get_if<CallRoutine>(&s.node);
    return (b != nullptr && (b->has_motion || pattern_in(*b) != nullptr)) ||
           (inner != nullptr && !callee_of(calls, *inner));
  });
}

bool leaves_feed(const Program& program, const CallGraph& calls, const CallRoutine& call, double feed) {
  return callee_of(calls, call) && !any_below(program, calls, call, [feed](const Statement& s) {
           return any_action_of(s, [feed](const Action& a) {
             const auto* f = std::get_if<SetFeed>(&a.data);
             return f != nullptr && !f->block_only && !f->value.is(feed);
           });
         });
}

bool acts_behind_motion(const Block& b) {
  const bool parts = b.motion.extra && (b.motion.extra->has_turns || b.motion.extra->has_pitch);
  return b.motion.frame != FrameUse::normal || parts ||
         std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
           return a.order == Order::after || std::holds_alternative<Corner>(a.data) ||
                  std::holds_alternative<TangentialEnd>(a.data) || std::holds_alternative<FrameOp>(a.data);
         });
}

bool shares_level_too(const CallGraph& calls, const CallRoutine& call) {
  const auto callee = callee_of(calls, call);
  return callee && !call.arguments.empty() && calls.called_with(*callee, CallLevel::shared) &&
         call.level == CallLevel::new_level;
}

}  // namespace cnctrans::ir::passes
