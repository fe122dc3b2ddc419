// Does the meaning of a program allow that lines are left out of its text?
#pragma once

#include <optional>
#include <string_view>

#include "ir/program.h"
#include "machine/profile.h"
#include "translator/folding/folded_text.h"
#include "translator/pipeline.h"

namespace cnctrans::translator {

struct FoldTarget {
  std::string_view dialect;
  const machine::Profile& machine;
};
/// nullopt: every gap stands where places are absolute, no jump or repeat asks for a line that could be in one, and
/// what is written for a rotary word does not go by where its axis stands.
std::optional<Unfit> unfit(const ir::Program& program, const machine::Profile& machine, const FoldTarget& target,
                           const FoldedText& folded);

}  // namespace cnctrans::translator
