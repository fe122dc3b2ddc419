// Tools whose radius the source program itself says: both machines have them.
#pragma once

#include "ir/program.h"
#include "machine/profile.h"

namespace cnctrans::translator {

/// `target` with the tools that cycles of the program name with a radius, unless it has its own of their numbers.
machine::Profile with_said_tools(const ir::Program& program, machine::Profile target);

}  // namespace cnctrans::translator
