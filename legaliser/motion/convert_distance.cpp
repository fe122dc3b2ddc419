// Absolute and incremental words (equivalences 7): a word with its own mode where the target knows block modes only.
#include <algorithm>
#include <array>
#include <iterator>
#include <map>

#include "ir/analysis/flow_states.h"
#include "legaliser/analysis/words.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"
#include "legaliser/frames/axis_scales.h"
#include "legaliser/frames/shifted_axes.h"
#include "legaliser/motion/path_values.h"
#include "legaliser/motion/polar_words.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

class DistancePass {
 public:
  DistancePass(const Program& program, const LegaliseContext& context, const FactsOf& facts)
      : context_(context), facts_(facts) {
    keeps_differ_ =
        context.source_machine.policies.frame_change_keeps != context.target_machine.policies.frame_change_keeps;
    if (!keeps_differ_) return;
    unmoved_.emplace(program, UnmovedAxes(context.source_machine.power_on.plane, head_selects_offset(context)));
    for (const auto& r : program.routines) {
      for_each_statement(r.body, [this](const Statement& s) {
        const auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr) return;
        for (const auto& a : b->actions) {
          const auto* f = std::get_if<FrameOp>(&a.data);
          turns_ = turns_ || (f != nullptr && f->change && turns(*f->change));
        }
      });
    }
    if (context.source_machine.policies.frame_change_keeps == machine::FrameChangeKeeps::machine &&
        (head_selects_offset(context) ||
         std::any_of(program.routines.begin(), program.routines.end(), UnmovedAxes::adds)))
      path_.emplace(program, facts, context.target_machine, context);
  }

  void block(Editor& editor, Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    if (!context_.target.distance_inside_block) keep_last(b);
    if (!context_.target.distance_per_word) drop_modes_in_force(b, facts_.before(s));
    const bool settled = watch_frames(s, b);
    if (settled && !context_.target.distance_per_word &&
        setting_in<Distance>(b, facts_.before(s), Setting::distance) == Distance::incremental)
      return switch_for_block(editor, std::move(s), Distance::incremental, out);
    if (!wants_work(b)) {
      out.push_back(std::move(s));
      return;
    }
    const Facts& facts = facts_.before(s);
    const auto mode = setting_in<Distance>(b, facts, Setting::distance);
    std::size_t foreign = 0, own = 0;
    for (auto& c : b.motion.coords) {
      const auto d = explicit_mode(c);
      if (d && mode && d == mode) c.mode = WordMode::modal;
      if (explicit_mode(c))
        ++foreign;
      else
        ++own;
    }
    const bool switches = own == 0 && mode && uniform(b) && !centres_follow(b);
    if (foreign == 0 || to_block_mode(b, mode, facts, !switches)) {
      out.push_back(std::move(s));
      return;
    }
    if (switches) return switch_for_block(editor, std::move(s), *mode, out);
    if (mode && all_in_other_mode(b, *mode, facts)) return switch_for_block(editor, std::move(s), *mode, out);
    if (mode)
      refuse(s, editor.program, context_, "TRN-181",
             "absolute and incremental words in one block, and the position before it is not known here",
             "write the block in one mode, or in two blocks");
    else
      refuse(s, editor.program, context_, "TRN-181",
             "a word that is absolute or incremental by itself, and which of the two modes is in force depends on the "
             "path that leads here",
             "write G90 or G91 before it on every path");
    out.push_back(std::move(s));
  }

  void end_routine() {
    for (const auto& [axis, where] : displaced_) tell_displaced(where);
    displaced_.clear();
  }
  void new_routine(Editor& editor) {
    dirty_ = turned_ = 0;
    shifted_.clear_all();
    const Routine& r = editor.routine;
    uses_ = label_uses(editor.program, r);
    straight_ = r.kind == RoutineKind::main;
    for (const auto& s : r.body) {
      const bool structured = std::holds_alternative<While>(s.node) || std::holds_alternative<Until>(s.node) ||
                              std::holds_alternative<For>(s.node) || std::holds_alternative<Loop>(s.node) ||
                              (std::holds_alternative<If>(s.node) && !std::get<If>(s.node).one_line);
      if (structured) straight_ = false;
    }
    if (straight_) shifted_.start();
  }
  /// A statement that is no block: does control go on in the text, and with the frame as it was?
  void other(const Statement& s) {
    leave_straight(s);
    if (const auto* assign = std::get_if<Assign>(&s.node)) {
      for (const auto& i : assign->items) {
        const auto a = axis_of_component(i);
        if (!a) continue;
        turned_ |= 1U << *a;
        shifted_.at[*a] = shifted_.moved[*a] = std::nullopt;
      }
    }
    const bool goes_on = std::holds_alternative<Assign>(s.node) || std::holds_alternative<Message>(s.node) ||
                         std::holds_alternative<Declare>(s.node) || std::holds_alternative<Label>(s.node) ||
                         std::holds_alternative<Jump>(s.node);
    if (!goes_on) shifted_.clear_all();
  }

 private:
  /// Of several changes in one block (each counts for the words behind it) the last one stays in force.
  static void keep_last(Block& b) {
    const auto sets = [](const Action& a) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      return m != nullptr && m->setting == Setting::distance;
    };
    auto left = std::count_if(b.actions.begin(), b.actions.end(), sets);
    std::erase_if(b.actions, [&](const Action& a) { return sets(a) && left-- > 1; });
  }

  void leave_straight(const Statement& s) {
    for (const auto& l : labels_on(s.line)) {
      if (uses_.is_target(l) || uses_.computed) return shifted_.clear_all();
    }
  }

  static std::optional<Distance> explicit_mode(const CoordWord& c) {
    if (c.mode == WordMode::absolute) return Distance::absolute;
    if (c.mode == WordMode::incremental) return Distance::incremental;
    return std::nullopt;
  }
  bool wants_work(const Block& b) const {
    if (!b.has_motion || context_.target.distance_per_word) return false;
    // Which of two modes in a block counts for the centre of an arc is nowhere said.
    if (context_.target.distance_inside_block && b.motion.centers.empty()) return false;
    return std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                       [](const CoordWord& c) { return c.mode != WordMode::modal; });
  }
  static bool uniform(const Block& b) {
    const auto first = explicit_mode(b.motion.coords.front());
    return std::all_of(b.motion.coords.begin(), b.motion.coords.end(),
                       [&](const CoordWord& c) { return explicit_mode(c) == first; });
  }

  /// All words in the block's mode, from the known position. False: nothing is changed. `asks`: where it is not known
  /// the target's own knowledge of it may stand in the text.
  bool to_block_mode(Block& b, std::optional<Distance> mode, const Facts& facts, bool asks = true) const {
    if (!mode) return false;
    std::vector<CoordWord> coords = b.motion.coords;
    for (auto& c : coords) {
      const auto d = explicit_mode(c);
      if (!d) continue;
      const auto from = to_radius(c.axis, c.scale, d, b, facts, context_.source_machine);
      const auto to = to_radius(c.axis, WordScale::modal, mode, b, facts, context_.source_machine);
      const auto& at = facts.position[c.axis];
      if (!from || !to) return false;
      if (d == mode) {
        c.value = scale(c.value, *from / *to);
        c.mode = WordMode::modal;
        c.scale = WordScale::modal;
        continue;
      }
      if (!at) {
        if (!asks || *mode != Distance::absolute || !from_machine(c, Datum::programmed_position, *from / *to))
          return false;
        continue;
      }
      const Value here{*at};
      const Value radius = scale(c.value, *from);
      c.value = scale(*mode == Distance::absolute ? add(here, radius) : subtract(radius, here), 1 / *to);
      c.value.text = {};
      c.mode = WordMode::modal;
      c.scale = WordScale::modal;
    }
    b.motion.coords = std::move(coords);
    return true;
  }

  /// Under the other mode the centre, or the point on the arc, would be another one.
  static bool centres_follow(const Block& b) {
    const auto follow = [](const std::vector<CenterWord>& words) {
      return std::any_of(words.begin(), words.end(),
                         [](const CenterWord& c) { return c.mode == CenterMode::follows_distance; });
    };
    return follow(b.motion.centers) || (b.motion.extra && follow(b.motion.extra->through));
  }

  /// A block with words of both modes, all in the other one than that in force. False: nothing is changed.
  bool all_in_other_mode(Block& b, Distance mode, const Facts& facts) const {
    const bool absolute = mode == Distance::incremental;
    const Motion as_it_was = b.motion;
    if (b.motion.extra || (centres_follow(b) && (absolute || !centres_from_start(b, facts)))) return false;
    for (auto& c : b.motion.coords) {
      if (c.mode == WordMode::modal) c.mode = absolute ? WordMode::incremental : WordMode::absolute;
    }
    if (to_block_mode(b, absolute ? Distance::absolute : Distance::incremental, facts)) return true;
    b.motion = as_it_was;
    return false;
  }
  /// Centres that are places become increments from the start.
  bool centres_from_start(Block& b, const Facts& facts) const {
    std::vector<CenterWord> centers = b.motion.centers;
    for (auto& c : centers) {
      const auto& at = facts.position[c.axis];
      const auto one = to_radius(c.axis, c.scale, Distance::absolute, b, facts, context_.source_machine);
      if (c.mode != CenterMode::follows_distance || one != 1 || !at) return false;
      c.value = subtract(c.value, Value{*at});
      c.value.text = {};
    }
    b.motion.centers = std::move(centers);
    return true;
  }

  /// The increment added to what the target knows as the last programmed coordinate, or as the place in the frame.
  bool from_machine(CoordWord& c, Datum datum, double factor) const {
    const auto here = at_run(context_, datum, c.axis);
    if (!here) return false;
    c.value = Value{binary(BinaryOp::add, here->expr, as_expr(scale(c.value, factor)))};
    c.mode = WordMode::modal;
    c.scale = WordScale::modal;
    return true;
  }

  /// The other mode for this block, and back in a block behind.
  void switch_for_block(Editor& editor, Statement&& s, Distance mode, Body& out) const {
    auto& b = std::get<Block>(s.node);
    const Distance other = mode == Distance::absolute ? Distance::incremental : Distance::absolute;
    for (auto& c : b.motion.coords) c.mode = WordMode::modal;
    bool said_behind = false;
    std::erase_if(b.actions, [&said_behind](const Action& a) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      if (m == nullptr || m->setting != Setting::distance) return false;
      said_behind = said_behind || a.order == Order::after;
      return a.order != Order::after;
    });
    b.actions.insert(b.actions.begin(),
                     action(ModalSet{Setting::distance, static_cast<std::uint8_t>(other), true, {}}));
    if (said_behind) return out.push_back(std::move(s));
    Body pieces;
    const LineInfo like = s.line;
    pieces.push_back(std::move(s));
    pieces.push_back(make_block(like, action(ModalSet{Setting::distance, static_cast<std::uint8_t>(mode), true, {}})));
    editor.put_group(out, std::move(pieces), 0);
  }

  /// The frame change as far as numbers go.
  void follow_frame(const Block& b, const Facts& facts, const FrameChange& c) {
    const bool metric = setting_in<Units>(b, facts, Setting::units) == Units::metric;
    const bool clears = c.combine == FrameCombine::clear;
    const bool replaces = c.combine == FrameCombine::replace;
    if (c.kind == FrameKind::translate && (clears || replaces)) {
      if (c.slot == FrameSlot::chain) shifted_.turned = false;
    } else if (c.kind != FrameKind::translate || c.by_distance_mode || c.combine != FrameCombine::replace_named) {
      shifted_.turned = shifted_.turned || !clears;
      if (c.kind != FrameKind::translate) return;
      return shifted_.clear_all();
    }
    for (AxisId a = 0; a < axis::first_extra; ++a) {
      std::optional<double> now = clears || replaces ? std::optional(0.0) : shifted_.shift[a];
      for (const auto& w : c.words) {
        if (w.axis != a) continue;
        const auto factor = to_radius(a, w.scale, Distance::absolute, b, facts, context_.source_machine);
        now = w.value.literal() && factor && metric ? std::optional(w.value.number * *factor) : std::nullopt;
      }
      auto& moved = shifted_.moved[a];
      moved = moved && now && shifted_.shift[a] ? std::optional(*moved + *now - *shifted_.shift[a]) : std::nullopt;
      shifted_.shift[a] = now;
    }
  }

  /// Where the source's control counts an increment of the axis from, in the frame in force (radius).
  std::optional<double> base(AxisId a, const Statement& s, const Block& b, const Facts& facts) const {
    if (!changes_here_ && facts.position[a]) return facts.position[a];
    if (const auto seen = path_ && !changes_here_ ? path_->number(s, a) : std::nullopt) return seen;
    if (!straight_ || (dirty_ >> a & 1U) == 0 || !shifted_.at[a]) return std::nullopt;  // a loop comes here again
    if (context_.source_machine.policies.frame_change_keeps == machine::FrameChangeKeeps::programmed) {
      const auto surface = facts.settings[static_cast<std::size_t>(Setting::surface)];
      if (!surface) return std::nullopt;
      if (*surface == static_cast<std::uint8_t>(Surface::none)) return shifted_.at[a];
    }  // on the face and the cylinder the point itself counts
    const bool metric = setting_in<Units>(b, facts, Setting::units) == Units::metric;
    const bool turned = shifted_.turned || (turned_ >> a & 1U) != 0;  // the old point was one of the turned frame
    if (turned || !shifted_.moved[a] || !metric) return std::nullopt;
    return *shifted_.at[a] - *shifted_.moved[a];
  }

  /// Increments right after a frame change become absolute where the place they start from is known.
  bool made_absolute(const Statement& s, Block& b, const Facts& facts) const {
    auto coords = absolute_words(b, facts, context_.source_machine, [&](AxisId a) { return base(a, s, b, facts); });
    if (!coords) return from_place(b, facts);
    b.motion.coords = std::move(*coords);
    return true;
  }
  /// Where the source counts from the place of the machine in the new frame, and the target can name that place.
  bool from_place(Block& b, const Facts& facts) const {
    if (changes_here_ ||  // the place would be read before the change
        context_.source_machine.policies.frame_change_keeps != machine::FrameChangeKeeps::machine ||
        !context_.target.distance_per_word || b.motion.extra || b.motion.frame != FrameUse::normal ||
        b.repeat_given != 0 || centres_follow(b) || setting_in<CompSide>(b, facts, Setting::comp) != CompSide::off)
      return false;
    std::vector<CoordWord> coords = b.motion.coords;
    for (auto& c : coords) {
      const auto d = distance_of(c, b, facts);
      if (d == Distance::absolute || (dirty_ >> c.axis & 1U) == 0) continue;
      if ((turned_ >> c.axis & 1U) != 0) return false;  // a repeat of such a block is better written out
      const auto* spec = context_.target_machine.axis(c.axis);
      if (d != Distance::incremental || c.scale != WordScale::modal || spec == nullptr || spec->diameter ||
          !from_machine(c, Datum::work_position, 1))
        return false;
      c.mode = WordMode::absolute;
    }
    b.motion.coords = std::move(coords);
    return true;
  }

  [[nodiscard]] bool ends_turn(const FrameChange& c) const {
    return c.combine == FrameCombine::clear || (replaces_chain(c) && shifted_.turned);
  }

  /// An increment right after a frame change: controls differ in what it is added to. True: its words are absolute now.
  bool watch_frames(const Statement& s, Block& b) {
    if (!keeps_differ_) return false;
    stay_displaced(s, b);
    leave_straight(s);
    if (const auto* waiting = unmoved_ ? unmoved_->before(s) : nullptr) {
      dirty_ = static_cast<std::uint32_t>(*waiting);
      if (turns_) turned_ |= UnmovedAxes::turned_axes(*waiting);
    }
    if (b.has_motion && is_polar(b.motion)) shifted_.at.fill(std::nullopt);
    const Facts& facts = facts_.before(s);
    changes_here_ = false;
    for (const auto& a : b.actions) {
      const auto* f = std::get_if<FrameOp>(&a.data);
      const bool offset = std::holds_alternative<WorkOffset>(a.data);
      changes_here_ = changes_here_ || f != nullptr || offset;
      if (f == nullptr && !offset) {
        const auto* m = std::get_if<ModalSet>(&a.data);
        if (m != nullptr && m->setting == Setting::units) shifted_.at.fill(std::nullopt);
        continue;
      }
      for (AxisId x = 0; x < axis::first_extra; ++x) {
        if ((dirty_ >> x & 1U) != 0) continue;  // changed again before a move
        shifted_.at[x] = facts.position[x];
        shifted_.moved[x] = 0;
      }
      dirty_ = ~0U;
      const auto* change = f != nullptr ? f->change.get() : nullptr;
      if (change != nullptr && (turns(*change) || (turns_ && ends_turn(*change)))) turned_ = ~0U;
      if (offset || !f->change || s.line.skip_mask != 0)
        shifted_.clear_all();
      else
        follow_frame(b, facts, *f->change);
    }
    if (!b.has_motion || dirty_ == 0) return false;
    const bool relative = std::any_of(b.motion.coords.begin(), b.motion.coords.end(), [&](const CoordWord& c) {
      return (dirty_ >> c.axis & 1U) != 0 && !holds_still(c) && distance_of(c, b, facts) != Distance::absolute;
    });
    const bool settled = relative && made_absolute(s, b, facts);
    for (const auto& c : b.motion.coords) {
      if (holds_still(c)) continue;
      const std::uint32_t bit = 1U << c.axis;
      const bool turned = (turned_ & bit) != 0;
      turned_ &= ~bit;
      if ((dirty_ & bit) == 0) continue;
      dirty_ &= ~bit;
      if (settled || distance_of(c, b, facts) == Distance::absolute) continue;
      const Span at = word_span(s.line.span, c.pos);
      // By how much is not known; behind a rotation, scale or mirror it is another direction as well.
      if (turned)
        context_.diagnostics.error("TRN-182", at, other_start, other_start_hint);
      else
        displaced_.emplace(c.axis, at);
    }
    return settled;
  }

  /// The axis stands elsewhere than in the source from that increment on, up to its next move to a place.
  void stay_displaced(const Statement& s, const Block& b) {
    if (!b.has_motion || !b.motion.moves()) return;
    const Facts& facts = facts_.before(s);
    for (auto it = displaced_.begin(); it != displaced_.end();) {
      auto& [axis, where] = *it;
      const bool placed = std::any_of(
          b.motion.coords.begin(), b.motion.coords.end(),
          [&, a = axis](const CoordWord& c) { return c.axis == a && distance_of(c, b, facts) == Distance::absolute; });
      if (!placed && s.line.span.file == where.file && s.line.span.line > std::max(where.line, where.end_line)) {
        where.end_line = s.line.span.line;
        where.end_column = s.line.span.end_column;
      }
      if (placed) tell_displaced(where);
      it = placed ? displaced_.erase(it) : std::next(it);
    }
  }
  void tell_displaced(const Span& where) const {
    context_.diagnostics.warning("TRN-182", where, other_start, other_start_hint);
  }
  static constexpr const char* other_start =
      "an incremental move of this axis right after a change of the offsets: the source and the target control differ "
      "in the point that it starts from";
  static constexpr const char* other_start_hint = "make the first move of the axis after the change absolute";

  const LegaliseContext& context_;
  const FactsOf& facts_;
  std::map<AxisId, Span> displaced_;  ///< from the increment on, as far as it is not told
  std::optional<FlowStates<UnmovedAxes>> unmoved_;
  std::optional<PathStates> path_;
  bool keeps_differ_ = false;
  bool changes_here_ =
      false;                  ///< the block at hand changes the frame itself: what is known before it is of the old one
  std::uint32_t turned_ = 0;  ///< bit n: not since a rotation, scale or mirror began or ended
  bool turns_ = false;        ///< the program has such
  std::uint32_t dirty_ = 0;   ///< bit n: axis n has not moved since the frame changed
  Shifted shifted_;
  LabelUses uses_;
  bool straight_ = false;
};

