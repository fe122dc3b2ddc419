// Work offsets and the programmable frame (equivalences 17): shift and rotation are followed along the program and said
// again in the target's own slots.
#include <algorithm>
#include <map>

#include "base/text.h"
#include "ir/passes/blocks.h"
#include "ir/passes/editor.h"
#include "ir/passes/frame_state.h"
#include "ir/passes/passes.h"
#include "ir/passes/words.h"

namespace cnctrans::ir::passes {

namespace {

class FramePass {
 public:
  FramePass(Program& program, const LegaliseContext& context, const FactsOf& facts)
      : program_(program), context_(context), facts_(facts), states_(program, facts, context) {}

  void routine(Routine& r) {
    Editor editor(program_, r, context_);
    rewrite_body(r.body, [&](Statement&& s, Body& out) {
      auto* b = std::get_if<Block>(&s.node);
      if (std::holds_alternative<End>(s.node)) return end(editor, std::move(s), states_.before(s), out);
      if (b == nullptr || !concerns(*b)) {
        out.push_back(std::move(s));
        return;
      }
      block(editor, std::move(s), states_.before(s), out);
    });
  }

 private:
  static bool concerns(const Block& b) {
    return std::any_of(b.actions.begin(), b.actions.end(),
                       [](const Action& a) {
                         return std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data);
                       }) ||
           (b.has_motion && b.motion.frame != FrameUse::normal);
  }

  void block(Editor& editor, Statement&& s, FrameState state, Body& out) {
    auto& b = std::get<Block>(s.node);
    if (b.has_motion && b.motion.frame != FrameUse::normal && !machine_move(s, b)) {
      out.push_back(std::move(s));
      return;
    }
    std::vector<Action> actions;
    for (auto& a : b.actions) {
      if (const auto* w = std::get_if<WorkOffset>(&a.data)) {
        work_offset(s, a, *w);
        actions.push_back(std::move(a));
      } else if (const auto* f = std::get_if<FrameOp>(&a.data); f != nullptr && f->change) {
        const FrameState before = state;
        state.apply(*f->change, facts_.before(s), b, context_.source_machine);
        const bool silent = a.pos.column == 0 && before.known() && before == state;
        if (legal(*f->change))
          actions.push_back(std::move(a));
        else if (silent)
          continue;  // a reset of what is not there, made by the reader
        else if (!rebuild(s, a, *f->change, before, state, actions)) {
          out.push_back(std::move(s));
          return;
        }
      } else {
        actions.push_back(std::move(a));
      }
    }
    b.actions = std::move(actions);
    editor.put(out, {}, std::move(s));
  }

  /// A shift that outlives the program on the target is taken back where the source forgets it.
  void end(Editor& editor, Statement&& s, const FrameState& state, Body& out) const {
    Body before;
    const bool needed =
        context_.target.shift_survives_end && program_.dialect != context_.target.dialect && !state.neutral();
    if (needed && can(FrameSlot::shift, FrameCombine::clear)) {
      s.line.joined = false;
      before.push_back(make_block(s.line, make(FrameSlot::shift, FrameKind::translate, FrameCombine::clear)));
      if (can(FrameSlot::rotation, FrameCombine::clear) && !(state.angle() && state.angle()->is(0)))
        before.push_back(make_block(s.line, make(FrameSlot::rotation, FrameKind::rotate, FrameCombine::clear)));
    }
    editor.put(out, std::move(before), std::move(s));
  }

  bool machine_move(Statement& s, Block& b) {
    if (!machine_words(s, b)) return false;
    const auto& uses = context_.target.frame_uses;
    if (uses.count(b.motion.frame) != 0) return true;
    if (b.motion.frame == FrameUse::machine_with_length && uses.count(FrameUse::machine) != 0) {
      context_.diagnostics.warning(
          "TRN-321", word_span(s.line.span, b.motion.frame_pos),
          "a move in machine coordinates that keeps the tool length: the target leaves the length out, so "
          "the slide stands off by the tool length",
          "check the height of this move");
      b.motion.frame = FrameUse::machine;
      return true;
    }
    refuse(s, program_, context_, "TRN-322", "a move in machine coordinates of a kind that the target lacks", {},
           b.motion.frame_pos);
    return false;
  }

