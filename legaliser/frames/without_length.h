// Moves in machine coordinates that keep the tool length where there is none to keep: no offset is in force (D0), or a
// mill does not move along its tool.
#pragma once

#include <set>

#include "legaliser/analysis/facts.h"

namespace cnctrans::ir::passes {

class WithoutLength {
 public:
  WithoutLength(const Program& program, const LegaliseContext& context, const FactsOf& facts);
  [[nodiscard]] bool holds(const Statement& s) const { return found_.count(s.id) != 0; }

 private:
  std::set<std::uint32_t> found_;  ///< statements
};

}  // namespace cnctrans::ir::passes
