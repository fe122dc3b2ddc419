// Where a hole cycle ends without a word of its own.
#pragma once

#include <vector>

#include "ir/program.h"

namespace cnctrans::ir {

/// On a control where another plane and the search for home end a hole cycle: a cancel is put where they do, wherever
/// the cycle was defined. Yields the statements where that depends on the way that leads to them.
std::vector<const Statement*> end_cycles_with_plane(Program& program, const ModalState& power_on);

}  // namespace cnctrans::ir
