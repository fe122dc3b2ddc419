// What the domains of FlowStates share whose state is one value: the same on every way, or not known.
#pragma once

#include <optional>

namespace cnctrans::ir::passes {

template <class T>
class OneValue {
 public:
  struct State {
    std::optional<T> value;
  };
  static void unknown(State& state) { state.value.reset(); }
  static bool join(State& a, const State& b) {
    if (!a.value || a.value == b.value) return false;
    a.value.reset();
    return true;
  }
};

}  // namespace cnctrans::ir::passes
