// Standard drilling cycles: CYCLE81 to CYCLE89, CYCLE840 (reference-language 18.1).
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/sinumerik/cycles.h"
#include "frontends/sinumerik/cycles/cycle_arguments.h"
#include "frontends/sinumerik/state/statements.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

namespace {

std::string_view feature_of(CycleFamily family) {
  switch (family) {
    case CycleFamily::drilling: return "cycle.hole";
    case CycleFamily::pattern: return "cycle.pattern";
    case CycleFamily::milling: return "cycle.milling";
    case CycleFamily::turning: return "cycle.turning";
    case CycleFamily::swivel: return "motion.transformation";
    case CycleFamily::measuring: break;
  }
  return "motion.probe";
}

/// Units of AMODE: 1: the depth in DP is an amount.
int absolute_mode(const Arguments& a) {
  const ir::Value mode = a.get("AMODE");
  return mode.literal() ? saturate<int>(std::fmod(mode.number, 10)) : 0;
}

/// Seconds when positive, revolutions when negative.
void dwell(const ir::Value& v, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  hole.dwell_bottom = v;
  if (!v.literal()) {
    c.note("SIN-021", pos, "the dwell is taken as seconds: its sign is known only when the program runs");
    return;
  }
  if (v.number >= 0) return;
  hole.dwell_bottom = ir::negate(v);
  hole.dwell_in_revolutions = true;
}

bool axis_of_hole(const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  const ir::Value axn = a.get("AXN");
  if (axn.is(0)) return true;
  if (!axn.literal() || axn.number < 1 || axn.number > 3) {
    c.error("SIN-021", pos, "AXN must be 1, 2 or 3");
    return false;
  }
  hole.axis = static_cast<ir::AxisId>(ir::axis::x + saturate<std::int16_t>(axn.number) - 1);
  return true;
}

/// The dwells of CYCLE83: after a peck (DTB), before the next one (DTS), at the final depth (DTD, else DTB). Each is in
/// seconds when positive and in revolutions when negative; one cycle carries one unit.
bool dwells(const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  const ir::Value peck = a.get("DTB"), top = a.get("DTS"), bottom = a.says("DTD") ? a.get("DTD") : a.get("DTB");
  bool seconds = false, revolutions = false;
  for (const ir::Value* v : {&peck, &top, &bottom}) {
    seconds = seconds || !v->literal() || v->number > 0;
    revolutions = revolutions || (v->literal() && v->number < 0);
  }
  if (seconds && revolutions) {
    c.error("SIN-021", pos, "a dwell in revolutions next to dwells in seconds is not carried yet");
    return false;
  }
  hole.pecks.dwell = absolute_value(peck);
  hole.dwell_top = absolute_value(top);
  hole.dwell_bottom = absolute_value(bottom);
  hole.dwell_in_revolutions = revolutions;
  return true;
}

/// The way back that breaks the chip: VRT, without it 1 mm, whatever the units of the program (18.1.1).
ir::Value chip_lift(const Arguments& a, FileContext& c, WordPos pos) {
  return a.says("VRT") ? a.get("VRT") : c.millimetres(ir::Value(1), "the way back without VRT is 1 mm", "VRT", pos);
}

/// The first depth lies between the reference plane and the final depth.
bool first_depth(const Arguments& a, FileContext& c, WordPos pos) {
  const ir::Value first = a.get("FDEP"), top = a.get("RFP"), rtp = a.get("RTP");
  if (!first.literal() || !top.literal() || !rtp.literal()) return true;
  const double down = rtp.number < top.number ? 1 : -1;
  const ir::Value& end = a.get(a.says("DPR") ? "DPR" : "DP");
  const double depth =
      a.says("DPR") || absolute_mode(a) == 1 ? std::fabs(end.number) : down * (end.number - top.number);
  const double to_first = down * (first.number - top.number);
  if (to_first >= 0 && (!end.literal() || to_first <= depth + 1e-9)) return true;
  c.error("SIN-021", pos,
          to_first < 0 ? "FDEP lies on the wrong side of the reference plane (alarm 61107)"
                       : "FDEP lies behind the final depth (alarm 61107)",
          "FDEP is a coordinate; an amount is FDPR");
  return false;
}

/// A factor; a number above 1 is a percentage, if the eighth digit of AMODE is set.
bool first_feed(const Arguments& a, ir::Pecks& p, FileContext& c, WordPos pos) {
  if (!a.says("FRF")) return true;
  p.has_first_feed_factor = true;
  p.first_feed_factor = a.get("FRF");
  const ir::Value mode = a.get("AMODE");
  if (mode.literal() && mode.number >= 1e7) p.first_feed_factor = ir::scale(a.get("FRF"), 0.01);
  if (!p.first_feed_factor.literal() || (p.first_feed_factor.number > 0 && p.first_feed_factor.number <= 1))
    return true;
  c.error("SIN-021", pos, "FRF must be above 0 and not above 1: a factor of the feed for the first depth");
  return false;
}

bool pecks(const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  const ir::Value vari = a.get("VARI");
  if (!vari.literal() || (vari.number != 0 && vari.number != 1)) {
    c.error("SIN-021", pos, "VARI must be 0 (chip breaking) or 1 (swarf removal)");
    return false;
  }
  hole.kind = vari.number == 1 ? ir::HoleKind::peck_full : ir::HoleKind::peck_break;
  ir::Pecks& p = hole.pecks;
  p.first_from_surface = true;
  if (a.says("FDPR")) {
    p.first = absolute_value(a.get("FDPR"));
  } else if (a.given("FDEP")) {
    if (!first_depth(a, c, pos)) return false;
    p.first_to = level(a.get("FDEP"), ir::LevelBase::absolute);
  } else {
    c.error("SIN-021", pos, "CYCLE83 needs its first depth: FDEP or FDPR");
    return false;
  }
  const ir::Value dam = a.get("DAM");
  p.law = dam.is(0) ? ir::PeckLaw::balanced : ir::PeckLaw::arithmetic;
  p.degression = dam;
  if (dam.literal() && dam.number < 0) {
    p.law = ir::PeckLaw::geometric;
    p.degression = ir::negate(dam);
  }
  if (!dam.literal())
    c.note("SIN-021", pos, "DAM is taken as an amount, not as a factor: its sign is known only when the program runs");
  p.minimum = a.get("MDEP");
  if (hole.kind == ir::HoleKind::peck_break) {
    p.lift = chip_lift(a, c, pos);
  } else {
    p.reapproach_automatic = !a.says("DIS1");
    p.reapproach = a.get("DIS1");
    if (p.reapproach.literal() && p.reapproach.number < 0) {
      c.error("SIN-021", pos, "a negative DIS1 is a factor, and nothing here says of what: it is not carried",
              "write the distance itself, above zero");
      return false;
    }
    if (!p.reapproach.literal())
      c.note("SIN-021", pos, "DIS1 is taken as a distance: a run stops where it is below zero, which is a factor");
  }
  if (!first_feed(a, p, c, pos)) return false;
  if (!dwells(a, hole, c, pos)) return false;
  return axis_of_hole(a, hole, c, pos);
}

/// The sense that a parameter asks for: 3 and 4 as M3 and M4, 5 as M5; 0: `otherwise`.
bool sense_of(const Arguments& a, std::string_view name, bool may_stop, ir::SpindleStep otherwise, ir::SpindleStep& out,
              FileContext& c, WordPos pos) {
  const ir::Value v = a.get(name);
  out = otherwise;
  if (v.is(0)) return true;
  if (v.is(3)) return out = ir::SpindleStep::cw, true;
  if (v.is(4)) return out = ir::SpindleStep::ccw, true;
  if (v.is(5) && may_stop) return out = ir::SpindleStep::off, true;
  c.error("SIN-021", pos, std::string(name) + (may_stop ? " must be 3, 4 or 5" : " must be 3 or 4") + ", as a number");
  return false;
}

/// The sense after a tapping cycle. Without one the spindle is left as the cycle leaves it.
bool sense_after(const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  if (!sense_of(a, "SDAC", true, ir::SpindleStep::none, hole.spindle_after, c, pos)) return false;
  if (hole.spindle_after == ir::SpindleStep::none)
    c.warning("SIN-021", pos, "without SDAC (3, 4 or 5) it is not said how the spindle turns after the cycle");
  hole.spindle_after_retract = true;
  return true;
}

/// The pitch from PIT, or in mm from the size of a metric thread (MPIT); its sign is the hand.
bool pitch(const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  if (a.says("PITA") && !a.get("PITA").is(1)) {
    c.error("SIN-021", pos, "a pitch in threads per inch, inches or modules (PITA) is not carried yet");
    return false;
  }
  hole.pitch = a.get("PIT");
  if (a.says("PITA") && a.says("PIT"))
    hole.pitch = c.millimetres(hole.pitch, "PIT with PITA 1 is in millimetres", "PITA 0", pos);
  if (!a.says("MPIT")) return true;
  if (a.says("PIT")) {
    c.error("SIN-021", pos, "MPIT and PIT are both given");
    return false;
  }
  const ir::Value size = a.get("MPIT");
  const double coarse = size.literal() ? coarse_pitch(std::fabs(size.number)) : 0;
  if (coarse == 0) {
    c.error("SIN-021", pos, "MPIT must be the size of a metric thread, 3 to 48, as a number");
    return false;
  }
  hole.pitch = c.millimetres(ir::Value(size.number < 0 ? -coarse : coarse),
                             "a pitch by its size (MPIT) is in millimetres", "PIT", pos);
  return true;
}

/// CYCLE84: the spindle follows the axis (G331, G332); nothing is reversed by a command.
bool rigid_tap(const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  hole.kind = ir::HoleKind::tap;
  hole.rigid = true;
  if (!pitch(a, hole, c, pos) || !sense_after(a, hole, c, pos)) return false;
  if (hole.pitch.is(0)) {
    c.error("SIN-021", pos, "CYCLE84 needs its pitch: PIT or MPIT");
    return false;
  }
  hole.spindle_bottom = ir::SpindleStep::none;
  hole.orient_first = true;
  hole.orient_angle = a.get("POSS");
  hole.has_speed = a.says("SST");
  hole.speed = a.get("SST");
  hole.has_speed_out = a.says("SST1");
  hole.speed_out = a.get("SST1");
  const ir::Value vari = a.get("VARI");
  if (!vari.is(0) && !vari.is(1) && !vari.is(2)) {
    c.error("SIN-021", pos, "VARI must be 0 (one stroke), 1 (chip breaking) or 2 (swarf removal)");
    return false;
  }
  if (!vari.is(0) && a.says("DAM")) {
    hole.pecks.law = ir::PeckLaw::constant;
    hole.pecks.first = absolute_value(a.get("DAM"));
    if (vari.is(1)) hole.pecks.lift = chip_lift(a, c, pos);
  }
  return axis_of_hole(a, hole, c, pos);
}

/// CYCLE840: with an encoder (ENC 0) the dwell has no effect.
bool floating_tap(const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  hole.kind = ir::HoleKind::tap_floating;
  if (!pitch(a, hole, c, pos) || !sense_after(a, hole, c, pos)) return false;
  if (!sense_of(a, "SDR", false, ir::SpindleStep::usual, hole.spindle_bottom, c, pos)) return false;
  const ir::Value enc = a.get("ENC");
  if (!enc.is(0) && !enc.is(1) && !enc.is(11)) {
    c.error("SIN-021", pos, "this ENC is not carried yet: 0, 1 and 11 are");
    return false;
  }
  hole.rigid = enc.is(0);
  if (hole.rigid) hole.dwell_bottom = ir::Value(0);
  if (hole.rigid && hole.pitch.is(0)) {
    c.error("SIN-021", pos, "CYCLE840 with an encoder (ENC 0) needs its pitch: PIT or MPIT");
    return false;
  }
  if (hole.pitch.literal()) hole.pitch = absolute_value(hole.pitch);
  return axis_of_hole(a, hole, c, pos);
}

bool ream(const Arguments& a, ir::HoleCycle& hole) {
  hole.kind = ir::HoleKind::ream;
  hole.has_feed = a.says("FFR");
  hole.feed = a.get("FFR");
  hole.has_feed_out = a.says("RFF");
  hole.feed_out = a.get("RFF");
  return true;
}

bool oriented_bore(const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  hole.kind = ir::HoleKind::bore_shift;
  hole.orient_angle = a.get("POSS");
  hole.shift_u = a.get("RPA");
  hole.shift_v = a.get("RPO");
  hole.shift_w = a.get("RPAP");
  hole.spindle_after = ir::SpindleStep::none;
  return sense_of(a, "SDIR", false, ir::SpindleStep::usual, hole.spindle_before, c, pos);
}

/// What the cycle does beside going down to the bottom and back.
bool kind_of(std::string_view name, const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  if (name == "CYCLE83") return pecks(a, hole, c, pos);
  if (name == "CYCLE84") return rigid_tap(a, hole, c, pos);
  if (name == "CYCLE840") return floating_tap(a, hole, c, pos);
  if (name == "CYCLE85") return ream(a, hole);
  if (name == "CYCLE86") return oriented_bore(a, hole, c, pos);
  if (name == "CYCLE87" || name == "CYCLE88") {
    hole.kind = ir::HoleKind::bore_manual;
    return sense_of(a, "SDIR", false, ir::SpindleStep::usual, hole.spindle_before, c, pos);
  }
  if (name == "CYCLE89") hole.kind = ir::HoleKind::bore;
  return true;
}

/// GMODE: its tens lead the shank of the drill to the depth in place of the tip. DMODE: its units name the plane of the
/// cycle, 1 to 3 for G17 to G19.
bool tip_and_plane(const Arguments& a, FileContext& c, WordPos pos) {
  if (a.says("GMODE")) {
    c.error("SIN-021", pos,
            "this GMODE is not carried yet: the depth counts for the shank of the drill, not for its tip",
            "write 0 for GMODE, and the depth of the tip");
    return false;
  }
  const ir::Value mode = a.get("DMODE");
  const int named = mode.literal() && mode.number >= 0 && mode.number < 1e9 ? saturate<int>(mode.number) % 10 : 4;
  if (named == 0) return true;
  if (named > 3) {
    c.error("SIN-021", pos, "this DMODE is not carried yet");
    return false;
  }
  const auto plane = named == 1 ? ir::Plane::xy : named == 2 ? ir::Plane::zx : ir::Plane::yz;
  const std::string code = "G" + std::to_string(16 + named);
  if (c.plane && *c.plane != plane) {
    c.error("SIN-090", pos, "DMODE names the plane " + code + " for this cycle, and another one is in force here",
            "write " + code + " before the cycle, or 0 in the units of DMODE");
    return false;
  }
  if (!c.plane && (c.more_planes || plane != c.machine.profile->power_on.plane))
    c.warning("SIN-090", pos,
              "DMODE names the plane " + code +
                  " for this cycle, and the text does not tell whether it is the one in force; the cycle is taken to "
                  "work in the one in force",
              "write " + code + " before the cycle");
  return true;
}

/// The modes behind the newer signatures: only those that mean the same as none. The digits above the tens, one for
/// each further word, are taken for the usual reading (amounts, seconds) as long as none is above 1.
bool modes(const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  if (!tip_and_plane(a, c, pos)) return false;
  if (!a.says("AMODE")) return true;
  const ir::Value mode = a.get("AMODE");
  const int number = mode.literal() && mode.number < 1e9 ? saturate<int>(mode.number) : -1;
  const int depth = number % 10;
  const int time = number / 10 % 10;
  bool usual = true;
  for (int rest = number / 100; rest > 0; rest /= 10) usual = usual && rest % 10 <= 1;
  if (number < 0 || depth > 2 || time > 2 || !usual) {
    c.error("SIN-021", pos, "this AMODE is not carried yet");
    return false;
  }
  if (number >= 100)
    c.warning("SIN-081", pos,
              "digits of AMODE above the tens: the words that they speak of are taken as amounts and seconds");
  if (depth == 1 && hole.bottom.base == ir::LevelBase::absolute) hole.bottom = depth_by_amount(a);
  if (time == 2) {
    hole.dwell_bottom = absolute_value(hole.dwell_bottom);
    hole.dwell_in_revolutions = true;
  }
  return true;
}

/// CYCLE802 (18.2): up to nine positions, one behind the other.
ir::CyclePtr position_list(const CycleRow& row, const Arguments& a, FileContext& c, WordPos pos) {
  for (const std::string_view other : {"VARI", "UMODE"}) {
    if (!a.says(other)) continue;
    c.error("SIN-021", pos, "CYCLE802 with " + std::string(other) + " is not carried yet");
    return nullptr;
  }
  ir::NamedCycle named;
  named.name = "points.list";
  bool ended = false;
  for (char digit = '0'; digit <= '8'; ++digit) {
    const std::string x{'X', digit}, y{'Y', digit};
    const bool given = a.given(x) || a.given(y);
    if (given && (ended || !a.given(x) || !a.given(y))) {
      c.error("SIN-021", pos, "the positions of CYCLE802 are pairs without a gap: " + x + " or " + y + " is not given");
      return nullptr;
    }
    ended = !given;
    if (ended) continue;
    const char number = static_cast<char>(digit + 1);
    named.words.emplace_back(std::string{'u', number}, a.get(x));
    named.words.emplace_back(std::string{'v', number}, a.get(y));
  }
  if (named.words.empty()) {
    c.error("SIN-021", pos, std::string(row.name) + " has no position");
    return nullptr;
  }
  return std::make_shared<const ir::Cycle>(ir::Cycle{std::move(named)});
}

/// HOLES1, HOLES2, CYCLE801 (18.2): positions for the modal cycle.
ir::CyclePtr pattern(const std::string& name, const CycleRow& row, const Arguments& a, FileContext& c, WordPos pos) {
  if (name == "CYCLE802") return position_list(row, a, c, pos);
  const bool frame = a.get("VARI").is(1);
  for (const std::string_view other : {"ANG1", "ANG2", "HIDE", "NSP"}) {
    if (!a.given(other) || a.get(other).is(0)) continue;
    c.error("SIN-021", pos, name + " with " + std::string(other) + " is not carried yet");
    return nullptr;
  }
  if (a.says("VARI") && !frame) {
    c.error("SIN-021", pos, "VARI must be 0 (grid) or 1 (frame)");
    return nullptr;
  }
  for (const PatternRow& p : patterns()) {
    if (p.name != name || (frame && p.pattern != "points.frame")) continue;
    ir::NamedCycle named;
    named.name = std::string(p.pattern);
    std::string_view rest = p.parameters, places = row.parameters;
    while (!rest.empty()) {
      const auto next = [](std::string_view& list) {
        const std::size_t comma = list.find(',');
        const std::string_view one = list.substr(0, comma);
        list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 1);
        return one;
      };
      const std::string_view parameter = next(rest), place = next(places);
      named.words.emplace_back(std::string(parameter), a.get(place));
    }
    return std::make_shared<const ir::Cycle>(ir::Cycle{std::move(named)});
  }
  return nullptr;
}

}  // namespace

