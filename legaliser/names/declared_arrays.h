// Arrays under names of their own, for a target whose variables have no computed numbers but whose arrays have.
#pragma once

#include <string_view>

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Prefix of the space of arrays that stay arrays. No variable of a program has it.
inline constexpr std::string_view array_prefix = "\x01";

/// Arrays whose indices are computed, and those that take too many numbers, become arrays of the target; so do numbered
/// variables whose number is computed.
void declare_arrays(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
