// What holds at a line: by the lines above it, and by the ways of the program where they bring something else.
#include "frontends/num/state/lower.h"

namespace cnctrans::frontends::num {

void Lowering::arrive(std::uint32_t line) {
  state_.several_cycles = false;
  const auto at = arrivals_->find(line);
  if (at == arrivals_->end()) return;
  const Arrival& a = at->second;
  state_.known = state_.main || (a.plane && a.distance && a.motion);
  state_.plane = a.plane.value_or(state_.plane);
  state_.distance = a.distance.value_or(state_.distance);
  state_.motion = a.motion.value_or(state_.motion);
  state_.inch = a.inch.value_or(state_.inch);
  state_.several_cycles = a.several_cycles;
  if (!a.cycle_line || *a.cycle_line == state_.cycle.line) return;
  if (*a.cycle_line == 0) {
    state_.cycle = {};
    return;
  }
  // A cycle further down in the text stands in the reading before this one.
  const auto here = cycles_.find(*a.cycle_line);
  const auto before = earlier_cycles_.find(*a.cycle_line);
  if (here == cycles_.end() && before == earlier_cycles_.end()) return;
  state_.cycle = here != cycles_.end() ? here->second : before->second;
  state_.cycle_stale.clear();  // what was written meanwhile is judged by the ways too
}

void Lowering::uses(Modal fact) {
  const bool own = (fact == Modal::plane && marks_.plane) || (fact == Modal::motion && marks_.motion) ||
                   (fact == Modal::unit && marks_.unit) || (fact == Modal::cycle && marks_.cycle_off);
  if (!collects_ || own) return;
  const Span& line = report_.line();
  if (uses_.empty() || uses_.back().where.line != line.line) {
    ModalUse& use = uses_.emplace_back();
    use.where = line;
    use.taken.plane = state_.plane;
    use.taken.distance = marks_.distance_before;
    use.taken.motion = state_.motion;
    use.taken.inch = state_.inch;
    use.taken.cycle_line = state_.cycle.line;
    use.taken.several_cycles = state_.several_cycles;
  }
  uses_.back().facts |= static_cast<std::uint8_t>(fact);
}

ir::Plane Lowering::plane() {
  uses(Modal::plane);
  return state_.plane;
}

}  // namespace cnctrans::frontends::num
