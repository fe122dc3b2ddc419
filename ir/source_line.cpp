#include "ir/source_line.h"

namespace cnctrans::ir {

std::string source_line(const Span& span, const Program& program) {
  if (!span.known()) return {};
  for (const FileLook& look : program.files) {
    if (look.file != span.file) continue;
    if (const SourcePtr s = program.texts->source(look.name)) return std::string(s->line_text(span.line));
  }
  return {};
}

}  // namespace cnctrans::ir
