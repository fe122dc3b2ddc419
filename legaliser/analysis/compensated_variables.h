// Variables that a program uses while radius compensation is on or in words of a contour (angles of lines, corners):
// some controls don't take all of theirs there.
#pragma once

#include <set>
#include <string>
#include <utility>

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// By space and name; a numbered one by its number.
using VariableNames = std::set<std::pair<SpaceId, std::string>>;

/// Variables that stand in a statement while radius compensation is on, or may be, or in a block that describes a
/// contour by an angle or a corner.
VariableNames compensated_variables(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