  /// Increments and positions in machine coordinates, by what the modes mean there on both controls. False: refused.
  bool machine_words(Statement& s, Block& b) const {
    if (b.motion.frame == FrameUse::no_programmable) return true;
    const auto positions = [](const machine::Profile& m) { return m.option("machine_move.words") == "absolute"; };
    const bool from = positions(context_.source_machine), to = positions(context_.target_machine);
    const Capabilities& t = context_.target;
    for (auto& c : b.motion.coords) {
      if (from && c.mode == WordMode::modal) c.mode = WordMode::absolute;
      const auto d = distance_of(c, b, facts_.before(s));
      if (!to) continue;
      if (d == Distance::incremental) {
        refuse(s, program_, context_, "TRN-322", "an incremental move in machine coordinates, which the target lacks",
               "write the position in machine coordinates", c.pos);
        return false;
      }
      if (!d) {
        context_.diagnostics.warning(
            "TRN-321", word_span(s.line.span, c.pos),
            "whether this word in machine coordinates is absolute depends on the path that leads here; the target "
            "takes it as a machine position",
            "write the distance mode before this move");
      }
      const bool by_block = !t.distance_per_word && !t.distance_inside_block;
      c.mode = by_block ? WordMode::modal : WordMode::absolute;
    }
    return true;
  }

  void work_offset(const Statement& s, const Action& a, const WorkOffset& w) const {
    const Span where = word_span(s.line.span, a.pos);
    if (w.off) {
      if (!context_.target.work_offset_off) {
        context_.diagnostics.error("TRN-323", where, "the target can't switch the work offsets off",
                                   "select an offset of zero");
      }
      return;
    }
    if (w.index.literal() && w.index.number > context_.target.work_offset_rows) {
      context_.diagnostics.error("TRN-324", where,
                                 "work offset " + shortest(w.index.number) + ": the target selects 1 to " +
                                     std::to_string(context_.target.work_offset_rows),
                                 "use one of these, or shift the origin in the program");
    }
  }

  bool legal(const FrameChange& c) const {
    const auto slot = context_.target.frames.find(c.slot);
    if (slot == context_.target.frames.end() || slot->second.count(c.combine) == 0) return false;
    if (c.by_distance_mode && context_.target.dialect != program_.dialect)
      return slot->second.count(FrameCombine::add) != 0;
    return true;
  }

  static Action make(FrameSlot slot, FrameKind kind, FrameCombine combine, std::vector<FrameWord> words = {}) {
    auto change = std::make_shared<FrameChange>();
    change->slot = slot;
    change->kind = kind;
    change->combine = combine;
    change->words = std::move(words);
    return action(FrameOp{std::move(change)});
  }
  static Action rotation(FrameSlot slot, FrameCombine combine, const Value& angle) {
    auto change = std::make_shared<FrameChange>();
    change->slot = slot;
    change->kind = FrameKind::rotate;
    change->combine = combine;
    change->has_angle = true;
    change->angle = angle;
    return action(FrameOp{std::move(change)});
  }

  bool can(FrameSlot slot, FrameCombine combine) const {
    const auto it = context_.target.frames.find(slot);
    return it != context_.target.frames.end() && it->second.count(combine) != 0;
  }

  /// The whole programmable frame in the target's slots. False: refused.
  bool rebuild(Statement& s, const Action& a, const FrameChange& c, const FrameState& before, const FrameState& after,
               std::vector<Action>& out) {
    if (!after.known()) {
      const std::string what = after.foreign()
                                   ? "a mirror, a scale or a rotation that the passes do not carry over yet"
                                   : "what the programmable frame holds here depends on the path that leads here";
      refuse(s, program_, context_, "TRN-325", "frame: " + what, "set the whole frame in one place", a.pos);
      return false;
    }
    const bool chain = can(FrameSlot::chain, FrameCombine::replace);
    const std::size_t first = out.size();
    const bool done = chain ? to_chain(before, after, out) : to_slots(c, before, after, out);
    if (!done) {
      refuse(s, program_, context_, "TRN-326", "the target can't hold this frame",
             "transform the coordinates of the part", a.pos);
      return false;
    }
    for (std::size_t i = first; i < out.size(); ++i) out[i].pos = {};
    return true;
  }

