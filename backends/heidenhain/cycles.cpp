#include "backends/heidenhain/cycles.h"

#include <cmath>

#include "dialects/heidenhain/limits.h"

namespace cnctrans::backends::heidenhain {

namespace facts = dialects::heidenhain;
using ir::HoleCycle;
using ir::HoleKind;
using ir::Level;
using ir::LevelBase;
using ir::SpindleStep;
using ir::Value;

namespace {

constexpr double tiny = 1e-9;

/// A number, or a parameter with its sign: what stands behind Q200=.
bool sayable(const Value& v) {
  if (v.literal()) return true;
  const auto* u = std::get_if<ir::Unary>(&v.expr->node);
  const ir::ExprPtr& e = u != nullptr && u->op == ir::UnaryOp::negate ? u->operand : v.expr;
  return std::holds_alternative<ir::VarRef>(e->node);
}

class HoleText {
 public:
  HoleText(const HoleCycle& c, const Value& feed) : c_(c), feed_(feed) {}

  std::optional<CycleText> text() {
    if (!c_.has_feed && !feed_.literal()) return std::nullopt;
    if (c_.has_feed_out && !c_.feed_out.literal()) return std::nullopt;  // Q208=0 is the feed of Q206
    if (c_.axis != ir::axis::none && c_.axis != ir::axis::z) return std::nullopt;
    if (c_.keeps_initial || c_.reference_may_be_below || c_.approach_by_retract || c_.dwell_in_revolutions)
      return std::nullopt;
    // A speed of its own is said before the tap, and the one before comes back behind it.
    const bool one_speed = !c_.has_speed_out || (c_.has_speed && ir::equal(c_.speed, c_.speed_out));
    if ((c_.has_speed || c_.has_speed_out) && (c_.kind != HoleKind::tap || !c_.speed.literal() || !one_speed))
      return std::nullopt;
    const int number = cycle();
    if (number == 0 || !levels()) return std::nullopt;
    text_.row = facts::find_cycle(number);
    for (const auto& [q, v] : text_.values) {
      const bool unused = q == 202 && c_.kind == HoleKind::mill;
      if ((facts::find_parameter(*text_.row, q) == nullptr && !unused) || !sayable(v)) return std::nullopt;
    }
    return text_;
  }

 private:
  void q(std::int16_t number, Value v) { text_.values[number] = std::move(v); }
  [[nodiscard]] bool seconds(const Value& v, std::int16_t number) {
    q(number, c_.dwell_scale == 1 ? v : ir::scale(v, c_.dwell_scale));
    return v.literal() || c_.dwell_scale == 1;
  }
  void feed_in() { q(206, c_.has_feed ? c_.feed : feed_); }
  void feed_out() { q(208, c_.has_feed_out ? c_.feed_out : Value(0)); }

  [[nodiscard]] bool pecks_from_reference() const {
    const bool pecks = c_.kind == HoleKind::peck_full || c_.kind == HoleKind::peck_break ||
                       (c_.kind == HoleKind::tap && c_.pecks.law != ir::PeckLaw::none);
    return pecks && !c_.pecks.first_from_surface;
  }

  /// Q203, Q200, Q201, Q204. Without a surface it is the reference plane, but for the usual one a little above zero.
  bool levels() {
    const Level &r = c_.reference, &b = c_.bottom, &t = c_.retract;
    if (!r.given || !b.given || !t.given) return false;
    Value surface, clearance;
    const bool number = r.base == LevelBase::absolute && r.value.literal();
    if (c_.surface.given && !pecks_from_reference()) {
      if (c_.surface.base != LevelBase::absolute) return false;
      surface = c_.surface.value;
      clearance = r.base == LevelBase::from_surface ? r.value : ir::subtract(r.value, surface);
      if (r.base != LevelBase::absolute && r.base != LevelBase::from_surface) return false;
    } else if (number) {
      const bool usual = !pecks_from_reference() && r.value.number > 0 && r.value.number <= 10 && b.value.literal() &&
                         b.base == LevelBase::absolute && b.value.number < 0;
      surface = usual ? Value(0) : r.value;
      clearance = usual ? r.value : Value(0);
    } else {
      return false;
    }
    const auto above = [&](const Level& l) -> std::optional<Value> {
      if (l.base == LevelBase::from_surface && c_.surface.given && ir::equal(surface, c_.surface.value)) return l.value;
      if (l.base == LevelBase::from_reference && clearance.is(0)) return l.value;
      if (l.base != LevelBase::absolute) return std::nullopt;
      return ir::subtract(l.value, surface);
    };
    const auto depth = above(b), second = above(t);
    if (!depth || !second || !clearance.literal() || clearance.number < 0) return false;
    if (!depth->literal() || depth->number > -tiny) return false;
    if (!second->literal() || second->number < clearance.number - tiny) return false;
    q(203, surface);
    q(200, clearance);
    q(201, *depth);
    q(204, *second);
    depth_ = -depth->number;
    return pecks();
  }

