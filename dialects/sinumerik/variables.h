// Variable spaces of a Sinumerik program (reference-language 3.2, 3.3): what a program's VarRef::space means.
#pragma once

#include <vector>

#include "ir/program.h"

namespace cnctrans::sinumerik {

/// Spaces every Sinumerik program has, in this order: R parameters, then the user variables of a routine by type, then
/// global user variables.
std::vector<ir::VariableSpace> variable_spaces();

}  // namespace cnctrans::sinumerik
