#include "ir/passes/facts.h"

#include "ir/passes/uncalled.h"

namespace cnctrans::ir::passes {

FactsOf::FactsOf(Program& program, const LegaliseContext& context) {
  number_statements(program);
  table_ = analyse(program, context.source_machine.power_on, uncalled_state(context.source_machine));
}

}  // namespace cnctrans::ir::passes
