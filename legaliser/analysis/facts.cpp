#include "legaliser/analysis/facts.h"

#include "legaliser/analysis/seen_facts.h"

namespace cnctrans::ir::passes {

FactsOf::FactsOf(Program& program, const LegaliseContext& context) {
  number_statements(program);
  table_ = analyse(program, context.source_machine.power_on, context.options.uncalled);
  if (context.seen != nullptr) context.seen->complete(program, table_);
}

}  // namespace cnctrans::ir::passes
