#include "legaliser/analysis/facts.h"

namespace cnctrans::ir::passes {

FactsOf::FactsOf(Program& program, const LegaliseContext& context) {
  number_statements(program);
  table_ = analyse(program, context.source_machine.power_on, context.options.uncalled);
}

}  // namespace cnctrans::ir::passes