  /// What the size of a peck has to do with the depth and the clearance.
  bool pecks() {
    const auto infeed = text_.values.find(202);  // of a pocket: none is one in the IR
    const bool whole = c_.kind == HoleKind::mill && (infeed == text_.values.end() || infeed->second.is(0));
    if (one_stroke_ || whole) q(202, Value(depth_));
    const ir::Pecks& p = c_.pecks;
    if (c_.kind == HoleKind::peck_full) {
      const bool own = p.reapproach.literal() && std::fabs(p.reapproach.number - text_.values[200].number) < tiny;
      if (!own && number_ == 200) return false;
    }
    if (c_.kind == HoleKind::peck_break) {
      if (!peck_.literal() || peck_.number <= 0) return false;
      q(213, Value(std::max(1.0, std::ceil(depth_ / peck_.number - tiny) - 1)));
    }
    return true;
  }

  /// Equal pecks; the last may be smaller.
  [[nodiscard]] bool constant_pecks() {
    const ir::Pecks& p = c_.pecks;
    const bool plain = !p.reapproach_automatic && !p.withdraws_to_retract && p.dwell.is(0) && !p.lift_rapid &&
                       (!p.has_first_feed_factor || p.first_feed_factor.is(1));
    peck_ = p.first;
    if (p.first_to.given && !first_peck_to(p.first_to)) return false;
    if (!plain || peck_.is(0)) return false;
    if (p.law == ir::PeckLaw::constant) return true;
    // A remainder would be shared between the last two.
    const auto top = peck_start(), bottom = absolute(c_.bottom);
    if (p.law != ir::PeckLaw::balanced || !p.degression.is(0) || !peck_.literal() || !top || !bottom) return false;
    const double pecks = (*top - *bottom) / peck_.number;
    return std::fabs(pecks - std::round(pecks)) < tiny;
  }
  /// Levels as numbers.
  [[nodiscard]] std::optional<double> absolute(const Level& l) const {
    if (!l.given || !l.value.literal()) return std::nullopt;
    if (l.base == LevelBase::absolute) return l.value.number;
    const auto surface = l.base == LevelBase::from_surface ? absolute(c_.surface) : std::nullopt;
    return surface ? std::optional(*surface + l.value.number) : std::nullopt;
  }
  [[nodiscard]] std::optional<double> peck_start() const {
    return absolute(pecks_from_reference() ? c_.reference : c_.surface);
  }
  bool first_peck_to(const Level& l) {
    const auto top = peck_start(), to = absolute(l);
    if (!top || !to) return false;
    peck_ = Value(*top - *to);
    return peck_.number > tiny;
  }
  [[nodiscard]] bool usual_spindle() const {
    return c_.spindle_before == SpindleStep::usual && c_.spindle_bottom == SpindleStep::usual &&
           c_.spindle_after == SpindleStep::usual && !c_.orient_first && !c_.spindle_after_retract;
  }
  [[nodiscard]] bool quiet_spindle() const {
    const auto quiet = [](SpindleStep s) { return s == SpindleStep::usual || s == SpindleStep::none; };
    return quiet(c_.spindle_before) && quiet(c_.spindle_bottom) && quiet(c_.spindle_after) && !c_.orient_first;
  }

