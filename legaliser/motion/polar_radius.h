// Whether a radius of polar words that the target keeps from its last one is the present distance from the pole, which
// the source keeps.
#pragma once

#include <cstdint>
#include <set>

#include "legaliser/analysis/facts.h"

namespace cnctrans::ir::passes {

/// A domain of FlowStates, for a target whose polar words without a radius take the last programmed one.
class RadiusDomain {
 public:
  struct State {
    bool same = false;  ///< the target's last radius is the present distance
  };
  /// `written_out`: statements (by id) whose polar words become coordinates in any case.
  RadiusDomain(const FactsOf& facts, const std::set<std::uint32_t>& written_out)
      : facts_(facts), written_out_(written_out) {}
  [[nodiscard]] static State start(const Routine& /*r*/, bool /*called*/) { return {}; }
  void transfer(const Statement& s, State& state) const;
  [[nodiscard]] static bool touches(const Routine& r);
  static void unknown(State& state) { state.same = false; }
  static bool join(State& a, const State& b) {
    const bool changed = a.same && !b.same;
    a.same = a.same && b.same;
    return changed;
  }

 private:
  const FactsOf& facts_;
  const std::set<std::uint32_t>& written_out_;
};

}  // namespace cnctrans::ir::passes
