#include "frontends/heidenhain/cycles/build.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "dialects/heidenhain/limits.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;
using facts::OldKind;
using facts::Role;
using ir::HoleKind;
using ir::Level;
using ir::LevelBase;
using ir::Value;

namespace {

Level level(Value v, LevelBase base) {
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

class CycleBuilder {
 public:
  CycleBuilder(const CycleDefinition& cycle, const CycleContext& context, Report& report)
      : cycle_(cycle), context_(context), report_(report) {}

  ir::CyclePtr build() {
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
    if (!good || report_.refused() || skipped_) return nullptr;
    return std::make_shared<const ir::Cycle>(ir::Cycle{std::move(hole_)});
  }

 private:
  [[nodiscard]] Value q(std::int16_t number) const { return context_.value(number); }
  bool refuse(std::string message) {
    report_.keep("HEI-018", {}, "cycle " + std::to_string(cycle_.number) + ": " + std::move(message), "cycle.hole");
    return false;
  }
  bool not_carried() { return refuse("not carried yet"); }
  void warn(std::string message) {
    report_.warn("HEI-019", {}, "cycle " + std::to_string(cycle_.number) + ": " + std::move(message));
  }
  bool only_value(std::int16_t number) {
    const auto it = cycle_.values.find(number);
    if (it == cycle_.values.end() || it->second.kind == QValue::Kind::value) return true;
    return refuse("Q" + std::to_string(number) + " in words (FMAX, FU, FZ, PREDEF) is not carried here");
  }
  /// FMAX, or the number that programs write for it.
  [[nodiscard]] bool rapid(std::int16_t number) const {
    const Value v = q(number);
    return v.literal() && v.number >= facts::rapid_stand_in;
  }

  bool levels() {
    for (const auto n : std::initializer_list<std::int16_t>{200, 201, 203, 204}) {
      if (!only_value(n)) return false;
    }
    const Value depth = q(201), clearance = q(200);
    if (depth.is(0)) {
      skipped_ = true;
      report_.note("HEI-019", {}, "depth 0: the cycle does nothing");
      return true;
    }
    if (depth.literal() && depth.number > 0)
      return refuse("a positive depth turns the approach round; that is not carried");
    if (!depth.literal()) report_.note("HEI-019", {}, "the depth is taken to be negative, as it should");
    Value surface = q(203);
    if (context_.shift) surface = ir::add(surface, *context_.shift);
    hole_.surface = level(surface, LevelBase::absolute);
    hole_.reference = level(clearance, LevelBase::from_surface);
    hole_.bottom = level(depth, LevelBase::from_surface);
    hole_.retract = level(ir::add(surface, larger(q(204), clearance)), LevelBase::absolute);
    return true;
  }
  bool feed_in(std::int16_t number = 206) {
    if (!only_value(number)) return false;
    hole_.feed = q(number);
    hole_.has_feed = true;
    return true;
  }
  /// Q208: 0 is the feed itself.
  bool feed_out() {
    if (!only_value(208) && !rapid(208)) return false;
    const Value out = q(208);
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
  bool tip() {
    const Value t = q(395);
    if (t.is(0)) return true;
    return refuse("Q395=1 needs the point angle of the tool, which is not in the machine profile");
  }
  /// One stroke where the peck is not smaller than the depth.
  [[nodiscard]] bool one_stroke(const Value& peck) const {
    const Value depth = q(201);
    return peck.literal() && depth.literal() && (peck.number <= 0 || peck.number >= std::abs(depth.number) - 1e-9);
  }
  void pecks(const Value& peck) {
    hole_.pecks.law = ir::PeckLaw::constant;
    hole_.pecks.first = peck;
    hole_.pecks.first_from_surface = true;
  }

  bool hole() {
    hole_.kind = cycle_.row->hole;
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
      default: return not_carried();
    }
  }
  bool drill() {
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
  bool ream() {
    hole_.dwell_bottom = q(211);
    return feed_in() && feed_out();
  }
  /// The tip is freed by 0.2 mm toward Q214, then the retract.
  bool bore() {
    hole_.dwell_bottom = q(211);
    hole_.orient_angle = q(336);
    if (!feed_in()) return false;
    if (!rapid(208)) {
      warn("the retract with the freed tip is in rapid, not at Q208");
    }
    const Value side = q(214);
    if (!side.literal()) return refuse("Q214 must be a number");
    constexpr double inch = 25.4;
    const double d = facts::freed_distance / (context_.inch ? inch : 1);
    if (side.is(1) || side.is(3)) hole_.shift_u = Value(side.is(1) ? -d : d);
    if (side.is(2) || side.is(4)) hole_.shift_v = Value(side.is(2) ? -d : d);
    return true;
  }
  bool universal() {
    hole_.dwell_bottom = q(211);
    const Value peck = q(202), breaks = q(213), decrement = q(212);
    if (!feed_in() || !tip() || !feed_out()) return false;
    if (!breaks.literal() || !decrement.literal()) return refuse("Q212 and Q213 must be numbers");
    const bool stroke = one_stroke(peck) && breaks.is(0);
    if (stroke) {
      hole_.kind = HoleKind::bore;
      return true;
    }
    if (!decrement.is(0)) return refuse("pecks that shrink by Q212 are not carried yet");
    if (!rapid(208) && !q(208).is(0)) warn("the retract is in rapid, not at Q208");
    hole_.has_feed_out = false;
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
    if (!all) return refuse("full retracts between chip breaks (Q213 below the number of pecks) are not carried yet");
    hole_.kind = HoleKind::peck_break;
    hole_.pecks.lift = q(256);
    return true;
  }
  bool pecking() {
    hole_.dwell_bottom = q(211);
    const Value peck = q(202), decrement = q(212), chip = q(257);
    if (!feed_in() || !tip()) return false;
    if (!decrement.is(0)) return refuse("pecks that shrink by Q212 are not carried yet");
    if (!q(379).is(0)) return refuse("a deeper starting point (Q379) is not carried yet");
    if (!chip.is(0)) {
      if (!one_stroke(peck)) return refuse("chip breaks (Q257) within pecks are not carried yet");
      warn("the short lifts are at the feed of drilling, not at 3000 mm/min");
      hole_.kind = HoleKind::peck_break;
      pecks(chip);
      hole_.pecks.lift = q(256);
      return true;
    }
    if (!rapid(208)) warn("the retract is in rapid, not at Q208");
    if (one_stroke(peck)) {
      hole_.kind = HoleKind::drill;
      return true;
    }
    if (!ir::equal(q(258), q(259)))
      return refuse("Q258 and Q259 must be equal: a distance that changes is not carried");
    pecks(peck);
    hole_.pecks.reapproach = q(258);
    return true;
  }
  bool tap() {
    hole_.rigid = true;
    hole_.pitch = q(239);
    hole_.spindle_after = ir::SpindleStep::off;
    return only_value(239);
  }
  bool tap_in_pecks() {
    if (!tap()) return false;
    hole_.orient_first = true;
    hole_.orient_angle = q(336);
    const Value chip = q(257), factor = q(256), speed = q(403);
    if (!speed.is(1)) return refuse("a faster way out (Q403) is not carried yet");
    if (chip.is(0) || one_stroke(chip)) return true;
    hole_.pecks.law = ir::PeckLaw::constant;
    hole_.pecks.first = chip;
    if (!factor.is(0)) {
      const Value pitch = magnitude(q(239));
      if (!factor.literal() || !pitch.literal()) return refuse("Q256 and Q239 must be numbers");
      hole_.pecks.lift = Value(factor.number * pitch.number);
    }
    return true;
  }
  bool centre() {
    hole_.dwell_bottom = q(211);
    if (!q(343).is(0))
      return refuse("a depth by its diameter (Q343=1) needs the point angle of the tool, which is not in the profile");
    return feed_in();
  }

  // --- milling -------------------------------------------------------------------------------------------------------

  void word(std::string_view name, Value v) { hole_.mill.words.emplace_back(std::string(name), std::move(v)); }
  bool mill() {
    hole_.kind = HoleKind::mill;
    hole_.mill.shape = std::string(cycle_.row->name);
    switch (cycle_.number) {
      case 251:
      case 252:
      case 253:
      case 254:
      case 256:
      case 257: break;
      default: return not_carried();
    }
    if (!levels()) return false;
    if (skipped_) return true;
    if (cycle_.number == 253) hole_.mill.shape = "pocket.rect";
    for (const auto& p : cycle_.row->parameters) {
      if (p.number != 0 && !mill_word(p.number)) return false;
    }
    if (cycle_.number == 253) word("corner", half(q(219)));
    if (cycle_.number == 257 || cycle_.number == 256) word("variant", Value(1));
    warn("the way of the passes is that of this program, the part is the same");
    return true;
  }
  bool mill_word(std::int16_t number) {
    const auto* row = facts::find_q_word(number, cycle_.number);
    if (row == nullptr) return true;
    const Value v = q(number);
    const bool boss = cycle_.number == 256 || cycle_.number == 257;
    switch (row->role) {
      case Role::mill:
        if (cycle_.number == 254 && number == 369) {
          return v.is(0) || refuse("an allowance for the floor (Q369) is not carried here");
        }
        if (number == 376 && cycle_.number == 257) return true;  // where the approach begins
        if (number == 368 && boss) return v.is(0) || refuse("an allowance for the side (Q368) is not carried here");
        word(row->parameter, v);
        return true;
      case Role::mill_half: word(row->parameter, half(v)); return true;
      case Role::mill_overlap:
        if (!boss) word(row->parameter, half(v));
        return true;
      case Role::mill_climb:
        if (!v.is(1) && !v.is(-1) && !v.is(0)) return refuse("Q351 must be +1, -1 or 0");
        word(row->parameter, Value(v.is(-1) ? 1 : 0));
        return true;
      case Role::mill_feed_word:
        if (!only_value(number)) return false;
        word(row->parameter, v);
        return true;
      case Role::peck: word("infeed", v); return true;
      case Role::feed:
        if (!only_value(number)) return false;
        word("plunge_feed", v);
        return true;
      case Role::place: {
        const double centre = 0;
        if (v.is(centre)) return true;
        return refuse("Q367 other than 0: the tool does not stand in the middle; not carried yet");
      }
      case Role::plunge_way:
        if (!v.is(0)) warn("the tool goes straight down, not on a helix or a ramp (Q366)");
        return true;
      case Role::pattern: word(row->parameter, v); return true;
      case Role::other: {
        const bool harmless = number == 439 || number == 437;
        if (harmless && v.is(0)) return true;
        return refuse("Q" + std::to_string(number) + " is not carried");
      }
      default: return true;  // levels
    }
  }

  // --- cycles of numbered parts --------------------------------------------------------------------------------------

  [[nodiscard]] const Value* part(int n) const {
    const auto it = cycle_.parts.find(n);
    if (it == cycle_.parts.end()) return nullptr;
    const Value* found = nullptr;
    for (const auto& l : it->second.letters) {
      if (l.has_value) found = &l.value;
    }
    return found;
  }
  /// All of them are counted from where the tool stands at the call.
  bool old() {
    const auto kind = cycle_.old->kind;
    if (kind != OldKind::pecking && kind != OldKind::tapping && kind != OldKind::rigid_tapping) return not_carried();
    const Value *distance = part(1), *depth = part(2);
    if (distance == nullptr || depth == nullptr) return refuse("the distance or the depth is missing");
    if (depth->literal() && depth->number > 0) return refuse("a positive depth works upward; that is not carried");
    if (depth->is(0)) {
      skipped_ = true;
      return true;
    }
    hole_.reference = level(Value(0), LevelBase::from_initial);
    hole_.surface = level(ir::negate(magnitude(*distance)), LevelBase::from_reference);
    hole_.bottom = level(ir::negate(magnitude(*depth)), LevelBase::from_surface);
    hole_.retract = level(Value(0), LevelBase::from_initial);
    const auto feed = [this](int n) {
      if (const Value* f = part(n)) {
        hole_.feed = *f;
        hole_.has_feed = true;
      }
    };
    if (kind == OldKind::pecking) {
      const Value* peck = part(3);
      if (const Value* dwell = part(4)) hole_.dwell_bottom = *dwell;
      feed(5);
      if (peck == nullptr) return refuse("the size of a peck is missing");
      const Value size = magnitude(*peck);
      if (size.literal() && depth->literal() && (size.number == 0 || size.number >= std::abs(depth->number) - 1e-9)) {
        hole_.kind = HoleKind::drill;
        return true;
      }
      hole_.kind = HoleKind::peck_full;
      pecks(size);
      hole_.pecks.reapproach_automatic = true;
      return true;
    }
    if (kind == OldKind::tapping) {
      hole_.kind = HoleKind::tap_floating;
      if (const Value* dwell = part(3)) hole_.dwell_bottom = *dwell;
      feed(4);
      return true;
    }
    const Value* pitch = part(3);
    if (pitch == nullptr) return refuse("the pitch is missing");
    hole_.kind = HoleKind::tap;
    hole_.rigid = true;
    hole_.pitch = *pitch;
    hole_.spindle_after = ir::SpindleStep::off;
    return true;
  }

  const CycleDefinition& cycle_;
  const CycleContext& context_;
  Report& report_;
  ir::HoleCycle hole_;
  bool skipped_ = false;
};

/// Without the noise that sines leave in the last places.
double clean(double x) {
  return std::round(x * 1e10) / 1e10 + 0.0;
}

}  // namespace

ir::CyclePtr build_cycle(const CycleDefinition& cycle, const CycleContext& context, Report& report) {
  return CycleBuilder(cycle, context, report).build();
}

std::vector<PatternPoint> pattern_points(const CycleDefinition& cycle, Report& report) {
  std::map<std::int16_t, double> n;
  for (const auto& [number, v] : cycle.values) {
    if (v.kind != QValue::Kind::value || !v.value.literal()) {
      report.keep("HEI-018", {}, "cycle " + std::to_string(cycle.number) + ": its parameters must be numbers",
                  "cycle.pattern");
      return {};
    }
    n[number] = v.value.number;
  }
  constexpr double most = 10'000;
  const double degrees = std::numbers::pi / 180;
  std::vector<PatternPoint> points;
  if (cycle.number == 220) {
    const double count = n[241], full = 360;
    if (!(count >= 1) || count > most || count != std::floor(count)) {
      report.refuse("HEI-018", {}, "cycle 220: Q241 is the number of machinings, 1 or more");
      return {};
    }
    if (n[365] != 0) {
      report.keep("HEI-018", {}, "cycle 220: the way along the circle (Q365=1) is not carried yet", "cycle.pattern");
      return {};
    }
    double step = n[247];
    const double span = n[246] - n[245];
    if (step == 0) {
      const bool round = std::abs(std::abs(span) - full) < 1e-9;
      step = round ? std::copysign(full / count, span) : count > 1 ? span / (count - 1) : 0;
    }
    for (double k = 0; k < count; ++k) {
      const double a = (n[245] + k * step) * degrees;
      points.push_back({clean(n[216] + n[244] / 2 * std::cos(a)), clean(n[217] + n[244] / 2 * std::sin(a))});
    }
    return points;
  }
  const double columns = n[242], lines = n[243];
  if (!(columns >= 1) || !(lines >= 1) || columns * lines > most || columns != std::floor(columns) ||
      lines != std::floor(lines)) {
    report.refuse("HEI-018", {}, "cycle 221: Q242 and Q243 are numbers of columns and lines, 1 or more");
    return {};
  }
  const double c = std::cos(n[224] * degrees), s = std::sin(n[224] * degrees);
  for (double j = 0; j < lines; ++j) {
    for (double i = 0; i < columns; ++i) {
      const double k = std::fmod(j, 2) == 0 ? i : columns - 1 - i;  // every other line backwards
      const double x = k * n[237], y = j * n[238];
      points.push_back({clean(n[225] + x * c - y * s), clean(n[226] + x * s + y * c)});
    }
  }
  return points;
}

}  // namespace cnctrans::frontends::heidenhain
