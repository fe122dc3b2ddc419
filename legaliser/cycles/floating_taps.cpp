// A tap with a compensating chuck is a straight move at F for a target without a word of its own for it; the code that
// was in force comes back behind it.
#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

bool is_floating_tap(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  return b != nullptr && b->has_motion && b->motion.kind == MotionKind::tap_floating;
}

}  // namespace

void write_floating_taps(Program& program, const LegaliseContext& context) {
  if (context.target.motions.count(MotionKind::tap_floating) != 0) return;
  bool found = false;
  for (const auto& r : program.routines)
    for_each_statement(r.body, [&found](const Statement& s) { found = found || is_floating_tap(s); });
  if (!found) return;
  const FactsOf facts(program, context);
  edit_blocks(program, context, [&](Editor& editor, Statement&& s, Body& out) {
    const auto before = facts.before(s).motion;
    const bool alone = facts.before(s).modal_call == 0 && !facts.before(s).cycle_active;
    if (!is_floating_tap(s) || !alone || (before != MotionKind::linear && before != MotionKind::rapid))
      return out.push_back(std::move(s));
    auto& m = std::get<Block>(s.node).motion;
    context.diagnostics.warning(
        "TRN-338", word_span(s.line.span, m.code_pos),
        "the tap with a compensating chuck becomes a straight move at its feed: the override of "
        "the feed is not held at 100 % by the target",
        "leave the override at 100 %, or use the tapping cycle of the target");
    m.kind = MotionKind::linear;
    m.explicit_code = m.keeps_modal = true;
    m.code_text = {};
    const LineInfo like = s.line;
    Body pieces;
    pieces.push_back(std::move(s));
    if (before == MotionKind::rapid) {
      Block back;
      back.has_motion = true;
      back.motion.kind = *before;
      back.motion.explicit_code = true;
      pieces.push_back(made(like, std::move(back)));
    }
    editor.put_group(out, std::move(pieces), 0);
  });
}

}  // namespace cnctrans::ir::passes
