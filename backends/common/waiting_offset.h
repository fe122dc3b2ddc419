// D beside a T that only selects the tool: on some controls such an offset counts from the change of the tool on.
#pragma once

#include <cstdint>
#include <set>

#include "ir/program.h"

namespace cnctrans::backends {

/// What a statement behind `T2 D1` means for the D.
enum class OffsetStep : std::uint8_t {
  arrives,  ///< the change of the tool, with no D of its own
  passes,   ///< nothing moves and nothing else is selected
  lost      ///< anything else
};
OffsetStep offset_step(const ir::Statement& s);

/// A tool that is selected only, with an offset beside it.
bool offset_beside_tool(const ir::Block& b);

/// The blocks whose D may stay beside the T, since nothing moves before the change: it makes no difference from when on
/// the offset counts.
std::set<const ir::Statement*> offsets_that_wait(const ir::Program& program);

}  // namespace cnctrans::backends
