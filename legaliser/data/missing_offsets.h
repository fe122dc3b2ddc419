// Work offsets of the source that the table of the target does not have.
#pragma once

#include <string_view>

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// In the report: the name of the target's only work offset; its new name is the number that it has in the source.
inline constexpr std::string_view offset_name = "= offset";

/// A program that works with one offset has it in the one row of the target; of several, each selection writes the row.
void place_missing_offsets(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
