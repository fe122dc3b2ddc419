// The plane is modal over calls (reference 13.2): blocks of a called program or range are read in the plane that the
// flow of the program brings to them, not in that of the text above.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::frontends::num {

/// Planes to read the file once more with, by line; empty: the text says the same everywhere (numbers the statements).
std::map<std::uint32_t, ir::Plane> planes_by_flow(ir::Program& program, const ir::ModalState& power_on);

/// NUM-080 at each use of the plane that several planes reach.
void judge_planes(ir::Program& program, const std::vector<std::pair<Span, ir::Plane>>& uses,
                  const ir::ModalState& power_on, Diagnostics& diagnostics);

}  // namespace cnctrans::frontends::num
