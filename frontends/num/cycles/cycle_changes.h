// Changes of the words of an active cycle: were they joined with the right one?
#pragma once

#include <cstdint>
#include <map>

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::frontends::num {

/// NUM-048 at each change whose cycle is not the one above in the text on every way (numbers the statements).
/// `joined`: line of a change -> line of the cycle that it was joined with.
void judge_cycle_changes(ir::Program& program, const ir::ModalState& power_on,
                         const std::map<std::uint32_t, std::uint32_t>& joined, Diagnostics& diagnostics);

}  // namespace cnctrans::frontends::num
