// An arc about the pole by a computed angle, several turns or less: how many turns it makes is part of its form on
// every target, so that the angle must be a number.
#include "legaliser/expressions/polar_turns.h"

#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "ir/edit/rewrite.h"
#include "legaliser/analysis/head_constants.h"

namespace cnctrans::ir::passes {

namespace {

const MotionExtra* computed_turns(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  const MotionExtra* x = b != nullptr && b->has_motion ? b->motion.extra.get() : nullptr;
  const bool computed = x != nullptr && x->has_turns && !x->turns.literal() && x->has_polar_angle &&
                        x->polar_angle_mode == WordMode::incremental;
  return computed ? x : nullptr;
}

}  // namespace

void know_polar_turns(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect) return;
  std::optional<HeadConstants> constants;
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      const MotionExtra* x = computed_turns(s);
      if (x == nullptr) return;
      if (!constants) constants.emplace(program);
      std::map<std::string, double> used;
      const auto number_of = [&](const Value& v) {
        const Value folded = constants->fold(v, r, s, &used);
        return folded.literal() ? std::optional(folded.number) : constant_value(folded.expr);
      };
      const auto turns = number_of(x->turns), angle = number_of(x->polar_angle);
      if (!turns || !angle) return;
      auto known = std::make_shared<MotionExtra>(*x);
      known->has_turns = *turns > 0;
      known->turns = Value{*turns};
      known->has_polar_angle = std::fmod(*angle, 360) != 0;  // else it ends where it begins
      known->polar_angle = Value{known->has_polar_angle ? *angle : 0};
      if (!known->has_polar_angle) known->polar_angle_mode = WordMode::modal;
      std::get<Block>(s.node).motion.extra = std::move(known);
      context.diagnostics.warning(
          "TRN-711", s.line.span,
          "the translation holds for " + listed(used) + ": the number of turns of an arc is written, not computed",
          "translate again after changing it");
    });
  }
}

}  // namespace cnctrans::ir::passes
