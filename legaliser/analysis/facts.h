// Facts for a pass: numbers the statements and runs the dataflow analysis once.
#pragma once

#include <set>

#include "ir/analysis/dataflow.h"
#include "ir/analysis/settings.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

class FactsOf {
 public:
  FactsOf(Program& program, const LegaliseContext& context);
  /// What is known before the statement; a statement made by a pass after the analysis: nothing.
  [[nodiscard]] const Facts& before(const Statement& s) const { return s.id == 0 ? nothing_ : table_.before(s.id); }

 private:
  FactTable table_;
  Facts nothing_;
};

}  // namespace cnctrans::ir::passes
