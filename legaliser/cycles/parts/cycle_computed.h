// Hole cycles whose words only the run knows, written out: the moves of ir/cycles/expand.cpp with expressions for
// numbers, and a loop over the pecks. The variables of the loop are the distance to the bottom and the peck.
#pragma once

#include <cmath>
#include <utility>

#include "legaliser/cycles/parts/cycle_parts.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

/// A rest of a peck below this (mm) belongs to the peck before it.
inline constexpr double least_rest = 1e-4;

inline bool zero_value(const Value& v) {
  return v.is(0);
}
inline Value binary_value(BinaryOp op, const Value& a, const Value& b) {
  return Value(binary(op, as_expr(a), as_expr(b)));
}
inline Value product(const Value& a, const Value& b) {
  if (a.literal()) return b.is(1) ? a : ir::scale(b, a.number);
  return b.literal() ? ir::scale(a, b.number) : binary_value(BinaryOp::multiply, a, b);
}
/// As product, and 0 where a factor is 0.
inline Value times(const Value& a, const Value& b) {
  return a.is(0) || b.is(0) ? Value(0.0) : product(a, b);
}
inline Value root(const Value& v) {
  return v.literal() ? Value(std::sqrt(v.number)) : Value(call(Function::sqrt, {v.expr}));
}
inline Value quotient(const Value& a, const Value& b) {
  return a.literal() && b.literal() ? Value(a.number / b.number) : binary_value(BinaryOp::divide, a, b);
}
/// a - b, and a + c when b is -c.
inline Value difference(const Value& a, const Value& b) {
  const auto* u = b.literal() ? nullptr : std::get_if<Unary>(&b.expr->node);
  return u != nullptr && u->op == UnaryOp::negate ? add(a, Value(u->operand)) : subtract(a, b);
}
inline ExprPtr more(const Value& a, const Value& b) {
  return binary(BinaryOp::gt, as_expr(a), as_expr(b));
}

class ComputedHole {
 public:
  ComputedHole(const HoleCycle& c, const LineInfo& like, const Block& b, const Facts& facts, const FeedBefore& feed,
               std::optional<double> initial, std::optional<SpindleState> sense, Editor& editor)
      : c_(c), b_(b), facts_(facts), feed_(feed), sense_(sense), editor_(editor), initial_(initial) {
    like_.span = like.span;
    like_.skip_mask = like.skip_mask;
  }
  ~ComputedHole() {
    for (const auto& v : taken_) editor_.release(v);
  }
  ComputedHole(const ComputedHole&) = delete;
  ComputedHole& operator=(const ComputedHole&) = delete;

  std::optional<Explosion> run() {
    if (!circumstances() || !planes()) return std::nullopt;
    if (c_.approach_by_retract && c_.retract.given) rapid(retract_);
    rapid(reference_);
    turn(c_.spindle_before, std::nullopt);
    strokes();
    if (!c_.spindle_after_retract) restore();
    leave();
    if (c_.spindle_after_retract) restore();
    if (feed_changed_ && !feed_.none) feed_word(usual_feed());
    if (!error.empty()) return std::nullopt;
    Explosion made{std::move(out_), std::nullopt};
    if (retract_.literal()) made.end_height = retract_.number * unit_;
    return made;
  }
  [[nodiscard]] bool taken_downward() const { return taken_downward_; }
  std::string error;

 private:
  bool fail(std::string text) {
    if (error.empty()) error = std::move(text);
    return false;
  }

  // --- levels ---------------------------------------------------------------------------------------------------

  bool circumstances() {
    const auto axis = cycle_axis(c_, b_, facts_);
    const auto units = setting_in<Units>(b_, facts_, Setting::units);
    const auto distance = setting_in<Distance>(b_, facts_, Setting::distance);
    const auto plane = setting_in<Plane>(b_, facts_, Setting::plane);
    if (!axis || !units || !distance || !plane)
      return fail("plane, units or absolute and incremental are not known here");
    axis_ = *axis;
    unit_ = *units == Units::inch ? 25.4 : 1;
    distance_ = *distance;
    plane_ = *plane;
    tiny_ = Value(least_rest / unit_);
    return true;
  }

  Value start() {
    if (!initial_) fail("the height of the tool before it is not known here");
    return Value(initial_.value_or(0) / unit_);
  }
  Value level(const Level& l, const Level* surface, bool from_reference) {
    auto base = l.base;
    if (base == LevelBase::distance_mode) base = distance_ == Distance::absolute ? LevelBase::absolute : l.otherwise;
    switch (base) {
      case LevelBase::from_initial: return above(start(), l.value);
      case LevelBase::from_reference: return above(from_reference ? reference_ : start(), l.value);
      case LevelBase::from_surface: return above(surface != nullptr ? surface_ : start(), l.value);
      default: break;
    }
    Value v = l.value;
    v.text = {};
    return v;
  }
  static Value above(const Value& base, const Value& by) { return zero_value(by) ? base : add(base, by); }

