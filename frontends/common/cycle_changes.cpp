#include "frontends/common/cycle_changes.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "ir/analysis/dataflow.h"
#include "ir/analysis/domains/kept_values.h"

namespace cnctrans::frontends {

namespace {

struct Change {
  std::size_t routine = 0;
  const ir::Statement* statement = nullptr;
  const ir::HoleCycle* cycle = nullptr;
  const ir::Statement* above = nullptr;  ///< whose cycle it was joined with
  const ir::HoleCycle* before = nullptr;
  bool far = false;  ///< `above` stands in another routine
};

const ir::Action* cycle_in(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  if (b == nullptr) return nullptr;
  for (const auto& a : b->actions) {
    const auto* d = std::get_if<ir::CycleDefine>(&a.data);
    if (d != nullptr && d->modal && d->cycle && std::holds_alternative<ir::HoleCycle>(d->cycle->node)) return &a;
  }
  return nullptr;
}

std::vector<Change> changes_of(const ir::Program& program, const std::function<bool(const ir::Action&)>& is_change,
                               const std::map<std::uint32_t, std::uint32_t>& joined) {
  struct Place {
    std::size_t routine = 0;
    const ir::Statement* statement = nullptr;
    const ir::HoleCycle* cycle = nullptr;
  };
  std::map<std::uint32_t, Place> by_line;
  std::vector<Change> found;
  for (std::size_t r = 0; r < program.routines.size(); ++r) {
    const ir::Statement* above = nullptr;
    const ir::HoleCycle* before = nullptr;
    ir::for_each_statement(program.routines[r].body, [&](const ir::Statement& s) {
      const ir::Action* a = cycle_in(s);
      if (a == nullptr) return;
      const auto* cycle = std::get_if<ir::HoleCycle>(&std::get<ir::CycleDefine>(a->data).cycle->node);
      if ((above != nullptr || joined.count(s.line.span.line) != 0) && is_change(*a))
        found.push_back({r, &s, cycle, above, before});
      above = &s;
      before = cycle;
      if (!joined.empty()) by_line.emplace(s.line.span.line, Place{r, &s, cycle});
    });
  }
  for (Change& c : found) {
    const auto line = joined.find(c.statement->line.span.line);
    const auto at = line == joined.end() ? by_line.end() : by_line.find(line->second);
    if (at == by_line.end()) continue;
    c.above = at->second.statement;
    c.before = at->second.cycle;
    c.far = at->second.routine != c.routine;
  }
  return found;
}

std::vector<ir::ExprPtr> computed_words(const ir::HoleCycle& cycle) {
  ir::Cycle copy{cycle};
  auto& hole = std::get<ir::HoleCycle>(copy.node);
  if (cycle.keeps_initial) {  // a plane that is not given stays at its height
    for (ir::Level* l : {&hole.reference, &hole.bottom}) {
      if (!l->given) l->value = ir::Value{};
    }
  }
  std::vector<ir::ExprPtr> words;
  bool changed = false;
  ir::passes::visit_values(
      copy,
      [&words](ir::Value& v, const ir::passes::Place&) {
        if (!v.literal()) words.push_back(v.expr);
        return false;
      },
      changed);
  return words;
}

/// The words of the cycle before that the change has taken over as they stand.
std::vector<ir::ExprPtr> words_taken_over(const Change& c) {
  std::vector<ir::ExprPtr> taken;
  const auto now = computed_words(*c.cycle);
  for (const auto& old : computed_words(*c.before)) {
    bool here = false;
    for (const auto& word : now) {
      ir::walk(word, [&](const ir::ExprPtr& part) { here = here || part == old; });
    }
    if (here) taken.push_back(old);
  }
  return taken;
}

/// What writes variables between a cycle and its change.
class Between {
 public:
  explicit Between(const ir::Program& program) : program_(program), calls_(program), writes_(program) {}

