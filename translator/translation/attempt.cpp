#include "translator/translation/attempt.h"

#include "legaliser/uncalled.h"

namespace cnctrans::translator {

namespace {

Attempt attempt(const AttemptContext& c, ir::Program work, backends::WriteOptions write, bool assume) {
  Attempt out;
  const auto uncalled = assume ? ir::Uncalled::power_on : ir::Uncalled::unknown;
  const ir::LegaliseContext context{
      c.to.backend->capabilities_for(c.target_machine),
      c.source_machine,
      c.target_machine,
      {c.options.cycles, c.options.raise_structure, c.options.unsupported != backends::Unsupported::error,
       !c.options.annotate, uncalled},
      out.said,
      &out.names,
      nullptr,
      c.options.names};
  if (assume) ir::passes::tell_assumed_state(work, context);
  if (!c.as_it_stands) ir::legalise(work, context);
  const bool refused = out.said.has_errors() && c.options.unsupported == backends::Unsupported::error;
  if (c.refused || refused) return out;  // the writer would only say the same again
  write.profile = &c.target_machine;
  write.uncalled = uncalled;
  out.files = c.to.backend->write(work, write, out.said);
  return out;
}

}  // namespace

Attempt attempt_both(const AttemptContext& c, ir::Program program, const backends::WriteOptions& write) {
  const std::string wanted = c.source_machine.option(ir::passes::uncalled_option, "when_needed");
  const bool uncalled = !c.as_it_stands && !ir::passes::uncalled_routines(program).empty();
  if (!uncalled || wanted == "unknown") return attempt(c, std::move(program), write, false);
  if (wanted == "power_on") return attempt(c, std::move(program), write, true);
  Attempt first = attempt(c, program, write, false);
  if (!first.said.has_errors()) return first;
  Attempt second = attempt(c, std::move(program), write, true);
  return second.said.error_count() < first.said.error_count() ? std::move(second) : std::move(first);
}

}  // namespace cnctrans::translator
