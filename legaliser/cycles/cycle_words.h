// Words of a modal cycle that read variables which change while it is in force.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// What the cycle pass could not write once more: by the id of the definition (or of the change of its words), the
/// variables that have changed behind it.
struct StaleWords {
  std::map<std::uint32_t, std::vector<VarRef>> found;
};

/// `carry_out(program, context, stale)`: the cycle pass. Where it would have to read words anew, the definition gives
/// them to variables of their own, which nothing changes.
void keep_cycle_words(Program& program, const LegaliseContext& context,
                      const std::function<void(Program&, const LegaliseContext&, StaleWords*)>& carry_out);

}  // namespace cnctrans::ir::passes
