// Variable spaces of a Sinumerik program (reference-language 3.2, 3.3): what a program's VarRef::space means.
#pragma once

#include <optional>
#include <vector>

#include "ir/program.h"

namespace cnctrans::sinumerik {

/// Spaces every Sinumerik program has, in this order: R parameters, then the user variables of a routine by type, then
/// global user variables by type.
std::vector<ir::VariableSpace> variable_spaces();

/// Their indices.
namespace space {
inline constexpr ir::SpaceId r = 0, real = 1, integer = 2, boolean = 3, string = 4, axis = 5;
inline constexpr ir::SpaceId global_real = 6, global_integer = 7, global_boolean = 8, global_string = 9, frame = 10;
}  // namespace space
/// The space for variables of a type; types without a space give none.
std::optional<ir::SpaceId> space_of(ir::Type type, bool global);

}  // namespace cnctrans::sinumerik