  /// One of the words may have another value at the change than at the cycle.
  [[nodiscard]] bool changes(const Change& c, const std::vector<ir::ExprPtr>& words) const {
    const auto passed = statements_between(c);
    std::set<std::size_t> called;
    for (const auto& site : calls_.sites()) {
      const bool modal = std::holds_alternative<ir::ModalCall>(site.statement->node);
      const bool passes = site.caller == c.routine && passed.count(site.statement->id) != 0;
      if (!site.callee || (!modal && !passes)) continue;
      const auto reached = ir::passes::reached_from(calls_, *site.callee);
      called.insert(reached.begin(), reached.end());
    }
    for (const auto& w : writes_.all()) {
      const bool here = c.far || (w.routine == c.routine && passed.count(w.at) != 0) || called.count(w.routine) != 0;
      if (!here) continue;
      for (const auto& word : words) {
        if (writes_.touches(w, word, c.routine)) return true;
      }
    }
    return false;
  }

 private:
  /// Ids of the routine's statements on the ways from the cycle to its change.
  std::set<std::uint32_t> statements_between(const Change& c) const {
    const ir::ControlFlow flow = ir::control_flow(program_, program_.routines[c.routine]);
    std::map<std::uint32_t, std::vector<std::uint32_t>> before;
    for (std::size_t at = 0; at < flow.successors.size(); ++at) {
      for (const auto next : flow.successors[at]) before[next].push_back(static_cast<std::uint32_t>(at));
    }
    std::set<std::uint32_t> passed;
    std::vector<std::uint32_t> open{c.statement->id};
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      for (const auto id : before[at]) {
        if (id != c.above->id && passed.insert(id).second) open.push_back(id);
      }
    }
    return passed;
  }

  const ir::Program& program_;
  ir::passes::CallGraph calls_;
  ir::passes::Writes writes_;
};

}  // namespace

std::vector<ChangeFinding> judge_changes(ir::Program& program, const ir::ModalState& power_on,
                                         const std::function<bool(const ir::Action&)>& is_change,
                                         const std::map<std::uint32_t, std::uint32_t>& joined) {
  ir::number_statements(program);
  const auto changes = changes_of(program, is_change, joined);
  if (changes.empty()) return {};
  const ir::FactTable table = ir::analyse(program, power_on);
  std::vector<ChangeFinding> findings;
  std::optional<Between> between;
  for (const Change& c : changes) {
    const ir::Facts& before = table.before(c.statement->id);
    if (!before.reachable || c.above == nullptr || c.before == nullptr) continue;
    if (before.cycle_from != c.above->id) {
      const bool outside = before.cycle_from == 0 && !before.cycle_active_known;
      findings.push_back({c.statement, outside ? ChangeFault::outside : ChangeFault::another});
      if (!outside) continue;
    }
    const auto words = words_taken_over(c);
    if (words.empty()) continue;
    if (!between) between.emplace(program);
    if (between->changes(c, words)) findings.push_back({c.statement, ChangeFault::stale});
  }
  return findings;
}

void report_changes(const std::vector<ChangeFinding>& findings, std::string_view code, Diagnostics& diagnostics) {
  for (const auto& f : findings) {
    const Span& where = f.statement->line.span;
    switch (f.fault) {
      case ChangeFault::outside:
        diagnostics.warning(
            code, where,
            "these words change the cycle in force, which a program of another file may have set: the one "
            "above in the text is taken",
            "write the whole cycle");
        break;
      case ChangeFault::another:
        diagnostics.error(
            code, where,
            "these words change the cycle in force, and which one that is depends on the way to this block",
            "write the whole cycle here");
        break;
      case ChangeFault::stale:
        diagnostics.error(code, where,
                          "the other words of the cycle keep the values of its definition, and a variable that they "
                          "read has changed since",
                          "write the whole cycle here");
        break;
    }
  }
}

}  // namespace cnctrans::frontends
