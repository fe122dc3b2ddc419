// Hole cycles as calls of the standard cycles (reference-language 18.1).
#pragma once

#include <functional>
#include <string>

#include "ir/cycle.h"

namespace cnctrans::backends::sinumerik {

/// True when cycle_call() says exactly this cycle: same planes, schedule, dwells, retract.
bool native_cycle(const ir::Cycle& cycle);

/// "CYCLE82(20,0,2,-15,,0.5)": leading arguments, trailing empty ones dropped. `print` writes a value.
std::string cycle_call(const ir::Cycle& cycle, const std::function<std::string(const ir::Value&)>& print);

}  // namespace cnctrans::backends::sinumerik
