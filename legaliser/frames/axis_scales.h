// Factors of single axes on a target whose programmable frame has one for each axis: the component
// of the frame is written, and nothing else of the frame has to be known.
#pragma once

#include <optional>

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Where the program changes its frames by such factors only; a target that clears the whole frame with another change
/// would lose them.
void write_axis_scales(Program& program, const LegaliseContext& context);

/// The axis whose component of the programmable frame the assignment writes.
std::optional<AxisId> axis_of_component(const Assign::Item& item);

}  // namespace cnctrans::ir::passes
