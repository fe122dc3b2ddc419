#include "backends/sinumerik/cycles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "base/saturate.h"
#include "dialects/sinumerik/cycles.h"
#include "dialects/sinumerik/milling.h"
#include "dialects/sinumerik/turning.h"
#include "ir/cycles/hole.h"
#include "ir/cycles/milling/mill_contour.h"
#include "ir/cycles/milling/milling.h"

namespace cnctrans::backends::sinumerik {
namespace {

namespace dialect = cnctrans::sinumerik;
using ir::HoleCycle;
using ir::HoleKind;
using ir::Level;
using ir::LevelBase;
using ir::Value;

constexpr double tiny = 1e-9;
constexpr double written_places = 1e6;  ///< of a unit: what a number is rounded to (tables.h)

using Arguments = std::map<std::string, Value, std::less<>>;

bool zero(const Value& v) {
  return v.is(0);
}

/// The value without its sign: depths and distances are unsigned on this control.
Value unsigned_value(const Value& v) {
  if (v.literal()) return v.number < 0 ? ir::negate(v) : v;
  const auto* u = std::get_if<ir::Unary>(&v.expr->node);
  if (u != nullptr && u->op == ir::UnaryOp::negate) return Value(u->operand);
  return v;
}

Value seconds(const HoleCycle& c, const Value& v) {
  const Value s = c.dwell_scale == 1 ? v : ir::scale(v, c.dwell_scale);
  return c.dwell_in_revolutions ? ir::negate(unsigned_value(s)) : s;
}

/// RFP and SDIS. Without a surface the reference plane is the surface, except for the usual plane a little above zero.
bool planes(const HoleCycle& c, Arguments& args) {
  const Level& r = c.reference;
  if (!r.given) return false;
  if (c.surface.given) {
    if (c.surface.base != LevelBase::absolute) return false;
    args["RFP"] = c.surface.value;
    if (r.base == LevelBase::from_surface) {
      args["SDIS"] = unsigned_value(r.value);
    } else if (r.base == LevelBase::absolute) {
      const Value distance = ir::subtract(r.value, c.surface.value);
      if (!distance.literal()) return false;
      args["SDIS"] = unsigned_value(distance);
    } else {
      return false;
    }
    return true;
  }
  if (r.base != LevelBase::absolute) return false;
  const bool pecks = c.kind == HoleKind::peck_full || c.kind == HoleKind::peck_break;
  const bool usual = !pecks && r.value.literal() && c.bottom.value.literal() && c.bottom.base == LevelBase::absolute &&
                     r.value.number > 0 && r.value.number <= 10 && c.bottom.value.number < 0;
  args["RFP"] = usual ? Value(0) : r.value;
  args["SDIS"] = usual ? r.value : Value(0);
  return true;
}

bool bottom(const HoleCycle& c, Arguments& args) {
  if (!c.bottom.given) return false;
  switch (c.bottom.base) {
    case LevelBase::absolute: args["DP"] = c.bottom.value; return true;
    case LevelBase::from_surface:
      if (!c.surface.given) return false;
      args["DPR"] = unsigned_value(c.bottom.value);
      return true;
    default: return false;
  }
}

/// The schedule: DAM 0 is the balanced law; equal pecks without remainder are the same under it.
bool degression(const HoleCycle& c, Arguments& args) {
  const ir::Pecks& p = c.pecks;
  args["DAM"] = Value(0);
  switch (p.law) {
    case ir::PeckLaw::balanced:
      if (!zero(p.minimum)) args["MDEP"] = p.minimum;
      return zero(p.degression);
    case ir::PeckLaw::geometric:
      if (!p.degression.literal() || p.degression.number <= 0) return false;
      args["DAM"] = ir::negate(p.degression);
      if (!zero(p.minimum)) args["MDEP"] = p.minimum;
      return true;
    case ir::PeckLaw::arithmetic:
      if (!p.degression.literal() || p.degression.number <= 0) return false;
      args["DAM"] = p.degression;
      if (!zero(p.minimum)) args["MDEP"] = p.minimum;
      return true;
    case ir::PeckLaw::constant: {
      std::string error;
      const auto numbers = ir::cycles::resolve(
          c, {}, [](const Value& v) { return v.literal() ? std::optional<double>(v.number) : std::nullopt; }, &error);
      if (!numbers) return false;
      const double depth = std::abs((numbers->from_surface ? numbers->surface : numbers->reference) - numbers->bottom);
      const double rest = std::fmod(depth, numbers->first);
      const bool equal_pecks = depth <= numbers->first + tiny || rest < tiny || numbers->first - rest < tiny;
      // A size cut off below its last decimal would leave a rest for a further peck.
      if (equal_pecks && args.count("FDPR") != 0) {
        const double up = std::ceil(numbers->first * written_places - 1e-3) / written_places;
        if (up > numbers->first) args["FDPR"] = Value(up);
      }
      return equal_pecks;
    }
    default: return false;
  }
}

bool first_peck(const HoleCycle& c, Arguments& args) {
  const ir::Pecks& p = c.pecks;
  if (!p.first_from_surface && !zero(args["SDIS"])) {  // counted from the reference plane: that becomes RFP
    if (c.reference.base != LevelBase::absolute) return false;
    args["RFP"] = c.reference.value;
    args["SDIS"] = Value(0);
    if (args.count("DPR") != 0) return false;
  }
  if (!p.first_to.given) {
    args["FDPR"] = unsigned_value(p.first);
    return true;
  }
  if (p.first_to.base == LevelBase::absolute) {
    args["FDEP"] = p.first_to.value;
    return true;
  }
  if (p.first_to.base != LevelBase::from_surface) return false;
  args["FDPR"] = unsigned_value(p.first_to.value);
  return true;
}

/// Dwells of CYCLE83: DTB after every peck, DTD at the final depth, where 0 or nothing means DTB.
bool peck_dwells(const HoleCycle& c, Arguments& args) {
  const bool every = !zero(c.pecks.dwell);
  const bool last = !zero(c.dwell_bottom);
  if (every && !last) return false;
  args["DTB"] = every ? seconds(c, c.pecks.dwell) : Value(0);
  if (last && !(every && ir::equal(c.pecks.dwell, c.dwell_bottom))) args["DTD"] = seconds(c, c.dwell_bottom);
  return true;
}

bool pecks(const HoleCycle& c, Arguments& args) {
  const ir::Pecks& p = c.pecks;
  if (p.withdraws_to_retract) return false;
  if (!first_peck(c, args) || !degression(c, args) || !peck_dwells(c, args)) return false;
  if (p.has_first_feed_factor)
    args["FRF"] = p.first_feed_factor;
  else
    args["FRF"] = Value(1);
  args["DTS"] = seconds(c, c.dwell_top);
  if (c.kind == HoleKind::peck_full) {
    args["VARI"] = Value(1);
    if (p.reapproach_automatic) return true;
    args["DIS1"] = p.reapproach;
    return !p.reapproach.literal() || p.reapproach.number > 0;
  }
  args["VARI"] = Value(0);
  if (p.lift_rapid || !zero(c.dwell_top)) return false;
  args["VRT"] = p.lift;
  return !p.lift.literal() || p.lift.number > 0;
}

/// Number of a sense as this control takes it; 0: none.
Value sense(ir::SpindleStep s) {
  switch (s) {
    case ir::SpindleStep::cw: return Value(3);
    case ir::SpindleStep::ccw: return Value(4);
    case ir::SpindleStep::off: return Value(5);
    default: return Value(0);
  }
}

/// The sense after a tap is switched behind the retract; that is the same when there is none.
bool switched_last(const HoleCycle& c) {
  if (c.spindle_after == ir::SpindleStep::none || c.spindle_after_retract) return true;
  return c.retract.given && c.retract.base == c.reference.base && ir::equal(c.retract.value, c.reference.value);
}

std::string_view tap(const HoleCycle& c, Arguments& args) {
  if (c.spindle_after == ir::SpindleStep::usual || !switched_last(c)) return {};
  if (!zero(c.dwell_bottom)) args["DTB"] = seconds(c, c.dwell_bottom);
  args["SDAC"] = sense(c.spindle_after);
  if (!zero(c.pitch)) args["PIT"] = c.pitch;
  if (c.kind == HoleKind::tap_floating) {
    if (c.pecks.law != ir::PeckLaw::none || c.orient_first || c.has_speed || c.has_speed_out) return {};
    if (c.spindle_bottom == ir::SpindleStep::none || c.spindle_bottom == ir::SpindleStep::off) return {};
    if (c.rigid && (zero(c.pitch) || !zero(c.dwell_bottom))) return {};
    args["SDR"] = sense(c.spindle_bottom);
    args["ENC"] = Value(c.rigid ? 0 : zero(c.pitch) ? 1 : 11);
    return "CYCLE840";
  }
  if (c.spindle_bottom != ir::SpindleStep::none || zero(c.pitch) || !c.orient_first) return {};
  args["POSS"] = c.orient_angle;
  if (c.has_speed) args["SST"] = c.speed;
  if (c.has_speed_out) args["SST1"] = c.speed_out;
  if (c.pecks.law == ir::PeckLaw::none) return "CYCLE84";
  if (c.pecks.law != ir::PeckLaw::constant || c.pecks.first_from_surface) return {};
  args["VARI"] = Value(zero(c.pecks.lift) ? 2 : 1);
  args["DAM"] = c.pecks.first;
  if (!zero(c.pecks.lift)) args["VRT"] = c.pecks.lift;
  return "CYCLE84";
}

/// Boring and reaming. Without a feed of its own reaming is CYCLE89: both feeds are the feed in force.
std::string_view bore(const HoleCycle& c, Arguments& args) {
  if (!zero(c.dwell_bottom)) args["DTB"] = seconds(c, c.dwell_bottom);
  const bool plain = c.spindle_after == ir::SpindleStep::usual || c.spindle_after == ir::SpindleStep::none;
  switch (c.kind) {
    case HoleKind::ream:
    case HoleKind::bore:
      if (!c.has_feed && !c.has_feed_out) return "CYCLE89";
      if (c.has_feed) args["FFR"] = c.feed;
      if (c.has_feed_out) args["RFF"] = c.feed_out;
      return "CYCLE85";
    case HoleKind::bore_shift:
      if (c.spindle_after != ir::SpindleStep::none) return {};
      args["SDIR"] = sense(c.spindle_before);
      args["RPA"] = c.shift_u;
      args["RPO"] = c.shift_v;
      args["RPAP"] = c.shift_w;
      args["POSS"] = c.orient_angle;
      return "CYCLE86";
    case HoleKind::bore_manual:
      if (!plain || c.spindle_bottom != ir::SpindleStep::usual) return {};
      args["SDIR"] = sense(c.spindle_before);
      return zero(c.dwell_bottom) ? "CYCLE87" : "CYCLE88";
    default: return {};
  }
}

/// The words of a milling cycle under the names of the row's parameters; false: some have none.
bool mill_words(const HoleCycle& c, const dialect::MillingCycle& row, std::string_view call, Arguments& words) {
  const auto parameter = [&row](std::string_view name) -> std::string_view {
    for (const auto& [own, word] : row.parameters) {
      if (!own.empty() && name == word) return own;
    }
    return {};
  };
  Arguments kept;
  for (const auto& [name, value] : c.mill.words) {
    if (ir::cycles::is_contour_word(name)) {
      words[std::string(dialect::mill_contour_parameter)] = Value(0);  // its text comes with the call
    } else if (ir::cycles::is_kept_word(name)) {
      kept[name.substr(ir::cycles::kept_word.size())] = value;
    } else if (const auto own = parameter(name); !own.empty()) {
      words[std::string(own)] = value;
    } else if (name == "step_factor" && !parameter("step").empty()) {  // AMODE, which is kept, says so
      words[std::string(parameter("step"))] = ir::scale(value, 100);
    } else {
      return false;
    }
  }
  for (const auto& [own, value] : kept) words[own] = value;
  if (kept.count(dialect::mill_contour_parameter) != 0) words.erase(std::string(dialect::mill_contour_parameter));
  const bool percent =
      words.count("AMODE") != 0 && words["AMODE"].literal() && static_cast<long>(words["AMODE"].number) / 10 % 10 == 1;
  const auto has = [&c](std::string_view name) {
    return std::any_of(c.mill.words.begin(), c.mill.words.end(), [name](const auto& w) { return w.first == name; });
  };
  if (has("step_factor") != (percent && !has("step"))) return false;
  return std::all_of(words.begin(), words.end(), [call](const auto& w) {
    return dialect::parameter_index(call, w.first) >= 0 || w.first == "DPR";
  });
}

/// A milling cycle with a parameter for every word; planes and depth are there already.
std::string_view mill(const HoleCycle& c, Arguments& args) {
  for (const auto& row : dialect::milling_cycles) {
    if (row.shape != c.mill.shape) continue;
    Arguments words = args;
    const auto* call = dialect::cycle(row.name);
    bool all = mill_words(c, row, call->parameters, words);
    for (std::string_view rest = row.needs; !rest.empty();) {
      const auto comma = std::min(rest.find(','), rest.size());
      all = all && words.count(rest.substr(0, comma)) != 0;
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    if (!all) continue;
    if (words.count("DPR") != 0 && dialect::parameter_index(*call, "DPR") < 0) {  // DP as an increment
      words["DP"] = words["DPR"];
      if (words.count("AMODE") == 0) words["AMODE"] = Value(1);
      words.erase("DPR");
    }
    args = std::move(words);
    return row.name;
  }
  return {};
}

/// The plane to go back to lies beyond the reference plane: the cycle takes RTP for the side of the tool.
bool retracts_into_hole(const HoleCycle& c) {
  const auto number = [](const Level& l) { return l.given && l.base == LevelBase::absolute && l.value.literal(); };
  if (!number(c.retract) || !number(c.reference) || !number(c.bottom)) return false;
  const double out = c.reference.value.number - c.bottom.value.number;
  return (c.retract.value.number - c.reference.value.number) * out < 0;
}

/// Name of the standard cycle and its arguments; empty: it can't be said exactly.
std::string_view arguments(const HoleCycle& c, Arguments& args) {
  const bool taps = c.kind == HoleKind::tap || c.kind == HoleKind::tap_floating;
  const bool reams = c.kind == HoleKind::ream || c.kind == HoleKind::bore;
  if ((c.has_feed || c.has_feed_out) && !reams) return {};
  if (c.reference_may_be_below || c.approach_by_retract || c.keeps_initial) return {};
  const bool pecking = c.kind == HoleKind::peck_full || c.kind == HoleKind::peck_break;
  const bool named = pecking || taps || (c.kind == HoleKind::mill && c.axis != ir::axis::none);
  if (c.axis != ir::axis::none && (!named || c.axis > ir::axis::z)) return {};
  if (c.axis != ir::axis::none && c.kind != HoleKind::mill) args["AXN"] = Value(c.axis + 1);  // milling: by its DMODE
  if (!c.retract.given || c.retract.base != LevelBase::absolute) return {};
  if (retracts_into_hole(c)) return {};
  args["RTP"] = c.retract.value;
  if (!planes(c, args) || !bottom(c, args)) return {};
  if (taps) return tap(c, args);
  if (c.kind == HoleKind::mill) return mill(c, args);
  if (c.has_speed || c.has_speed_out || c.orient_first) return {};
  switch (c.kind) {
    case HoleKind::drill:
      if (!zero(c.dwell_top) || c.pecks.has_first_feed_factor) return {};
      if (zero(c.dwell_bottom)) return "CYCLE81";
      args["DTB"] = seconds(c, c.dwell_bottom);
      return "CYCLE82";
    case HoleKind::peck_full:
    case HoleKind::peck_break: return pecks(c, args) ? "CYCLE83" : std::string_view{};
    default: return bore(c, args);
  }
}

const dialect::PatternRow* pattern_of(std::string_view name) {
  for (const auto& p : dialect::patterns()) {
    if (p.pattern == name) return &p;
  }
  return nullptr;
}

/// The pattern's parameters stand in the order of the call; a frame is the variant 1 behind them.
std::string pattern_call(const dialect::PatternRow& row, const ir::NamedCycle& c,
                         const std::function<std::string(const Value&)>& print) {
  std::string call = std::string(row.name) + '(';
  const bool list = row.pattern == "points.list";
  if (list) call += dialect::every_place_absolute;
  std::string_view rest = row.parameters;
  for (bool first = true; !rest.empty(); first = false) {
    const std::size_t comma = rest.find(',');
    const std::string_view name = rest.substr(0, comma);
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
    if (!first) call += ',';
    for (const auto& [word, value] : c.words) {
      if (word == name) call += print(value);
    }
  }
  while (list && call.back() == ',') call.pop_back();
  if (row.pattern == "points.frame") call += ",1";
  return call + ')';
}

}  // namespace

bool native_cycle(const ir::Cycle& cycle) {
  if (const auto* named = std::get_if<ir::NamedCycle>(&cycle.node))
    return dialect::cycle(named->name) != nullptr || dialect::turning_cycle(named->name) != nullptr ||
           pattern_of(named->name) != nullptr;
  const auto& hole = std::get<HoleCycle>(cycle.node);
  const bool unnamed = ir::cycles::has_contours(hole) && ir::cycles::contours_named(hole).empty();  // only as points
  Arguments args;
  return !unnamed && !arguments(hole, args).empty();
}

/// The parameter of the control for one of the IR.
static std::string_view own_name(const dialect::TurningCycle* cycle, std::string_view word) {
  if (cycle == nullptr) return word;
  for (const auto& [own, neutral] : cycle->parameters) {
    if (neutral == word) return own;
  }
  return word;
}

/// "LB100:LB140" with its quotes, or the name of a subprogram; empty: the cycle has no contour.
static std::string contour_text(const ir::NamedCycle& cycle) {
  std::string first, last;
  for (const auto& [word, v] : cycle.words) {
    const auto* s = v.expr ? std::get_if<ir::String>(&v.expr->node) : nullptr;
    const std::string text = s != nullptr ? s->text : 'N' + std::to_string(saturate<long>(v.number));
    if (word == "routine") return '"' + text + '"';
    if (word == "first_label") first = text;
    if (word == "last_label") last = text;
  }
  return first.empty() ? std::string() : '"' + first + ':' + last + '"';
}

std::string cycle_call(const ir::Cycle& cycle, const std::function<std::string(const Value&)>& print) {
  Arguments args;
  std::string name, contour;
  if (const auto* named = std::get_if<ir::NamedCycle>(&cycle.node)) {
    if (const auto* p = pattern_of(named->name)) return pattern_call(*p, *named, print);
    const auto* turning = dialect::turning_cycle(named->name);
    name = turning != nullptr ? turning->name : named->name;
    for (const auto& [word, value] : named->words) args[std::string(own_name(turning, word))] = value;
    if (turning != nullptr) contour = contour_text(*named);
  } else {
    name = arguments(std::get<HoleCycle>(cycle.node), args);
    const auto contours = ir::cycles::contours_named(std::get<HoleCycle>(cycle.node));
    if (!contours.empty() && args.count(dialect::mill_contour_parameter) != 0) contour = contour_text(contours.front());
  }
  const dialect::CycleRow* row = dialect::cycle(name);
  if (row == nullptr) return {};
  std::vector<std::string> texts;
  for (const auto& [word, value] : args) {
    const int at = dialect::parameter_index(*row, word);
    if (at < 0) continue;
    if (texts.size() <= static_cast<std::size_t>(at)) texts.resize(static_cast<std::size_t>(at) + 1);
    const bool letter = word == dialect::form_parameter && value.literal();
    texts[static_cast<std::size_t>(at)] =
        letter ? std::string{'"', static_cast<char>(saturate<int>(value.number)), '"'} : print(value);
  }
  if (!contour.empty()) {
    texts.resize(std::max<std::size_t>(texts.size(), 1));
    texts[0] = contour;
  }
  std::string call = name + '(';
  for (std::size_t i = 0; i < texts.size(); ++i) call += (i == 0 ? "" : ",") + texts[i];
  return call + ')';
}

}  // namespace cnctrans::backends::sinumerik
