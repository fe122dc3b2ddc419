#include "translator/written.h"

#include <set>

#include "translator/readable.h"

namespace cnctrans::translator {

void check_written(TranslateResult& result, const Dialect& to, const machine::Profile& target_profile) {
  if (!readable(to)) return;
  for (const auto& out : result.outputs) {
    Diagnostics found;
    Loader loader(to, target_profile, frontends::Reader::scanner, {});
    loader.read_source(SourceText::from_string(out.name, out.bytes), found);
    std::set<std::uint32_t> said;
    for (const auto& d : found.all()) {
      if (d.severity != Severity::error || !said.insert(d.span.line).second) continue;
      const bool mapped = d.span.line > 0 && d.span.line <= out.map.lines.size();
      result.diagnostics.error(
          "TRN-401", mapped ? out.map.lines[d.span.line - 1] : Span{},
          "the target's control does not take what this line becomes: " + d.message + " (" + d.code + ")", d.hint);
    }
  }
}

}  // namespace cnctrans::translator
