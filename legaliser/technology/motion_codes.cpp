// The motion function in force against the code that the written text says last (equivalences 21.1). A pass that writes
// a move for this one time (a way back in rapid behind a hole, a point of a pattern, the place of a reference point)
// leaves its code standing in the text. Inside of a routine the writer says the code again at the next move; here this
// is done where the two part at the border of a routine: at its first move without a code, or before the call where the
// callers have different functions in force.
#include <algorithm>
#include <set>

#include "ir/analysis/flow_states.h"
#include "ir/analysis/hole_points.h"
#include "ir/edit/search.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/edit/editor.h"
#include "legaliser/technology/motion_codes.h"

namespace cnctrans::ir::passes {

namespace {

/// What the reader of the text takes to be in force, against what is.
enum class Step : std::uint8_t {
  same,
  inside,  ///< another one may stand in the text since this routine began: the writer follows that itself
  apart    ///< another one may stand in the text
};

/// The code of the move stays in force in the written text as it does in the source.
bool stays(const Motion& m, const Capabilities& target) {
  return m.keeps_modal && (m.kind != MotionKind::thread || target.thread_stays);
}

/// A domain of FlowStates.
class Steps {
 public:
  using State = Step;
  Steps(const Program& program, const LegaliseContext& context, const FactsOf& facts)
      : facts_(facts),
        target_(context.target),
        rapid_points_(context.target_machine.policies.cycle_positioning == machine::CyclePositioning::rapid),
        rapid_at_holes_(context.target.retract_plane_switch) {
    for (const auto& r : program.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        const auto* c = std::get_if<CallRoutine>(&s.node);
        if (c != nullptr && c->computed) computed_call(program);
        if (c != nullptr && c->has_range) heads(program, c->routine, c->first);
        if (const auto* p = std::get_if<Repeat>(&s.node); p != nullptr && p->has_program)
          heads(program, p->program, p->first);
      });
    }
  }

  [[nodiscard]] static State start(const Routine& /*unused*/, bool part) { return part ? Step::apart : Step::same; }
  [[nodiscard]] static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      found = found || (b != nullptr && (b->has_motion || action_in<CycleDefine>(*b) != nullptr));
    });
    return found;
  }
  static void unknown(State& state) { state = Step::apart; }
  static bool join(State& a, State b) {
    if (b <= a) return false;
    a = b;
    return true;
  }
  void transfer(const Statement& s, State& state) const {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    if (heads_.count(s.id) != 0) state = Step::apart;
    const Facts& facts = facts_.before(s);
    const HolePoint hole = hole_point(*b, facts);
    const bool point = hole != HolePoint::no;
    if (hole == HolePoint::yes && rapid_points_ && !rapid_at_holes_ && b->has_motion &&
        b->motion.kind == MotionKind::rapid && !b->motion.keeps_modal)
      return;  // reached without a code
    if (b->has_motion && b->motion.kind != MotionKind::modal)
      state = stays(b->motion, target_) || (facts.motion == b->motion.kind && !b->motion.keeps_modal) ? Step::same
                                                                                                      : Step::apart;
    else if (b->has_motion && b->motion.moves() && !(point && rapid_points_))
      state = Step::same;
    if (rapid_at_holes_ && point && (b->has_motion || action_in<CycleDefine>(*b) != nullptr) &&
        facts.motion != MotionKind::rapid)
      state = std::max(state, Step::inside);
  }
  /// A border of routines.
  void crosses(const Statement& s, std::optional<std::size_t> callee, State& state) const {
    if (state == Step::inside) state = Step::apart;
    if (callee && said_before_.count(*callee) != 0 && std::holds_alternative<CallRoutine>(s.node)) state = Step::same;
  }
  [[nodiscard]] State at(const Statement& s, const State* state) const {
    if (heads_.count(s.id) != 0) return Step::apart;
    return state == nullptr ? Step::same : *state;
  }
  [[nodiscard]] bool needs_code(const Block& b, const Facts& facts) const {
    return b.has_motion && b.motion.kind == MotionKind::modal && b.motion.moves() && facts.reachable &&
           !(rapid_points_ && hole_point(b, facts) == HolePoint::yes);
  }
  /// On one way it is a hole, which takes no code but G0, and on another one it needs its code.
  [[nodiscard]] bool both_ways(const Block& b, const Facts& facts) const {
    return rapid_points_ && facts.motion != MotionKind::rapid && hole_point(b, facts) == HolePoint::perhaps;
  }
  void say_before(std::size_t callee) { said_before_.insert(callee); }
  [[nodiscard]] bool said_before(std::size_t callee) const { return said_before_.count(callee) != 0; }

 private:
  /// A part of another program begins here, whatever stands before it.
  void heads(const Program& program, const RoutineName& name, const LabelRef& first) {
    const Routine* r = program.find(name);
    if (r == nullptr) return;
    for_each_statement(r->body, [&](const Statement& s) {
      for (const auto& l : labels_on(s.line)) {
        if (first.computed || same_label(l, first)) heads_.insert(s.id);
      }
    });
  }

  /// Any subprogram may be the one that is meant.
  void computed_call(const Program& program) {
    for (const auto& r : program.routines) {
      if (r.kind != RoutineKind::main && !r.body.empty()) heads_.insert(r.body.front().id);
    }
  }

  const FactsOf& facts_;
  const Capabilities& target_;
  bool rapid_points_, rapid_at_holes_;
  std::set<std::uint32_t> heads_;
  std::set<std::size_t> said_before_;  ///< routines whose calls say the code before them
};

