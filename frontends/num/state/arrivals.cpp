#include "frontends/num/state/arrivals.h"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <utility>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/dataflow.h"
#include "ir/check/missing_features.h"

namespace cnctrans::frontends::num {

namespace {

bool has(const ModalUse& use, Modal fact) {
  return (use.facts & static_cast<std::uint8_t>(fact)) != 0;
}

/// One program without jumps, calls and structures: the text is its way.
bool straight(const ir::Program& program) {
  if (program.routines.size() != 1) return false;
  bool only_blocks = true;
  ir::for_each_statement(program.routines[0].body, [&](const ir::Statement& s) {
    only_blocks = only_blocks &&
                  (std::holds_alternative<ir::Block>(s.node) || std::holds_alternative<ir::Assign>(s.node) ||
                   std::holds_alternative<ir::Message>(s.node) || std::holds_alternative<ir::Declare>(s.node) ||
                   std::holds_alternative<ir::Opaque>(s.node) || std::holds_alternative<ir::End>(s.node)) &&
                  s.line.skip_mask == 0;
  });
  return only_blocks;
}

/// Every statement of the file by its line, the first of each.
std::map<std::uint32_t, const ir::Statement*> by_line(const Ways& ways) {
  std::map<std::uint32_t, const ir::Statement*> lines;
  for (std::size_t i = ways.own; i < ways.whole.routines.size(); ++i) {
    ir::for_each_statement(ways.whole.routines[i].body,
                           [&](const ir::Statement& s) { lines.emplace(s.line.span.line, &s); });
  }
  return lines;
}

Arrival arrival_of(const ir::Facts& before, const std::map<std::uint32_t, std::uint32_t>& line_of) {
  const auto setting = [&before](ir::Setting s) { return before.settings[static_cast<std::size_t>(s)]; };
  Arrival a;
  if (const auto v = setting(ir::Setting::plane)) a.plane = static_cast<ir::Plane>(*v);
  if (const auto v = setting(ir::Setting::distance)) a.distance = static_cast<ir::Distance>(*v);
  if (const auto v = setting(ir::Setting::units)) a.inch = static_cast<ir::Units>(*v) == ir::Units::inch;
  a.motion = before.motion;
  a.several_cycles = before.cycle_from == ir::Facts::several_cycles;
  if (before.cycle_active_known && !before.cycle_active) {
    a.cycle_line = 0;
  } else if (const auto line = line_of.find(before.cycle_from); line != line_of.end()) {
    a.cycle_line = line->second;
  }
  return a;
}

/// A call that leaves the file, or a block that nobody could read: what holds behind it is not known.
bool leads_outside(const ir::Program& program) {
  const ir::passes::CallGraph calls(program);
  if (std::any_of(calls.sites().begin(), calls.sites().end(), [](const auto& s) { return !s.callee; })) return true;
  bool unread = false;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* o = std::get_if<ir::Opaque>(&s.node);
      unread = unread || (o != nullptr && !o->harmless);
    });
  }
  return unread;
}

/// Lines of the main programs of the file, and of its programs that are called.
std::unordered_set<std::uint32_t> lines_with_callers(const Ways& ways) {
  const ir::Program& program = ways.whole;
  const ir::passes::CallGraph calls(program);
  std::unordered_set<std::uint32_t> lines;
  for (std::size_t i = ways.own; i < program.routines.size(); ++i) {
    if (program.routines[i].kind != ir::RoutineKind::main && !calls.called(i)) continue;
    ir::for_each_statement(program.routines[i].body, [&](const ir::Statement& s) { lines.insert(s.line.span.line); });
  }
  return lines;
}

struct Named {
  Modal fact;
  const char *what, *hint;
};
constexpr Named names[] = {
    {Modal::plane, "the plane", "write the plane function (G17, G18, G19) in the block"},
    {Modal::distance, "G90 or G91", "write G90 or G91 before the words of the block"},
    {Modal::motion, "the motion function", "write G0, G1, G2 or G3 in the block"},
    {Modal::unit, "G70 or G71", "write the whole cycle here"},
    {Modal::cycle, "the cycle in force", "write the whole cycle here"},
};

