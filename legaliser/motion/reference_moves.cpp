// The search of a reference point (equivalences 8), and the way to a fixed point of the machine, on a control that has
// no function for it: a rapid move to the place that the profile gives it.
#include <cmath>

#include "ir/edit/rewrite.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"
#include "machine/profile.h"

namespace cnctrans::ir::passes {

namespace {

struct MachinePoint {
  std::optional<double> place;  ///< nullopt: it is computed which point it is
  bool said = true;             ///< by the profile
};

/// Of the axis, in machine coordinates.
MachinePoint point_of(const Motion& m, const machine::AxisSpec& axis) {
  if (m.kind == MotionKind::reference_point) return {axis.reference_point};
  const bool numbered = m.extra && m.extra->has_fixed_point;
  if (numbered && !m.extra->fixed_point.literal()) return {std::nullopt};
  const double n = numbered ? std::round(m.extra->fixed_point.number) : 1;
  if (n < 1) return {std::nullopt};
  if (axis.fixed_points.empty()) return {0, false};  // what a run takes
  if (n > static_cast<double>(axis.fixed_points.size())) return {std::nullopt};
  return {axis.fixed_points[static_cast<std::size_t>(n) - 1]};
}

}  // namespace

void convert_reference_moves(Program& program, const LegaliseContext& context) {
  const auto lacks = [&context](MotionKind kind) { return context.target.motions.count(kind) == 0; };
  if (program.dialect == context.target.dialect || context.target.frame_uses.count(FrameUse::machine) == 0 ||
      (!lacks(MotionKind::reference_point) && !lacks(MotionKind::fixed_point)))
    return;
  const FactsOf facts(program, context);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !b->has_motion || !lacks(b->motion.kind)) return;
      const bool reference = b->motion.kind == MotionKind::reference_point;
      if (!reference && b->motion.kind != MotionKind::fixed_point) return;
      const bool metric = setting_in<Units>(*b, facts.before(s), Setting::units) == Units::metric;
      bool said = true;
      for (const auto& c : b->motion.coords) {
        const auto* axis = context.source_machine.axis(c.axis);
        const auto point = axis != nullptr ? point_of(b->motion, *axis) : MachinePoint{};
        if (!point.place || (*point.place != 0 && !metric)) return;  // the writer refuses it
        said = said && point.said;
      }
      for (auto& c : b->motion.coords) {
        c.value = Value{*point_of(b->motion, *context.source_machine.axis(c.axis)).place};
        c.mode = WordMode::absolute;
        c.scale = c.value.is(0) ? WordScale::modal : WordScale::radius;
      }
      b->motion.kind = MotionKind::rapid;
      b->motion.frame = FrameUse::machine;
      b->motion.keeps_modal = false;
      const Span where = word_span(s.line.span, b->motion.code_pos);
      if (reference) {
        context.diagnostics.warning(
            "TRN-328", where,
            "the target has no search of the reference point: a rapid move to its place in machine "
            "coordinates is written, the reference is not taken again",
            "check the place of the reference point in the machine profile");
        return;
      }
      b->motion.extra.reset();
      context.diagnostics.warning(
          "TRN-342", where,
          std::string("the target has no fixed points of the machine: a rapid move to its place in machine coordinates "
                      "is written") +
              (said ? "" : ", and the profile of the source's machine does not give it: 0 is taken"),
          said ? "check \"fixed_points\" of the axes in the profile of the source's machine"
               : "give \"fixed_points\" of the axes in the profile of the source's machine");
    });
  }
}

}  // namespace cnctrans::ir::passes
