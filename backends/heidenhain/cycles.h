// Machining cycles in the words of the control.
#pragma once

#include <map>
#include <optional>

#include "dialects/heidenhain/cycles.h"
#include "ir/cycle.h"

namespace cnctrans::backends::heidenhain {

/// The values of a cycle's Q parameters by number; what is not there has the control's own value.
struct CycleText {
  const dialects::heidenhain::CycleRow* row = nullptr;
  std::map<std::int16_t, ir::Value> values;
};

/// The cycle of the control with exactly these moves. `feed`: the F in force, which the cycles of the control name.
std::optional<CycleText> cycle_text(const ir::HoleCycle& cycle, const ir::Value& feed);

/// The number of the milling cycle, and its parameters beside the levels; 0: the control has none with these moves.
int mill_text(const ir::HoleCycle& cycle, std::map<std::int16_t, ir::Value>& values);

bool native_cycle(const ir::Cycle& cycle);

/// The spindle turns on behind the cycle of the source; the control's own leaves it standing. 0: nothing to say.
int spindle_after(const ir::HoleCycle& cycle);

}  // namespace cnctrans::backends::heidenhain
