#include "legaliser/cycles/cycle_spindles.h"

#include "ir/analysis/dataflow.h"
#include "ir/edit/rewrite.h"
#include "ir/edit/search.h"
#include "legaliser/edit/refuse.h"

namespace cnctrans::ir::passes {

namespace {

/// The number of spindle 1 in an action that no word of the source says.
std::uint8_t* made_number(Action& a) {
  if (a.pos.column != 0) return nullptr;
  std::uint8_t* number = nullptr;
  if (auto* run = std::get_if<SpindleRun>(&a.data)) number = &run->number;
  if (auto* orient = std::get_if<SpindleOrient>(&a.data)) number = &orient->number;
  if (auto* set = std::get_if<SetSpindle>(&a.data)) number = &set->number;
  if (auto* limit = std::get_if<SpindleLimit>(&a.data)) number = &limit->number;
  return number != nullptr && *number == 1 ? number : nullptr;
}

}  // namespace

void name_cycle_spindles(Program& program, const LegaliseContext& context) {
  const auto chooses = [](const Action& a) { return std::holds_alternative<MasterSpindle>(a.data); };
  if (!any_action(program, chooses)) return;
  number_statements(program);
  const FactTable facts = analyse(program, context.source_machine.power_on, context.options.uncalled);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      const auto& chosen = facts.before(s.id).master;
      for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
        std::uint8_t* number = made_number(b->actions[i]);
        if (number == nullptr || chosen == 1) continue;
        if (chosen) {
          *number = *chosen;
          continue;
        }
        refuse(s, program, context, "TRN-330",
               "a cycle that is written out turns the spindle that is chosen, and which one that is is not known here",
               "choose the spindle before the cycle", {});
        return;
      }
    });
  }
}

}  // namespace cnctrans::ir::passes
