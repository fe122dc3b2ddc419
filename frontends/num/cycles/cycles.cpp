// Hole cycles G81..G89 (reference 11).
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/saturate.h"
#include "dialects/num/limits.h"
#include "frontends/num/state/actions.h"
#include "frontends/num/state/lower.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;
using slot::e;
using slot::letter;

ir::AxisId Lowering::cycle_axis() {
  if (settings_.lathe) return ir::axis::z;
  return state_.tool_axis != ir::axis::none ? state_.tool_axis : ir::plane_axes(plane()).w;
}

void Lowering::put_cycle(const Word& at, std::shared_ptr<const ir::HoleCycle> cycle, bool here) {
  const auto below = [&cycle](const ir::Level& l) {
    return l.given && l.base == ir::LevelBase::absolute && l.value.literal() && cycle->bottom.value.literal() &&
           l.value.number < cycle->bottom.value.number;
  };
  if (below(cycle->retract) || below(cycle->reference)) {
    report_.warn("NUM-047", at.pos,
                 "a plane of this cycle lies below its depth: the tool goes there in rapid and drills upwards");
  }
  ir::CycleDefine define;
  define.cycle = std::make_shared<const ir::Cycle>(ir::Cycle{*cycle});
  define.here = here;
  ir::Action& action = act(at, Step::special, std::move(define));
  if (&at != marks_.cycle) action.text = {};
  if (&at != marks_.cycle) changed_cycles_[report_.line().line] = state_.cycle.line;
  state_.cycle.words = std::move(cycle);
  state_.cycle.inch = state_.inch;
  state_.cycle.line = report_.line().line;
  state_.cycle_stale.clear();
  if (collects_) cycles_[state_.cycle.line] = state_.cycle;
}

/// ER and EH.
bool Lowering::plane_words(ir::HoleCycle& cycle) {
  for (const int s : {e('R'), e('H')}) {
    if (!has(s)) continue;
    const Word& w = *pending_[static_cast<std::size_t>(s)];
    if (distance_at(w.pos.column) != ir::Distance::incremental) continue;
    report_.refuse("NUM-026", w.pos, "what a plane of a cycle counts from under G91 is not described",
                   "write G90 before it", "cycle.hole");
    return false;
  }
  const auto level = [this](const Word& w) {
    ir::Level l;
    l.value = axis_value(w, cycle_axis());
    l.given = true;
    return l;
  };
  if (const Word* er = use(e('R'))) {
    cycle.retract = level(*er);
    if (!has(e('H')) && !state_.cycle.has_impact_plane) cycle.reference = cycle.retract;
  }
  if (const Word* eh = use(e('H'))) {
    cycle.reference = level(*eh);
    state_.cycle.has_impact_plane = true;
  }
  const bool full = cycle.kind == ir::HoleKind::peck_full;
  cycle.pecks.withdraws_to_retract =
      full && settings_.options.peck_withdraw == dialects::num::PeckWithdraw::er && state_.cycle.has_impact_plane;
  return true;
}

