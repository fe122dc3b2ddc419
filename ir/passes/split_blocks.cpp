// Order of actions inside a block (equivalences 4): one event, one block. What the source does after the motion and the
// target would do before it gets a block of its own behind, and the other way round; never are words reordered.
#include <algorithm>

#include "ir/passes/blocks.h"
#include "ir/passes/editor.h"
#include "ir/passes/passes.h"

namespace cnctrans::ir::passes {

namespace {

/// Order as far as the motion is concerned: `with` starts with it and counts as before.
bool is_after(Order o) {
  return o == Order::after;
}

class Splitter {
 public:
  Splitter(Editor& editor, Statement&& s) : editor_(editor), main_(std::move(s)) {}

  void put(Body& out) {
    auto& block = std::get<Block>(main_.node);
    std::vector<Action> actions = std::move(block.actions);
    block.actions.clear();
    const bool moving = has_motion(block) || defines_cycle(actions);
    for (auto& a : actions) sort_in(std::move(a), moving);
    pieces_.push_back(Statement{});  // place of the block itself
    const std::size_t at = pieces_.size() - 1;
    flush_after();
    const bool nothing_left = block.empty() && block.repeat_given == 0 && pieces_.size() > 1;
    if (nothing_left && at > 0) {
      fold_main_into(pieces_[at - 1]);
      pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(at));
      editor_.put_group(out, std::move(pieces_), at - 1);
      return;
    }
    pieces_[at] = std::move(main_);
    editor_.put_group(out, std::move(pieces_), at);
  }

 private:
  static bool defines_cycle(const std::vector<Action>& actions) {
    return std::any_of(actions.begin(), actions.end(),
                       [](const Action& a) { return std::holds_alternative<CycleDefine>(a.data); });
  }

  /// The line's comments and marks go to `s`, which replaces the block.
  void fold_main_into(Statement& s) {
    auto node = std::move(s.node);
    s = std::move(main_);
    s.node = std::move(node);
  }

  Block& main_block() { return std::get<Block>(main_.node); }

  /// A block of its own before (or, when `behind`, after) the motion.
  void own(Action a, bool behind) {
    a.order = Order::before;
    Statement s = made(main_.line, Block{});
    std::get<Block>(s.node).actions.push_back(std::move(a));
    (behind ? after_ : pieces_).push_back(std::move(s));
  }

  void sort_in(Action a, bool moving) {
    const Order theirs = target_order(a, editor_.context.target_machine);
    const bool alone = own_block(a, editor_.target());
    if (moving) {
      if (is_after(a.order) != is_after(theirs) && makes_event(a)) return own(std::move(a), is_after(a.order));
      if (alone) return own(std::move(a), is_after(a.order));
      if (makes_event(a)) a.order = theirs;
      main_block().actions.push_back(std::move(a));
      return;
    }
    // Without motion only the sequence of events counts.
    if (alone) {
      cut();
      return own(std::move(a), false);
    }
    if (makes_event(a)) {
      if (reached_after_ && !is_after(theirs)) cut();
      reached_after_ = reached_after_ || is_after(theirs);
      a.order = theirs;
    }
    main_block().actions.push_back(std::move(a));
  }

  /// What has been gathered so far becomes a block of its own.
  void cut() {
    reached_after_ = false;
    if (main_block().actions.empty()) return;
    Statement s = made(main_.line, Block{});
    std::get<Block>(s.node).actions = std::move(main_block().actions);
    main_block().actions.clear();
    pieces_.push_back(std::move(s));
  }

  void flush_after() {
    for (auto& s : after_) pieces_.push_back(std::move(s));
    after_.clear();
  }

  Editor& editor_;
  Statement main_;
  Body pieces_, after_;
  bool reached_after_ = false;
};

bool needs_split(const Block& block, const LegaliseContext& context) {
  const bool moving = has_motion(block);
  bool reached_after = false;
  std::size_t others = block.has_motion ? 1 : 0;
  bool alone = false;
  for (const auto& a : block.actions) {
    ++others;
    if (own_block(a, context.target)) alone = true;
    if (!makes_event(a)) continue;
    const bool theirs = is_after(target_order(a, context.target_machine));
    if (moving && theirs != is_after(a.order)) return true;
    if (!moving && reached_after && !theirs) return true;
    reached_after = reached_after || theirs;
  }
  return alone && others > 1;
}

}  // namespace

void split_blocks(Program& program, const LegaliseContext& context) {
  edit_blocks(program, context, [&context](Editor& editor, Statement&& s, Body& out) {
    auto& block = std::get<Block>(s.node);
    if (!needs_split(block, context)) {
      for (auto& a : block.actions) {
        if (makes_event(a)) a.order = target_order(a, context.target_machine);
      }
      out.push_back(std::move(s));
      return;
    }
    Splitter(editor, std::move(s)).put(out);
  });
}

}  // namespace cnctrans::ir::passes
