#include "ir/analysis/rotary_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ir/analysis/dataflow.h"

namespace cnctrans::ir {

namespace {

constexpr std::array rotary{axis::a, axis::b, axis::c};

/// Of one axis before a statement: no way leads here yet, a number, or several.
struct Place {
  bool reached = false;
  std::optional<double> value;
};
using Places = std::array<Place, rotary.size()>;

bool join(Places& into, const Places& from) {
  bool changed = false;
  for (std::size_t i = 0; i < into.size(); ++i) {
    if (!from[i].reached) continue;
    if (!into[i].reached) {
      into[i] = from[i];
      changed = true;
    } else if (into[i].value && into[i].value != from[i].value) {
      into[i].value.reset();
      changed = true;
    }
  }
  return changed;
}

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

}  // namespace

RotaryPlaces::RotaryPlaces(const Program& program, const ModalState& power_on) {
  if (shifts_rotary(program)) return;
  const Routine* main = program.main();
  const FactTable table = analyse(program, power_on);
  for (const auto& r : program.routines) routine(program, r, &r == main, table);
}

std::optional<double> RotaryPlaces::target(std::uint32_t statement, AxisId axis) const {
  const auto at = targets_.find({statement, axis});
  return at == targets_.end() ? std::nullopt : std::optional(at->second);
}

void RotaryPlaces::routine(const Program& program, const Routine& r, bool main, const FactTable& facts) {
  if (r.body.empty() || !moves_rotary(r)) return;
  const bool callee_moves = std::any_of(program.routines.begin(), program.routines.end(),
                                        [&](const Routine& other) { return &other != &r && moves_rotary(other); });
  const ControlFlow flow = control_flow(program, r);
  std::vector<Places> before(flow.successors.size());
  const std::uint32_t first = r.body.front().id;
  for (auto& p : before[first]) p = {true, main ? std::optional(0.0) : std::nullopt};
  const auto carry_out = [&](std::uint32_t id, Places& places, bool keep) {
    const Statement* s = flow.statements[id];
    if (s == nullptr) return;
    const bool call = std::holds_alternative<CallRoutine>(s->node) || std::holds_alternative<ModalCall>(s->node);
    const auto* repeat = std::get_if<Repeat>(&s->node);
    const bool unread = std::holds_alternative<Opaque>(s->node) && !std::get<Opaque>(s->node).harmless;
    if (unread || (callee_moves && (call || (repeat != nullptr && repeat->has_program)))) {
      for (auto& p : places) p.value.reset();
    }
    const auto* b = std::get_if<Block>(&s->node);
    if (b == nullptr || !b->has_motion) return;
    for (const CoordWord& w : b->motion.coords) {
      const auto at = std::find(rotary.begin(), rotary.end(), w.axis);
      if (at == rotary.end()) continue;
      Place& place = places[static_cast<std::size_t>(at - rotary.begin())];
      const auto mode = mode_of(w, *b, facts.before(id));
      const bool plain = w.value.literal() && b->repeat_given == 0 && b->motion.frame == FrameUse::normal && mode;
      if (!plain || (!place.value && (*mode == Distance::incremental || w.direction != RotaryDirection::as_value))) {
        place.value.reset();
        continue;
      }
      place.value = *mode == Distance::incremental ? *place.value + w.value.number
                                                   : counted(place.value.value_or(0), w.value.number, w.direction);
      if (keep) targets_[{id, w.axis}] = *place.value;
    }
  };
  std::vector<std::uint32_t> work{first};
  while (!work.empty()) {
    const std::uint32_t id = work.back();
    work.pop_back();
    Places after = before[id];
    carry_out(id, after, false);
    for (const std::uint32_t next : flow.successors[id]) {
      if (next != 0 && next < before.size() && join(before[next], after)) work.push_back(next);
    }
  }
  for (std::uint32_t id = 0; id < before.size(); ++id) {
    if (!before[id][0].reached) continue;
    Places after = before[id];
    carry_out(id, after, true);
  }
}

}  // namespace cnctrans::ir