/// Words that all cycles share, into `cycle`; what is not given stays.
bool Lowering::cycle_words(ir::HoleCycle& cycle, int number) {
  if (!plane_words(cycle)) return false;
  if (const Word* ef = use(e('F'))) {
    if (number != 82 && number != 83 && number != 87 && number != 89) {
      report_.refuse("NUM-027", ef->pos, "EF (dwell) in this cycle is not described", {}, "cycle.hole");
      return false;
    }
    (number == 87 ? cycle.pecks.dwell : cycle.dwell_bottom) = value(*ef);
  }
  const Word* p = use(letter('P'));
  const Word* q = use(letter('Q'));
  const Word* ep = use(e('P'));
  const Word* es = use(e('S'));
  const bool pecks = number == 83 || number == 87;
  for (const Word* w : {p, q, ep, es}) {
    if (w != nullptr && !pecks) {
      report_.refuse("NUM-027", w->pos, "`" + std::string(text_of(*w)) + "` belongs to no word of this cycle", {},
                     "cycle.hole");
      return false;
    }
  }
  if (const Word* k = number == 84 ? use(letter('K')) : nullptr) {  // the spindle follows the axis by its pitch
    cycle.kind = ir::HoleKind::tap;
    cycle.rigid = true;
    cycle.pitch = value(*k);
  }
  if (const Word* ek = number == 84 ? use(e('K')) : nullptr) {
    report_.keep("NUM-004", ek->pos,
                 "`" + std::string(text_of(*ek)) + "`: the speed of the way back of a tap is not carried",
                 "cycle.hole");
    return false;
  }
  if (const Word* ec = number == 86 ? use(e('C')) : nullptr) {
    cycle.orient_angle = value(*ec);
    oriented_clearance(cycle);
  }
  if (ep != nullptr) cycle.pecks.reapproach = value(*ep);
  if (es != nullptr) return equal_pecks(cycle, *es, p != nullptr ? p : q);
  if (p == nullptr && q == nullptr) return true;
  if (p == nullptr) {
    report_.refuse("NUM-027", q->pos, "Q (last peck) needs P (first peck)", {}, "cycle.hole");
    return false;
  }
  const bool falling = q != nullptr && (p->is_expression || q->is_expression || p->number != q->number);
  for (const Word* w : {p, q}) {
    if (w == nullptr || w->is_expression || w->number > 0) continue;
    report_.refuse("NUM-027", w->pos, "the size of a peck must be above 0", {}, "cycle.hole");
    return false;
  }
  if (falling && settings_.options.peck_law == dialects::num::PeckLaw::constant) {
    report_.refuse("NUM-027", q->pos,
                   "pecks of one size and a last one of another (num.peck_law = constant) are not carried yet", {},
                   "cycle.hole");
    return false;
  }
  cycle.pecks.law = falling ? ir::PeckLaw::linear : ir::PeckLaw::constant;
  cycle.pecks.first = value(*p);
  if (falling) cycle.pecks.minimum = value(*q);
  return true;
}

/// G86 frees the tip by 2 mm in the direction of the oriented stop, taken as an angle to the abscissa.
void Lowering::oriented_clearance(ir::HoleCycle& cycle) {
  const double length = state_.inch ? facts::oriented_clearance / 25.4 : facts::oriented_clearance;
  const auto part = [&](ir::Function f) {
    if (cycle.orient_angle.literal()) {
      const double angle = cycle.orient_angle.number * std::acos(-1.0) / 180;
      const double x = length * (f == ir::Function::cos ? std::cos(angle) : std::sin(angle));
      return ir::Value(std::round(x * 1e12) / 1e12);
    }
    return ir::Value(ir::binary(ir::BinaryOp::multiply, ir::number(length), ir::call(f, {cycle.orient_angle.expr})));
  };
  cycle.shift_u = part(ir::Function::cos);
  cycle.shift_v = part(ir::Function::sin);
}

/// ES: so many equal pecks between the plane where the feed starts and the bottom.
bool Lowering::equal_pecks(ir::HoleCycle& cycle, const Word& es, const Word* beside) {
  if (beside != nullptr || (!es.is_expression && (es.number < 1 || es.number != std::floor(es.number)))) {
    report_.refuse("NUM-027", (beside != nullptr ? *beside : es).pos,
                   "ES is the number of equal pecks, a whole number without P and Q", {}, "cycle.hole");
    return false;
  }
  if (cycle.reference.base != ir::LevelBase::absolute) {
    report_.refuse("NUM-027", es.pos, "ES needs the plane where the feed starts: the depth of a peck follows from it",
                   "write ER or EH", "cycle.hole");
    return false;
  }
  const ir::Value depth = ir::subtract(cycle.reference.value, cycle.bottom.value), count = value(es);
  cycle.pecks.law = ir::PeckLaw::constant;
  cycle.pecks.first = depth.literal() && count.literal()
                          ? ir::Value(depth.number / count.number)
                          : ir::Value(ir::binary(ir::BinaryOp::divide, ir::as_expr(depth), ir::as_expr(count)));
  return true;
}

