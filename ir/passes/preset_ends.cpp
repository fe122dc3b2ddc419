#include "ir/passes/preset_ends.h"

#include <algorithm>

namespace cnctrans::ir::passes {

namespace {

bool outlasts(const machine::Profile& machine) {
  return machine.option("frame.preset_outlasts") == "yes";
}
bool is_preset(const Action& a) {
  const auto* f = std::get_if<FrameOp>(&a.data);
  return f != nullptr && f->change && f->change->combine == FrameCombine::preset;
}

/// A preset is in force somewhere where it is taken back.
bool taken_back(const Program& program, const LegaliseContext& context, const FactsOf& facts,
                const FrameStates& states) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || found) return;
      FrameState state = states.before(s);
      for (const auto& a : b->actions) {
        const FrameState before = state;
        if (const auto* w = std::get_if<WorkOffset>(&a.data)) {
          state.select(*w, context.source_machine);
          found = found || !(before.slot(FrameSlot::preset) == state.slot(FrameSlot::preset));
        }
        const auto* f = std::get_if<FrameOp>(&a.data);
        if (f == nullptr || !f->change) continue;
        state.apply(*f->change, facts.before(s), *b, context.source_machine);
        found = found || (f->change->slot == FrameSlot::preset && f->change->combine == FrameCombine::clear &&
                          !before.slot(FrameSlot::preset).neutral());
      }
    });
  }
  return found;
}

/// Every preset is a shift by numbers.
bool are_numbers(const Program& program, const LegaliseContext& context, const FactsOf& facts,
                 const FrameStates& states) {
  bool all = true;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !all || std::none_of(b->actions.begin(), b->actions.end(), is_preset)) return;
      FrameState state = states.before(s);
      for (const auto& a : b->actions) {
        if (const auto* f = std::get_if<FrameOp>(&a.data); f != nullptr && f->change)
          state.apply(*f->change, facts.before(s), *b, context.source_machine);
      }
      const PlanarFrame whole = state.whole(context.source_machine, true);
      all = whole.known() && !whole.foreign;
    });
  }
  return all;
}

}  // namespace

bool presets_as_shifts(const Program& program, const LegaliseContext& context, const FactsOf& facts,
                       const FrameStates& states) {
  if (program.dialect == context.target.dialect) return false;
  return taken_back(program, context, facts, states) ||
         (outlasts(context.target_machine) && !outlasts(context.source_machine) &&
          are_numbers(program, context, facts, states));
}

PresetEnds::PresetEnds(const Program& program, const LegaliseContext& context) : context_(context) {
  if (program.dialect == context.target.dialect) return;
  source_keeps_ = outlasts(context.source_machine);
  target_keeps_ = outlasts(context.target_machine);
}

void PresetEnds::tell(const Statement& s, const Action& a, bool as_it_is) const {
  const bool stays = as_it_is && target_keeps_ && !source_keeps_;
  const bool goes = source_keeps_ && !(as_it_is && target_keeps_);
  if (!is_preset(a) || (!stays && !goes)) return;
  context_.diagnostics.warning(
      "TRN-672", word_span(s.line.span, a.pos),
      stays ? "this preset moves the zero point of the target for good, in its datum table: it holds on behind the end "
              "of "
              "the program, and the next run begins with it; where the tool stands here is not known as a number"
            : "the source's control keeps this preset in its datum table behind the end of the program, the target "
              "forgets it there",
      stays ? "give the point before it as numbers, or set the datum again behind the end"
            : "set the work offset on the target if later programs count on it");
}

}  // namespace cnctrans::ir::passes
