// Cycles on the labels of cycle 14 (reference 16, 17) -> neutral ones.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/noise.h"
#include "frontends/heidenhain/cycles/builder.h"
#include "ir/cycles/milling/milling.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;
using facts::Contours;
using ir::HoleKind;
using ir::LevelBase;
using ir::Value;
using ir::cycles::MillContour;
using ir::cycles::MillElement;

namespace {

MillElement backwards(const MillElement& e) {
  return {e.u1, e.v1, e.u0, e.v0, e.arc, !e.ccw, e.cu, e.cv};
}
std::vector<MillElement> backwards(const std::vector<MillElement>& way) {
  std::vector<MillElement> out;
  for (auto e = way.rbegin(); e != way.rend(); ++e) out.push_back(backwards(*e));
  return out;
}

}  // namespace

bool CycleBuilder::on_contours() {
  if (cycle_.labels.empty()) return refuse("cycle 14 stands before it");
  if (!cycle_.area_fault.empty()) return refuse(cycle_.area_fault);
  switch (cycle_.row->contours) {
    case Contours::line:
    case Contours::line_in_space: return train();
    case Contours::middle_line: return slot_along();
    case Contours::developed: return on_cylinder();
    default: return area();
  }
}

/// 25 and 276: the contour of one label, approached along a line or a quadrant.
bool CycleBuilder::train() {
  if (!numbers()) return false;
  const bool in_space = cycle_.row->contours == facts::Contours::line_in_space;
  const auto& line = cycle_.areas.front();
  const double unit = context_.inch ? 25.4 : 1;
  double top = in_space ? n(7) : n(5), bottom = in_space ? top : top + n(1);
  if (!in_space && n(1) == 0) return skipped_ = true;
  if (in_space && n(1) != 0) return refuse("passes (Q1 not 0) above the heights of the contour are not described");
  for (const double h : line.front().heights) bottom = std::min(bottom, h / unit);
  if (bottom >= top) return refuse("a depth of 0 or above is not carried");
  for (const double h : line.front().heights) {
    if (h / unit >= top) return refuse("the contour rises above the clearance height (Q7)");
  }
  if (n(18) != 0) return refuse("Q18 (a coarser tool was there) is not carried");
  const bool data = cycle_.values.count(390) != 0;
  if (data && cycle_.side != 0) return refuse("beside cycle 270 the label has no compensation of its own");
  const double own = data ? n(391) : 0;
  const int side = own == 1 ? 1 : own == 2 ? -1 : cycle_.side;
  if (side == 0 && n(3) != 0) return refuse("an allowance (Q3) needs the side of the contour: RL or RR");
  const bool arc = data ? n(390) == 1 && side != 0 : false;
  const double length = !data ? n(448) : arc ? n(392) : n(394);
  if (length <= 0) return refuse("the way onto the contour has no length");
  hole_.surface = level_of(Value(top), LevelBase::absolute);
  hole_.bottom = level_of(Value(bottom), LevelBase::absolute);
  hole_.reference = hole_.retract = level_of(q(7), LevelBase::absolute);
  word("infeed", magnitude(q(10)));
  word("plunge_feed", q(11));
  word("mill_feed", q(12));
  word("variant", Value(1));
  word("side", Value(side == 0 ? 40 : side > 0 ? 41 : 42));
  if (n(3) != 0) word("wall_stock", q(3));
  for (const char* way : {"approach", "leave"}) word(way, Value(arc ? 2 : 1));
  for (const char* way : {"approach_length", "leave_length"}) word(way, Value(length));
  warn("the ways onto the contour and off it are those of this program");
  if (!in_space && n(15) == 0) return to_and_fro(line.front(), top, bottom);
  ir::cycles::put_contours(hole_, line);
  return true;
}

/// 25 with Q15=0: every second level from the end to the start, with the tool on the same side of the contour.
bool CycleBuilder::to_and_fro(MillContour line, double top, double bottom) {
  const double infeed = std::abs(n(10));
  const double count = infeed > 0 ? std::ceil((top - bottom) / infeed - 1e-9) : 1;
  constexpr double most = 1000;
  if (count > most) return refuse("it has more levels than anyone mills");
  MoveList steps;
  for (double k = 0; k < count; ++k) {
    ir::HoleCycle level = hole_;
    level.surface = level_of(Value(top + (bottom - top) * k / count), LevelBase::absolute);
    level.bottom = level_of(Value(top + (bottom - top) * (k + 1) / count), LevelBase::absolute);
    ir::cycles::put_contours(level, {line});
    steps.cycle(as_cycle(std::move(level)));
    line.elements = backwards(line.elements);
    for (auto& [name, v] : hole_.mill.words) {
      if (name == "side" && !v.is(40)) v = Value(v.is(41) ? 42 : 41);
    }
  }
  if (count > 1) warn("between the levels the tool goes up to the clearance height (Q7)");
  return told(steps);
}

