// Increments right behind a preset of the zero point (equivalences 17): some controls count them from the coordinate
// that was preset, others from the one programmed before. Where the place is known they become absolute while the
// preset still says it.
#include "ir/edit/rewrite.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/analysis/words.h"
#include "legaliser/early_passes.h"

namespace cnctrans::ir::passes {

namespace {

class PresetSteps {
 public:
  PresetSteps(const LegaliseContext& context, const FactsOf& facts) : context_(context), facts_(facts) {}

  void block(const Statement& s, Block& b) {
    for (const auto& a : b.actions) {
      const auto* f = std::get_if<FrameOp>(&a.data);
      if (f == nullptr || !f->change || f->change->combine != FrameCombine::preset) continue;
      for (const auto& w : f->change->words) waiting_ |= bit(w.axis);
    }
    if (waiting_ == 0 || !b.has_motion || b.motion.coords.empty()) return;
    const Facts& facts = facts_.before(s);
    bool relative = false;
    for (const auto& c : b.motion.coords) {
      relative = relative || ((waiting_ & bit(c.axis)) != 0 && distance_of(c, b, facts) == Distance::incremental);
    }
    if (relative) {
      auto coords = absolute_words(b, facts, context_.source_machine, [&](AxisId a) { return facts.position[a]; });
      if (coords) b.motion.coords = std::move(*coords);  // else nothing is changed
    }
    for (const auto& c : b.motion.coords) waiting_ &= ~bit(c.axis);
  }

 private:
  static std::uint32_t bit(AxisId a) { return 1U << a; }

  const LegaliseContext& context_;
  const FactsOf& facts_;
  std::uint32_t waiting_ = 0;  ///< axes that have not moved since a preset
};

}  // namespace

void settle_preset_steps(Program& program, const LegaliseContext& context) {
  if (context.source_machine.policies.frame_change_keeps == context.target_machine.policies.frame_change_keeps) return;
  const FactsOf facts(program, context);
  for (auto& r : program.routines) {
    PresetSteps steps(context, facts);
    for_each_statement(r.body, [&steps](Statement& s) {
      if (auto* b = std::get_if<Block>(&s.node)) steps.block(s, *b);
    });
  }
}

}  // namespace cnctrans::ir::passes
