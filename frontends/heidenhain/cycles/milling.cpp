// Milling cycles -> neutral ones (reference 16, 17).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/noise.h"
#include "dialects/heidenhain/limits.h"
#include "frontends/heidenhain/cycles/builder.h"
#include "ir/cycles/milling/milling.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;
using facts::Role;
using ir::HoleKind;
using ir::LevelBase;
using ir::Value;

bool CycleBuilder::mill() {
  hole_.kind = HoleKind::mill;
  hole_.mill.shape = std::string(cycle_.row->name);
  if (cycle_.row->contours != facts::Contours::none) return on_contours();
  if (cycle_.number == 208) return helix_bore();
  if (cycle_.number == 262 || cycle_.number == 267) return helix_thread();
  if (cycle_.number >= 263 && cycle_.number <= 265) return thread_with_countersink();
  if (cycle_.number == 230 || cycle_.number == 232) return face();
  if (cycle_.number == 231) return ruled_surface();
  switch (cycle_.number) {
    case 251:
    case 252:
    case 253:
    case 254:
    case 256:
    case 257:
    case 210:
    case 211:
    case 212:
    case 213:
    case 214:
    case 215: break;
    default: return not_carried();
  }
  if (!levels()) return false;
  if (skipped_) return true;
  if (cycle_.number == 253) hole_.mill.shape = "pocket.rect";
  for (const auto& p : cycle_.row->parameters) {
    if (p.number != 0 && !mill_word(p.number)) return false;
  }
  if (cycle_.values.count(367) != 0 && !(cycle_.number == 254 ? place_on_ring() : place())) return false;
  switch (cycle_.number) {
    case 210:
    case 253: word("corner", half(q(219))); break;
    case 211: word("count", Value(1)); break;
    case 214: word("wall_stock", half(ir::subtract(q(223), q(222)))); [[fallthrough]];
    case 212: word("operation", Value(2)); break;
    case 213:
      word("blank_length", ir::add(q(218), ir::scale(q(221), 2)));
      word("blank_width", ir::add(q(219), ir::scale(q(221), 2)));
      [[fallthrough]];
    case 215:
    case 256:
    case 257: word("variant", Value(1)); break;
    default: break;
  }
  warn("the way of the passes is that of this program, the part is the same");
  return true;
}

bool CycleBuilder::place() {
  const Value at = q(367);
  if (at.is(0)) return true;
  const bool slot = cycle_.number == 253;
  const Value length = q(218), width = q(219), angle = q(slot ? 374 : 224);
  if (!at.literal() || !length.literal() || !width.literal() || !angle.literal())
    return refuse("where the tool stands in the shape (Q367) must be known by numbers");
  const double a = length.number / 2, b = width.number / 2;
  double u = 0, v = 0;
  if (slot) {
    u = at.is(1) ? a : at.is(2) ? a - b : at.is(3) ? b - a : -a;
  } else {
    u = at.is(1) || at.is(4) ? a : -a;
    v = at.is(1) || at.is(2) ? b : -b;
  }
  constexpr double degrees = std::numbers::pi / 180;
  const double c = std::cos(angle.number * degrees), s = std::sin(angle.number * degrees);
  aside_ = {Value(without_noise(c * u - s * v)), Value(without_noise(s * u + c * v))};
  return true;
}

/// 254 from the tool: at the start of the slot (3), in its middle (2), or at its end (1), seen from the centre of the
/// circle.
bool CycleBuilder::place_on_ring() {
  const Value at = q(367), radius = q(375), angle = q(376), opening = q(248);
  if (at.is(0)) return true;
  if (!at.literal() || !radius.literal() || !angle.literal() || !opening.literal())
    return refuse("where the tool stands in the slot (Q367) must be known by numbers");
  const double a = angle.number * std::numbers::pi / 180, r = radius.number / 2;
  std::erase_if(hole_.mill.words, [](const auto& w) { return w.first == "u" || w.first == "v"; });
  for (auto& [name, v] : hole_.mill.words) {
    if (name == "angle") v = Value(angle.number - (at.is(1) ? 1 : at.is(2) ? 0.5 : 0) * opening.number);
  }
  aside_ = {Value(without_noise(-r * std::cos(a))), Value(without_noise(-r * std::sin(a)))};
  return true;
}