/// 21: where the roughing goes down, drilled; 22, 23 and 24 in one pocket of cycle 14.
bool CycleBuilder::area() {
  const bool drills = cycle_.number == 21, rough = cycle_.number == 22, floor = cycle_.number == 23;
  if (!drills && !rough && !floor && cycle_.number != 24) return not_carried();
  if (cycle_.values.count(1) == 0) return refuse("cycles 14 and 20 stand before it");
  for (const std::int16_t n : {1, 2, 3, 4, 5, 6, 7, 9, 10, 11, 12}) {
    if (cycle_.values.count(n) != 0 && !q(n).literal()) return refuse("its parameters must be numbers");
  }
  const double top = q(5).number, bottom = top + q(1).number;
  if (q(1).number >= 0) return refuse("a depth of 0 or above is not carried");
  const double skin = std::abs(q(4).number);
  hole_.surface = level_of(Value(floor && skin > 0 ? bottom + skin : top), LevelBase::absolute);
  hole_.reference = level_of(Value(top + q(6).number), LevelBase::absolute);
  hole_.bottom = level_of(Value(bottom), LevelBase::absolute);
  hole_.retract = level_of(q(7), LevelBase::absolute);
  if (drills) {
    hole_.kind = HoleKind::peck_full;
    hole_.bottom = level_of(Value(bottom + skin), LevelBase::absolute);
    pecks(magnitude(q(10)));
    hole_.pecks.reapproach_automatic = true;
    hole_.feed = q(11);
    hole_.has_feed = true;
    if (!q(13).literal()) return refuse("Q13 must be the number of a tool");
    word("tool", q(13));
    const auto said = context_.tool_radii->find(static_cast<std::int64_t>(q(13).number));
    if (said != context_.tool_radii->end())
      word(ir::cycles::tool_radius_word, Value(said->second * (context_.inch ? 25.4 : 1)));
  }
  word("operation", Value(rough || floor || drills ? 1 : 2));
  if (!floor) word("infeed", magnitude(q(10)));
  word("plunge_feed", q(11));
  if (!drills) word("mill_feed", q(12));
  word("step_factor", half(q(2)));
  if (rough || floor || drills) word("wall_stock", q(3));
  if (rough || drills) word("floor_stock", q(4));
  word("sense", Value(q(9).is(-1) ? 1 : 0));
  word("outside", Value(1));
  const auto coarse = cycle_.values.find(18);
  if (coarse != cycle_.values.end() && !q(18).is(0)) return refuse("Q18 (a coarser tool was there) is not carried");
  if (cycle_.values.count(14) != 0 && !q(14).is(0)) return refuse("Q14 (an allowance that stays) is not carried");
  ir::cycles::put_contours(hole_, cycle_.areas[context_.area]);
  warn("the way of the passes is that of this program, the part is the same");
  return true;
}

namespace {

/// The outline of the slot of this half width about the line, its ends round. nullopt with a sentence.
std::optional<MillContour> outline(const std::vector<MillElement>& line, double half, std::string* error) {
  const auto left = ir::cycles::parallel(line, half, true, error),
             right = ir::cycles::parallel(line, half, false, error);
  if (!left || !right) return std::nullopt;
  const auto end = [](const MillElement& from, const MillElement& to, double u, double v) {
    return MillElement{from.u1, from.v1, to.u0, to.v0, true, false, u, v};
  };
  MillContour out;
  out.elements = *left;
  const std::vector<MillElement> back = backwards(*right);
  out.elements.push_back(end(left->back(), back.front(), line.back().u1, line.back().v1));
  out.elements.insert(out.elements.end(), back.begin(), back.end());
  out.elements.push_back(end(back.back(), left->front(), line.front().u0, line.front().v0));
  return out;
}

}  // namespace

