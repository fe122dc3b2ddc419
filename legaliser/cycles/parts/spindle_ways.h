// How the spindle may turn at a statement, by all ways that lead there.
#pragma once

#include "ir/analysis/flow_states.h"

namespace cnctrans::ir::passes {

/// A domain of FlowStates. Spindle 1 only; a cycle that turns it by itself makes it unknown.
class SpindleDomain {
 public:
  using State = unsigned;
  static constexpr State off = 1, cw = 2, ccw = 4, unknown_way = 8;

  [[nodiscard]] static State start(const Routine& r, bool called) {
    return r.kind == RoutineKind::main && !called ? off : unknown_way;
  }
  static void transfer(const Statement& s, State& state);
  [[nodiscard]] static bool touches(const Routine& r);
  static void unknown(State& state) { state = unknown_way; }
  static bool join(State& a, State b) {
    const State before = a;
    a |= b;
    return a != before;
  }
};

class SpindleWays {
 public:
  explicit SpindleWays(const Program& program) : states_(program, domain_) {}
  /// Where the block moves: on one way there it turns, on another one it stands.
  [[nodiscard]] bool turns_on_some_way(const Statement& s) const;
  /// It stands on every way.
  [[nodiscard]] bool stands(const Statement& s) const;

 private:
  [[nodiscard]] SpindleDomain::State where_it_moves(const Statement& s) const;
  SpindleDomain domain_;
  FlowStates<SpindleDomain> states_;
};

}  // namespace cnctrans::ir::passes
