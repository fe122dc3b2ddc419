// How a pass refuses a statement.
#pragma once

#include <string>
#include <string_view>

#include "ir/edit/rewrite.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Nothing will be written: what follows is looked at as if this statement had changed nothing but the feed, so that it
/// is not blamed for it.
void pass_over(Opaque& refused);

/// Puts an Opaque statement in the place of one that the target can't say, with an error.
void refuse(Statement& s, const Program& program, const LegaliseContext& context, std::string_view code,
            std::string message, std::string hint = {}, WordPos pos = {});

}  // namespace cnctrans::ir::passes