/// 275: a slot along the contour as a pocket, roughed and finished.
bool CycleBuilder::slot_along() {
  if (!numbers() || !levels() || skipped_) return skipped_;
  const double kind = n(215), stock = n(368);
  if (kind != 0 && kind != 1 && kind != 2) return refuse("Q215 must be 0, 1 or 2");
  if (!climb()) return false;
  const double unit = context_.inch ? 25.4 : 1, half_width = n(219) / 2 * unit;
  const auto& line = cycle_.areas.front().front().elements;
  const auto &from = line.front(), &to = line.back();
  constexpr double apart = 1e-6, no_wall = 1e-4;
  if (std::hypot(from.u0 - to.u1, from.v0 - to.v1) < apart) return refuse("a closed contour has no slot along it");
  if (context_.tool_radius && half_width < *context_.tool_radius + no_wall)
    return refuse("the tool leaves no room beside itself in the slot");
  std::string error;
  const auto around = outline(line, half_width, &error);
  if (!around) return refuse(error);
  MoveList steps;
  const auto part = [&](int operation, const Value& infeed, const Value& feed) {
    ir::HoleCycle h = hole_;
    const auto put = [&h](std::string_view name, const Value& v) { h.mill.words.emplace_back(std::string(name), v); };
    put("operation", Value(operation));
    put("infeed", infeed.is(0) ? magnitude(q(201)) : infeed);
    put("plunge_feed", q(206));
    put("mill_feed", feed);
    if (operation == 1) put("wall_stock", Value(stock));
    put("outside", Value(1));
    ir::cycles::put_contours(h, {*around});
    steps.cycle(as_cycle(std::move(h)));
  };
  if (kind != 2) part(1, q(202), q(207));
  if (kind != 1) part(2, q(338), q(385).is(0) ? q(207) : q(385));
  warn("the way of the passes is that of this program, the part is the same");
  return told(steps);
}

/// 27: along the developed contour in levels. 28: there and back in each level, with a tool as wide as the slot.
bool CycleBuilder::on_cylinder() {
  if (!numbers()) return false;
  const bool slot = cycle_.number == 28;
  const double depth = n(1), radius = n(16), unit = context_.inch ? 25.4 : 1;
  if (depth == 0) return skipped_ = true;
  if (depth > 0) return refuse("a depth above 0 is not carried");
  if (radius <= -depth) return refuse("the cylinder (Q16) is not thicker than the depth");
  if (!slot && (cycle_.side != 0 || n(3) != 0))
    return refuse("to which side of the developed contour RL, RR and Q3 lead depends on how the rotary axis is built");
  constexpr double no_wall = 1e-4;
  const double wide = (n(20) - 2 * n(3)) * unit;
  if (slot && !context_.tool_radius) return refuse("it needs the radius of the tool as a number (TOOL DEF)");
  if (slot && std::abs(wide - 2 * *context_.tool_radius) > no_wall)
    return refuse("how far a tool that is narrower than the slot (Q20) stands aside is not described");
  MoveList steps;
  const auto to = [&](double around, double along) {
    PlaneMove m{Value(without_noise(around / unit / radius * 180 / std::numbers::pi, 1e10)),
                Value(without_noise(along / unit, 1e10)),
                true,
                {},
                {},
                cycle_.around,
                cycle_.along};
    return m;
  };
  std::vector<MillElement> way = cycle_.areas.front().front().elements;
  const auto mill = [&](const MillElement& e) {
    if (!e.arc) return steps.plane(to(e.u1, e.v1), n(12));
    constexpr double chord = 0.002;  // mm beside the arc
    const double r = std::hypot(e.u0 - e.cu, e.v0 - e.cv), a = std::atan2(e.v0 - e.cv, e.u0 - e.cu);
    double turn = std::atan2(e.v1 - e.cv, e.u1 - e.cu) - a;
    if (e.ccw && turn <= 0) turn += 2 * std::numbers::pi;
    if (!e.ccw && turn >= 0) turn -= 2 * std::numbers::pi;
    const double part = 2 * std::acos(1 - std::min(chord / r, 1.0)), count = std::ceil(std::abs(turn) / part);
    for (double k = 1; k < count; ++k)
      steps.plane(to(e.cu + r * std::cos(a + turn * k / count), e.cv + r * std::sin(a + turn * k / count)), n(12));
    steps.plane(to(e.u1, e.v1), n(12));
  };
  const auto& first = way.front();
  const double clear = radius + n(6), infeed = std::abs(n(10));
  if (infeed == 0) return refuse("Q10 must not be 0");
  steps.plane(to(first.u0, first.v0));
  for (double down = std::min(infeed, -depth);; down = std::min(down + infeed, -depth)) {
    if (!slot || down <= infeed) steps.rapid(Value(clear));
    steps.feed(Value(radius - down), n(11));
    for (const auto& e : way) mill(e);
    if (slot) {
      for (const auto& e : backwards(way)) mill(e);
    } else {
      steps.rapid(Value(clear));
    }
    if (down >= -depth) break;
    if (!slot) steps.plane(to(first.u0, first.v0));
  }
  steps.rapid(context_.height ? *context_.height : Value(clear));
  warn("the datum lies on the axis of the cylinder: its surface is at the height Q16; F is written as it stands");
  return told(steps);
}

}  // namespace cnctrans::frontends::heidenhain