  /// The number of the cycle and its own parameters; 0: the control has none.
  int cycle() {
    number_ = number();
    return number_;
  }
  int number() {
    switch (c_.kind) {
      case HoleKind::drill:
        if (!quiet_spindle() || c_.has_feed_out || !seconds(c_.dwell_bottom, 211)) return 0;
        one_stroke_ = true;
        feed_in();
        q(210, Value(0));
        return 200;
      case HoleKind::peck_full: return peck_full();
      case HoleKind::peck_break:
        if (!quiet_spindle() || c_.has_feed_out || !constant_pecks() || !c_.dwell_top.is(0)) return 0;
        if (!c_.pecks.lift.literal() || c_.pecks.lift.number <= 0 || !seconds(c_.dwell_bottom, 211)) return 0;
        feed_in();
        q(202, peck_);
        q(256, c_.pecks.lift);
        q(208, Value(facts::rapid_stand_in));
        q(210, Value(0));
        q(212, Value(0));
        q(205, Value(0));
        return 203;
      case HoleKind::ream:
      case HoleKind::bore:
        if (!quiet_spindle() || !seconds(c_.dwell_bottom, 211)) return 0;
        feed_in();
        feed_out();
        return 201;
      case HoleKind::bore_shift: return bore();
      case HoleKind::tap: return tap();
      case HoleKind::tap_floating:
        if (!usual_spindle() || c_.has_feed_out || c_.pecks.law != ir::PeckLaw::none || c_.rigid || !c_.pitch.is(0) ||
            !seconds(c_.dwell_bottom, 211))
          return 0;
        feed_in();
        return 206;
      case HoleKind::mill: return mill_text(c_, text_.values);
      default: return 0;
    }
  }
  int peck_full() {
    if (!quiet_spindle() || c_.has_feed_out || !constant_pecks() || !seconds(c_.dwell_bottom, 211)) return 0;
    feed_in();
    q(202, peck_);
    const Level &r = c_.reference, &s = c_.surface;
    std::optional<double> clearance;
    if (pecks_from_reference()) clearance = 0;
    if (!clearance && s.given && r.base == LevelBase::from_surface && r.value.literal()) clearance = r.value.number;
    if (!clearance && s.given && r.base == LevelBase::absolute && r.value.literal() && s.value.literal())
      clearance = r.value.number - s.value.number;
    const Value& again = c_.pecks.reapproach;
    if (clearance && again.literal() && std::fabs(again.number - *clearance) < tiny) {
      if (!seconds(c_.dwell_top, 210)) return 0;
      return 200;
    }
    if (!c_.dwell_top.is(0)) return 0;
    q(258, again);
    q(259, again);
    q(208, Value(facts::rapid_stand_in));
    for (const std::int16_t none : {212, 205, 257, 379}) q(none, Value(0));
    return 205;
  }
  /// Freed by 0.2 mm along one axis.
  int bore() {
    if (!usual_spindle() || c_.has_feed_out || !c_.shift_w.is(0) || !seconds(c_.dwell_bottom, 211)) return 0;
    if (!c_.shift_u.literal() || !c_.shift_v.literal()) return 0;
    const double u = c_.shift_u.number, v = c_.shift_v.number, d = facts::freed_distance;
    const auto is = [](double a, double b) { return std::fabs(a - b) < tiny; };
    const int side = is(u, -d) && is(v, 0)   ? 1
                     : is(u, 0) && is(v, -d) ? 2
                     : is(u, d) && is(v, 0)  ? 3
                     : is(u, 0) && is(v, d)  ? 4
                                             : 0;
    if (side == 0) return 0;
    feed_in();
    q(208, Value(facts::rapid_stand_in));
    q(214, Value(side));
    q(336, c_.orient_angle);
    return 202;
  }
  int tap() {
    const bool ends = c_.spindle_after == SpindleStep::off || c_.spindle_after == SpindleStep::cw ||
                      c_.spindle_after == SpindleStep::ccw;
    if (!ends || c_.spindle_before != SpindleStep::usual || !c_.dwell_bottom.is(0) || c_.pitch.is(0)) return 0;
    if (c_.spindle_bottom != SpindleStep::usual && c_.spindle_bottom != SpindleStep::none) return 0;
    q(239, c_.pitch);
    if (!c_.orient_first && c_.pecks.law == ir::PeckLaw::none) return 207;
    const ir::Pecks& p = c_.pecks;
    q(336, c_.orient_angle);
    q(403, Value(1));
    if (p.law == ir::PeckLaw::none) {
      q(257, Value(0));
      q(256, Value(0));
      return 209;
    }
    if (p.law != ir::PeckLaw::constant || !p.first_from_surface || !p.lift.literal() || !c_.pitch.literal()) return 0;
    q(257, p.first);
    q(256, Value(p.lift.number / std::fabs(c_.pitch.number)));
    return 209;
  }

  const HoleCycle& c_;
  const Value& feed_;
  CycleText text_;
  Value peck_;
  int number_ = 0;
  bool one_stroke_ = false;
  double depth_ = 0;
};

}  // namespace

std::optional<CycleText> cycle_text(const HoleCycle& cycle, const Value& feed) {
  return HoleText(cycle, feed).text();
}

bool native_cycle(const ir::Cycle& cycle) {
  const auto* hole = std::get_if<HoleCycle>(&cycle.node);
  return hole != nullptr && cycle_text(*hole, Value(1.0)).has_value();
}

int spindle_after(const HoleCycle& cycle) {
  if (cycle.kind != HoleKind::tap) return 0;
  return cycle.spindle_after == SpindleStep::cw ? 3 : cycle.spindle_after == SpindleStep::ccw ? 4 : 0;
}

}  // namespace cnctrans::backends::heidenhain
