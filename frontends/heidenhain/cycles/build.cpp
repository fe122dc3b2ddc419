#include "frontends/heidenhain/cycles/builder.h"
#include "ir/cycles/milling/milling.h"

#include <cmath>
#include <memory>
#include <utility>

#include "dialects/heidenhain/limits.h"
#include "frontends/heidenhain/state/datum.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;
using facts::Role;
using ir::HoleKind;
using ir::Level;
using ir::LevelBase;
using ir::Value;

namespace {

ir::ExprPtr programmed_speed() {
  return datum(ir::Datum::rpm, "S");
}

}  // namespace

Level level_of(Value v, LevelBase base) {
  Level l;
  l.value = std::move(v);
  l.base = base;
  l.given = true;
  return l;
}
Value larger(const Value& a, const Value& b) {
  if (a.literal() && b.literal()) return a.number > b.number ? a : b;
  return Value(ir::call(ir::Function::max, {ir::as_expr(a), ir::as_expr(b)}));
}
Value half(const Value& v) {
  return ir::scale(v, 0.5);
}
Value magnitude(const Value& v) {
  if (v.literal()) return v.number < 0 ? ir::negate(v) : v;
  return Value(ir::call(ir::Function::abs, {v.expr}));
}

ir::CyclePtr CycleBuilder::build() {
  for (const auto& [number, v] : cycle_.values) {
    const bool words = v.kind != QValue::Kind::value && v.kind != QValue::Kind::rapid;
    if (words && !only_value(number)) return nullptr;
  }
  bool good = false;
  if (cycle_.row != nullptr)
    good = cycle_.row->kind == facts::CycleKind::hole   ? hole()
           : cycle_.row->kind == facts::CycleKind::mill ? mill()
                                                        : not_carried();
  else
    good = cycle_.old != nullptr ? old() : not_carried();
  if (!good || report_.refused() || skipped_ || !context_.moves->empty()) return nullptr;
  auto made = as_cycle(std::move(hole_));
  if (!aside_ && cycle_.number != 254) return made;
  MoveList steps;
  if (!aside_) {  // it leaves the tool over the middle of the circle
    steps.cycle(std::move(made));
    steps.plane({q(216), q(217), true, {}, {}});
    told(steps);
    return nullptr;
  }
  steps.plane({aside_->first, aside_->second, false, {}, {}});
  steps.cycle(std::move(made));
  if (cycle_.number == 251 || cycle_.number == 3)
    steps.plane({ir::negate(aside_->first), ir::negate(aside_->second), false, {}, {}});
  told(steps);
  return nullptr;
}

bool CycleBuilder::told(MoveList& steps) {
  *context_.moves = steps.take();
  return true;
}

ir::CyclePtr CycleBuilder::as_cycle(ir::HoleCycle hole) const {
  if (hole.kind == HoleKind::mill && context_.tool_radius)
    hole.mill.words.emplace_back(std::string(ir::cycles::tool_radius_word), Value(*context_.tool_radius));
  return std::make_shared<const ir::Cycle>(ir::Cycle{std::move(hole)});
}

bool CycleBuilder::numbers() {
  for (const auto& [number, v] : cycle_.values) {
    if (!q(number).literal()) return refuse("its parameters must be numbers");
  }
  return !context_.shift || context_.shift->literal() || refuse("its surface must be a number");
}

ir::Value CycleBuilder::radius() const {
  if (context_.tool_radius) return Value(*context_.tool_radius / (context_.inch ? 25.4 : 1));
  return Value(datum(ir::Datum::tool_radius, "Q108"));
}

bool CycleBuilder::refuse(std::string message) {
  report_.keep("HEI-018", {}, "cycle " + std::to_string(cycle_.number) + ": " + std::move(message), "cycle.hole");
  return false;
}

void CycleBuilder::warn(std::string message) {
  report_.warn("HEI-019", {}, "cycle " + std::to_string(cycle_.number) + ": " + std::move(message));
}

