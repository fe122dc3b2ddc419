// A pattern of points beside other words of its block. What acts before the way to the first point gets a block of its
// own in front, what acts behind the last point one behind: the points become many blocks, or a line that stands alone.
#include <utility>

#include "legaliser/cycles/parts/cycle_parts.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

bool has_patterns(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      found = found || (b != nullptr && pattern_in(*b) != nullptr);
    });
  }
  return found;
}

/// Takes everything out of the block but its pattern and its count; the motion code goes with what acts before.
std::pair<Block, Block> take_other_words(Block& b) {
  Block before, after;
  after.actions = take_after(b);
  std::vector<Action> pattern;
  for (auto& a : b.actions) {
    (std::holds_alternative<CycleDefine>(a.data) ? pattern : before.actions).push_back(std::move(a));
  }
  b.actions = std::move(pattern);
  before.has_motion = std::exchange(b.has_motion, false);
  before.motion = std::exchange(b.motion, Motion{});
  return {std::move(before), std::move(after)};
}

}  // namespace

void separate_pattern_words(Program& program, const LegaliseContext& context) {
  const bool as_it_is = program.dialect == context.target.dialect && context.options.cycles != CycleWriting::explode;
  if (as_it_is || !has_patterns(program)) return;
  edit_blocks(program, context, [](Editor& editor, Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    if (pattern_in(b) == nullptr || (b.actions.size() == 1 && !b.has_motion)) return out.push_back(std::move(s));
    const LineInfo like = s.line;
    auto [before, after] = take_other_words(b);
    Body pieces;
    if (!before.empty()) pieces.push_back(made(like, std::move(before)));
    const std::size_t main = pieces.size();
    pieces.push_back(std::move(s));
    if (!after.empty()) pieces.push_back(made(like, std::move(after)));
    editor.put_group(out, std::move(pieces), main);
  });
}

}  // namespace cnctrans::ir::passes
