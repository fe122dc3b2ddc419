#include "legaliser/analysis/seen_facts.h"

#include <tuple>

namespace cnctrans::ir::passes {

namespace {

template <class T>
void fill(std::optional<T>& known, const std::optional<T>& seen) {
  if (!known) known = seen;
}

}  // namespace

bool SeenFacts::Before::operator()(const Span& a, const Span& b) const {
  return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
}

void SeenFacts::visit(const Span& where, const Facts& now) {
  const auto [it, fresh] = seen_.emplace(where, now);
  if (!fresh) join(it->second, now);
}

void SeenFacts::complete(const Program& program, FactTable& table) const {
  // What passes have made of a statement stands in several places with one span: which of them the run has seen is
  // open.
  std::map<Span, std::uint32_t, Before> one;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&one](const Statement& s) {
      const auto [it, fresh] = one.emplace(s.line.span, s.id);
      if (!fresh) it->second = 0;
    });
  }
  for (const auto& [where, id] : one) {
    const auto seen = seen_.find(where);
    if (id == 0 || id >= table.facts.size() || seen == seen_.end() || !table.facts[id].reachable) continue;
    Facts& known = table.facts[id];
    const Facts& more = seen->second;
    for (std::size_t i = 0; i < setting_count; ++i) fill(known.settings[i], more.settings[i]);
    for (std::size_t i = 0; i < known.position.size(); ++i) fill(known.position[i], more.position[i]);
    fill(known.motion, more.motion);
    fill(known.work_offset, more.work_offset);
    fill(known.feed, more.feed);
  }
}

}  // namespace cnctrans::ir::passes