/// Where a frame change keeps the position of the machine, an increment of 0 behind it moves nothing; on the other
/// control it would travel the difference.
void leave_out_idle(Program& program, const LegaliseContext& context, const FactsOf& facts) {
  if (context.source_machine.policies.frame_change_keeps != machine::FrameChangeKeeps::machine ||
      context.target_machine.policies.frame_change_keeps == machine::FrameChangeKeeps::machine)
    return;
  bool changes = head_selects_offset(context), idle = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      UnmovedAxes::State none = 0;
      UnmovedAxes::transfer(s, none);
      changes = changes || (none & UnmovedAxes::axis_bits) != 0;
      const auto* b = std::get_if<Block>(&s.node);
      idle = idle || (b != nullptr && b->has_motion &&
                      std::any_of(b->motion.coords.begin(), b->motion.coords.end(),
                                  [](const CoordWord& c) { return c.value.is(0); }));
    });
  }
  if (!changes || !idle) return;
  const UnmovedAxes domain(context.source_machine.power_on.plane, head_selects_offset(context));
  const FlowStates<UnmovedAxes> unmoved(program, domain);
  const auto statement = [&](Statement& s) {
    auto* b = std::get_if<Block>(&s.node);
    const auto* waiting = b != nullptr ? unmoved.before(s) : nullptr;
    if (waiting == nullptr || !b->has_motion || b->motion.extra || !b->motion.centers.empty() || b->motion.radius_given)
      return;
    const auto kind = motion_in(*b, facts.before(s));  // not known: without a centre and a radius it is no arc
    if (kind && kind != MotionKind::rapid && kind != MotionKind::linear) return;
    const auto left = std::erase_if(b->motion.coords, [&](const CoordWord& c) {
      return (*waiting >> c.axis & UnmovedAxes::one) != 0 && c.value.is(0) &&
             distance_of(c, *b, facts.before(s)) == Distance::incremental;
    });
    if (left == 0) return;
    if (b->motion.coords.empty() && !b->motion.explicit_code) b->has_motion = false;
    context.diagnostics.note("TRN-562", s.line.span,
                             "an increment of 0 right after a change of the offsets moves nothing on the source; the "
                             "target would travel the change: it is left out");
  };
  for (auto& r : program.routines) for_each_statement(r.body, statement);
}

}  // namespace

void convert_distance(Program& program, const LegaliseContext& context) {
  const FactsOf facts(program, context);
  leave_out_idle(program, context, facts);
  DistancePass pass(program, context, facts);
  for (auto& routine : program.routines) {
    Editor editor(program, routine, context);
    pass.new_routine(editor);
    rewrite_body(routine.body, [&](Statement&& s, Body& out) {
      if (std::holds_alternative<Block>(s.node)) {
        pass.block(editor, std::move(s), out);
      } else {
        pass.other(s);
        out.push_back(std::move(s));
      }
    });
    pass.end_routine();
  }
}

}  // namespace cnctrans::ir::passes
