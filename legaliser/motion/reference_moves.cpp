// The search of a reference point (equivalences 8) on a control that has no function for it: a rapid move to the place
// that the profile gives it.
#include "ir/edit/rewrite.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"
#include "machine/profile.h"

namespace cnctrans::ir::passes {

void convert_reference_moves(Program& program, const LegaliseContext& context) {
  if (context.target.motions.count(MotionKind::reference_point) != 0 || program.dialect == context.target.dialect)
    return;
  if (context.target.frame_uses.count(FrameUse::machine) == 0) return;
  const FactsOf facts(program, context);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !b->has_motion || b->motion.kind != MotionKind::reference_point) return;
      const bool metric = setting_in<Units>(*b, facts.before(s), Setting::units) == Units::metric;
      for (const auto& c : b->motion.coords) {
        const auto* axis = context.source_machine.axis(c.axis);
        if (axis == nullptr || (axis->reference_point != 0 && !metric)) return;  // the writer refuses it
      }
      for (auto& c : b->motion.coords) {
        c.value = Value{context.source_machine.axis(c.axis)->reference_point};
        c.mode = WordMode::absolute;
        c.scale = c.value.is(0) ? WordScale::modal : WordScale::radius;
      }
      b->motion.kind = MotionKind::rapid;
      b->motion.frame = FrameUse::machine;
      b->motion.keeps_modal = false;
      context.diagnostics.warning(
          "TRN-328", word_span(s.line.span, b->motion.code_pos),
          "the target has no search of the reference point: a rapid move to its place in machine "
          "coordinates is written, the reference is not taken again",
          "check the place of the reference point in the machine profile");
    });
  }
}

}  // namespace cnctrans::ir::passes
