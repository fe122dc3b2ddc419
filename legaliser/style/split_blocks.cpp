// Order of actions inside a block (equivalences 4): one event, one block. What the source does after the motion and the
// target would do before it gets a block of its own behind, and the other way round; never are words reordered.
#include <algorithm>

#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

/// Order as far as the motion is concerned: `with` starts with it and counts as before.
bool is_after(Order o) {
  return o == Order::after;
}

/// What acts before the motion can't stand behind this in the same block: a dwell takes the place of the motion.
bool waits(const Action& a, Order o) {
  return is_after(o) || std::holds_alternative<Dwell>(a.data);
}

bool is_tool_word(const Action& a) {
  return std::holds_alternative<ToolSelect>(a.data) || std::holds_alternative<ToolChange>(a.data) ||
         std::holds_alternative<ToolOffset>(a.data);
}

/// Words that an event of the same block may rest on: they go where it goes.
bool goes_with_events(const Action& a) {
  if (makes_event(a) || is_tool_word(a) || std::holds_alternative<SetSpindle>(a.data)) return true;
  const auto* m = std::get_if<ModalSet>(&a.data);
  return m != nullptr && m->setting == Setting::spindle_mode;
}

/// The speed of a spindle, or what it counts in.
bool says_speed(const Action& a, std::uint8_t spindle) {
  const auto* speed = std::get_if<SetSpindle>(&a.data);
  const auto* mode = std::get_if<ModalSet>(&a.data);
  return (speed != nullptr && speed->number == spindle) ||
         (mode != nullptr && mode->setting == Setting::spindle_mode && spindle == 1);
}

/// When the block changes the tool, and whether by a word of its own; nullopt: it does not.
struct Change {
  Order order = Order::before;
  bool by_m = false;
};
std::optional<Change> tool_change(const Block& b) {
  std::optional<Change> found;
  for (const auto& a : b.actions) {
    if (std::holds_alternative<ToolChange>(a.data)) return Change{a.order, true};
    const auto* t = std::get_if<ToolSelect>(&a.data);
    if (t != nullptr && t->changes) found = Change{a.order, false};
  }
  return found;
}

/// When the target makes it.
Order theirs(const Change& change, const LegaliseContext& context) {
  return change.by_m ? target_order(action(ToolChange{}), context.target_machine) : Order::before;
}

/// The words of a tool change stay together; beside a move they need a block of their own where the target changes
/// at another time, and an M code for it always has one when another language is written (chapter 4).
bool change_leaves(const Block& b, const Program& program, const LegaliseContext& context) {
  const auto change = tool_change(b);
  if (!change || !has_motion(b)) return false;
  if (is_after(change->order) != is_after(theirs(*change, context))) return true;
  return change->by_m && program.dialect != context.target.dialect;
}

/// A mode that counts only behind the words of its block needs a block of its own where modes count for the whole
/// block.
bool mode_leaves(const Action& a, const Program& program, const Capabilities& target) {
  const auto* m = std::get_if<ModalSet>(&a.data);
  if (m == nullptr || !is_after(a.order) || program.dialect == target.dialect) return false;
  return m->setting != Setting::distance || !target.distance_inside_block;
}

/// F and S beside a dwell are the dwell's own where it may be programmed in revolutions.
bool apart_from_dwell(const std::vector<Action>& actions, const Action& next, const Capabilities& target) {
  const auto dwells = [](const Action& a) { return std::holds_alternative<Dwell>(a.data); };
  const auto speaks = [](const Action& a) {
    return std::holds_alternative<SetFeed>(a.data) || std::holds_alternative<SetSpindle>(a.data);
  };
  return target.dwell_revolutions && ((dwells(next) && std::any_of(actions.begin(), actions.end(), speaks)) ||
                                      (speaks(next) && std::any_of(actions.begin(), actions.end(), dwells)));
}

