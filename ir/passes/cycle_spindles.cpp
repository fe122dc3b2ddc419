#include "ir/passes/cycle_spindles.h"

#include "ir/passes/flow_states.h"
#include "ir/passes/one_value.h"
#include "ir/passes/rewrite.h"
#include "ir/search.h"

namespace cnctrans::ir::passes {

namespace {

/// A domain of FlowStates: the spindle that is chosen.
class ChosenSpindle : public OneValue<std::uint8_t> {
 public:
  [[nodiscard]] static State start(const Routine& r, bool /*called*/) {
    return r.kind == RoutineKind::main ? State{std::uint8_t{1}} : State{};
  }
  static void transfer(const Statement& s, State& state) {
    const auto* chosen = chosen_in(s);
    if (chosen == nullptr) return;
    state.value = s.line.skip_mask == 0 || state.value == chosen->number ? std::optional(chosen->number) : std::nullopt;
  }
  static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) { found = found || chosen_in(s) != nullptr; });
    return found;
  }

 private:
  static const MasterSpindle* chosen_in(const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    return b != nullptr ? action_in<MasterSpindle>(*b) : nullptr;
  }
};

/// The number of spindle 1 in an action that no word of the source says.
std::uint8_t* made_number(Action& a) {
  if (a.pos.column != 0) return nullptr;
  std::uint8_t* number = nullptr;
  if (auto* run = std::get_if<SpindleRun>(&a.data)) number = &run->number;
  if (auto* orient = std::get_if<SpindleOrient>(&a.data)) number = &orient->number;
  if (auto* set = std::get_if<SetSpindle>(&a.data)) number = &set->number;
  return number != nullptr && *number == 1 ? number : nullptr;
}

}  // namespace

void name_cycle_spindles(Program& program, const LegaliseContext& context) {
  if (std::none_of(program.routines.begin(), program.routines.end(), ChosenSpindle::touches)) return;
  number_statements(program);
  const ChosenSpindle domain;
  const FlowStates<ChosenSpindle> states(program, domain);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      const auto* state = states.before(s);
      for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
        std::uint8_t* number = made_number(b->actions[i]);
        if (number == nullptr || (state != nullptr && state->value == 1)) continue;
        if (state != nullptr && state->value) {
          *number = *state->value;
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
