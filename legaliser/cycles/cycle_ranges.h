// Ranges of points that several cycles run.
#pragma once

#include <functional>

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// `carry_out(program, context)`: the cycle pass. Where it could not say which cycle the points of a repeated range
/// run, each repetition gets the range in its place, a copy for each cycle; a range that nothing reaches any more goes.
void separate_cycle_ranges(Program& program, const LegaliseContext& context,
                           const std::function<void(Program&, const LegaliseContext&)>& carry_out);

}  // namespace cnctrans::ir::passes
