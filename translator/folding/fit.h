// Does the meaning of a program allow that lines are left out of its text?
#pragma once

#include <optional>

#include "ir/program.h"
#include "machine/profile.h"
#include "translator/folding/folded_text.h"
#include "translator/pipeline.h"

namespace cnctrans::translator {

/// nullopt: every gap stands where places are absolute, and no jump or repeat asks for a line that could be in one.
std::optional<Unfit> unfit(const ir::Program& program, const machine::Profile& machine, const FoldedText& folded);

}  // namespace cnctrans::translator