  bool planes() {
    if (c_.surface.given && c_.surface.base == LevelBase::from_reference) {
      reference_ = c_.reference.given ? level(c_.reference, nullptr, false) : start();
      surface_ = level(c_.surface, nullptr, true);
    } else {
      if (c_.surface.given) surface_ = level(c_.surface, nullptr, false);
      reference_ = c_.reference.given ? level(c_.reference, c_.surface.given ? &c_.surface : nullptr, false) : start();
      if (!c_.surface.given) surface_ = reference_;
    }
    reference_ = kept(reference_);
    if (c_.bottom.given) {
      bottom_ = kept(level(c_.bottom, &c_.surface, true));
    } else if (c_.pecks.law == PeckLaw::count) {
      bottom_ = kept(add(reference_, product(c_.pecks.first, c_.pecks.count)));
    } else {
      return fail("it has no final depth");
    }
    if (c_.retract.given) {
      retract_ = level(c_.retract, &c_.surface, true);
    } else {
      const auto plane = setting_in<RetractPlane>(b_, facts_, Setting::retract_plane).value_or(RetractPlane::initial);
      retract_ = plane == RetractPlane::initial ? start() : reference_;
    }
    return error.empty();
  }

  // --- variables ------------------------------------------------------------------------------------------------

  /// A word can hold it: a number, a variable, or one with a sign.
  static bool simple(const Value& v) {
    if (v.literal() || is_primary(v.expr)) return true;
    const auto* u = std::get_if<Unary>(&v.expr->node);
    return u != nullptr && u->op == UnaryOp::negate && is_primary(u->operand);
  }
  std::optional<VarRef> variable_of(const Value& v) {
    const auto var = editor_.take(like_);
    if (!var) {
      fail("there are no variables left to compute its pecks");
      return std::nullopt;
    }
    taken_.push_back(*var);
    set(*var, v);
    return var;
  }
  void set(const VarRef& v, const Value& value) { body().push_back(make_assign(like_, v, as_expr(value))); }
  static Value value_of(const VarRef& v) { return Value(variable(v)); }
  /// The value under a name of its own when it has to be computed.
  Value kept(const Value& v) {
    if (simple(v)) return v;
    const auto var = variable_of(v);
    return var ? value_of(*var) : v;
  }
  void when(ExprPtr condition, const VarRef& v, const Value& value) {
    If node;
    node.condition = std::move(condition);
    node.then_body.push_back(make_assign(like_, v, as_expr(value)));
    body().push_back(made(like_, std::move(node)));
  }

  // --- moves ----------------------------------------------------------------------------------------------------

  Body& body() { return loop_ != nullptr ? *loop_ : out_; }
  Block move(MotionKind kind, const Value& to) const { return straight_move(kind, axis_, to); }
  void rapid(const Value& to) { body().push_back(made(like_, move(MotionKind::rapid, to))); }
  void feed(const Value& to) {
    Block b = move(MotionKind::linear, to);
    if (c_.has_feed && !feed_changed_) b.actions.push_back(action(SetFeed{c_.feed, false}));
    feed_changed_ = feed_changed_ || c_.has_feed;
    body().push_back(made(like_, std::move(b)));
  }
  void feed_out(const Value& to) {
    Block b = move(MotionKind::linear, to);
    if (c_.has_feed_out) {
      b.actions.push_back(action(SetFeed{c_.feed_out, false}));
      feed_changed_ = true;
    }
    body().push_back(made(like_, std::move(b)));
  }
  void feed_word(const Value& f) { body().push_back(make_block(like_, action(SetFeed{f, false}))); }
  Value usual_feed() {
    const auto word = feed_.word();
    if (!word) fail("the feed after the cycle's own one is not known here");
    return word.value_or(Value(0.0));
  }
  void dwell(const Value& v) {
    if (zero_value(v)) return;
    body().push_back(make_block(like_, action(Dwell{v, c_.dwell_scale, c_.dwell_in_revolutions})));
  }
  void run_spindle(SpindleState s) { body().push_back(make_block(like_, action(SpindleRun{1, s}))); }
  void turn(SpindleStep step, std::optional<cycles::CycleStep> usual) {
    switch (step) {
      case SpindleStep::none: return;
      case SpindleStep::cw: return run_spindle(SpindleState::cw);
      case SpindleStep::ccw: return run_spindle(SpindleState::ccw);
      case SpindleStep::off: return run_spindle(SpindleState::off);
      case SpindleStep::usual: break;
    }
    if (!usual) return;
    if (*usual == cycles::CycleStep::spindle_stop) return run_spindle(SpindleState::off);
    if (!sense_) fail("the sense of the spindle before the cycle is not known here");
    if (sense_ == SpindleState::off && c_.kind != HoleKind::bore_shift) return;  // goes on standing
    run_spindle(sense_.value_or(SpindleState::cw));
  }
  void restore() {
    const bool switches = c_.kind == HoleKind::bore_shift || c_.kind == HoleKind::bore_stop;
    turn(c_.spindle_after, switches ? std::optional(cycles::CycleStep::spindle_restore) : std::nullopt);
  }

  // --- the strokes ----------------------------------------------------------------------------------------------