/// Without motion: the source commands its spindle before it changes the tool (at the end of the block), and the target
/// would change the tool first. Whether the spindle turns at the change is no matter of style.
bool spindle_before_change(const Block& b, const LegaliseContext& context) {
  const auto change = tool_change(b);
  return change && is_after(change->order) && !is_after(theirs(*change, context)) &&
         std::any_of(b.actions.begin(), b.actions.end(),
                     [](const Action& a) { return std::holds_alternative<SpindleRun>(a.data) && !is_after(a.order); });
}

/// A speed beside the stop of its spindle, which the source stops at once and the target behind the block: there the
/// spindle would turn at that speed first.
bool waits_for_stop(const Action& a, const std::vector<Action>& all, const LegaliseContext& context) {
  const auto* speed = std::get_if<SetSpindle>(&a.data);
  return speed != nullptr && !is_after(a.order) && std::any_of(all.begin(), all.end(), [&](const Action& x) {
           const auto* run = std::get_if<SpindleRun>(&x.data);
           return run != nullptr && run->state == SpindleState::off && run->number == speed->number &&
                  !is_after(x.order) && is_after(target_order(x, context.target_machine));
         });
}

class BlockSplitter {
 public:
  BlockSplitter(Editor& editor, Statement&& s) : editor_(editor), main_(std::move(s)) {}

  void put(Body& out) {
    auto& block = std::get<Block>(main_.node);
    const bool moving = has_motion(block);
    if (moving && change_leaves(block, editor_.program, editor_.context)) change_ = tool_change(block);
    const bool spindle_first = !moving && spindle_before_change(block, editor_.context);
    std::vector<Action> actions = std::move(block.actions);
    block.actions.clear();
    // A limit of the speed holds before the speed does.
    std::stable_partition(actions.begin(), actions.end(), [this](const Action& a) {
      return std::holds_alternative<SpindleLimit>(a.data) && own_block(a, editor_.target());
    });
    Body pieces;
    std::size_t at = 0;
    if (moving) {
      for (auto& a : actions) sort_in(std::move(a));
      sequence(std::move(early_), pieces);
      at = pieces.size();
      pieces.push_back(Statement{});
      sequence(std::move(late_), pieces);
    } else {
      if (spindle_first) {
        std::vector<Action> first;
        for (auto& a : actions) {
          if (!is_tool_word(a) && !is_after(a.order)) first.push_back(std::move(a));
        }
        std::erase_if(actions, [](const Action& a) { return !is_tool_word(a) && !is_after(a.order); });
        sequence(std::move(first), pieces);
      }
      sequence(std::move(actions), pieces);
      at = pieces.size() - 1;
      block.actions = std::move(std::get<Block>(pieces[at].node).actions);
    }
    pieces[at] = std::move(main_);
    editor_.put_group(out, std::move(pieces), at);
  }

 private:
  std::vector<Action>& gathered() { return std::get<Block>(main_.node).actions; }

  /// An action of a block that moves: with the motion, or in a block before or behind it.
  void sort_in(Action a) {
    if (change_ && is_tool_word(a)) return with_change(std::move(a));
    const Order theirs = target_order(a, editor_.context.target_machine);
    const bool event = makes_event(a);
    const bool leaves = own_block(a, editor_.target()) || (event && is_after(a.order) != is_after(theirs));
    if (is_after(a.order)) {
      if (leaves || mode_leaves(a, editor_.program, editor_.target()) || (event && !late_.empty())) {
        late_.push_back(std::move(a));
        return;
      }
    } else if (leaves) {
      if (event) pull_events();
      early_.push_back(std::move(a));
      return;
    }
    if (event) a.order = theirs;
    gathered().push_back(std::move(a));
  }

  /// T, D and the change. A D that counts for the move as well is said with both.
  void with_change(Action a) {
    const bool late = is_after(change_->order);
    if (late && std::holds_alternative<ToolOffset>(a.data) && !is_after(a.order)) gathered().push_back(a);
    a.order = Order::before;
    if (!late && std::holds_alternative<ToolChange>(a.data)) pull_events();
    (late ? late_ : early_).push_back(std::move(a));
  }

  /// What comes before an event that leaves leaves with it.
  void pull_events() {
    auto& b = gathered();
    for (auto& a : b) {
      if (goes_with_events(a)) early_.push_back(a);
    }
    std::erase_if(b, goes_with_events);
  }

