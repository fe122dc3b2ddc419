// The feed of moves in which linear and rotary axes move together.
#pragma once

#include "legaliser/legalise.h"
#include "machine/profile.h"

namespace cnctrans::ir::passes {

/// One control counts degrees as millimetres of the way, the other lets F hold for the linear axes alone (option
/// `feed.mixed_axes`).
bool mixed_feeds_differ(const machine::Profile& source, const machine::Profile& target);
/// The block names a linear and a rotary axis of the machine.
bool moves_and_turns(const Block& block, const machine::Profile& machine);
/// Warns, once a program, where F would be another speed (TRN-655).
void check_mixed_feeds(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
