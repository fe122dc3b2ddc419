// G45, simple pockets (reference 11.6).
#include <memory>
#include <utility>

#include "dialects/num/milling.h"
#include "frontends/num/state/actions.h"
#include "frontends/num/state/lower.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;
using slot::e;
using slot::letter;

/// ER retract plane, EH surface; the feed starts a little above the surface.
bool Lowering::pocket_levels(ir::HoleCycle& cycle) {
  const auto at_call = ir::Level{ir::Value(0), ir::LevelBase::from_initial, ir::LevelBase::from_initial, true};
  const Word *er = use(e('R')), *eh = use(e('H'));
  for (const Word* w : {er, eh}) {
    if (w == nullptr || distance_at(w->pos.column) != ir::Distance::incremental) continue;
    report_.refuse("NUM-026", w->pos, "what a plane of a cycle counts from under G91 is not described",
                   "write G90 before it", "cycle.milling");
    return false;
  }
  const auto level = [this](const Word& w) {
    return ir::Level{axis_value(w, cycle_axis()), ir::LevelBase::absolute, ir::LevelBase::absolute, true};
  };
  cycle.retract = cycle.reference = er != nullptr ? level(*er) : at_call;
  if (eh == nullptr) return true;
  cycle.surface = level(*eh);
  const bool upward = cycle.surface.value.literal() && cycle.bottom.value.literal() &&
                      cycle.surface.value.number < cycle.bottom.value.number;
  const double clearance = (upward ? -1 : 1) * (state_.inch ? facts::pocket_clearance / 25.4 : facts::pocket_clearance);
  cycle.reference = ir::Level{ir::Value(clearance), ir::LevelBase::from_surface, ir::LevelBase::from_surface, true};
  return true;
}

void Lowering::pocket(const Word& g) {
  ir::HoleCycle cycle;
  cycle.kind = ir::HoleKind::mill;
  if (marks_.motion && out_->motion.kind != ir::MotionKind::rapid) {
    report_.refuse("NUM-026", out_->motion.code_pos,
                   "a cycle positions in rapid: this motion function can't stand beside it");
    return;
  }
  if (!cycle_bottom(cycle, g) || !pocket_levels(cycle)) return;
  const bool sides = has(e('X')) || has(e('Y'));
  if ((sides && !(has(e('X')) && has(e('Y')))) || (!sides && !has(e('B')))) {
    report_.refuse("NUM-027", g.pos, "a pocket needs its two sides EX and EY, or the radius EB of a circle", {},
                   "cycle.milling");
    return;
  }
  cycle.mill.shape = std::string(sides ? facts::rectangle : facts::circle);
  for (const auto& row : facts::pocket_words) {
    const Word* w = use(row.e ? e(row.letter) : letter(row.letter));
    if (w == nullptr) continue;
    if (!w->is_expression && w->number < 0) {
      report_.refuse("NUM-027", w->pos, "the words of a pocket are not negative", {}, "cycle.milling");
      return;
    }
    const bool radius = !sides && row.parameter == "corner";
    cycle.mill.words.emplace_back(radius ? "radius" : std::string(row.parameter), value(*w));
  }
  state_.cycle.code = 45;
  out_->has_motion = out_->has_motion || !out_->motion.coords.empty();
  put_cycle(g, std::make_shared<const ir::HoleCycle>(std::move(cycle)), true);
}

}  // namespace cnctrans::frontends::num
