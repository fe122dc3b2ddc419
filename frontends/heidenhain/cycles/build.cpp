#include "frontends/heidenhain/cycles/build.h"

#include <cmath>
#include <memory>
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

ir::ExprPtr programmed_speed() {
  ir::SystemRef ref;
  ref.datum = ir::Datum::rpm;
  ref.text = "S";
  auto e = std::make_shared<ir::Expr>();
  e->node = std::move(ref);
  return e;
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
    if (good && as_moves_ && !report_.refused()) {
      *context_.moves = peck_moves(cycle_, context_);
      if (context_.moves->empty()) refuse("with these pecks its parameters must be numbers");
      return nullptr;
    }
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
  /// The cycle is told by peck_moves().
  bool as_moves() {
    as_moves_ = true;
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
    if (!breaks.literal() || !decrement.literal()) return as_moves();
    const bool stroke = one_stroke(peck) && breaks.is(0);
    if (stroke) {
      hole_.kind = HoleKind::bore;
      return true;
    }
    if (!decrement.is(0) || !rapid(208)) return as_moves();
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
    if (!all) return as_moves();
    hole_.kind = HoleKind::peck_break;
    hole_.pecks.lift = q(256);
    return true;
  }
  bool pecking() {
    hole_.dwell_bottom = q(211);
    const Value peck = q(202), decrement = q(212), chip = q(257);
    if (!feed_in() || !tip()) return false;
    if (!decrement.is(0) || !q(379).is(0) || !chip.is(0)) return as_moves();
    if (one_stroke(peck)) {
      hole_.kind = rapid(208) ? HoleKind::drill : HoleKind::bore;
      return rapid(208) || feed_out();
    }
    if (!rapid(208) || !ir::equal(q(258), q(259))) return as_moves();
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
    if (!speed.is(1)) {
      hole_.has_speed_out = true;
      hole_.speed_out = Value(ir::binary(ir::BinaryOp::multiply, programmed_speed(), ir::as_expr(speed)));
    }
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
    if (cycle_.row->on_contours) return area();
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
  /// 22, 23 and 24 in one pocket of cycle 14.
  bool area() {
    const bool rough = cycle_.number == 22, floor = cycle_.number == 23;
    if (!rough && !floor && cycle_.number != 24) return not_carried();
    if (cycle_.labels.empty() || cycle_.values.count(1) == 0) return refuse("cycles 14 and 20 stand before it");
    if (!cycle_.area_fault.empty()) return refuse(cycle_.area_fault);
    for (const std::int16_t n : {1, 2, 3, 4, 5, 6, 7, 9, 10, 11, 12}) {
      if (cycle_.values.count(n) != 0 && !q(n).literal()) return refuse("its parameters must be numbers");
    }
    const double top = q(5).number, bottom = top + q(1).number;
    if (q(1).number >= 0) return refuse("a depth of 0 or above is not carried");
    const double skin = std::abs(q(4).number);
    hole_.surface = level(Value(floor && skin > 0 ? bottom + skin : top), LevelBase::absolute);
    hole_.reference = level(Value(top + q(6).number), LevelBase::absolute);
    hole_.bottom = level(Value(bottom), LevelBase::absolute);
    hole_.retract = level(q(7), LevelBase::absolute);
    word("operation", Value(rough || floor ? 1 : 2));
    if (!floor) word("infeed", magnitude(q(10)));
    word("plunge_feed", q(11));
    word("mill_feed", q(12));
    word("step_factor", half(q(2)));
    if (rough || floor) word("wall_stock", q(3));
    if (rough) word("floor_stock", q(4));
    word("sense", Value(q(9).is(-1) ? 1 : 0));
    word("outside", Value(1));
    const auto coarse = cycle_.values.find(18);
    if (coarse != cycle_.values.end() && !q(18).is(0)) return refuse("Q18 (a coarser tool was there) is not carried");
    if (cycle_.values.count(14) != 0 && !q(14).is(0)) return refuse("Q14 (an allowance that stays) is not carried");
    ir::cycles::put_contours(hole_, cycle_.areas[context_.area]);
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
    const bool pocket = kind == OldKind::pocket || kind == OldKind::round_pocket;
    if (kind == OldKind::slot) return refuse("the tool starts in the slot by its radius, which is not in the program");
    if (!pocket && kind != OldKind::pecking && kind != OldKind::tapping && kind != OldKind::rigid_tapping)
      return not_carried();
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
    if (pocket) return old_pocket(kind == OldKind::round_pocket);
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

  [[nodiscard]] const OldPartValue::Letter* letter(int n, std::string_view address) const {
    const auto it = cycle_.parts.find(n);
    if (it == cycle_.parts.end()) return nullptr;
    for (const auto& l : it->second.letters) {
      if (l.address == address) return &l;
    }
    return nullptr;
  }
  /// 4 and 5: `PECKG -5 F80`, the sides or `RADIUS 30`, `F200 DR+ RADIUS 5`. The tool stands in the middle.
  bool old_pocket(bool round) {
    hole_.kind = HoleKind::mill;
    hole_.mill.shape = round ? "pocket.circle" : "pocket.rect";
    const int last = round ? 5 : 6;
    const auto number = [&](int n) -> const Value* {  // the first one behind the words of the dialog
      const auto it = cycle_.parts.find(n);
      if (it == cycle_.parts.end()) return nullptr;
      for (const auto& l : it->second.letters) {
        if (l.has_value) return &l.value;
      }
      return nullptr;
    };
    const auto *peck = number(3), *first = number(4), *second = round ? first : number(5);
    const auto *plunge = letter(3, "F"), *feed = letter(last, "F"), *sense = letter(last, "DR");
    if (peck == nullptr || first == nullptr || second == nullptr || feed == nullptr || !feed->has_value)
      return refuse("a size, the infeed or the feed is missing");
    word("infeed", magnitude(*peck));
    if (plunge != nullptr && plunge->has_value) word("plunge_feed", plunge->value);
    word("mill_feed", feed->value);
    word("sense", Value(sense != nullptr && sense->negative ? 2 : 3));
    word("operation", Value(1));
    if (round) {
      word("radius", *first);
    } else {
      word("length", *first);
      word("width", *second);
      const auto* corner = letter(last, "RADIUS");
      if (corner != nullptr && corner->has_value) word("corner", corner->value);
    }
    warn("the way of the passes is that of this program, the part is the same");
    return true;
  }

  const CycleDefinition& cycle_;
  const CycleContext& context_;
  Report& report_;
  ir::HoleCycle hole_;
  bool skipped_ = false, as_moves_ = false;
};

}  // namespace

ir::CyclePtr build_cycle(const CycleDefinition& cycle, const CycleContext& context, Report& report) {
  return CycleBuilder(cycle, context, report).build();
}

}  // namespace cnctrans::frontends::heidenhain
