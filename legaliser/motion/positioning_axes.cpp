// Axes that move by themselves, for a target whose axes all belong to the path: each becomes a straight move of its
// own, at its own feed or in rapid; the motion code and the feed of before are written behind it.
#include <algorithm>
#include <array>

#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

bool sets_axis_feed(const Assign::Item& i) {
  return i.to_system && i.system.datum == Datum::axis_feed;
}
bool has_positioning(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      const auto* a = std::get_if<Assign>(&s.node);
      found = found || (b != nullptr && positions_alone(*b)) ||
              (a != nullptr && std::any_of(a->items.begin(), a->items.end(), sets_axis_feed));
    });
  }
  return found;
}

class PositioningAxes {
 public:
  PositioningAxes(Program& program, const LegaliseContext& context)
      : program_(program), context_(context), facts_(program, context) {}

  void run() {
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [this](const Statement& s) {
        const auto* a = std::get_if<Assign>(&s.node);
        fed_ = fed_ || (a != nullptr && std::any_of(a->items.begin(), a->items.end(), sets_axis_feed));
      });
    }
    for (auto& r : program_.routines) {
      uses_ = label_uses(program_, r);
      forget();
      if (r.kind == RoutineKind::main) feed_.fill(0.0);
      no_feed_ = r.kind == RoutineKind::main;
      Editor editor(program_, r, context_);
      const bool flat = std::none_of(r.body.begin(), r.body.end(), [](const Statement& s) {
        return std::holds_alternative<If>(s.node) || std::holds_alternative<While>(s.node) ||
               std::holds_alternative<For>(s.node) || std::holds_alternative<Loop>(s.node) ||
               std::holds_alternative<Until>(s.node);
      });
      if (!flat) {
        forget();
        no_feed_ = false;
      }
      rewrite_body(r.body, [&](Statement&& s, Body& out) { one(editor, std::move(s), out, flat); });
    }
  }

 private:
  void forget() { feed_.fill(fed_ ? std::nullopt : std::optional(0.0)); }

  void one(Editor& editor, Statement&& s, Body& out, bool flat) {
    for (const auto& l : labels_on(s.line)) {
      if (!uses_.is_target(l) && !uses_.computed) continue;
      forget();
      no_feed_ = false;
    }
    if (auto* a = std::get_if<Assign>(&s.node)) {
      if (flat && s.line.skip_mask == 0 && !take_feeds(*a)) {
        if (a->items.empty()) s.node = Label{};  // nothing is left of it
      }
      return out.push_back(std::move(s));
    }
    auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) {
      const bool goes_on = std::holds_alternative<Message>(s.node) || std::holds_alternative<Declare>(s.node) ||
                           std::holds_alternative<Label>(s.node) || std::holds_alternative<Jump>(s.node);
      if (!goes_on) {
        forget();
        no_feed_ = false;
      }
      return out.push_back(std::move(s));
    }
    no_feed_ = no_feed_ && std::none_of(b->actions.begin(), b->actions.end(),
                                        [](const Action& a) { return std::holds_alternative<SetFeed>(a.data); });
    if (!positions_alone(*b) || !write(editor, s, *b, out)) out.push_back(std::move(s));
  }

  /// Takes literal axis feeds out of the assignment; true when some feed is left in it.
  bool take_feeds(Assign& a) {
    bool left = false;
    std::erase_if(a.items, [&](const Assign::Item& i) {
      if (!sets_axis_feed(i)) return false;
      const auto value = constant_value(i.value);
      feed_[i.system.axis] = value;
      left = left || !value;
      return value.has_value();
    });
    return left;
  }

  bool write(Editor& editor, Statement& s, Block& b, Body& out) {
    const Facts& facts = facts_.before(s);
    const bool fed = std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                                 [this](const CoordWord& c) { return feed_[c.axis].value_or(1) > 0; });
    for (const auto& c : b.motion.coords) {
      if (!feed_[c.axis]) return false;
    }
    const auto mode = setting_in<FeedMode>(b, facts, Setting::feed_mode);
    const bool line = facts.motion == MotionKind::linear || facts.motion == MotionKind::rapid;
    if (facts.modal_call != 0 || facts.cycle_active || !facts.cycle_active_known) return false;
    if (fed && !facts.feed && !no_feed_) return false;
    if (!line || (fed && mode != FeedMode::per_minute)) return false;
    const LineInfo like = s.line;
    Body pieces;
    const std::vector<CoordWord> words = std::move(b.motion.coords);
    b.motion.clear();
    b.has_motion = false;
    Block first = std::move(b);
    for (const auto& word : words) {
      Block move = pieces.empty() ? std::move(first) : Block{};
      const double feed = *feed_[word.axis];
      move.has_motion = true;
      move.motion.kind = feed > 0 ? MotionKind::linear : MotionKind::rapid;
      move.motion.explicit_code = true;
      move.motion.coords.push_back(word);
      move.motion.coords.back().positioning = Positioning::with_path;
      if (feed > 0) move.actions.push_back(action(SetFeed{Value{feed}, false, false}));
      Statement piece;
      if (pieces.empty()) piece.line = s.line;
      if (!pieces.empty()) piece.line.span = like.span;
      piece.node = std::move(move);
      pieces.push_back(std::move(piece));
    }
    Block back;
    back.has_motion = true;
    back.motion.kind = *facts.motion;
    back.motion.explicit_code = true;
    if (fed && facts.feed) back.actions.push_back(action(SetFeed{Value{*facts.feed}, false, false}));
    pieces.push_back(made(like, std::move(back)));
    editor.put_group(out, std::move(pieces), 0);
    return true;
  }

  Program& program_;
  const LegaliseContext& context_;
  const FactsOf facts_;
  LabelUses uses_;
  bool no_feed_ = false;  ///< the program has given no F so far: there is none to come back to
  bool fed_ = false;      ///< some axis has a feed of its own somewhere
  std::array<std::optional<double>, axis::count_max> feed_{};  ///< of an axis by itself; 0: rapid; empty: not known
};

}  // namespace

void write_positioning(Program& program, const LegaliseContext& context) {
  if (program.dialect != context.target.dialect && has_positioning(program)) PositioningAxes(program, context).run();
}

}  // namespace cnctrans::ir::passes
