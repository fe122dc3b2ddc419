// A cycle whose moves the maker's manual leaves open: it runs as the reader assumed, and a translation writes its moves
// only when the machine profile confirms them.
#pragma once

#include <string>
#include <string_view>

#include "ir/cycle.h"

namespace cnctrans::ir::cycles {

/// The word that names the option which would confirm the moves.
inline constexpr std::string_view assumed_word = "assumed", assumed_mill_word = "kept.assumed";
/// The option that nobody has confirmed; empty: the moves are known.
std::string assumed_option(const NamedCycle& cycle);
std::string assumed_option(const HoleCycle& cycle);

}  // namespace cnctrans::ir::cycles
