// A replay as a fact: what the one run of a program sees that has no other.
#pragma once

#include <optional>
#include <string>

#include "legaliser/analysis/seen_facts.h"
#include "translator/translation/attempt.h"

namespace cnctrans::translator {

struct Seen {
  ir::passes::SeenFacts facts;
  Span first;         ///< of the assignments that the run rests on; invalid: there are none
  std::string lines;  ///< of all of them: "3-9, 12"
};
/// nullopt: the program has inputs that do not stand in its text (values read before they are set, data of the machine,
/// subprograms elsewhere), or does not run to its end. Block skips are tried both ways, each level
/// by itself, or it has more than a few levels.
std::optional<Seen> see(const AttemptContext& c, const ir::Program& program);

}  // namespace cnctrans::translator