  void strokes() {
    switch (c_.kind) {
      case HoleKind::drill:
        first_feed();
        feed(bottom_);
        return dwell(c_.dwell_bottom);
      case HoleKind::peck_full:
      case HoleKind::peck_break: return pecks();
      case HoleKind::ream:
      case HoleKind::bore:
        feed(bottom_);
        dwell(c_.dwell_bottom);
        return feed_out(reference_);
      case HoleKind::bore_stop:
      case HoleKind::bore_manual:
        feed(bottom_);
        dwell(c_.dwell_bottom);
        turn(c_.spindle_bottom, cycles::CycleStep::spindle_stop);
        if (c_.kind == HoleKind::bore_manual) body().push_back(make_block(like_, action(Stop{}, Order::after)));
        if (c_.kind == HoleKind::bore_stop) rapid(retract_);
        return;
      case HoleKind::bore_shift: return shifted();
      case HoleKind::tap:
      case HoleKind::tap_floating: fail("the strokes of a tap can't be written out"); return;
      default: fail("cycles of this kind are not carried yet"); return;
    }
  }
  void sideways(Block& b, bool back) const {
    const auto axes = plane_axes(plane_);
    for (const auto& [axis, by] : {std::pair(axes.u, c_.shift_u), std::pair(axes.v, c_.shift_v)}) {
      if (zero_value(by)) continue;
      CoordWord w;
      w.axis = axis;
      w.mode = WordMode::incremental;
      w.value = back ? negate(by) : by;
      b.motion.coords.push_back(w);
    }
  }
  void shifted() {
    feed(bottom_);
    dwell(c_.dwell_bottom);
    body().push_back(make_block(like_, action(SpindleOrient{1, c_.orient_angle})));
    Block aside = move(MotionKind::rapid, add(bottom_, c_.shift_w));
    if (zero_value(c_.shift_w)) aside.motion.coords.clear();
    sideways(aside, false);
    if (!aside.motion.coords.empty()) body().push_back(made(like_, std::move(aside)));
    if (c_.has_feed_out) {
      feed_out(reference_);
      if (!equal(retract_, reference_)) rapid(retract_);
    } else {
      rapid(reference_);
    }
    Block out = move(MotionKind::rapid, retract_);
    if (c_.has_feed_out || equal(retract_, reference_)) out.motion.coords.clear();
    sideways(out, true);
    if (!out.motion.coords.empty()) body().push_back(made(like_, std::move(out)));
  }
  /// Some are out already, before the spindle turns again.
  void leave() {
    if (c_.kind != HoleKind::bore_shift && c_.kind != HoleKind::bore_stop) rapid(retract_);
  }

  void first_feed() {
    if (!c_.pecks.has_first_feed_factor || c_.pecks.first_feed_factor.is(1)) return;
    feed_word(product(usual_feed(), c_.pecks.first_feed_factor));
    slow_first_ = true;
  }
  void after_first() {
    if (slow_first_) feed_word(usual_feed());
  }

  /// Heights are counted from the bottom: a distance above it as a coordinate.
  Value height(const Value& distance) const {
    if (up_ < 0) return subtract(bottom_, distance);
    if (bottom_.literal() && bottom_.number < 0) return subtract(distance, negate(bottom_));
    const auto* u = bottom_.literal() ? nullptr : std::get_if<Unary>(&bottom_.expr->node);
    return u != nullptr && u->op == UnaryOp::negate ? subtract(distance, Value(u->operand)) : add(distance, bottom_);
  }

  /// Distance from the place where the pecks begin to the bottom, and which way is out.
  Value depth();
  void pecks();
  Value kept_copy(const Value& v);
  /// The tool stands under the reference plane at that distance above any bottom of a peck.
  [[nodiscard]] bool above_deepest(const Value& distance) const;
  /// `distance` above the bottom of a peck, at most the reference plane.
  Value over(const Value& left, const Value& distance);
  void between(const Value& left, const Value& gap);
  /// 0.6 mm down to a depth of 30 mm, else a fiftieth of the depth, at most 7 mm.
  Value reapproach(const Value& depth_now);
  bool law_begin(const Value& left);
  bool peck_variable(const Value& v);
  bool halving_begin();
  /// The last two of the smallest pecks share what is left.
  void halve(const Value& left);
  bool geometric_begin();
  /// n pecks from the first evenly to the last, all times one factor so that they end at the bottom.
  bool linear_begin(const Value& left);
  void law_next(const Value& left);

  const HoleCycle& c_;
  const Block& b_;
  const Facts& facts_;
  FeedBefore feed_;
  std::optional<SpindleState> sense_;
  Editor& editor_;
  std::optional<double> initial_;  ///< mm
  LineInfo like_;
  AxisId axis_ = axis::z;
  Plane plane_ = Plane::xy;
  double unit_ = 1;
  Distance distance_ = Distance::absolute;
  Value surface_, reference_, bottom_, retract_, tiny_;
  double up_ = 1;
  bool taken_downward_ = false, feed_changed_ = false, slow_first_ = false;
  Value first_, whole_, peck_, least_, step_;
  std::optional<VarRef> peck_var_;
  std::vector<VarRef> taken_;
  Body out_;
  Body* loop_ = nullptr;
};

}  // namespace cnctrans::ir::passes
