// How a pass refuses a statement.
#pragma once

#include <string>
#include <string_view>

#include "ir/edit/rewrite.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Puts an Opaque statement in the place of one that the target can't say, with an error.
void refuse(Statement& s, const Program& program, const LegaliseContext& context, std::string_view code,
            std::string message, std::string hint = {}, WordPos pos = {});

}  // namespace cnctrans::ir::passes
