#include "legaliser/frames/preset_ends.h"

#include "ir/edit/search.h"

namespace cnctrans::ir::passes {

namespace {

bool outlasts(const machine::Profile& machine) {
  return machine.policies.frame_preset_outlasts;
}
bool presets(const Action& a) {
  const auto* f = std::get_if<FrameOp>(&a.data);
  return f != nullptr && f->change && f->change->combine == FrameCombine::preset;
}

}  // namespace

bool presets_taken_back(const Program& program, const LegaliseContext& context, const FactsOf& facts,
                        const FrameStates& states) {
  bool found = false;
  if (program.dialect == context.target.dialect) return false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || found) return;
      FrameState state = states.before(s);
      for (const auto& a : b->actions) {
        const FrameState before = state;
        if (const auto* w = std::get_if<WorkOffset>(&a.data)) {
          state.select(*w, context.source_machine);
          found = found || !before.slot(FrameSlot::preset).neutral() || !state.slot(FrameSlot::preset).neutral();
        }
        const auto* f = std::get_if<FrameOp>(&a.data);
        if (f == nullptr || !f->change) continue;
        state.apply(*f->change, facts.before(s), *b, context.source_machine);
        const bool goes = f->change->combine == FrameCombine::clear && !before.slot(FrameSlot::preset).neutral();
        const bool waits = presets(a) && before.preset_waits();  // the target's own would act at once
        found = found || (f->change->slot == FrameSlot::preset && (goes || waits));
      }
    });
  }
  return found;
}

bool presets_outlast(const Program& program, const LegaliseContext& context) {
  return program.dialect != context.target.dialect && outlasts(context.target_machine) &&
         !outlasts(context.source_machine) && any_action(program, presets);
}

PresetEnds::PresetEnds(const Program& program, const LegaliseContext& context) : context_(context) {
  if (program.dialect == context.target.dialect) return;
  source_keeps_ = outlasts(context.source_machine);
  target_keeps_ = outlasts(context.target_machine);
}

void PresetEnds::tell(const Statement& s, const Action& a, bool as_it_is) const {
  const bool goes = source_keeps_ && !(as_it_is && target_keeps_);
  if (presets(a) && goes) say(s, a, false);
}

void PresetEnds::tell_kept(const Program& program) const {
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [this](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
        if (presets(b->actions[i])) say(s, b->actions[i], true);
      }
    });
  }
}

void PresetEnds::say(const Statement& s, const Action& a, bool stays) const {
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