/// What is known of the fact: nothing, that it was taken so, or that it is another one.
enum class Match : std::uint8_t { unknown, same, other };
template <class T>
Match compare(const std::optional<T>& taken, const std::optional<T>& brought) {
  if (!brought) return Match::unknown;
  return taken == brought ? Match::same : Match::other;
}
Match match(const ModalUse& use, Modal fact, const Arrival& brought) {
  switch (fact) {
    case Modal::plane: return compare(use.taken.plane, brought.plane);
    case Modal::distance: return compare(use.taken.distance, brought.distance);
    case Modal::motion: return compare(use.taken.motion, brought.motion);
    case Modal::unit: return compare(use.taken.inch, brought.inch);
    case Modal::cycle: break;
  }
  if (brought.several_cycles && !use.taken.several_cycles && use.taken.cycle_line == 0U) return Match::other;
  return compare(use.taken.cycle_line, brought.cycle_line);
}

}  // namespace

Ways ways_of(const ir::Program& file, const std::vector<const ir::Program*>* callers) {
  Ways ways;
  const bool alone = callers == nullptr || callers->empty();
  ways.straight = alone && straight(file);
  if (ways.straight) return ways;
  ways.whole.spaces = file.spaces;
  const auto add = [&ways](const ir::Program& program, bool main) {
    for (ir::Routine routine : program.routines) {
      if (!main && routine.kind == ir::RoutineKind::main) routine.kind = ir::RoutineKind::sub;
      ways.whole.routines.push_back(std::move(routine));
    }
  };
  for (std::size_t k = 0; !alone && k < callers->size(); ++k) add(*(*callers)[k], k == 0);
  ways.own = ways.whole.routines.size();
  add(file, alone);
  ir::number_statements(ways.whole);
  return ways;
}

Arrivals arrivals_at(const Ways& ways, const std::vector<ModalUse>& uses, const ir::ModalState& power_on) {
  Arrivals arrivals;
  if (uses.empty() || ways.straight) return arrivals;
  const ir::FactTable table = ir::analyse(ways.whole, power_on);
  const auto lines = by_line(ways);
  std::map<std::uint32_t, std::uint32_t> line_of;
  for (std::size_t i = ways.own; i < ways.whole.routines.size(); ++i) {
    ir::for_each_statement(ways.whole.routines[i].body,
                           [&](const ir::Statement& s) { line_of.emplace(s.id, s.line.span.line); });
  }
  for (const auto& use : uses) {
    const auto at = lines.find(use.where.line);
    if (at == lines.end()) continue;
    const ir::Facts& before = table.before(at->second->id);
    if (before.reachable) arrivals.emplace(use.where.line, arrival_of(before, line_of));
  }
  return arrivals;
}

bool agrees(const std::vector<ModalUse>& uses, const Arrivals& arrivals) {
  return std::all_of(uses.begin(), uses.end(), [&](const ModalUse& use) {
    const auto at = arrivals.find(use.where.line);
    return at == arrivals.end() || std::none_of(std::begin(names), std::end(names), [&](const Named& n) {
             return has(use, n.fact) && match(use, n.fact, at->second) == Match::other;
           });
  });
}

void judge_uses(const Ways& ways, const std::vector<ModalUse>& uses, const Arrivals& arrivals,
                Diagnostics& diagnostics) {
  if (arrivals.empty()) return;
  const auto sure = lines_with_callers(ways);
  const bool nobody = ways.own != 0 && sure.empty();  // called by another number than the one it names
  const bool outside = nobody || leads_outside(ways.whole);
  bool told = false;
  for (const auto& use : uses) {
    const auto at = arrivals.find(use.where.line);
    if (at == arrivals.end()) continue;
    for (const Named& n : names) {
      if (!has(use, n.fact)) continue;
      const Match found = match(use, n.fact, at->second);
      // Of a cycle nobody knows, the judge of its changes says what is to be said (NUM-048).
      const bool unknown =
          found == Match::unknown && n.fact != Modal::cycle && (nobody || sure.count(use.where.line) != 0);
      if (unknown && outside && !std::exchange(told, true)) {
        diagnostics.warning("NUM-072", use.where,
                            "this block depends on " + std::string(n.what) +
                                ", which a program of another file may have changed: it is read as the lines above say",
                            n.hint);
      }
      if (found != Match::other && !(unknown && !outside)) continue;
      diagnostics.error("NUM-070", use.where,
                        "this block depends on " + std::string(n.what) +
                            ", and the ways of the program come to it with different ones",
                        n.hint);
      break;
    }
  }
}

}  // namespace cnctrans::frontends::num
