#include "legaliser/control/modal_callees.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "ir/analysis/domains/kept_values.h"
#include "legaliser/analysis/words.h"
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

void leave_line(Statement&& s, Body& out) {
  if (s.line.number.empty() && s.line.labels.empty() && s.line.comments.empty()) return;
  s.node = Label{};
  out.push_back(std::move(s));
}

bool starts_modal_calls(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* m = std::get_if<ModalCall>(&s.node);
      found = found || (m != nullptr && !m->off && !m->cycle);
    });
  }
  return found;
}

bool has_modal_call(const Routine& r) {
  bool found = false;
  for_each_statement(r.body,
                     [&found](const Statement& s) { found = found || std::holds_alternative<ModalCall>(s.node); });
  return found;
}

bool changes_modal_calls(const Program& program, const CallGraph& calls, const CallRoutine& call) {
  return any_below(program, calls, call, [](const Statement& s) { return std::holds_alternative<ModalCall>(s.node); });
}

bool fixed_arguments(const CallRoutine& call) {
  return std::all_of(call.arguments.begin(), call.arguments.end(),
                     [](const Argument& a) { return !a.by_reference && (!a.value || constant_value(a.value)); });
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

bool leaves_its_point(const Program& program, const CallGraph& calls, const CallRoutine& call, const FactsOf& facts) {
  std::map<AxisId, double> travel;
  bool straight = true, places = false;
  const bool unknown = !callee_of(calls, call) || any_below(program, calls, call, [&](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    straight = straight && s.line.skip_mask == 0 &&
               (b != nullptr || std::holds_alternative<Label>(s.node) || std::holds_alternative<Assign>(s.node) ||
                std::holds_alternative<Message>(s.node) || std::holds_alternative<Return>(s.node));
    if (b == nullptr || !b->has_motion) return std::holds_alternative<Opaque>(s.node);
    const auto plane = setting_in<Plane>(*b, facts.before(s), Setting::plane);
    for (const auto& c : b->motion.coords) {
      if (c.axis > axis::z || (plane && c.axis == plane_axes(*plane).w)) continue;
      travel[c.axis] += c.value.literal() ? c.value.number : std::nan("");
      places = places || distance_of(c, *b, facts.before(s)) != Distance::incremental;
    }
    places = places || b->motion.extra || b->motion.frame != FrameUse::normal || pattern_in(*b) != nullptr;
    return false;
  });
  return unknown || places || (!straight && !travel.empty()) ||
         std::any_of(travel.begin(), travel.end(), [](const auto& t) { return !(std::fabs(t.second) < 1e-9); });
}

bool arcs_from_elsewhere(const Body& way, const Program& program, const CallGraph& calls, const CallRoutine& call,
                         const FactsOf& facts) {
  const bool arcs = std::any_of(way.begin(), way.end(), [](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    return b != nullptr && b->motion.kind != MotionKind::rapid && b->motion.kind != MotionKind::linear;
  });
  return arcs && leaves_its_point(program, calls, call, facts);
}

bool runs_modal_call(const Block& b, const Facts& facts, bool by_words) {
  if (b.has_motion && b.motion.moves()) return true;
  if (!by_words) return false;
  const auto kind = motion_in(b, facts);
  if (kind && kind != MotionKind::rapid && kind != MotionKind::linear) return false;
  if (b.has_motion && b.motion.explicit_code) return true;
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    return std::holds_alternative<SetFeed>(a.data) || std::holds_alternative<SetSpindle>(a.data);
  });
}

void say_all_axes(Body& way, const Facts& facts) {
  std::map<AxisId, CoordWord> last;
  const auto plane = setting<Plane>(facts, Setting::plane);
  for (const auto& s : way) {  // where the tool stands before the first one
    const auto* b = std::get_if<Block>(&s.node);
    const bool absolute = b != nullptr && !b->motion.coords.empty() && b->motion.coords[0].mode == WordMode::absolute;
    if (!absolute || !plane) break;
    for (const AxisId axis : {plane_axes(*plane).u, plane_axes(*plane).v}) {
      CoordWord word = b->motion.coords[0];
      word.axis = axis;
      if (facts.position[axis]) word.value = Value{*facts.position[axis]};
      if (facts.position[axis]) last.insert_or_assign(axis, word);
    }
    break;
  }
  for (auto& s : way) {
    auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr || !b->has_motion) continue;
    for (const auto& c : b->motion.coords) last.erase(c.axis);
    for (const auto& [axis, word] : last) b->motion.coords.push_back(word);
    std::sort(b->motion.coords.begin(), b->motion.coords.end(),
              [](const auto& a, const auto& c) { return a.axis < c.axis; });
    for (const auto& c : b->motion.coords) {
      if (c.mode == WordMode::absolute) last.insert_or_assign(c.axis, c);
    }
  }
}

bool leaves_feed(const Program& program, const CallGraph& calls, const CallRoutine& call, double feed) {
  return callee_of(calls, call) && !any_below(program, calls, call, [feed](const Statement& s) {
           return any_action_of(s, [feed](const Action& a) {
             const auto* f = std::get_if<SetFeed>(&a.data);
             return f != nullptr && !f->block_only && !f->value.is(feed);
           });
         });
}

bool goes_at_a_feed(const NamedCycle* pattern) {
  return pattern != nullptr &&
         std::any_of(pattern->words.begin(), pattern->words.end(), [](const auto& w) { return w.first == "way_feed"; });
}

std::set<std::size_t> called_by_main(const Program& program, const CallGraph& calls) {
  std::set<std::size_t> found;
  for (std::size_t i = 0; i < program.routines.size(); ++i) {
    if (program.routines[i].kind == RoutineKind::main) found.insert(i);
  }
  for (std::size_t before = 0; before != found.size();) {
    before = found.size();
    for (const auto& site : calls.sites()) {
      if (site.callee && found.count(site.caller) != 0 && !std::holds_alternative<ModalCall>(site.statement->node))
        found.insert(*site.callee);
    }
  }
  return found;
}

bool acts_behind_motion(const Block& b) {
  const bool parts = b.motion.extra && (b.motion.extra->has_turns || b.motion.extra->has_pitch);
  return b.motion.frame != FrameUse::normal || parts ||
         std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
           return a.order == Order::after || std::holds_alternative<Corner>(a.data) ||
                  std::holds_alternative<TangentialEnd>(a.data) || std::holds_alternative<FrameOp>(a.data);
         });
}

bool reads_own_locals(const Program& program, const CallGraph& calls, ReadFirst& reads_first, const CallRoutine& call) {
  const auto callee = callee_of(calls, call);
  if (!callee || call.level != CallLevel::new_level) return false;
  bool found = false;
  const auto look = [&](const VarRef& v) {
    const auto* segment = segment_of(program, v);
    found = found || (segment != nullptr && segment->scope == Scope::level && reads_first(*callee, v));
  };
  for (const auto r : calls.sharing_level(*callee))
    for_each_statement(program.routines[r].body, [&](const Statement& s) { each_target(s, look); });
  return found;
}

bool shares_level_too(const CallGraph& calls, const CallRoutine& call) {
  const auto callee = callee_of(calls, call);
  return callee && !call.arguments.empty() && calls.called_with(*callee, CallLevel::shared) &&
         call.level == CallLevel::new_level;
}

}  // namespace cnctrans::ir::passes
