// A coordinate that a numbered block of a program writes, read without carrying the block out.
#pragma once

#include <functional>
#include <optional>

#include "ir/program.h"

namespace cnctrans::ir {

using ProgramFinder = std::function<const Program*(const RoutineName&)>;

/// The number of a main program: its own, or the one that its name is (000100); nullopt: it has a name only.
std::optional<double> main_number(const Routine& main);

/// Word of `axis`, as written, in the first block with number `block` of the main program `number`: `at_hand` itself
/// (null: none) or one that `library` knows. 100000 where the block has no such word; nullopt: no such program or
/// block, or a value that only carrying it out gives.
std::optional<double> block_coordinate(const Program* at_hand, const ProgramFinder* library, AxisId axis, double block,
                                       double number);

}  // namespace cnctrans::ir
