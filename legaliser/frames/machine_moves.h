// Moves in machine coordinates, as the target has them. Those that keep the tool length lose nothing where there is
// none to keep: no offset is in force (D0), or a mill does not move along its tool.
#pragma once

#include <set>

#include "legaliser/analysis/facts.h"

namespace cnctrans::ir::passes {

class MachineMoves {
 public:
  MachineMoves(const Program& program, const LegaliseContext& context, const FactsOf& facts);
  /// Makes the block's move one of the target's. False: refused.
  bool fit(Statement& s, Block& b) const;

 private:
  bool words(Statement& s, Block& b) const;

  const Program& program_;
  const LegaliseContext& context_;
  const FactsOf& facts_;
  std::set<std::uint32_t> without_length_;  ///< statements
};

}  // namespace cnctrans::ir::passes
