#include "ir/analysis/rotary_places.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ir/analysis/dataflow.h"
#include "ir/analysis/flow_states.h"

namespace cnctrans::ir {

namespace {

constexpr std::array rotary{axis::a, axis::b, axis::c};

using Places = std::array<std::optional<double>, rotary.size()>;

double counted(double here, double word, RotaryDirection direction) {
  if (direction == RotaryDirection::as_value) return word;
  if (direction == RotaryDirection::by_sign) {
    direction = std::signbit(word) ? RotaryDirection::negative : RotaryDirection::positive;
    word = std::fabs(word);
  }
  double turn = std::fmod(word - here, 360);
  constexpr double nothing = 1e-9;
  if (std::fabs(turn) < nothing || std::fabs(std::fabs(turn) - 360) < nothing) return here;
  if (direction == RotaryDirection::positive && turn < 0) turn += 360;
  if (direction == RotaryDirection::negative && turn > 0) turn -= 360;
  if (direction == RotaryDirection::shortest && turn > 180) turn -= 360;
  if (direction == RotaryDirection::shortest && turn <= -180) turn += 360;
  return here + turn;
}

/// A shift of a rotary axis: words and places count from elsewhere.
bool shifts_rotary(const Program& program) {
  const auto is_rotary = [](AxisId a) { return std::find(rotary.begin(), rotary.end(), a) != rotary.end(); };
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      if (const auto* a = std::get_if<Assign>(&s.node)) {
        for (const auto& item : a->items) found = found || (item.to_system && is_rotary(item.system.axis));
      }
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        const auto* f = std::get_if<FrameOp>(&a.data);
        if (f == nullptr || !f->change) continue;
        for (const auto& w : f->change->words) found = found || is_rotary(w.axis);
      }
    });
  }
  return found;
}

/// Absolute or incremental, as the word, its block or what holds before it says.
std::optional<Distance> mode_of(const CoordWord& w, const Block& b, const Facts& before) {
  if (w.mode == WordMode::absolute) return Distance::absolute;
  if (w.mode == WordMode::incremental) return Distance::incremental;
  auto mode = before.settings[static_cast<std::size_t>(Setting::distance)];
  for (const auto& a : b.actions) {
    const auto* set = std::get_if<ModalSet>(&a.data);
    if (set != nullptr && set->setting == Setting::distance && a.order != Order::after) mode = set->value;
  }
  return mode ? std::optional(static_cast<Distance>(*mode)) : std::nullopt;
}

bool moves_rotary(const Routine& r) {
  bool found = false;
  for_each_statement(r.body, [&found](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr || !b->has_motion) return;
    for (const auto& w : b->motion.coords)
      found = found || std::find(rotary.begin(), rotary.end(), w.axis) != rotary.end();
  });
  return found;
}

/// The axes stand at 0 degrees where the main program begins.
class PlacesDomain {
 public:
  using State = Places;
  PlacesDomain(const Program& program, const FactTable& facts) : main_(program.main()), facts_(facts) {}

  Places start(const Routine& r, bool) const {
    Places at;
    if (&r == main_) at.fill(0.0);
    return at;
  }
  static bool touches(const Routine& r) { return moves_rotary(r); }
  static void unknown(Places& at) { at.fill(std::nullopt); }
  static bool join(Places& into, const Places& from) {
    bool changed = false;
    for (std::size_t i = 0; i < into.size(); ++i) {
      if (!into[i] || into[i] == from[i]) continue;
      into[i].reset();
      changed = true;
    }
    return changed;
  }
  void transfer(const Statement& s, Places& at) const {
    const auto* opaque = std::get_if<Opaque>(&s.node);
    if (opaque != nullptr && !opaque->harmless) unknown(at);
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr || !b->has_motion) return;
    for (const CoordWord& w : b->motion.coords) {
      const auto axis = std::find(rotary.begin(), rotary.end(), w.axis);
      if (axis == rotary.end()) continue;
      auto& place = at[static_cast<std::size_t>(axis - rotary.begin())];
      const auto mode = mode_of(w, *b, facts_.before(s.id));
      const bool plain = w.value.literal() && b->repeat_given == 0 && b->motion.frame == FrameUse::normal && mode;
      if (!plain || (!place && (*mode == Distance::incremental || w.direction != RotaryDirection::as_value)))
        place.reset();
      else
        place = *mode == Distance::incremental ? *place + w.value.number
                                               : counted(place.value_or(0), w.value.number, w.direction);
    }
  }

 private:
  const Routine* main_;
  const FactTable& facts_;
};

}  // namespace

RotaryPlaces::RotaryPlaces(const Program& program, const ModalState& power_on) {
  const bool moves = std::any_of(program.routines.begin(), program.routines.end(), moves_rotary);
  if (!moves || shifts_rotary(program)) return;
  const FactTable table = analyse(program, power_on);
  const PlacesDomain domain(program, table);
  const passes::FlowStates<PlacesDomain> states(program, domain);
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      const Places* before = states.before(s);
      if (b == nullptr || !b->has_motion || before == nullptr) return;
      Places after = *before;
      domain.transfer(s, after);
      for (const CoordWord& w : b->motion.coords) {
        const auto axis = std::find(rotary.begin(), rotary.end(), w.axis);
        if (axis == rotary.end()) continue;
        if (const auto& place = after[static_cast<std::size_t>(axis - rotary.begin())])
          targets_[{s.id, w.axis}] = *place;
      }
    });
  }
}

std::optional<double> RotaryPlaces::target(std::uint32_t statement, AxisId axis) const {
  const auto at = targets_.find({statement, axis});
  return at == targets_.end() ? std::nullopt : std::optional(at->second);
}

}  // namespace cnctrans::ir
