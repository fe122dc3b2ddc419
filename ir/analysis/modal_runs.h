// Where a modal subprogram is run. Only for the .cpp files of ir/.
#pragma once

#include <cstddef>
#include <vector>

#include "ir/program.h"

namespace cnctrans::ir::detail {

/// A motion, or a pattern of points: a modal subprogram runs behind it.
bool moves(const Statement& s);
/// A block of F, S or a bare motion code: some machines run a modal subprogram there as well.
bool may_run_modal_call(const Statement& s);
/// By routine: it is one of `targets` (indices of routines), or they call it.
std::vector<bool> run_modally(const Program& program, const std::vector<std::size_t>& targets);

}  // namespace cnctrans::ir::detail
