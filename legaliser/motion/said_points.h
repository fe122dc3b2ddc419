// Where the tool stands by a word of the program, and where by the control's own arithmetic: the end of a line by its
// angle, of polar words, or a point of the other unit. A word is rounded by the writer, such a point is not.
#pragma once

#include <cstdint>

#include "legaliser/analysis/facts.h"

namespace cnctrans::ir::passes {

/// A domain of FlowStates.
class SaidPoints {
 public:
  using State = std::uint32_t;  ///< bit n: axis n stands where a word of it says, in the unit in force

  SaidPoints(const FactsOf& facts, const Capabilities& target) : facts_(facts), target_(target) {}
  [[nodiscard]] static State start(const Routine& /*r*/, bool /*called*/) { return 0; }
  void transfer(const Statement& s, State& state) const;
  [[nodiscard]] static bool touches(const Routine& r);
  static void unknown(State& state) { state = 0; }
  static bool join(State& a, State b) {
    const State both = a & b;
    const bool changed = both != a;
    a = both;
    return changed;
  }
  /// Some point of the program comes from the control's arithmetic.
  [[nodiscard]] static bool needed(const Program& program);

 private:
  const FactsOf& facts_;
  const Capabilities& target_;
};

}  // namespace cnctrans::ir::passes
