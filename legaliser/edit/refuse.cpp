#include "legaliser/edit/refuse.h"

#include <utility>

#include "ir/text/text.h"

namespace cnctrans::ir::passes {

void pass_over(Opaque& refused) {
  refused.harmless = true;
  refused.feature = "text.unread";
}

void refuse(Statement& s, const Program& program, const LegaliseContext& context, std::string_view code,
            std::string message, std::string hint, WordPos pos) {
  context.diagnostics.error(code, word_span(s.line.span, pos), std::move(message), std::move(hint));
  Opaque o;
  o.text = to_text(s, program);
  if (context.options.goes_on)
    o.feature = "language.statement";  // the rest is written all the same: nothing is known behind it
  else
    pass_over(o);
  s.node = std::move(o);
}

}  // namespace cnctrans::ir::passes
