#include "legaliser/cycles/copied_cycles.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "legaliser/edit/refuse.h"

namespace cnctrans::ir::passes {

namespace {

using machine::Policies;

/// An option of a machine profile on which the moves of a cycle depend.
struct Habit {
  std::string_view cycle, option;
  bool (*same)(const Policies& a, const Policies& b);
};
template <auto Field>
bool same(const Policies& a, const Policies& b) {
  return a.*Field == b.*Field;
}
constexpr std::array habits = {
    Habit{"part.off", "cycle.parting_part", &same<&Policies::cycle_parting_part>},
    Habit{"part.off", "cycle.parting_speed", &same<&Policies::cycle_parting_speed>},
    Habit{"part.off", "cycle.parting_retract", &same<&Policies::cycle_parting_retract>},
    Habit{"part.off", "cycle.parting_after", &same<&Policies::cycle_parting_after>},
    Habit{"groove.alternate", "cycle.groove_position", &same<&Policies::cycle_groove_position>},
    Habit{"groove.alternate", "cycle.groove_depth", &same<&Policies::cycle_groove_depth>},
    Habit{"groove.alternate", "cycle.groove_dwell", &same<&Policies::cycle_groove_dwell>},
    Habit{"groove.alternate", "cycle.groove_edge", &same<&Policies::cycle_groove_edge>},
    Habit{"groove.alternate", "cycle.face_groove_left", &same<&Policies::cycle_face_groove_left>},
    Habit{"groove.shaped", "cycle.groove_edge", &same<&Policies::cycle_groove_edge>},
    Habit{"groove.shaped", "cycle.face_groove_left", &same<&Policies::cycle_face_groove_left>},
    Habit{"relief.shoulder", "cycle.relief_edge", &same<&Policies::cycle_relief_edge>},
    Habit{"relief.thread", "cycle.relief_edge", &same<&Policies::cycle_relief_edge>},
};

/// The first option that the profiles set differently; empty: none.
std::string_view other_option(const Statement& s, const LegaliseContext& context) {
  const auto* b = std::get_if<Block>(&s.node);
  for (const auto& a : b != nullptr ? b->actions : std::vector<Action>{}) {
    const auto* define = std::get_if<CycleDefine>(&a.data);
    const auto* named = define != nullptr && define->cycle ? std::get_if<NamedCycle>(&define->cycle->node) : nullptr;
    if (named == nullptr) continue;
    const auto other = std::find_if(habits.begin(), habits.end(), [&](const Habit& h) {
      return h.cycle == named->name && !h.same(context.source_machine.policies, context.target_machine.policies);
    });
    if (other != habits.end()) return other->option;
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