bool CycleBuilder::only_value(std::int16_t number) {
  const auto it = cycle_.values.find(number);
  if (it == cycle_.values.end() || it->second.kind == QValue::Kind::value) return true;
  const bool stud = cycle_.number == 256 || cycle_.number == 257;
  const bool may_be_rapid = number == 208 || number == 253 || (number == 206 && stud);
  if (may_be_rapid && it->second.kind == QValue::Kind::rapid) return true;
  return refuse("Q" + std::to_string(number) + " in words (FMAX, FU, FZ, PREDEF) is not carried here");
}

/// FMAX, or the number that programs write for it.
bool CycleBuilder::rapid(std::int16_t number) const {
  const Value v = q(number);
  return v.literal() && v.number >= facts::rapid_stand_in;
}

/// How deep the point of the tool goes before its full width is there, for a width of 1 (T-ANGLE of the tool table).
Value CycleBuilder::point() const {
  using ir::BinaryOp;
  const auto angle = ir::binary(BinaryOp::divide, datum(ir::Datum::other, "T_ANGLE"), ir::number(2));
  return Value(ir::binary(BinaryOp::divide, ir::number(0.5), ir::call(ir::Function::tan, {angle})));
}

/// Q201, or that of the diameter Q344 which the point makes (240).
Value CycleBuilder::depth() const {
  if (cycle_.number != 240 || !q(343).is(1) || !q(344).literal() || q(344).is(0)) return q(201);
  return Value(ir::binary(ir::BinaryOp::multiply, ir::number(q(344).number), ir::as_expr(point())));
}

bool CycleBuilder::levels() {
  for (const auto n : std::initializer_list<std::int16_t>{200, 201, 203, 204}) {
    if (!only_value(n)) return false;
  }
  const Value depth = this->depth(), clearance = q(200);
  if (depth.is(0)) {
    skipped_ = true;
    report_.note("HEI-019", {}, "depth 0: the cycle does nothing");
    return true;
  }
  const bool upward = depth.literal() && depth.number > 0;
  if (upward && hole_.kind == HoleKind::mill)
    return refuse("a positive depth turns the approach round; that is not carried");
  if (upward) warn("a positive depth: the tool goes in rapid to Q203 - Q200, below the surface, and works upward");
  if (!depth.literal()) report_.note("HEI-019", {}, "the depth is taken to be negative, as it should");
  Value surface = q(203);
  if (context_.shift) surface = ir::add(surface, *context_.shift);
  hole_.surface = level_of(surface, LevelBase::absolute);
  hole_.reference = level_of(upward ? ir::negate(clearance) : clearance, LevelBase::from_surface);
  hole_.bottom = level_of(depth, LevelBase::from_surface);
  const Value second = q(204);
  const bool low = upward && second.literal() && clearance.literal() && second.number <= clearance.number;
  const Value above = low ? ir::negate(clearance) : larger(second, clearance);
  hole_.retract = level_of(ir::add(surface, above), LevelBase::absolute);
  return true;
}

/// The cycle is told by peck_moves().
bool CycleBuilder::as_moves() {
  if (cycle_.values.count(395) != 0 && !q(395).is(0)) return refuse("with these pecks Q395 is not carried");
  *context_.moves = peck_moves(cycle_, context_);
  return !context_.moves->empty() || refuse("with these pecks its parameters must be numbers");
}

bool CycleBuilder::feed_in(std::int16_t number) {
  if (!only_value(number)) return false;
  hole_.feed = q(number);
  hole_.has_feed = true;
  return true;
}

/// Q208: 0 is the feed itself. In rapid the cycle is another one (drilling), or has no such feed.
bool CycleBuilder::feed_out() {
  if (!only_value(208)) return false;
  const Value out = q(208);
  if (rapid(208)) return true;
  if (out.is(0)) {
    hole_.feed_out = hole_.feed;
  } else if (!out.literal()) {
    return refuse("Q208 in a parameter is not carried: 0 means the feed Q206");
  } else {
    hole_.feed_out = out;
  }
  hole_.has_feed_out = true;
  return true;
}