bool CycleBuilder::climb() {
  const Value v = q(351);
  if (!v.is(1) && !v.is(-1) && !v.is(0)) return refuse("Q351 must be +1, -1 or 0");
  word("sense", Value(v.is(-1) ? 1 : 0));
  return true;
}

bool CycleBuilder::helix_bore() {
  if (!levels() || skipped_) return skipped_;
  if (!only_value(206)) return false;
  word("diameter", q(335));
  word("pitch", q(334));
  word("mill_feed", q(206));
  word("plunge_feed", q(206));
  return climb();
}

bool CycleBuilder::helix_thread() {
  if (!levels() || skipped_) return skipped_;
  if (!only_value(207) || !only_value(512) || !only_value(253)) return false;
  if (cycle_.number == 267 && !q(358).is(0)) return refuse("countersinking at the front (Q358) is not carried");
  word("diameter", q(335));
  word("pitch", q(239));
  word("per_step", q(355));
  word("mill_feed", q(207));
  word("plunge_feed", q(253));
  if (cycle_.values.count(512) != 0 && !q(512).is(0)) word("lead_feed", q(512));
  if (cycle_.number == 267) word("external", Value(1));
  warn("the start of the thread and the ways onto it and off it are those of this program");
  return climb();
}

/// 230: one level in lines to and fro; 232: in levels, Q389 2 in lines one way.
bool CycleBuilder::face() {
  for (const auto& p : cycle_.row->parameters) {
    if (p.number != 0 && !q(p.number).literal()) return refuse("its parameters must be numbers");
  }
  const bool multipass = cycle_.number == 230;
  const double top = q(227).number, bottom = multipass ? top : q(386).number, width = q(219).number;
  hole_.surface = level_of(Value(top), LevelBase::absolute);
  hole_.bottom = level_of(Value(bottom), LevelBase::absolute);
  hole_.reference = level_of(Value(top + q(200).number), LevelBase::absolute);
  hole_.retract = level_of(Value(top + std::max(q(200).number, multipass ? 0 : q(204).number)), LevelBase::absolute);
  word("u", q(225));
  word("v", q(226));
  word("length", q(218));
  word("width", q(219));
  word("mill_feed", q(207));
  word("from_dimension", Value(1));
  if (multipass) {
    if (q(240).number < 1) return refuse("Q240 is the number of lines");
    word("step", Value(std::abs(width) / q(240).number));
    word("variant", Value(32));
  } else {
    if (bottom >= top) return refuse("the end (Q386) lies above the start (Q227)");
    word("infeed", q(202));
    word("step_factor", half(q(370)));
    word("overrun", q(357));
    word("variant", Value(q(389).is(2) ? 11 : 31));
  }
  warn("the way of the passes is that of this program, the part is the same");
  const double skin = multipass ? 0 : n(369);
  if (skin <= 0 || skin >= top - bottom) return true;
  ir::HoleCycle rough = hole_, last = hole_;  // the last level is as high as the allowance, at a feed of its own
  rough.bottom = last.surface = level_of(Value(bottom + skin), LevelBase::absolute);
  for (auto& [name, v] : last.mill.words) {
    if (name == "infeed") v = Value(skin);
    if (name == "mill_feed" && !q(385).is(0)) v = q(385);
  }
  MoveList steps;
  for (auto* h : {&rough, &last}) steps.cycle(as_cycle(std::move(*h)));
  return told(steps);
}

bool CycleBuilder::mill_word(std::int16_t number) {
  const auto* row = facts::find_q_word(number, cycle_.number);
  if (row == nullptr) return true;
  const Value v = q(number);
  const bool boss = cycle_.number == 256 || cycle_.number == 257;
  switch (row->role) {
    case Role::mill:
      if (cycle_.number == 254 && number == 369) {
        if (v.is(0) || !q(215).is(1)) return true;  // finishing takes it
        hole_.bottom = level_of(ir::add(q(201), v), LevelBase::from_surface);
        return true;
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
    case Role::plunge_way:
      if (!v.is(0)) warn("the tool goes straight down, not on a helix or a ramp (Q366)");
      return true;
    case Role::mill_blank: return true;
    case Role::pattern: word(row->parameter, v); return true;
    case Role::other: {
      const bool harmless = number == 439 || number == 437;
      if (harmless && v.is(0)) return true;
      return refuse("Q" + std::to_string(number) + " is not carried");
    }
    default: return true;  // levels
  }
}

}  // namespace cnctrans::frontends::heidenhain
