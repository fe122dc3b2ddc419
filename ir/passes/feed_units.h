// Whether the unit in force holds for F (and for the machine's data) too: G700 and G710 against G70 and G71.
#pragma once

#include <optional>

#include "ir/passes/flow_states.h"
#include "ir/program.h"
#include "ir/search.h"

namespace cnctrans::ir::passes {

/// A domain of FlowStates: whether the unit in force holds for F too.
class FeedUnits {
 public:
  struct State {
    std::optional<bool> feed_too;
  };
  explicit FeedUnits(bool at_power_on) : at_power_on_(at_power_on) {}
  [[nodiscard]] State start(const Routine&, bool) const { return {at_power_on_}; }
  static void transfer(const Statement& s, State& state) {
    const auto* b = std::get_if<Block>(&s.node);
    for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
      const auto* m = std::get_if<ModalSet>(&b->actions[i].data);
      if (m == nullptr || m->setting != Setting::units) continue;
      state.feed_too =
          s.line.skip_mask == 0 || state.feed_too == m->feed_too ? std::optional(m->feed_too) : std::nullopt;
    }
  }
  static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      State before{true}, after{false};
      transfer(s, before);
      transfer(s, after);
      found = found || before.feed_too == after.feed_too;
    });
    return found;
  }
  static void unknown(State& state) { state.feed_too.reset(); }
  static bool join(State& a, const State& b) {
    if (!a.feed_too || a.feed_too == b.feed_too) return false;
    a.feed_too.reset();
    return true;
  }

 private:
  bool at_power_on_;
};

}  // namespace cnctrans::ir::passes
