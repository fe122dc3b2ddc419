// Absolute and incremental words (equivalences 7): a word with its own mode where the target knows block modes only.
#include <algorithm>

#include "ir/passes/blocks.h"
#include "ir/passes/editor.h"
#include "ir/passes/passes.h"
#include "ir/passes/words.h"

namespace cnctrans::ir::passes {

namespace {

class DistancePass {
 public:
  DistancePass(const LegaliseContext& context, const FactsOf& facts) : context_(context), facts_(facts) {
    keeps_differ_ =
        context.source_machine.option("frame.change_keeps") != context.target_machine.option("frame.change_keeps");
  }

  void block(Editor& editor, Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    watch_frames(s, b);
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
    if (foreign == 0 || to_block_mode(b, mode, facts)) {
      out.push_back(std::move(s));
      return;
    }
    if (own == 0 && mode && uniform(b)) return switch_for_block(editor, std::move(s), *mode, out);
    if (mode == Distance::incremental && all_absolute(b, facts))
      return switch_for_block(editor, std::move(s), *mode, out);
    refuse(s, editor.program, context_, "TRN-181",
           "absolute and incremental words in one block, and the position before it is not known here",
           "write the block in one mode, or in two blocks");
    out.push_back(std::move(s));
  }

  void new_routine() { dirty_ = 0; }

 private:
  static std::optional<Distance> explicit_mode(const CoordWord& c) {
    if (c.mode == WordMode::absolute) return Distance::absolute;
    if (c.mode == WordMode::incremental) return Distance::incremental;
    return std::nullopt;
  }
  bool wants_work(const Block& b) const {
    if (!b.has_motion || context_.target.distance_per_word || context_.target.distance_inside_block) return false;
    return std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                       [](const CoordWord& c) { return c.mode != WordMode::modal; });
  }
  static bool uniform(const Block& b) {
    const auto first = explicit_mode(b.motion.coords.front());
    return std::all_of(b.motion.coords.begin(), b.motion.coords.end(),
                       [&](const CoordWord& c) { return explicit_mode(c) == first; });
  }

  /// All words in the block's mode, from the known position. False: nothing is changed.
  bool to_block_mode(Block& b, std::optional<Distance> mode, const Facts& facts) const {
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
        if (!from_machine(c, *mode, *from / *to)) return false;
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

  /// A block of increments with absolute words beside them: all of them absolute. False: nothing is changed.
  bool all_absolute(Block& b, const Facts& facts) const {
    const std::vector<CoordWord> as_it_was = b.motion.coords;
    const bool centres = std::any_of(b.motion.centers.begin(), b.motion.centers.end(),
                                     [](const CenterWord& c) { return c.mode == CenterMode::follows_distance; });
    if (centres || b.motion.extra) return false;
    for (auto& c : b.motion.coords) {
      if (c.mode == WordMode::modal) c.mode = WordMode::incremental;
    }
    if (to_block_mode(b, Distance::absolute, facts)) return true;
    b.motion.coords = as_it_was;
    return false;
  }

  /// The increment added to what the target knows as the last programmed coordinate.
  bool from_machine(CoordWord& c, Distance mode, double factor) const {
    SystemRef here;
    here.datum = Datum::programmed_position;
    here.axis = c.axis;
    if (mode != Distance::absolute || !context_.target.system_data || !context_.target.system_data(here)) return false;
    Expr e;
    e.node = std::move(here);
    const Value step = scale(c.value, factor);
    c.value = Value{binary(BinaryOp::add, std::make_shared<const Expr>(std::move(e)), as_expr(step))};
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

  /// An increment right after a frame change: controls differ in what it is added to.
  void watch_frames(const Statement& s, const Block& b) {
    if (!keeps_differ_) return;
    for (const auto& a : b.actions) {
      if (std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data)) dirty_ = ~0U;
    }
    if (!b.has_motion || dirty_ == 0) return;
    for (const auto& c : b.motion.coords) {
      const std::uint32_t bit = 1U << c.axis;
      if ((dirty_ & bit) == 0) continue;
      dirty_ &= ~bit;
      if (distance_of(c, b, facts_.before(s)) == Distance::absolute) continue;
      context_.diagnostics.warning(
          "TRN-182", word_span(s.line.span, c.pos),
          "an incremental move of this axis right after a change of the offsets: the source and "
          "the target control differ in the point that it starts from",
          "make the first move of the axis after the change absolute");
    }
  }

  const LegaliseContext& context_;
  const FactsOf& facts_;
  bool keeps_differ_ = false;
  std::uint32_t dirty_ = 0;
};

}  // namespace

void convert_distance(Program& program, const LegaliseContext& context) {
  const FactsOf facts(program, context);
  DistancePass pass(context, facts);
  for (auto& routine : program.routines) {
    Editor editor(program, routine, context);
    pass.new_routine();
    rewrite_body(routine.body, [&](Statement&& s, Body& out) {
      if (std::holds_alternative<Block>(s.node))
        pass.block(editor, std::move(s), out);
      else
        out.push_back(std::move(s));
    });
  }
}

}  // namespace cnctrans::ir::passes
