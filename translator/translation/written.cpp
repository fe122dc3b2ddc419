#include "translator/translation/written.h"

#include <set>
#include <utility>

#include "ir/check/missing_features.h"
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
  const auto tell = [&](const Span& at, const std::string& what, const std::string& hint) {
    if (!lines.emplace(at.file, at.line).second) return;
    const bool known = at.file > 0 && at.file <= outputs.size();
    const auto* map = known ? &outputs[at.file - 1].map.lines : nullptr;
    const bool mapped = map != nullptr && at.line > 0 && at.line <= map->size();
    said.error("TRN-401", mapped ? (*map)[at.line - 1] : Span{}, what, hint);
  };
  for (const auto& d : back.diagnostics.all()) {
    if (d.severity == Severity::error)
      tell(d.span, "the target's control does not take what this line becomes: " + d.message + " (" + d.code + ")",
           d.hint);
  }
  for (const auto& r : back.program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* text = std::get_if<ir::Opaque>(&s.node);
      const auto* feature = text == nullptr || text->harmless ? nullptr : ir::find_missing_feature(text->feature);
      if (text != nullptr && !text->harmless && (feature == nullptr || !feature->beside_path))
        tell(s.line.span, "what this line becomes is not carried out when it is read again: " + text->text, {});
    });
  }
}

}  // namespace cnctrans::translator