/// The coordinate along the tool axis is the bottom and no move.
bool Lowering::cycle_bottom(ir::HoleCycle& cycle, const Word& g) {
  auto& coords = out_->motion.coords;
  for (auto it = coords.begin(); it != coords.end(); ++it) {
    if (it->axis != cycle_axis()) continue;
    cycle.bottom.value = std::move(it->value);
    cycle.bottom.given = true;
    const bool incremental = distance_at(it->pos.column) == ir::Distance::incremental;
    coords.erase(it);
    if (!incremental) return true;
    report_.refuse("NUM-026", g.pos, "what the depth of a cycle counts from under G91 is not described",
                   "write G90 before the depth", "cycle.hole");
    return false;
  }
  report_.refuse("NUM-026", g.pos, "the cycle has no depth (" + std::string(ir::fixed_axis_name(cycle_axis())) + ")");
  return false;
}

void Lowering::define_cycle(const Word& g) {
  const int number = saturate<int>(g.number);
  if (number == 45) return pocket(g);
  if (number == 31) return chased_on_mill(g);
  ir::HoleCycle cycle;
  switch (number) {
    case 81:
    case 82: cycle.kind = ir::HoleKind::drill; break;
    case 83: cycle.kind = ir::HoleKind::peck_full; break;
    case 84: cycle.kind = ir::HoleKind::tap_floating; break;
    case 85:
    case 89: cycle.kind = ir::HoleKind::ream; break;
    case 86: cycle.kind = ir::HoleKind::bore_shift; break;
    case 87: cycle.kind = ir::HoleKind::peck_break; break;
    case 88:  // the spindle turns on while the operator looks at the hole
      cycle.kind = ir::HoleKind::bore_manual;
      cycle.spindle_bottom = ir::SpindleStep::none;
      break;
    default:
      report_.refuse("NUM-004", g.pos,
                     "`" + std::string(text_of(g)) + "`: the sequence of this cycle is not carried yet", {},
                     "cycle.hole");
      return;
  }
  if (marks_.motion && out_->motion.kind != ir::MotionKind::rapid) {
    report_.refuse("NUM-026", out_->motion.code_pos,
                   "a cycle positions in rapid: this motion function can't stand beside it");
    return;
  }
  if (settings_.lathe || state_.tool_axis != ir::axis::none) cycle.axis = cycle_axis();
  if (number == 83) cycle.pecks.reapproach = ir::Value(state_.inch ? facts::reapproach / 25.4 : facts::reapproach);
  if (number == 86) oriented_clearance(cycle);
  cycle.approach_by_retract = true;
  if (!cycle_bottom(cycle, g)) return;
  // Without ER the tool goes back to the height from which the cycle was called.
  cycle.retract = cycle.reference =
      ir::Level{ir::Value(0), ir::LevelBase::from_initial, ir::LevelBase::from_initial, true};
  state_.cycle.has_impact_plane = false;
  if (!cycle_words(cycle, number)) return;
  const bool pecks = cycle.kind == ir::HoleKind::peck_full || cycle.kind == ir::HoleKind::peck_break;
  if (pecks && cycle.pecks.law == ir::PeckLaw::none) cycle.kind = ir::HoleKind::drill;
  state_.cycle.code = number;
  out_->has_motion = out_->has_motion || !out_->motion.coords.empty();
  put_cycle(g, std::make_shared<const ir::HoleCycle>(std::move(cycle)), true);
}

bool Lowering::moves_cycle_axis() {
  for (const auto& c : out_->motion.coords) {
    if (c.axis == cycle_axis()) return true;
  }
  return false;
}

/// A word of the tool axis while a cycle is active.
bool Lowering::refuses_new_depth() {
  for (const auto& c : out_->motion.coords) {
    if (c.axis != cycle_axis()) continue;
    report_.refuse("NUM-026", c.pos, "the depth of a cycle can't be changed while it is active",
                   "write the cycle again");
    return true;
  }
  return false;
}

