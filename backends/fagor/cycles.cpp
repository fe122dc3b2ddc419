#include "backends/fagor/cycles.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dialects/fagor/cycles.h"
#include "dialects/fagor/limits.h"
#include "dialects/fagor/milling.h"
#include "ir/cycles/hole.h"

namespace cnctrans::backends::fagor {
namespace {

using ir::HoleCycle;
using ir::Level;
using ir::LevelBase;
using ir::Value;

constexpr double tiny = 1e-9;

bool zero(const Value& v) {
  return v.is(0);
}

/// A level as a coordinate of absolute mode; a level that follows the mode stays as written.
std::optional<Value> coordinate(const HoleCycle& c, const Level& l) {
  switch (l.base) {
    case LevelBase::absolute:
    case LevelBase::distance_mode: return l.value;
    case LevelBase::from_surface: {
      if (!c.surface.given || c.surface.base != LevelBase::absolute) return std::nullopt;
      return zero(l.value) ? c.surface.value : ir::add(c.surface.value, l.value);
    }
    case LevelBase::from_reference: {
      if (&l == &c.reference || !c.reference.given) return std::nullopt;
      const auto reference = coordinate(c, c.reference);
      if (!reference || c.reference.base == LevelBase::distance_mode) return std::nullopt;
      return zero(l.value) ? *reference : ir::add(*reference, l.value);
    }
    case LevelBase::from_initial: return std::nullopt;
  }
  return std::nullopt;
}

bool plain_hole(const HoleCycle& c) {
  return !c.has_feed && !c.has_feed_out && !c.dwell_in_revolutions && zero(c.dwell_top) && c.axis == ir::axis::none &&
         !c.approach_by_retract && !c.reference_may_be_below && !c.pecks.has_first_feed_factor && !c.orient_first &&
         !c.has_speed && !c.has_speed_out && c.spindle_before == ir::SpindleStep::usual &&
         c.spindle_bottom == ir::SpindleStep::usual && c.spindle_after == ir::SpindleStep::usual &&
         !c.spindle_after_retract;
}

/// Equal pecks, and the control's own 1 mm above the last bottom: G83.
bool equal_pecks(const HoleCycle& c, CycleWords& w) {
  const ir::Pecks& p = c.pecks;
  if (!zero(p.dwell) || p.withdraws_to_retract) return false;
  const bool usual_gap = !p.reapproach_automatic && (p.reapproach.is(1) || p.reapproach.is(1 / 25.4));
  if (c.kind != ir::HoleKind::peck_full || !usual_gap || !zero(c.dwell_bottom) || p.first_to.given) return false;
  if (p.law == ir::PeckLaw::count && (!c.bottom.given || c.bottom.base == LevelBase::from_reference)) {
    w.depth = p.first;
    w.count = p.count;
    const bool other_way = c.bottom.given && c.bottom.value.literal() && p.first.literal() &&
                           (c.bottom.value.number < 0) != (p.first.number < 0);
    if (other_way) w.depth = ir::negate(p.first);
    return true;
  }
  if (c.reference.base == LevelBase::distance_mode) return false;
  std::string error;
  const auto literal = [](const Value& v) { return v.literal() ? std::optional<double>(v.number) : std::nullopt; };
  const auto n = ir::cycles::resolve(c, {}, literal, &error);
  if (!n || n->from_surface) return false;
  const auto sizes = ir::cycles::peck_sizes(*n, std::abs(n->reference - n->bottom));
  if (sizes.empty()) return false;
  for (const double s : sizes) {
    if (std::abs(s - sizes.front()) > tiny) return false;
  }
  w.depth = Value(-n->up * sizes.front());
  w.count = Value(static_cast<double>(sizes.size()));
  return true;
}

/// G69: pecks by a factor, dwell after every one, from the surface D below the reference plane (25.3).
bool variable_pecks(const HoleCycle& c, CycleWords& w) {
  const ir::Pecks& p = c.pecks;
  const bool geometric = p.law == ir::PeckLaw::geometric;
  if (c.kind != ir::HoleKind::peck_full || (p.law != ir::PeckLaw::constant && !geometric)) return false;
  if (p.withdraws_to_retract || p.reapproach_automatic || p.first_to.given || !c.bottom.given ||
      !ir::equal(p.dwell, c.dwell_bottom))
    return false;
  if (!p.reapproach.literal() || p.reapproach.number <= 0) return false;
  const auto bottom = coordinate(c, c.bottom);
  if (!bottom) return false;
  w.depth = *bottom;
  w.more.emplace_back('B', p.first);
  const bool usual_gap = p.reapproach.is(1) || p.reapproach.is(1 / 25.4);
  if (!usual_gap || !p.reapproach.text.empty()) w.more.emplace_back('C', p.reapproach);
  if (c.surface.given) {
    const Value& v = c.surface.value;
    const auto* minus = v.literal() ? nullptr : std::get_if<ir::Unary>(&v.expr->node);
    if (!p.first_from_surface || c.surface.base != LevelBase::from_reference || (!v.literal() && minus == nullptr))
      return false;
    w.more.emplace_back('D', minus != nullptr ? Value(minus->operand) : Value(std::fabs(v.number)));
  }
  if (!zero(c.dwell_bottom)) {
    w.dwell = c.dwell_bottom;
    w.dwell_scale = c.dwell_scale;
  }
  if (geometric) {
    if (!zero(p.minimum)) w.more.emplace_back('L', p.minimum);
    w.more.emplace_back('R', p.degression);
  }
  w.code = "G69";
  return true;
}

/// Cycles of one feed to the bottom that differ in how the tool leaves (25.3). G84: the pitch is F over S.
std::string_view one_stroke(const HoleCycle& c) {
  switch (c.kind) {
    case ir::HoleKind::tap_floating: return zero(c.pitch) ? "G84" : "";
    case ir::HoleKind::tap: return zero(c.pitch) && c.rigid ? "G84" : "";
    case ir::HoleKind::ream: return "G85";
    case ir::HoleKind::bore_stop: return "G86";
    case ir::HoleKind::bore: return "G89";
    default: return "";
  }
}

/// Value of a word of a milling cycle; null: not there.
const Value* mill_word(const HoleCycle& c, std::string_view name) {
  for (const auto& [word, value] : c.mill.words) {
    if (word == name) return &value;
  }
  return nullptr;
}

/// G87 and G88 (25.3): every word has a letter, and those without say what the control takes for granted.
bool pocket(const HoleCycle& c, CycleWords& w) {
  namespace facts = dialects::fagor;
  const auto* step = mill_word(c, "step_factor");
  const auto* plunge = mill_word(c, "plunge_factor");
  if (step == nullptr || !step->is(facts::pocket_step) || plunge == nullptr || !plunge->is(facts::pocket_plunge))
    return false;
  for (const auto& row : facts::milling_cycles) {
    if (row.shape != c.mill.shape) continue;
    std::size_t found = 2;
    for (const auto& l : row.letters) {
      const auto* v = l.letter == 0 ? nullptr : mill_word(c, l.parameter);
      if (v == nullptr) continue;
      w.more.emplace_back(l.letter, *v);
      ++found;
    }
    if (found != c.mill.words.size()) return false;
    if (c.surface.given) {
      const Value& v = c.surface.value;
      const auto* minus = v.literal() ? nullptr : std::get_if<ir::Unary>(&v.expr->node);
      if (c.surface.base != LevelBase::from_reference || (!v.literal() && minus == nullptr)) return false;
      const auto place = std::find_if(w.more.begin(), w.more.end(), [](const auto& word) {
        return std::string_view("HLV").find(word.first) != std::string_view::npos;
      });
      w.more.emplace(place, 'D', minus != nullptr ? Value(minus->operand) : Value(std::fabs(v.number)));
    }
    w.printed_order = true;
    w.code = row.name;
    return true;
  }
  return false;
}

bool reference_word(const HoleCycle& c, CycleWords& w) {
  const Level& r = c.reference;
  if (!r.given || (r.base == LevelBase::from_initial && zero(r.value))) return true;  // left out: the present height
  const auto value = coordinate(c, r);
  if (!value) return false;
  w.has_reference = true;
  w.reference = *value;
  return true;
}

bool retract_words(const HoleCycle& c, CycleWords& w) {
  if (!c.retract.given) return true;
  const auto value = coordinate(c, c.retract);
  if (!value || c.retract.base == LevelBase::distance_mode || c.reference.base == LevelBase::distance_mode)
    return false;
  w.retract_given = true;
  w.retract = *value;
  w.retract_is_reference = w.has_reference && ir::equal(w.retract, w.reference);
  return w.has_reference;
}

}  // namespace

std::optional<CycleWords> cycle_words(const ir::Cycle& cycle) {
  const auto* c = std::get_if<HoleCycle>(&cycle.node);
  if (c == nullptr || !plain_hole(*c)) return std::nullopt;
  CycleWords w;
  if (!c->dwell_bottom.literal() && c->dwell_scale != 0.01) return std::nullopt;  // K is in hundredths
  if (!reference_word(*c, w) || !retract_words(*c, w)) return std::nullopt;
  if (c->kind == ir::HoleKind::mill) {
    const auto bottom = c->bottom.given ? coordinate(*c, c->bottom) : std::nullopt;
    if (!bottom || !pocket(*c, w)) return std::nullopt;
    w.depth = *bottom;
    return w;
  }
  if (c->kind == ir::HoleKind::drill) {
    if (c->pecks.law != ir::PeckLaw::none || !c->bottom.given) return std::nullopt;
    const auto bottom = coordinate(*c, c->bottom);
    if (!bottom) return std::nullopt;
    w.depth = *bottom;
    w.code = "G81";
    if (!zero(c->dwell_bottom)) {
      w.code = "G82";
      w.dwell = c->dwell_bottom;
      w.dwell_scale = c->dwell_scale;
    }
    return w;
  }
  if (const auto code = one_stroke(*c); !code.empty()) {
    const auto bottom = c->bottom.given ? coordinate(*c, c->bottom) : std::nullopt;
    if (!bottom || c->pecks.law != ir::PeckLaw::none) return std::nullopt;
    w.depth = *bottom;
    w.code = code;
    if (!zero(c->dwell_bottom)) {
      w.dwell = c->dwell_bottom;
      w.dwell_scale = c->dwell_scale;
    }
    if (c->kind == ir::HoleKind::tap) w.more.emplace_back('R', Value(1.0));
    return w;
  }
  if (equal_pecks(*c, w)) {
    w.code = "G83";
    return w;
  }
  if (!variable_pecks(*c, w)) return std::nullopt;
  return w;
}

/// K has room for the dwell; one that is computed is taken to fit.
static bool dwell_fits(const Value& v, double hundredths) {
  return !v.literal() || v.number * hundredths <= dialects::fagor::max_dwell;
}

bool native_cycle(const ir::Cycle& cycle) {
  const auto w = cycle_words(cycle);
  return w && (!w->dwell || dwell_fits(*w->dwell, w->dwell_scale * 100));
}

bool native_machining(const ir::Cycle& cycle) {
  const auto* named = std::get_if<ir::NamedCycle>(&cycle.node);
  const auto* row = named == nullptr ? nullptr : dialects::fagor::find_cycle(named->name);
  if (row == nullptr) return false;
  const bool fits = std::all_of(named->words.begin(), named->words.end(),
                                [](const auto& w) { return w.first != "dwell" || dwell_fits(w.second, 1); });
  return fits && std::all_of(named->words.begin(), named->words.end(), [row](const auto& w) {
           return !w.first.ends_with("_label") &&
                  std::any_of(row->letters.begin(), row->letters.end(),
                              [&w](const auto& l) { return l.letter != 0 && l.parameter == w.first; });
         });
}

std::string_view level_problem(const HoleCycle& c, std::optional<ir::Distance> distance) {
  const auto follows = [](const Level& l, LevelBase otherwise) {
    return !l.given || (l.base == LevelBase::distance_mode && l.otherwise == otherwise) ||
           (l.base == LevelBase::from_initial && zero(l.value));
  };
  const bool pecks_by_count = c.kind == ir::HoleKind::peck_full;
  const bool always =
      follows(c.reference, LevelBase::from_initial) && (pecks_by_count || follows(c.bottom, LevelBase::from_reference));
  if (always && !c.retract.given) return {};
  if (!distance) return "whether the levels of this cycle are absolute depends on the path that leads here";
  const bool mixed =
      (c.reference.base == LevelBase::distance_mode && c.reference.otherwise != LevelBase::from_initial) ||
      (c.bottom.base == LevelBase::distance_mode && c.bottom.otherwise != LevelBase::from_reference);
  if (*distance == ir::Distance::incremental) {
    return mixed || !always ? "the absolute levels of this cycle can't be written while increments are programmed (G91)"
                            : "";
  }
  return {};
}

}  // namespace cnctrans::backends::fagor