bool CycleBuilder::tip() {
  if (q(395).is(0)) return true;
  const Value wide = ir::scale(radius(), 2);
  const Value deeper(ir::binary(ir::BinaryOp::multiply, ir::as_expr(wide), ir::as_expr(point())));
  hole_.bottom = level_of(ir::subtract(q(201), deeper), LevelBase::from_surface);
  return true;
}

/// One stroke where the peck is not smaller than the depth.
bool CycleBuilder::one_stroke(const Value& peck) const {
  const Value depth = q(201);
  return peck.literal() && depth.literal() && (peck.number <= 0 || peck.number >= std::abs(depth.number) - 1e-9);
}

void CycleBuilder::pecks(const Value& peck) {
  hole_.pecks.law = ir::PeckLaw::constant;
  hole_.pecks.first = peck;
  hole_.pecks.first_from_surface = true;
}

bool CycleBuilder::hole() {
  hole_.kind = cycle_.row->hole;
  if (cycle_.number == 204) return back_bore();
  if (!levels()) return false;
  if (skipped_) return true;
  switch (cycle_.number) {
    case 200: return drill();
    case 201: return ream();
    case 202: return bore();
    case 203: return universal();
    case 205: return pecking();
    case 206: hole_.dwell_bottom = q(211); return feed_in();
    case 207: return tap();
    case 209: return tap_in_pecks();
    case 240: return centre();
    case 241: return as_moves();
    default: return not_carried();
  }
}

bool CycleBuilder::drill() {
  hole_.dwell_bottom = q(211);
  if (one_stroke(q(202))) {
    hole_.kind = HoleKind::drill;
  } else {
    pecks(q(202));
    hole_.pecks.reapproach = q(200);
    hole_.dwell_top = q(210);
  }
  return feed_in() && tip();
}

bool CycleBuilder::ream() {
  hole_.dwell_bottom = q(211);
  if (rapid(208)) hole_.kind = HoleKind::drill;
  return feed_in() && feed_out();
}

/// The tip is freed by 0.2 mm toward Q214, then the retract.
bool CycleBuilder::bore() {
  hole_.dwell_bottom = q(211);
  hole_.orient_angle = q(336);
  if (!feed_in()) return false;
  if (!feed_out()) return false;
  const Value side = q(214);
  if (!side.literal()) return refuse("Q214 must be a number");
  constexpr double inch = 25.4;
  const double d = facts::freed_distance / (context_.inch ? inch : 1);
  if (side.is(1) || side.is(3)) hole_.shift_u = Value(side.is(1) ? -d : d);
  if (side.is(2) || side.is(4)) hole_.shift_v = Value(side.is(2) ? -d : d);
  return true;
}

/// Q249 of the tool's edge, which lies Q252 above the end of the bar, into the underside of a plate of Q250.
bool CycleBuilder::back_bore() {
  if (!numbers()) return false;
  const double side = n(214), off = n(251);
  if (side < 1 || side > 4) return refuse("Q214 says the side to which the tool goes off the middle: 1 to 4");
  if (n(249) == 0) {
    skipped_ = true;
    return true;
  }
  if (n(249) < 0) return refuse("a negative depth bores downward; that is not carried");
  const double surface = n(203) + (context_.shift ? context_.shift->number : 0);
  hole_.surface = level_of(Value(surface), LevelBase::absolute);
  hole_.reference = level_of(Value(n(200)), LevelBase::from_surface);
  hole_.bottom = level_of(Value(n(249) - n(250) - n(252)), LevelBase::from_surface);
  hole_.retract = level_of(Value(surface + std::max(n(204), n(200))), LevelBase::absolute);
  hole_.pecks.reapproach = Value(n(249) + n(200));
  hole_.orient_angle = q(336);
  (side == 1 || side == 3 ? hole_.shift_u : hole_.shift_v) = Value(side <= 2 ? -off : off);
  hole_.dwell_bottom = q(255);
  hole_.feed = q(254);
  hole_.feed_out = q(253);
  hole_.has_feed = hole_.has_feed_out = true;
  return true;
}

