// Parts of finish_program (program_reader.h) that have a file of their own.
#pragma once

#include "frontends/fagor/state/state.h"
#include "ir/program.h"

namespace cnctrans::fagor {

/// G28 and G29 with axes (7.8): from here on every word names the axis that moves. FAG-051 where that can't be told.
void resolve_exchanges(ir::Program& program, LowerState& state);

/// G92 while axes are mirrored does not move their origin through the mirror image (7.5). FAG-103.
void set_presets_past_mirrors(ir::Program& program, LowerState& state);

/// No jump, call, subroutine or skipped block: what the text says is the order of work.
bool in_order_of_text(const ir::Program& program);
bool has_jumps(const ir::Program& program);

// finish_cycles.cpp
/// G79 was joined with the cycle above it in the text: FAG-090 where another one is in force, or its words have
/// changed.
void judge_cycle_changes(ir::Program& program, LowerState& state);
/// A cycle in force ends with its plane and with the search for home, wherever it was defined (25.2).
void end_cycles(ir::Program& program, LowerState& state);
/// G66, G68, G69 and G83 of the lathe end the radius compensation (8.2.3): nothing to say where it is off already.
void drop_needless_ends(ir::Program& program, LowerState& state);
/// Repeat counts under MEXEC, and under MCALL where the machine moves once (2.7): FAG-091.
void judge_repeats(ir::Program& program, LowerState& state);

}  // namespace cnctrans::fagor
