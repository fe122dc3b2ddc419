#include "translator/proving/coverage.h"

#include <map>
#include <utility>

namespace cnctrans::translator {

namespace {

bool acts(const ir::Statement& s) {
  if (const auto* b = std::get_if<ir::Block>(&s.node)) return !b->empty();
  return std::holds_alternative<ir::Assign>(s.node) || std::holds_alternative<ir::If>(s.node) ||
         std::holds_alternative<ir::Jump>(s.node) || std::holds_alternative<ir::Switch>(s.node) ||
         std::holds_alternative<ir::Repeat>(s.node) || std::holds_alternative<ir::CallRoutine>(s.node) ||
         std::holds_alternative<ir::ModalCall>(s.node) || std::holds_alternative<ir::Message>(s.node);
}

}  // namespace

verifier::Coverage coverage_of(const ir::Program& program, const std::vector<bool>& covered, std::string also) {
  std::map<std::pair<FileId, std::uint32_t>, bool> lines;
  for (const auto& routine : program.routines) {
    ir::for_each_statement(routine.body, [&](const ir::Statement& s) {
      if (!s.line.span.known() || !acts(s)) return;
      bool& done = lines[{s.line.span.file, s.line.span.line}];
      done = done || (s.id < covered.size() && covered[s.id]);
    });
  }
  verifier::Coverage c;
  c.also = std::move(also);
  c.blocks = lines.size();
  if (!lines.empty()) c.main = lines.begin()->first.first;
  const std::pair<const std::pair<FileId, std::uint32_t>, bool>* before = nullptr;
  for (const auto& entry : lines) {
    const auto [file, line] = entry.first;
    const bool goes_on = before != nullptr && !before->second && before->first.first == file;
    before = &entry;
    if (entry.second) {
      ++c.replayed;
    } else if (goes_on) {
      c.missed.back().last = line;
    } else {
      c.missed.push_back({file, line, line});
    }
  }
  return c;
}

verifier::LeftOut left_out_of(const ir::Program& program, const std::vector<bool>& covered,
                              const std::vector<interpreter::Event>& trace) {
  verifier::LeftOut out;
  for (const auto& routine : program.routines) {
    ir::for_each_statement(routine.body, [&](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr || s.id >= covered.size() || !covered[s.id]) return;
      for (const auto& a : b->actions) {
        const auto* m = std::get_if<ir::ModalSet>(&a.data);
        if (m != nullptr && m->setting == ir::Setting::path_mode) ++out.path_modes;
      }
    });
  }
  std::int32_t offset = 0;
  for (const auto& e : trace) {
    if (e.kind == interpreter::EventKind::offset && e.number != 0 && e.number != offset) ++out.offset_numbers;
    if (e.kind == interpreter::EventKind::offset) offset = e.number;
    if (e.kind == interpreter::EventKind::tool && !e.change) ++out.preselected_tools;
  }
  return out;
}

}  // namespace cnctrans::translator
