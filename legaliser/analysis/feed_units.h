// Whether the unit in force holds for F (and for the machine's data) too: G700 and G710 against G70 and G71.
#pragma once

#include <optional>

#include "ir/analysis/flow_states.h"
#include "ir/analysis/one_value.h"
#include "ir/edit/search.h"
#include "ir/program.h"

namespace cnctrans::ir::passes {

/// A domain of FlowStates: whether the unit in force holds for F too.
class FeedUnits : public OneValue<bool> {
 public:
  explicit FeedUnits(bool at_power_on) : at_power_on_(at_power_on) {}
  [[nodiscard]] State start(const Routine&, bool) const { return {at_power_on_}; }
  static void transfer(const Statement& s, State& state) {
    const auto* b = std::get_if<Block>(&s.node);
    for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
      const auto* m = std::get_if<ModalSet>(&b->actions[i].data);
      if (m == nullptr || m->setting != Setting::units) continue;
      state.value = s.line.skip_mask == 0 || state.value == m->feed_too ? std::optional(m->feed_too) : std::nullopt;
    }
  }
  static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      State before{true}, after{false};
      transfer(s, before);
      transfer(s, after);
      found = found || before.value == after.value;
    });
    return found;
  }

 private:
  bool at_power_on_;
};

}  // namespace cnctrans::ir::passes
