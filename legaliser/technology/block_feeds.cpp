// A feed of one block for a target whose F stays in force: the feed of before is written behind the block, where there
// is one.
#include <algorithm>

#include "legaliser/analysis/facts.h"
#include "legaliser/analysis/feed_before.h"
#include "legaliser/analysis/words.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"

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

/// A rapid has no feed: the word says nothing there, and what a cycle cuts at its end has the feed in force.
bool idle(const Block& b, const Facts& facts) {
  return b.has_motion && motion_in(b, facts) == MotionKind::rapid &&
         std::none_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
           return std::holds_alternative<Corner>(a.data) || std::holds_alternative<TangentialEnd>(a.data);
         });
}

/// What is modal runs at the end of the block, and cuts at the feed in force, not at that of the way.
bool runs_behind(const Block& b, const Facts& facts) {
  const bool modal = facts.modal_call > 0 || facts.cycle_active;
  return modal && b.has_motion && b.motion.moves() && b.motion.frame == FrameUse::normal && b.repeat_given == 0;
}

/// The block again where its move has ended: at the end of the way.
Block at_its_end(const Block& b, const Facts& facts) {
  Block there;
  there.has_motion = true;
  there.motion.kind = MotionKind::rapid;
  there.motion.explicit_code = true;
  there.motion.keeps_modal = false;
  for (CoordWord c : b.motion.coords) {
    if (distance_of(c, b, facts) != Distance::absolute) {
      c.mode = WordMode::incremental;
      c.value = Value(0);
    }
    there.motion.coords.push_back(std::move(c));
  }
  return there;
}

}  // namespace

void write_block_feeds(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || !has_block_feed(program)) return;
  const FactsOf facts(program, context);
  const FeedsBefore feeds(program, context);
  edit_blocks(program, context, [&](Editor& editor, Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    const auto own = std::find_if(b.actions.begin(), b.actions.end(), is_block_feed);
    if (own == b.actions.end()) return out.push_back(std::move(s));
    if (idle(b, facts.before(s))) {
      b.actions.erase(own);
      return out.push_back(std::move(s));
    }
    const FeedBefore known = feeds.at(s, b, facts.before(s));
    std::optional<Value> before = known.word();
    for (const auto& a : b.actions) {  // F beside FB= is the one that stays
      const auto* f = std::get_if<SetFeed>(&a.data);
      if (f != nullptr && !f->block_only) before = f->value;
    }
    if (!before && !known.none) return out.push_back(std::move(s));
    if (!b.has_motion || !b.motion.moves()) {
      // No way, and so nothing for it to say; as a word of the path it runs what is modal.
      const Facts& now = facts.before(s);
      const bool modal = now.modal_call_runs() || now.cycle_active || !now.cycle_active_known;
      const bool beside = std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
        return std::holds_alternative<SetFeed>(a.data) && !is_block_feed(a);
      });
      if (modal && !before && !beside) return out.push_back(std::move(s));  // no F to run it by: refused
      if (modal && !beside) {
        own->data = SetFeed{*before, false, false};
        own->text = {};
      } else {
        b.actions.erase(own);
      }
      settle(s);
      return out.push_back(std::move(s));
    }
    std::get<SetFeed>(own->data).block_only = false;
    own->text = {};
    std::erase_if(b.actions,
                  [](const Action& a) { return std::holds_alternative<SetFeed>(a.data) && !a.text.empty(); });
    const LineInfo like = s.line;
    Block behind;
    if (runs_behind(b, facts.before(s))) {
      behind = at_its_end(b, facts.before(s));
      behind.actions = take_after(b);
      b.repeat_given = 1;  // the way alone
      b.repeat = Value(0);
    }
    if (before) behind.actions.insert(behind.actions.begin(), action(SetFeed{*before, false, false}));
    Body pieces;
    pieces.push_back(std::move(s));
    if (!behind.empty()) pieces.push_back(made(like, std::move(behind)));
    editor.put_group(out, std::move(pieces), 0);
  });
}

}  // namespace cnctrans::ir::passes
