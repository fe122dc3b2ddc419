// Statements that the reader keeps as text, for a target of another language.
#include "base/text.h"
#include "ir/check/missing_features.h"
#include "ir/edit/rewrite.h"
#include "ir/source_line.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/refuse.h"

namespace cnctrans::ir::passes {

namespace {

/// The source chooses the axis of the tool's length by a function of its own: the words of the program say what cycles
/// make of it, the length itself is the machine's.
void tell_chosen_axis(Statement& s, Opaque& kept, Program& program, const LegaliseContext& context) {
  const bool follows = context.target_machine.policies.tool_length_axis == machine::ToolLengthAxis::plane;
  const std::string text(trim(kept.text));
  context.diagnostics.warning(
      "TRN-523", s.line.span,
      "'" + text + "' chooses the axis of the tool's length, which the target can't: there " +
          (follows ? "the length goes to the axis across the plane" : "the length stays along the axis of the tool"),
      "check along which axis the tool stands, and select its axis on the target");
  CommentText remark;
  remark.text = program.keep("!! TRN-523 " + text);
  s.line.comments.push_back(remark);
  kept.feature.clear();
}

/// Said before all else: what follows is not blamed for what the line hides. For what could not be read at all the
/// reader has given the reason, here or where it is defined.
void refuse_kept(const Statement& s, Opaque& kept, const Program& program, const LegaliseContext& context) {
  const auto* feature = find_missing_feature(kept.feature);
  if (kept.harmless || kept.feature.empty() || kept.feature == "text.unread" ||
      (feature != nullptr && feature->of_one_machine))
    return;
  const std::string line(trim(source_line(s.line.span, program)));
  context.diagnostics.error("TRN-205", s.line.span, "'" + (line.empty() ? kept.text : line) + "' is not translated",
                            std::string(not_translated_hint(kept.feature)));
  pass_over(kept);
}

}  // namespace

void settle_kept_text(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect) return;
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* kept = std::get_if<Opaque>(&s.node);
      if (kept == nullptr) return;
      if (kept->feature == "motion.length_axis")
        tell_chosen_axis(s, *kept, program, context);
      else if (!context.options.goes_on)
        refuse_kept(s, *kept, program, context);
    });
  }
}

}  // namespace cnctrans::ir::passes
