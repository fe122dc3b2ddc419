// Parts of finish_program (program_reader.h) that have a file of their own.
#pragma once

#include "frontends/fagor/lower_state.h"
#include "ir/program.h"

namespace cnctrans::fagor {

/// G28 and G29 with axes (7.8): from here on every word names the axis that moves. FAG-051 where that can't be told.
void resolve_exchanges(ir::Program& program, LowerState& state);

}  // namespace cnctrans::fagor
