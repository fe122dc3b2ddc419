// Which of several marks of one name ends a repeated part.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// A repeated part whose jumps pass its first end mark by names the one that it comes to.
void name_jumped_ends(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
