// Subprograms that nothing at hand calls: most passes leave what depends on their callers as it is or refuse it. Where
// that refuses the program, it is translated for a call in the state of power-on, with a warning (option
// call.uncalled_state of the machine profile; the translator tries both for `when_needed`).
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Subprograms that no statement of the program calls, by index.
std::vector<std::size_t> uncalled_routines(const Program& program);

/// A warning (TRN-460) for each: what its translation takes for granted.
void tell_assumed_state(const Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