namespace {

/// The words of a cycle in another unit.
void rescale(ir::HoleCycle& cycle, double factor) {
  for (ir::Value* v : {&cycle.retract.value, &cycle.reference.value, &cycle.bottom.value, &cycle.pecks.first,
                       &cycle.pecks.minimum, &cycle.pecks.reapproach, &cycle.shift_u, &cycle.shift_v, &cycle.pitch}) {
    if (v->is(0)) continue;
    *v = v->literal() ? ir::Value(std::round(v->number * factor * 1e12) / 1e12) : ir::scale(*v, factor);
  }
}

}  // namespace

/// The words that a block with ER, EH, P .. leaves alone keep their values: they are read when the cycle is defined.
bool Lowering::refuses_stale_words(const ir::HoleCycle& before, const Word& at) {
  const bool plane = has(e('R')), impact = has(e('H')) || (plane && !state_.cycle.has_impact_plane);
  const bool pecks = has(letter('P')) || has(letter('Q')) || has(e('S'));
  const std::pair<const ir::Value*, bool> words[] = {
      {&before.bottom.value, false},       {&before.retract.value, plane},     {&before.reference.value, impact},
      {&before.pecks.first, pecks},        {&before.pecks.minimum, pecks},     {&before.pecks.reapproach, has(e('P'))},
      {&before.dwell_bottom, has(e('F'))}, {&before.pecks.dwell, has(e('F'))}, {&before.orient_angle, false}};
  for (const auto& [word, anew] : words) {
    if (anew || word->literal()) continue;
    const auto& changed = state_.cycle_stale;
    if (std::none_of(changed.begin(), changed.end(),
                     [w = word](const auto& v) { return ir::passes::reads(w->expr, v); }))
      continue;
    report_.refuse("NUM-026", at.pos,
                   "the other words of the cycle keep the values of its definition, and a variable that they read has "
                   "changed since",
                   "write the cycle again");
    return true;
  }
  return false;
}

void Lowering::note_assigned(const std::vector<ir::Assign::Item>& items) {
  if (!state_.cycle.words) return;
  for (const auto& item : items) {
    if (!item.to_system) state_.cycle_stale.push_back(item.target);
  }
}

/// ER, EH, P, Q ... while a cycle is active.
void Lowering::change_cycle() {
  ir::HoleCycle cycle = *state_.cycle.words;
  uses(Modal::unit);
  if (state_.cycle.inch != state_.inch) rescale(cycle, state_.cycle.inch ? 25.4 : 1 / 25.4);
  const Word* at = nullptr;
  for (const int s : {e('R'), e('H'), e('F'), e('P'), e('S'), letter('P'), letter('Q')}) {
    if (at == nullptr && has(s)) at = pending_[static_cast<std::size_t>(s)];
  }
  if (refuses_new_depth()) return;
  if (state_.cycle.code == 45 || state_.cycle.code == 31) {
    report_.refuse("NUM-026", at->pos, "the words of a pocket or of G31 can't be changed while it is active",
                   "write the cycle again");
    return;
  }
  if (refuses_stale_words(cycle, *at)) return;
  const bool plane_given = has(e('R'));
  const bool to_plane = plane_given && out_->motion.coords.empty();
  if (!cycle_words(cycle, state_.cycle.code)) return;
  if (cycle.pecks.law != ir::PeckLaw::none) {
    cycle.kind = state_.cycle.code == 83 ? ir::HoleKind::peck_full : ir::HoleKind::peck_break;
  }
  if (to_plane) {
    // The block goes to the plane at once and drills nothing.
    auto& m = out_->motion;
    m.kind = ir::MotionKind::rapid;
    m.keeps_modal = false;
    auto& c = m.coords.emplace_back();
    c.axis = cycle_axis();
    c.mode = ir::WordMode::absolute;
    c.value = cycle.retract.value;
    c.pos = at->pos;
    out_->has_motion = true;
  } else {
    out_->has_motion = out_->has_motion || !out_->motion.coords.empty();
  }
  put_cycle(*at, std::make_shared<const ir::HoleCycle>(std::move(cycle)), !out_->motion.coords.empty() && !to_plane);
}

}  // namespace cnctrans::frontends::num
