// ER, EH, P .. while a cycle is active change the cycle in force (reference 11.1). The reader has joined them with the
// one above in the text; the flow of the program decides whether that was right.
#include "frontends/num/cycle_changes.h"

#include <vector>

#include "ir/dataflow.h"

namespace cnctrans::frontends::num {

namespace {

struct Change {
  const ir::Statement* statement = nullptr;
  std::uint32_t above = 0;  ///< the statement whose cycle it was joined with
};

const ir::Action* cycle_in(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  if (b == nullptr) return nullptr;
  for (const auto& a : b->actions) {
    const auto* d = std::get_if<ir::CycleDefine>(&a.data);
    if (d != nullptr && d->modal && d->cycle && std::holds_alternative<ir::HoleCycle>(d->cycle->node)) return &a;
  }
  return nullptr;
}

/// A change has no code of its own.
std::vector<Change> changes_of(const ir::Program& program) {
  std::vector<Change> found;
  for (const auto& r : program.routines) {
    std::uint32_t above = 0;
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const ir::Action* a = cycle_in(s);
      if (a == nullptr) return;
      if (a->text.empty() && above != 0) found.push_back({&s, above});
      above = s.id;
    });
  }
  return found;
}

}  // namespace

void judge_cycle_changes(ir::Program& program, const ir::ModalState& power_on, Diagnostics& diagnostics) {
  ir::number_statements(program);
  const auto changes = changes_of(program);
  if (changes.empty()) return;
  const ir::FactTable table = ir::analyse(program, power_on);
  for (const Change& c : changes) {
    const ir::Facts& before = table.before(c.statement->id);
    if (!before.reachable || before.cycle_from == c.above) continue;
    const Span& where = c.statement->line.span;
    if (before.cycle_from == 0 && !before.cycle_active_known) {
      diagnostics.warning(
          "NUM-048", where,
          "these words change the cycle in force, which a program of another file may have set: the one "
          "above in the text is taken",
          "write the whole cycle");
      continue;
    }
    diagnostics.error("NUM-048", where,
                      "these words change the cycle in force, and which one that is depends on the way to this block",
                      "write the whole cycle here");
  }
}

}  // namespace cnctrans::frontends::num