  bool to_chain(const FrameState& before, const FrameState& f, std::vector<Action>& out) const {
    const auto words = f.shift_words(true);
    const bool turn_alone = before.known() && before.angle()->is(0) && !f.angle()->is(0) && same_shift(before, f);
    if (turn_alone) {
      // The shift is in force already.
    } else if (words.empty())
      out.push_back(make(FrameSlot::chain, FrameKind::translate, FrameCombine::clear));
    else
      out.push_back(make(FrameSlot::chain, FrameKind::translate, FrameCombine::replace, words));
    if (!f.angle()->is(0)) {
      if (!can(FrameSlot::chain, FrameCombine::compose)) return false;
      out.push_back(rotation(FrameSlot::chain, FrameCombine::compose, *f.angle()));
    }
    return true;
  }

  bool to_slots(const FrameChange& c, const FrameState& before, const FrameState& after,
                std::vector<Action>& out) const {
    if (!same_shift(before, after) || c.kind == FrameKind::translate || c.combine == FrameCombine::clear) {
      const auto words = after.shift_words(true);
      if (words.empty() && can(FrameSlot::shift, FrameCombine::clear)) {
        out.push_back(make(FrameSlot::shift, FrameKind::translate, FrameCombine::clear));
      } else if (can(FrameSlot::shift, FrameCombine::replace_named)) {
        out.push_back(
            make(FrameSlot::shift, FrameKind::translate, FrameCombine::replace_named, named_words(before, after)));
      } else if (can(FrameSlot::shift, FrameCombine::replace)) {
        out.push_back(make(FrameSlot::shift, FrameKind::translate, FrameCombine::replace, words));
      } else {
        return false;
      }
    }
    if (before.angle() && equal(*before.angle(), *after.angle())) return true;
    return rotate_slot(before, after, out);
  }

  bool rotate_slot(const FrameState& before, const FrameState& after, std::vector<Action>& out) const {
    const FrameSlot slot = FrameSlot::rotation;
    const bool neutral = after.angle()->is(0), was_neutral = before.angle() && before.angle()->is(0);
    if (can(slot, FrameCombine::replace)) {
      out.push_back(rotation(slot, FrameCombine::replace, *after.angle()));
      return true;
    }
    if (!can(slot, FrameCombine::add) || !can(slot, FrameCombine::clear)) return neutral && was_neutral;
    if (!was_neutral) out.push_back(make(slot, FrameKind::rotate, FrameCombine::clear));
    if (!neutral) out.push_back(rotation(slot, FrameCombine::add, *after.angle()));
    return true;
  }

  static bool same_shift(const FrameState& a, const FrameState& b) {
    for (std::size_t i = 0; i < FrameState::axes; ++i) {
      if (!a.shift(i) || !b.shift(i) || !equal(*a.shift(i), *b.shift(i))) return false;
    }
    return true;
  }

  /// Words for every axis whose shift changes or is not known to be right already.
  static std::vector<FrameWord> named_words(const FrameState& before, const FrameState& after) {
    std::vector<FrameWord> words;
    for (std::size_t i = 0; i < FrameState::axes; ++i) {
      const auto& to = *after.shift(i);
      if (before.shift(i) && equal(*before.shift(i), to) && (to.is(0) || !after.named(i))) continue;
      words.push_back(after.word(i));
    }
    if (words.empty()) {
      for (std::size_t i = 0; i < 3; ++i) words.push_back(after.word(i));
    }
    return words;
  }

  Program& program_;
  const LegaliseContext& context_;
  const FactsOf& facts_;
  const FrameStates states_;
};

bool uses_frames(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      found = found || (b->has_motion && b->motion.frame != FrameUse::normal);
      for (const auto& a : b->actions) {
        found = found || std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data);
      }
    });
  }
  return found;
}

}  // namespace

void convert_frames(Program& program, const LegaliseContext& context) {
  if (!uses_frames(program)) return;
  const FactsOf facts(program, context);
  FramePass pass(program, context, facts);
  for (auto& r : program.routines) pass.routine(r);
}

}  // namespace cnctrans::ir::passes
