#include "legaliser/cycles/copied_cycles.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "legaliser/edit/refuse.h"

namespace cnctrans::ir::passes {

namespace {

struct Row {
  std::string_view cycle;
  std::array<std::string_view, 5> options;  ///< of a machine profile, on which its moves depend
};
constexpr std::array rows = {
    Row{"part.off", {"cycle.parting_part", "cycle.parting_speed", "cycle.parting_retract", "cycle.parting_after"}},
    Row{"groove.alternate",
        {"cycle.groove_position", "cycle.groove_depth", "cycle.groove_dwell", "cycle.groove_edge",
         "cycle.face_groove_left"}},
    Row{"groove.shaped", {"cycle.groove_edge", "cycle.face_groove_left"}},
    Row{"relief.shoulder", {"cycle.relief_edge"}},
    Row{"relief.thread", {"cycle.relief_edge"}},
};

/// The first option that the profiles set differently; empty: none.
std::string_view other_option(const Statement& s, const LegaliseContext& context) {
  const auto* b = std::get_if<Block>(&s.node);
  for (const auto& a : b != nullptr ? b->actions : std::vector<Action>{}) {
    const auto* define = std::get_if<CycleDefine>(&a.data);
    const auto* named = define != nullptr && define->cycle ? std::get_if<NamedCycle>(&define->cycle->node) : nullptr;
    if (named == nullptr) continue;
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.cycle == named->name; });
    if (row == rows.end()) continue;
    for (const auto option : row->options) {
      if (!option.empty() && context.source_machine.option(option) != context.target_machine.option(option))
        return option;
    }
  }
  return {};
}

}  // namespace

void refuse_other_moves(Program& program, const LegaliseContext& context) {
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      const auto option = other_option(s, context);
      if (option.empty()) return;
      refuse(s, program, context, "TRN-691",
             "the moves of this cycle follow from " + std::string(option) +
                 ", and the target's machine profile sets it otherwise",
             "set the same in both profiles");
    });
  }
}

}  // namespace cnctrans::ir::passes
