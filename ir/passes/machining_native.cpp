// Machining cycles of a lathe as cycles of the target, and those whose words only the run knows.
#include <algorithm>
#include <cmath>
#include <limits>

#include "ir/passes/blocks.h"
#include "ir/passes/machining_moves.h"

namespace cnctrans::ir::passes {

namespace {

using cycles::TurnMove;
using cycles::TurnNumbers;
using cycles::TurnStep;

std::optional<double> known(const Value& v) {
  return v.literal() ? std::optional(v.number) : constant_value(v.expr);
}

bool same_move(const TurnMove& a, const TurnMove& b) {
  constexpr double room = 5e-4;  // mm: what a target of three places rounds away
  const auto near = [](double u, double v, double by) { return std::abs(u - v) <= by; };
  return a.step == b.step && near(a.to.x, b.to.x, room) && near(a.to.z, b.to.z, room) &&
         near(a.centre.x, b.centre.x, room) && near(a.centre.z, b.centre.z, room) && a.ccw == b.ccw &&
         near(a.pitch, b.pitch, 1e-6) && near(a.start_angle, b.start_angle, 1e-4) &&
         near(a.pitch_change, b.pitch_change, 1e-6) && near(a.seconds, b.seconds, 5e-3) && a.has_feed == b.has_feed &&
         near(a.feed, b.feed, 1e-6);
}

TurnMove rapid_to(cycles::TurnPoint place) {
  TurnMove m;
  m.to = place;
  return m;
}

}  // namespace

std::optional<TurnForm> TurnCycles::native(const NamedCycle& named, const Statement& s, const Block& b,
                                           const Facts& facts) const {
  const auto& accepts = context_.target.native_cycle;
  const auto it = sites_.find(s.id);
  if (!accepts || context_.options.cycles == CycleWriting::explode || it == sites_.end()) return std::nullopt;
  const auto m = modes_at(b, facts, context_.source_machine.power_on);
  // The words of a cycle keep their numbers: both controls have to count them the same way.
  if (!m || m->units != Units::metric || m->diameter == DiameterMode::absolute_only) return std::nullopt;
  if (m->distance != Distance::absolute) return std::nullopt;
  if (!context_.target.diameter_switch && context_.target.fixed_diameter != m->diameter) return std::nullopt;
  const double k = m->diameter == DiameterMode::radius ? 1 : 2;
  TurnStart start{it->second.state.x, it->second.state.z};
  if (const auto x = facts.position[axis::x]) start.x = Value(*x * k);
  if (const auto z = facts.position[axis::z]) start.z = Value(*z);
  for (auto& form : turning_forms(named, k, start, context_.target.word_decimals)) {
    const bool there =
        form.from.x && start.x && start.z && equal(*form.from.x, *start.x) && equal(*form.from.z, *start.z);
    if (there) form.from = {};
    if (!accepts(Cycle{form.cycle})) continue;
    const auto* own = cycles::find_machining(named.name);
    const auto* other = cycles::find_machining(form.cycle.name);
    const bool comp_off = own->ends_comp || setting_in<CompSide>(b, facts, Setting::comp) == CompSide::off;
    if (!comp_off && other->ends_comp) continue;
    TurnNumbers mine, theirs;
    if (machining_numbers(named, *m, mine) && machining_numbers(form.cycle, *m, theirs)) {
      constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
      cycles::TurnContext before, after;
      const auto place = [&](const std::optional<Value>& v, double by) {
        const auto n = v ? known(*v) : std::nullopt;
        return n ? *n / by : unknown;
      };
      before.start = {place(start.x, k), place(start.z, 1)};
      after.start = form.from.x ? cycles::TurnPoint{place(form.from.x, k), place(form.from.z, 1)} : before.start;
      std::string error;
      const auto a = cycles::expand(*own, mine, before, &error), c = cycles::expand(*other, theirs, after, &error);
      if (!a || !c) continue;
      std::vector<TurnMove> moves;
      if (form.from.x) moves.push_back(rapid_to(after.start));
      moves.insert(moves.end(), c->begin(), c->end());
      if (!std::equal(a->begin(), a->end(), moves.begin(), moves.end(), same_move)) continue;
      return std::move(form);
    }
    if (form.proved) return std::move(form);
  }
  return std::nullopt;
}

std::optional<Body> TurnCycles::write_out_computed(const NamedCycle& named, const Statement& s, const Block& b,
                                                   const Facts& facts, Editor& editor, std::string* error) const {
  const auto it = sites_.find(s.id);
  const auto m = modes_at(b, facts, context_.source_machine.power_on);
  if (it == sites_.end() || !m) return *error = "units or diameters are not known here", std::nullopt;
  TurnStart start{it->second.state.x, it->second.state.z};
  const double k = m->diameter == DiameterMode::radius ? 1 : 2;
  if (const auto x = facts.position[axis::x]) start.x = Value(*x * k);
  if (const auto z = facts.position[axis::z]) start.z = Value(*z);
  ComputedTurn turn(named, s.line, *m, start, nose_width(it->second.state), editor);
  turn.usual_feed = facts.feed;
  auto out = turn.run();
  if (!out) *error = turn.error;
  return out;
}

}  // namespace cnctrans::ir::passes