bool CycleBuilder::universal() {
  hole_.dwell_bottom = q(211);
  const Value peck = q(202), breaks = q(213), decrement = q(212);
  if (!feed_in() || !tip() || !feed_out()) return false;
  if (!breaks.literal() || !decrement.literal()) return as_moves();
  const bool stroke = one_stroke(peck) && breaks.is(0);
  if (stroke) {
    hole_.kind = rapid(208) ? HoleKind::drill : HoleKind::bore;
    return true;
  }
  if (!decrement.is(0) || !rapid(208)) return as_moves();
  pecks(peck);
  if (breaks.is(0)) {
    hole_.kind = HoleKind::peck_full;
    hole_.pecks.reapproach = q(200);
    hole_.dwell_top = q(210);
    return true;
  }
  const Value depth = q(201);
  const bool all = peck.literal() && depth.literal() && peck.number > 0 &&
                   std::ceil(std::abs(depth.number) / peck.number - 1e-9) - 1 <= breaks.number;
  if (!all) return as_moves();
  hole_.kind = HoleKind::peck_break;
  hole_.pecks.lift = q(256);
  return true;
}

bool CycleBuilder::pecking() {
  hole_.dwell_bottom = q(211);
  const Value peck = q(202), decrement = q(212), chip = q(257);
  if (!feed_in() || !tip()) return false;
  if (!decrement.is(0) || !q(379).is(0) || !chip.is(0)) return as_moves();
  if (one_stroke(peck)) {
    hole_.kind = rapid(208) ? HoleKind::drill : HoleKind::bore;
    return feed_out();
  }
  if (!rapid(208) || !ir::equal(q(258), q(259))) return as_moves();
  pecks(peck);
  hole_.pecks.reapproach = q(258);
  return true;
}

bool CycleBuilder::tap() {
  hole_.rigid = true;
  hole_.pitch = q(239);
  hole_.spindle_after = ir::SpindleStep::off;
  return only_value(239);
}

bool CycleBuilder::tap_in_pecks() {
  if (!tap()) return false;
  hole_.orient_first = true;
  hole_.orient_angle = q(336);
  const Value chip = q(257), factor = q(256), speed = q(403);
  if (!speed.is(1)) {
    hole_.has_speed_out = true;
    hole_.speed_out = Value(ir::binary(ir::BinaryOp::multiply, programmed_speed(), ir::as_expr(speed)));
    *context_.speed_after = Value(ir::binary(ir::BinaryOp::divide, programmed_speed(), ir::as_expr(speed)));
  }
  if (chip.is(0) || one_stroke(chip)) return true;
  hole_.pecks.law = ir::PeckLaw::constant;
  hole_.pecks.first = chip;
  if (!factor.is(0)) {
    const Value pitch = magnitude(q(239));
    if (!factor.literal() || !pitch.literal()) return refuse("Q256 and Q239 must be numbers");
    hole_.pecks.lift = Value(factor.number * pitch.number);
  }
  hole_.pecks.first_from_surface = true;
  return true;
}

bool CycleBuilder::centre() {
  hole_.dwell_bottom = q(211);
  if (!q(343).is(0) && (!q(343).is(1) || !q(344).literal() || q(344).number > 0))
    return refuse("Q343 is 0, or 1 with a negative diameter in Q344");
  return feed_in();
}

ir::CyclePtr build_cycle(const CycleDefinition& cycle, const CycleContext& context, Report& report) {
  return CycleBuilder(cycle, context, report).build();
}

}  // namespace cnctrans::frontends::heidenhain