ir::CyclePtr StatementLowering::cycle(const std::string& name, const std::vector<Expr>& args, WordPos pos) {
  const CycleRow& row = *sinumerik::cycle(name);
  if (!row.carried || name == contour_cycle) {  // which stands alone, and not behind MCALL
    refuse(feature_of(row.family), pos, name + " is not carried yet");
    return nullptr;
  }
  if (row.family == CycleFamily::turning) return turning(name, args, pos);
  std::vector<ir::Value> values;
  std::vector<bool> given;
  const std::uint32_t before = c_.errors;
  for (const Expr& e : args) {
    Attribute attribute = Attribute::none;
    given.push_back(e.kind != ExprKind::missing);
    if (e.kind == ExprKind::string && names_a_table(row, values.size())) {  // the editor writes "" for none
      given.back() = false;
      values.emplace_back(0);
      if (!trim(e.text).empty())
        c_.keep("SIN-008", e.pos,
                name + " with a pitch from a table of the control is not carried: write it as a number");
      continue;
    }
    const bool names = e.kind == ExprKind::string && row.family == CycleFamily::milling &&
                       static_cast<int>(values.size()) == parameter_index(row, mill_contour_parameter);
    if (names)
      values.emplace_back(ir::string_literal(e.text));
    else
      values.push_back(given.back() ? exprs_.value_of(e, attribute) : ir::Value(0));
    if (attribute != Attribute::none)
      c_.error("SIN-012", e.pos, "AC() and IC() have no meaning in the call of a cycle");
  }
  if (c_.errors != before) return nullptr;
  const auto known = static_cast<std::size_t>(std::count(row.parameters.begin(), row.parameters.end(), ',')) + 1;
  for (std::size_t i = known; i < args.size(); ++i) {
    if (args[i].kind == ExprKind::missing || (row.family == CycleFamily::pattern && values[i].is(0))) continue;
    c_.warning("SIN-082", args[i].pos,
               name + " is carried with " + std::to_string(known) +
                   " parameters: this one and those behind it are "
                   "left out of account");
    break;
  }
  const Arguments a(row, std::move(values), std::move(given));
  if (a.knows("XA") && (!a.get("XA").is(all_absolute) || !a.get("YA").is(all_absolute))) {
    refuse(feature_of(row.family), pos, name + " with positions by increments (XA, YA) is not carried yet");
    return nullptr;
  }
  if (row.family == CycleFamily::pattern) return pattern(name, row, a, c_, pos);
  if (!a.given("RTP")) {
    c_.error("SIN-021", pos, name + " needs its planes: RTP, RFP, SDIS and a depth");
    return nullptr;
  }
  if (!a.given("DP") && !a.says("DPR")) {
    c_.error("SIN-021", pos, name + " needs its depth: DP or DPR");
    return nullptr;
  }
  ir::HoleCycle hole;
  planes(a, hole, c_, pos);
  if (row.family == CycleFamily::milling) {
    if (!milling_words(*milling_cycle(name, c_.machine.options.spigot_size), a, hole, c_, pos)) return nullptr;
    check_planes(hole, c_, pos);
    return std::make_shared<const ir::Cycle>(ir::Cycle{std::move(hole)});
  }
  dwell(a.get("DTB"), hole, c_, pos);
  if (!kind_of(name, a, hole, c_, pos)) return nullptr;
  if (!modes(a, hole, c_, pos)) return nullptr;
  check_planes(hole, c_, pos);
  auto out = std::make_shared<ir::Cycle>();
  out->node = std::move(hole);
  return out;
}

}  // namespace cnctrans::sinumerik
