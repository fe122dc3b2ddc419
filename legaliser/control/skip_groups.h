// Blocks with a skip mark as what they are: a branch on its switch.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Lines under one skip level right behind each other are all carried out or none. They become a branch with jumps, so
/// that every pass sees one: what it adds for the blocks of the branch stands in it, what others need stands outside.
///     / jump A, jump B, A: lines, B:
void open_skip_groups(Program& program, const LegaliseContext& context);
/// The branches become lines under the skip level again, wherever each of their lines can carry it.
void close_skip_groups(Program& program, const LegaliseContext& context);

/// A statement with bodies of its own, but an IF in one line.
bool is_structure(const Statement& s);

}  // namespace cnctrans::ir::passes
