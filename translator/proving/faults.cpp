// Errors of reading as faults of the run: one that control comes to refuses the program, any other is a warning.
#include <algorithm>
#include <set>

#include "translator/files/loader.h"

namespace cnctrans::translator {

namespace {

/// Where the faults of a routine can stand.
struct RoutineLines {
  std::uint32_t first = 0;   ///< of its header or first statement
  std::uint32_t anchor = 0;  ///< of its header; 0: it has none
  bool ends = false;         ///< its last statement ends it
  std::set<std::uint32_t> lines;
};

RoutineLines lines_of(const ir::Routine& routine) {
  RoutineLines out;
  const auto take = [&out](const Span& at) {
    for (auto l = at.line; at.known() && l <= std::max(at.line, at.end_line); ++l) out.lines.insert(l);
  };
  take(routine.header.span);
  out.anchor = routine.header.span.line;
  ir::for_each_statement(routine.body, [&take](const ir::Statement& s) {
    take(s.line.span);
    if (const auto* i = std::get_if<ir::If>(&s.node)) {
      take(i->else_line.span);
      take(i->end_line.span);
    }
    if (const auto* w = std::get_if<ir::While>(&s.node)) take(w->end_line.span);
    if (const auto* u = std::get_if<ir::Until>(&s.node)) take(u->end_line.span);
    if (const auto* f = std::get_if<ir::For>(&s.node)) take(f->end_line.span);
    if (const auto* l = std::get_if<ir::Loop>(&s.node)) take(l->end_line.span);
  });
  out.first = out.lines.empty() ? 0 : *out.lines.begin();
  const auto last = std::find_if_not(routine.body.rbegin(), routine.body.rend(), [](const ir::Statement& s) {
    const auto* b = std::get_if<ir::Block>(&s.node);
    return b != nullptr && b->empty();
  });
  out.ends = last != routine.body.rend() &&
             (std::holds_alternative<ir::End>(last->node) || std::holds_alternative<ir::Return>(last->node));
  return out;
}

/// The line that stands for `line`; nothing when control can't come there.
std::optional<std::uint32_t> place_of(std::uint32_t line, const std::vector<RoutineLines>& routines) {
  const RoutineLines* owner = nullptr;
  for (const auto& r : routines) {
    if (r.lines.count(line) != 0) return line;
    if (owner == nullptr || (r.first <= line && r.first >= owner->first)) owner = &r;
  }
  if (owner == nullptr) return 0;
  const auto next = owner->lines.upper_bound(line);
  if (next != owner->lines.end()) return *next;
  if (owner->ends) return std::nullopt;
  return owner->anchor;
}

}  // namespace

void Loader::note_faults(const ir::Program& program, FileId file, const Diagnostics& said, std::size_t from) {
  if (!said.has_errors()) return;
  std::vector<RoutineLines> routines;
  for (const auto& r : program.routines) routines.push_back(lines_of(r));
  const auto note = [&](std::uint32_t line, const Diagnostic& d) {
    if (const auto place = place_of(line, routines)) faults_.emplace(std::pair(file, *place), d);
  };
  for (std::size_t i = from; i < said.all().size(); ++i) {
    const auto& d = said.all()[i];
    if (d.severity == Severity::error && (d.span.file == file || !d.span.known())) note(d.span.line, d);
  }
  for (const auto& [code, more] : said.more()) {
    if (more.severity != Severity::error) continue;
    for (const auto& range : more.lines) {
      for (auto l = range.first; range.file == file && l <= range.last; ++l)
        note(l, {code, Severity::error, {file, l, 1, l, 1}, "the line can't be read", {}});
    }
  }
}

const Diagnostic* Loader::fault(FileId file, std::uint32_t first_line, std::uint32_t last_line) const {
  const auto it = faults_.lower_bound({file, first_line});
  return it != faults_.end() && it->first.first == file && it->first.second <= last_line ? &it->second : nullptr;
}

Diagnostics as_warnings(const Diagnostics& diagnostics) {
  Diagnostics out;
  const auto add = [&out](Diagnostic d) {
    if (d.severity == Severity::error) d.severity = Severity::warning;
    out.add(std::move(d));
  };
  for (const auto& d : diagnostics.all()) add(d);
  for (const auto& [code, more] : diagnostics.more()) {
    std::size_t left = more.count;
    for (const auto& range : more.lines) {
      for (auto l = range.first; l <= range.last && left != 0; ++l, --left)
        add({code, more.severity, {range.file, l, 1, l, 1}, {}, {}});
    }
  }
  return out;
}

}  // namespace cnctrans::translator