class MotionCodes {
 public:
  MotionCodes(Program& program, const LegaliseContext& context)
      : program_(program),
        context_(context),
        facts_(program, context),
        calls_(program),
        steps_(program, context, facts_) {}

  void run() {
    while (settle()) {
    }
    const FlowStates<Steps> states(program_, steps_);
    for (auto& r : program_.routines) write(r, states);
  }

 private:
  /// Routines whose first moves can't say their code, since the callers differ: their calls do. False: no more of them.
  bool settle() {
    const FlowStates<Steps> states(program_, steps_);
    bool more = false;
    for (std::size_t i = 0; i < program_.routines.size(); ++i) {
      const Routine& r = program_.routines[i];
      if (steps_.said_before(i) || !calls_.called(i)) continue;
      bool open = false;
      for_each_statement(r.body, [&](const Statement& s) { open = open || undecided(s, states); });
      if (!open) continue;
      steps_.say_before(i);
      more = true;
    }
    return more;
  }
  /// A move, or a call that has to say it, whose function only the run knows.
  [[nodiscard]] bool undecided(const Statement& s, const FlowStates<Steps>& states) const {
    if (steps_.at(s, states.before(s)) != Step::apart) return false;
    const Facts& facts = facts_.before(s);
    if (facts.motion) return false;
    if (const auto* b = std::get_if<Block>(&s.node)) return steps_.needs_code(*b, facts);
    return says_before(s);
  }
  [[nodiscard]] bool says_before(const Statement& s) const {
    const auto* call = std::get_if<CallRoutine>(&s.node);
    const auto callee = call == nullptr || call->computed ? std::nullopt : calls_.index_of(call->routine);
    return callee && steps_.said_before(*callee);
  }

  void write(Routine& r, const FlowStates<Steps>& states) {
    Editor editor(program_, r, context_);
    rewrite_body(r.body, [&](Statement&& s, Body& out) {
      const Facts& facts = facts_.before(s);
      const bool apart = steps_.at(s, states.before(s)) == Step::apart;
      auto* b = std::get_if<Block>(&s.node);
      if (!apart || (b == nullptr ? !says_before(s) : !steps_.needs_code(*b, facts)))
        return out.push_back(std::move(s));
      const bool sayable = facts.motion && context_.target.motions.count(*facts.motion) != 0;
      const bool both = b != nullptr && steps_.both_ways(*b, facts);
      // A code alone runs what is called at every block.
      const bool runs = b == nullptr && (facts.modal_call != 0 || (context_.target.modal_cycle_by_call &&
                                                                   (facts.cycle_active || !facts.cycle_active_known)));
      if (!sayable || both || runs) {
        refuse(s, program_, context_, "TRN-216",
               both && facts.motion
                   ? "the target needs the motion code again here, which no hole of a cycle takes, and "
                     "whether a cycle is active depends on the path that leads here"
                   : "the motion code in force here is not known, and the target needs one",
               "write G0, G1, G2 or G3 in this block, or before the call");
        return out.push_back(std::move(s));
      }
      if (b != nullptr) {
        b->motion.kind = *facts.motion;
        b->motion.explicit_code = true;
        return out.push_back(std::move(s));
      }
      Block code;
      code.has_motion = code.motion.explicit_code = true;
      code.motion.kind = *facts.motion;
      Body pieces;
      pieces.push_back(made(s.line, std::move(code)));
      editor.put(out, std::move(pieces), std::move(s));
    });
  }

  Program& program_;
  const LegaliseContext& context_;
  FactsOf facts_;
  CallGraph calls_;
  Steps steps_;
};

/// Some move leaves another code in the text than the one in force, and some routine is called.
bool may_part(const Program& program, const Capabilities& target) {
  bool once = false, called = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      once = once ||
             (b != nullptr && ((b->has_motion && !stays(b->motion, target)) || action_in<CycleDefine>(*b) != nullptr));
      const auto* p = std::get_if<Repeat>(&s.node);
      called = called || std::holds_alternative<CallRoutine>(s.node) || std::holds_alternative<ModalCall>(s.node) ||
               (p != nullptr && p->has_program);
    });
  }
  return once && called;
}

}  // namespace

void say_motion_codes(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || !may_part(program, context.target)) return;
  MotionCodes(program, context).run();
}

}  // namespace cnctrans::ir::passes
