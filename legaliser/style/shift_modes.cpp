#include "legaliser/style/shift_modes.h"

#include <algorithm>

#include "ir/edit/rewrite.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/analysis/modal_needs.h"

namespace cnctrans::ir::passes {

namespace {

bool sets_shift(const Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    const auto* f = std::get_if<FrameOp>(&a.data);
    return f != nullptr && f->change && f->change->slot == FrameSlot::shift && !f->change->by_distance_mode;
  });
}

}  // namespace

void say_shift_modes(Program& program, const LegaliseContext& context) {
  if (context.target_machine.policies.frame_shift != machine::FrameShift::by_distance ||
      program.dialect == context.target.dialect)
    return;
  const FactsOf facts(program, context);
  const CallGraph calls(program);
  ModalNeeds needs(program, calls);
  const ModalGroup group{ModalGroup::Kind::setting, Setting::distance};
  std::vector<Statement*> found;
  for (std::size_t r = 0; r < program.routines.size(); ++r) {
    for_each_statement(program.routines[r].body, [&](Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || s.line.skip_mask != 0 || b->has_motion || !sets_shift(*b) ||
          setting_in<Distance>(*b, facts.before(s), Setting::distance) || needs.behind(r, s, group))
        return;
      found.push_back(&s);
    });
  }
  for (Statement* s : found) {
    auto& actions = std::get<Block>(s->node).actions;
    actions.insert(actions.begin(),
                   action(ModalSet{Setting::distance, static_cast<std::uint8_t>(Distance::absolute), true, {}}));
  }
}

}  // namespace cnctrans::ir::passes
