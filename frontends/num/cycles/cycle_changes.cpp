// ER, EH, P .. while a cycle is active change the cycle in force (reference 11.1).
#include "frontends/num/cycles/cycle_changes.h"

#include "frontends/common/cycle_changes.h"

namespace cnctrans::frontends::num {

void judge_cycle_changes(ir::Program& program, const ir::ModalState& power_on,
                         const std::map<std::uint32_t, std::uint32_t>& joined, Diagnostics& diagnostics) {
  const auto is_change = [](const ir::Action& a) { return a.text.empty(); };  // a change has no code of its own
  report_changes(judge_changes(program, power_on, is_change, joined), "NUM-048", diagnostics);
}

}  // namespace cnctrans::frontends::num
