// Words of a hole cycle -> numbers.
#include <cmath>

#include "ir/cycles/hole.h"

namespace cnctrans::ir::cycles {
namespace {

/// Reads values one after the other; the first that is not known makes everything unknown.
class WordReader {
 public:
  WordReader(const HoleContext& context, const Evaluate& evaluate) : context_(context), evaluate_(evaluate) {}

  double raw(const Value& v) {
    const auto x = evaluate_(v);
    if (!x) known_ = false;
    return x.value_or(0);
  }
  double length(const Value& v) { return raw(v) * context_.length_unit; }
  double seconds(const Value& v, double scale) { return raw(v) * scale; }

  double level(const Level& l, double surface, double reference) {
    const auto base = l.base == LevelBase::distance_mode
                          ? (context_.distance == Distance::absolute ? LevelBase::absolute : l.otherwise)
                          : l.base;
    switch (base) {
      case LevelBase::from_initial: return context_.height + raw(l.value) * context_.level_unit;
      case LevelBase::from_reference: return reference + length(l.value);
      case LevelBase::from_surface: return surface + length(l.value);
      case LevelBase::absolute:
      case LevelBase::distance_mode: break;
    }
    return raw(l.value) * context_.level_unit;
  }
  [[nodiscard]] bool known() const { return known_; }

 private:
  const HoleContext& context_;
  const Evaluate& evaluate_;
  bool known_ = true;
};

/// Surface and reference plane may lean on each other; either may be left out.
void read_planes(const HoleCycle& c, WordReader& read, HoleNumbers& n) {
  if (c.surface.given && c.surface.base == LevelBase::from_reference) {
    if (c.reference.given)
      n.reference = read.level(c.reference, n.initial, n.initial);
    else
      n.reference = n.initial;
    n.surface = read.level(c.surface, n.initial, n.reference);
    return;
  }
  if (c.surface.given) n.surface = read.level(c.surface, n.initial, n.initial);
  n.reference = n.initial;
  if (c.reference.given) {
    n.reference = read.level(c.reference, c.surface.given ? n.surface : n.initial, n.initial);
  }
  if (!c.surface.given) n.surface = n.reference;
}

void read_pecks(const HoleCycle& c, WordReader& read, HoleNumbers& n) {
  const auto& p = c.pecks;
  n.law = p.law;
  n.from_surface = p.first_from_surface;
  n.count = read.raw(p.count);
  const double first = read.length(p.first);
  n.first = std::abs(first);
  n.degression = p.law == PeckLaw::geometric ? read.raw(p.degression) : read.length(p.degression);
  n.minimum = read.length(p.minimum);
  n.lift = read.length(p.lift);
  n.reapproach = read.length(p.reapproach);
  n.reapproach_automatic = p.reapproach_automatic;
  n.lift_rapid = p.lift_rapid;
  n.withdraws_to_retract = p.withdraws_to_retract;
  n.dwell_peck = read.seconds(p.dwell, c.dwell_scale);
  if (p.has_first_feed_factor) n.first_feed_factor = read.raw(p.first_feed_factor);
  if (p.law == PeckLaw::count && !c.bottom.given) n.bottom = n.reference + std::round(n.count) * first;
}

bool sensible(const HoleCycle& c, HoleNumbers& n, std::string* error) {
  const bool by_count = n.law == PeckLaw::count;
  if (!c.bottom.given && !by_count) {
    *error = "the cycle has no final depth";
    return false;
  }
  const double depth = std::abs(n.reference - n.bottom);
  if (depth < 1e-9) {
    *error = "the final depth of the cycle is its reference plane";
    return false;
  }
  n.up = n.reference > n.bottom ? 1 : -1;
  const bool pecks = n.kind == HoleKind::peck_full || n.kind == HoleKind::peck_break;
  const bool tap = n.kind == HoleKind::tap || n.kind == HoleKind::tap_floating;
  if ((pecks || tap) && n.law != PeckLaw::none && n.first < 1e-9) {
    *error = "the first peck of the cycle is zero";
    return false;
  }
  if (tap && !c.pitch.literal() && n.pitch == 0) {
    *error = "the pitch of the tap is zero";
    return false;
  }
  if (pecks && !n.reapproach_automatic && n.reapproach < 0) {
    *error =
        "the distance above the last depth, where feeding starts again, is negative: that would be a rapid into the "
        "stock";
    return false;
  }
  if (pecks && by_count && n.count < 0.5) {
    *error = "the number of pecks of the cycle is not at least 1";
    return false;
  }
  return true;
}

}  // namespace

std::optional<HoleNumbers> resolve(const HoleCycle& c, const HoleContext& context, const Evaluate& evaluate,
                                   std::string* error) {
  error->clear();
  WordReader read(context, evaluate);
  HoleNumbers n;
  n.kind = c.kind;
  n.initial = context.height;
  read_planes(c, read, n);
  if (c.bottom.given) n.bottom = read.level(c.bottom, n.surface, n.reference);
  n.has_retract = c.retract.given;
  if (c.retract.given) n.retract = read.level(c.retract, n.surface, n.reference);
  n.dwell_bottom = read.seconds(c.dwell_bottom, c.dwell_scale);
  n.dwell_top = read.seconds(c.dwell_top, c.dwell_scale);
  n.dwell_in_revolutions = c.dwell_in_revolutions;
  n.has_feed = c.has_feed;
  if (c.has_feed) n.feed = read.raw(c.feed) * context.feed_unit;
  n.has_feed_out = c.has_feed_out;
  if (c.has_feed_out) n.feed_out = read.raw(c.feed_out) * context.feed_unit;
  read_pecks(c, read, n);
  n.pitch = read.length(c.pitch);
  n.orient_angle = read.raw(c.orient_angle);
  n.shift_u = read.length(c.shift_u);
  n.shift_v = read.length(c.shift_v);
  n.shift_w = read.length(c.shift_w);
  n.approach_by_retract = c.approach_by_retract;
  n.orient_first = c.orient_first;
  n.rigid = c.rigid;
  n.spindle_before = c.spindle_before;
  n.spindle_bottom = c.spindle_bottom;
  n.spindle_after = c.spindle_after;
  n.spindle_after_retract = c.spindle_after_retract;
  n.has_speed = c.has_speed;
  if (c.has_speed) n.speed = read.raw(c.speed);
  n.has_speed_out = c.has_speed_out;
  if (c.has_speed_out) n.speed_out = read.raw(c.speed_out);
  double first_level = 0;
  if (c.pecks.first_to.given) first_level = read.level(c.pecks.first_to, n.surface, n.reference);
  if (!read.known()) return std::nullopt;
  if (c.pecks.first_to.given) n.first = std::abs((n.from_surface ? n.surface : n.reference) - first_level);
  if (!sensible(c, n, error)) return std::nullopt;
  return n;
}

std::pair<const Value*, const Value*> own_place(const HoleCycle& cycle) {
  std::pair<const Value*, const Value*> place{nullptr, nullptr};
  for (const auto& [name, v] : cycle.mill.words) {
    if (name == "u") place.first = &v;
    if (name == "v") place.second = &v;
  }
  return place;
}

bool ends_over_its_place(const HoleCycle& cycle, bool own_too) {
  if (cycle.axis != axis::none) return false;
  if (cycle.kind != HoleKind::mill) return cycle.mill.shape.empty();  // else it goes to where a pocket begins
  if (cycle.mill.shape != "pocket.rect" && cycle.mill.shape != "pocket.circle") return false;
  const auto place = own_place(cycle);
  return own_too || (place.first == nullptr && place.second == nullptr);
}

}  // namespace cnctrans::ir::cycles
