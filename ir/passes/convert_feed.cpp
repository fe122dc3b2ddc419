// The feed after a change of feed mode (equivalences 14.1): controls keep F, keep one F for each mode, or forget it.
// The target gets an explicit F before the next move at feed whenever its rule differs from the source's.
#include <algorithm>

#include "base/text.h"
#include "ir/passes/blocks.h"
#include "ir/passes/editor.h"
#include "ir/passes/facts.h"
#include "ir/passes/passes.h"

namespace cnctrans::ir::passes {

namespace {

const ModalSet* feed_mode_set(const Block& b) {
  const ModalSet* found = nullptr;
  for (const auto& a : b.actions) {
    if (const auto* m = std::get_if<ModalSet>(&a.data); m != nullptr && m->setting == Setting::feed_mode) found = m;
  }
  return found;
}

const SetFeed* feed_set(const Block& b) {
  for (const auto& a : b.actions) {
    if (const auto* f = std::get_if<SetFeed>(&a.data)) return f;
  }
  return nullptr;
}

bool needs_feed(MotionKind k) {
  return k == MotionKind::linear || k == MotionKind::arc_cw || k == MotionKind::arc_ccw ||
         k == MotionKind::arc_through_point || k == MotionKind::arc_tangent || k == MotionKind::spline ||
         k == MotionKind::polynomial;
}

class FeedPass {
 public:
  FeedPass(const LegaliseContext& context, const FactsOf& facts) : context_(context), facts_(facts) {}

  void routine(Body& body) { walk(body); }

 private:
  using Mode = std::uint8_t;

  void walk(Body& body) {
    for (auto& s : body) {
      if (auto* b = std::get_if<Block>(&s.node)) {
        block(s, *b);
      } else if (is_join(s)) {
        lost_ = lost_ || waiting_;
        known_.fill(std::nullopt);
      }
      if (!s.line.labels.empty()) known_.fill(std::nullopt);
      each_body(s, [this](Body& inner) { walk(inner); });
    }
  }

  /// Control may come from or go to somewhere else: what was seen in the text before does not count.
  static bool is_join(const Statement& s) {
    return !std::holds_alternative<Assign>(s.node) && !std::holds_alternative<Message>(s.node) &&
           !std::holds_alternative<Declare>(s.node) && !std::holds_alternative<Label>(s.node) &&
           !std::holds_alternative<Opaque>(s.node);
  }

  void block(Statement& s, Block& b) {
    const auto& facts = facts_.before(s);
    if (sets_units(b)) {  // the numbers seen so far are of another unit
      known_.fill(std::nullopt);
      other_unit_ = true;
    }
    if (const auto* set = feed_mode_set(b)) {
      const auto before = setting<Mode>(facts, Setting::feed_mode);
      if (before != std::optional<Mode>(set->value) && differs(set->feed_memory)) {
        waiting_ = true;
        lost_ = false;
        memory_ = set->feed_memory;
        mode_ = set->value;
        shared_ = other_unit_ ? std::nullopt : facts.feed;
      }
    }
    if (const auto* f = feed_set(b)) {
      waiting_ = false;
      other_unit_ = false;
      const auto mode = setting_in<Mode>(b, facts, Setting::feed_mode);
      if (mode && *mode < known_.size()) known_[*mode] = f->value;
    }
    if (!waiting_ || !b.has_motion || !b.motion.moves()) return;
    const auto kind = motion_in(b, facts);
    if (kind && !needs_feed(*kind)) return;
    give(s, b);
  }

  static bool sets_units(const Block& b) {
    return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      return m != nullptr && m->setting == Setting::units;
    });
  }

  [[nodiscard]] bool differs(FeedMemory source) const {
    return source != context_.target.feed_memory && source != FeedMemory::cleared;
  }

  void give(Statement& s, Block& b) {
    waiting_ = false;
    std::optional<Value> value;
    if (!lost_ && memory_ == FeedMemory::per_mode && mode_ < known_.size()) value = known_[mode_];
    if (!lost_ && !other_unit_ && memory_ == FeedMemory::shared && shared_) value = Value{*shared_};
    if (value && value->literal()) {
      value->text = {};
      b.actions.insert(b.actions.begin(), action(SetFeed{*value, false}));
      return;
    }
    context_.diagnostics.warning(
        "TRN-158", s.line.span,
        "the feed mode changed before this move and no F follows: the source goes on with a feed it "
        "remembers, which is not known here; the target has none",
        "write F in this block");
  }

  const LegaliseContext& context_;
  const FactsOf& facts_;
  bool waiting_ = false, lost_ = false;
  bool other_unit_ = false;  ///< the unit was set since the last F
  FeedMemory memory_ = FeedMemory::shared;
  Mode mode_ = 0;
  std::optional<double> shared_;
  std::array<std::optional<Value>, 3> known_{};
};

bool has_mode_change(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      found = found || (b != nullptr && feed_mode_set(*b) != nullptr);
    });
  }
  return found;
}

}  // namespace

void convert_feed(Program& program, const LegaliseContext& context) {
  if (!has_mode_change(program)) return;
  const FactsOf facts(program, context);
  for (auto& r : program.routines) FeedPass(context, facts).routine(r.body);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&context](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (auto& a : b->actions) {
        if (auto* m = std::get_if<ModalSet>(&a.data); m != nullptr && m->setting == Setting::feed_mode) {
          m->feed_memory = context.target.feed_memory;
        }
      }
    });
  }
}

}  // namespace cnctrans::ir::passes
