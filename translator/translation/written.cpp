#include "translator/translation/written.h"

#include <set>
#include <utility>

#include "translator/files/definitions.h"

namespace cnctrans::translator {

ReadBack read_back(const std::vector<OutputText>& outputs, const Dialect& to, const machine::Profile& target_profile,
                   Loader* definitions) {
  ReadBack back{Loader(to, target_profile, frontends::Reader::scanner, {}), ir::Program{}, Diagnostics{}};
  if (definitions != nullptr) back.loader.use_definitions(*definitions);
  bool first = true;
  for (const auto& out : outputs) {
    const ir::Program* read = back.loader.read_source(SourceText::from_string(out.name, out.bytes), back.diagnostics);
    if (std::exchange(first, false)) {
      back.program = *read;
      continue;
    }
    for (auto routine : read->routines) {
      if (routine.kind == ir::RoutineKind::main) routine.kind = ir::RoutineKind::sub;
      back.program.routines.push_back(std::move(routine));
    }
    back.program.texts->share(read->texts);
  }
  if (definitions != nullptr) {
    Diagnostics said_already;
    declare_names(back.program, back.loader.definitions(), false, said_already);
  }
  ir::number_statements(back.program);
  return back;
}

void check_written(const std::vector<OutputText>& outputs, const ReadBack& back, Diagnostics& said) {
  std::set<std::pair<FileId, std::uint32_t>> lines;
  for (const auto& d : back.diagnostics.all()) {
    if (d.severity != Severity::error || !lines.emplace(d.span.file, d.span.line).second) continue;
    const bool known = d.span.file > 0 && d.span.file <= outputs.size();
    const auto* map = known ? &outputs[d.span.file - 1].map.lines : nullptr;
    const bool mapped = map != nullptr && d.span.line > 0 && d.span.line <= map->size();
    said.error("TRN-401", mapped ? (*map)[d.span.line - 1] : Span{},
               "the target's control does not take what this line becomes: " + d.message + " (" + d.code + ")", d.hint);
  }
}

}  // namespace cnctrans::translator
