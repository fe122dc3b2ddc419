// Cycles that no neutral one is: threads with a countersink (263 to 265) and the ruled surface (231), told step by step
// (reference 16).
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "frontends/heidenhain/cycles/builder.h"
#include "frontends/heidenhain/state/term.h"
#include "ir/cycles/milling/milling.h"

namespace cnctrans::frontends::heidenhain {

using ir::LevelBase;
using ir::Value;

/// From the middle on a half circle out to `offset`, once round, and back. Q356 inside the bore, Q358 at its front.
void CycleBuilder::countersink(MoveList& steps, std::int16_t depth, const Value& offset) {
  const double to = hole_.surface.value.number + n(depth);
  const bool above = depth == 356 && n(357) <= 0;
  if (above) steps.feed(Value(to + n(200)), n(253));
  steps.feed(Value(to), above ? n(254) : n(253));
  if (offset.is(0)) return;
  const Term r(offset), half_of = r / Term(2), none(0);
  const auto arc = [&](const Term& u, const Term& centre) {
    steps.arc({u.value(), Value(0), false, centre.value(), Value(0)}, true, n(254));
  };
  arc(r, half_of);
  arc(none, none - r);
  arc(none - r, none - half_of);
}

bool CycleBuilder::thread_with_countersink() {
  if (!numbers()) return false;
  const bool downward = cycle_.number == 265;
  if (n(201) > 0) return refuse("a positive depth turns the approach round; that is not carried");
  const double surface = n(203) + (context_.shift ? context_.shift->number : 0);
  hole_.surface = level_of(Value(surface), LevelBase::absolute);
  hole_.reference = level_of(Value(n(200)), LevelBase::from_surface);
  hole_.bottom = level_of(q(201), LevelBase::from_surface);
  hole_.retract = level_of(Value(surface + std::max(n(204), n(200))), LevelBase::absolute);
  MoveList steps;
  steps.rapid(Value(surface + n(200)));
  if (cycle_.number == 264 && n(356) != 0) {
    CycleDefinition drill = cycle_;
    for (const auto& [number, v] : std::map<std::int16_t, double>{{201, n(356)}, {259, n(258)}, {208, 99999}, {204, 0}})
      drill.values[number].value = Value(v);
    CycleContext context = context_;
    context.value = [&drill](std::int16_t number) { return drill.values[number].value; };
    drill.number = 205;
    for (auto& m : peck_moves(drill, context)) steps.add(std::move(m));
  }
  if (cycle_.number == 263 && n(356) != 0) countersink(steps, 356, (Term(n(335) / 2) - Term(radius())).value());
  const bool front = n(358) != 0, after = downward && n(360) == 1;
  if (front && !after) countersink(steps, 358, q(359));
  if (n(201) != 0) {
    word("diameter", q(335));
    word("pitch", q(239));
    word("per_step", Value(downward ? 1 : 0));
    word("mill_feed", q(207));
    word("plunge_feed", q(253));
    if (cycle_.values.count(512) != 0 && n(512) != 0) word("lead_feed", q(512));
    if (downward)  // against the sense in which the thread rises
      word("sense", Value(n(239) > 0 ? 1 : 0));
    else if (!climb())
      return false;
    hole_.mill.shape = "thread.helix";
    steps.cycle(as_cycle(hole_));
  }
  if (front && after) countersink(steps, 358, q(359));
  steps.rapid(hole_.retract.value);
  warn("the start of the thread and the ways of countersinking are those of this program");
  return told(steps);
}

/// Lines from the edge between the points 1 and 4 to that between 2 and 3, each cut in the same direction.
bool CycleBuilder::ruled_surface() {
  if (!numbers()) return false;
  const double lines = n(240);
  constexpr double most = 10'000;
  if (lines < 1 || lines > most || lines != std::floor(lines)) return refuse("Q240 is the number of lines");
  const Term lift = Term(2) * Term(radius());
  const auto at = [&](std::int16_t from, std::int16_t to, double part) {
    const auto mixed = [&](std::int16_t k) {
      const auto a = static_cast<std::int16_t>(from + k), b = static_cast<std::int16_t>(to + k);
      return Term(n(a) + (n(b) - n(a)) * part).value();
    };
    return std::pair(PlaneMove{mixed(0), mixed(1), true, {}, {}}, mixed(2));
  };
  MoveList steps;
  const double feed = n(207);
  for (double k = 0; k < lines; ++k) {
    const double part = lines > 1 ? k / (lines - 1) : 0;
    const auto [first, low] = at(225, 234, part);
    const auto [last, high] = at(228, 231, part);
    steps.plane(first, feed, low);
    steps.plane(last, k == 0 ? feed / 2 : feed, high);
    const Term over(Value(std::max(low.number, high.number)));
    if (k + 1 == lines) break;
    steps.rapid((over + lift).value());
    steps.plane(first);
    steps.rapid(low);
  }
  const double top = std::max({n(227), n(230), n(233), n(236)});
  steps.rapid((Term(top) + lift).value());
  return told(steps);
}

}  // namespace cnctrans::frontends::heidenhain