  /// Without motion only the sequence of events counts: as few blocks as the target's order allows. The speed goes
  /// where the command to its spindle goes: a spindle that turns takes a speed at once (behind a tool change S1000 M3
  /// is one event, not two).
  void sequence(std::vector<Action> actions, Body& pieces) {
    std::vector<Action> block;
    bool reached_after = false;
    const auto cut = [&] {
      reached_after = false;
      if (block.empty()) return;
      Statement s = made(main_.line, Block{});
      std::get<Block>(s.node).actions = std::move(block);
      block.clear();
      pieces.push_back(std::move(s));
    };
    std::vector<Action> speeds;  // wait for the command to their spindle
    const auto add = [&](Action a) {
      if (const auto* run = std::get_if<SpindleRun>(&a.data)) {
        const auto own = std::stable_partition(
            speeds.begin(), speeds.end(), [number = run->number](const Action& w) { return !says_speed(w, number); });
        std::move(own, speeds.end(), std::back_inserter(block));
        speeds.erase(own, speeds.end());
      }
      block.push_back(std::move(a));
    };
    const std::vector<Action> all = actions;
    const auto late = std::stable_partition(actions.begin(), actions.end(),
                                            [&](const Action& a) { return !waits_for_stop(a, all, editor_.context); });
    for (auto at = actions.begin(); at != actions.end(); ++at) {
      Action& a = *at;
      if (at == late) cut();
      if (std::any_of(std::next(at), actions.end(), [&a](const Action& later) {
            const auto* run = std::get_if<SpindleRun>(&later.data);
            return run != nullptr && run->state != SpindleState::off && says_speed(a, run->number);
          })) {
        speeds.push_back(std::move(a));
        continue;
      }
      if (apart_from_dwell(block, a, editor_.target())) cut();
      if (own_block(a, editor_.target())) {
        cut();
        a.order = Order::before;
        add(std::move(a));
        cut();
        continue;
      }
      if (makes_event(a)) {
        const Order theirs = target_order(a, editor_.context.target_machine);
        if (reached_after && !is_after(theirs)) cut();
        reached_after = reached_after || waits(a, theirs);
        a.order = theirs;
      } else if (reached_after && std::holds_alternative<ToolSelect>(a.data)) {
        cut();
      }
      add(std::move(a));
    }
    cut();
  }

  Editor& editor_;
  Statement main_;
  std::vector<Action> early_, late_;
  std::optional<Change> change_;
};

bool needs_split(const Block& block, const Program& program, const LegaliseContext& context) {
  if (change_leaves(block, program, context)) return true;
  const bool moving = has_motion(block);
  if (!moving && spindle_before_change(block, context)) return true;
  bool reached_after = false;
  std::size_t others = block.has_motion ? 1 : 0;
  bool alone = false;
  for (const auto& a : block.actions) {
    ++others;
    if (own_block(a, context.target)) alone = true;
    if (apart_from_dwell(block.actions, a, context.target)) return true;
    if (moving && mode_leaves(a, program, context.target)) return true;
    if (waits_for_stop(a, block.actions, context)) return true;
    if (!makes_event(a)) continue;
    const bool theirs = is_after(target_order(a, context.target_machine));
    if (moving && theirs != is_after(a.order)) return true;
    if (!moving && reached_after && !theirs) return true;
    reached_after = reached_after || theirs || std::holds_alternative<Dwell>(a.data);
  }
  return alone && others > 1;
}

}  // namespace

void split_blocks(Program& program, const LegaliseContext& context) {
  edit_blocks(program, context, [&program, &context](Editor& editor, Statement&& s, Body& out) {
    auto& block = std::get<Block>(s.node);
    if (!needs_split(block, program, context)) {
      for (auto& a : block.actions) {
        if (makes_event(a)) a.order = target_order(a, context.target_machine);
      }
      out.push_back(std::move(s));
      return;
    }
    BlockSplitter(editor, std::move(s)).put(out);
  });
  split_crowded_blocks(program, context);
}

}  // namespace cnctrans::ir::passes
