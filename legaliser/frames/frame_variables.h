// A programmable frame that the paths leading here make different, kept in variables of the target.
#pragma once

#include <cstdint>
#include <set>

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Frame statements `lost` (ids) add to a frame that is not known there: a shift or a rotation about the normal of its
/// plane inside a loop, or in a subprogram that several places call. What is not known is kept in global variables of
/// the target: every frame statement that changes such a part sets its variable, and the statements `lost` set the
/// whole frame from them (TRN-490). Where that can't be done (scales and mirrors that differ, several units or
/// diameter modes, calls into programs that are not at hand) the program stays as it is. Statements must be numbered.
void keep_frames_in_variables(Program& program, const LegaliseContext& context, const std::set<std::uint32_t>& lost);

}  // namespace cnctrans::ir::passes
