// A feed of one block for a target whose F stays in force: the feed of before is written behind the block.
#include <algorithm>

#include "ir/passes/blocks.h"
#include "ir/passes/early_passes.h"
#include "ir/passes/editor.h"
#include "ir/passes/facts.h"

namespace cnctrans::ir::passes {

namespace {

bool is_block_feed(const Action& a) {
  const auto* f = std::get_if<SetFeed>(&a.data);
  return f != nullptr && f->block_only;
}

bool has_block_feed(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      found = found || (b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), is_block_feed));
    });
  }
  return found;
}

}  // namespace

void write_block_feeds(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || !has_block_feed(program)) return;
  const FactsOf facts(program, context);
  edit_blocks(program, context, [&](Editor& editor, Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    const auto own = std::find_if(b.actions.begin(), b.actions.end(), is_block_feed);
    if (own == b.actions.end()) return out.push_back(std::move(s));
    std::optional<Value> before;
    if (const auto known = facts.before(s).feed) before = Value{*known};
    for (const auto& a : b.actions) {  // F beside FB= is the one that stays
      const auto* f = std::get_if<SetFeed>(&a.data);
      if (f != nullptr && !f->block_only) before = f->value;
    }
    if (!before) return out.push_back(std::move(s));
    std::get<SetFeed>(own->data).block_only = false;
    own->text = {};
    std::erase_if(b.actions,
                  [](const Action& a) { return std::holds_alternative<SetFeed>(a.data) && !a.text.empty(); });
    const LineInfo like = s.line;
    Body pieces;
    pieces.push_back(std::move(s));
    pieces.push_back(make_block(like, action(SetFeed{*before, false, false})));
    editor.put_group(out, std::move(pieces), 0);
  });
}

}  // namespace cnctrans::ir::passes
