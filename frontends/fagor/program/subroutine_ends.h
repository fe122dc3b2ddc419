// Where the subroutines of a file end (12.5), and which blocks behind them are the main part's again.
#pragma once

#include <cstdint>
#include <set>

#include "ir/program.h"

namespace cnctrans::fagor {

/// A subroutine ends at its first (RET); what stands behind it is the file's. A program was read with each subroutine
/// going on to the next (SUB): the lines at which the main part goes on instead. Blocks that the subroutine itself
/// jumps to or names (`GOTO`, `RPT`, a profile) run on to the next (RET) and stay with it. Nothing is found where the
/// main part would run on into the (SUB).
std::set<std::uint32_t> lines_of_the_main_part(const ir::Program& program);

}  // namespace cnctrans::fagor
