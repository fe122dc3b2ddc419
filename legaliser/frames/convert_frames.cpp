// Work offsets and the programmable frame (equivalences 17): shift and rotation are followed along the program and said
// again in the target's own slots.
#include <algorithm>
#include <set>

#include "base/text.h"
#include "legaliser/analysis/words.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"
#include "legaliser/frames/frame_rebuild.h"
#include "legaliser/frames/frame_variables.h"
#include "legaliser/frames/preset_ends.h"
#include "legaliser/frames/without_length.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

/// A turn by 0 on top of what is in force.
bool turns_nothing(const FrameChange& c) {
  return c.kind == FrameKind::rotate && c.combine == FrameCombine::compose && c.has_angle && c.angle.is(0) &&
         c.words.empty();
}

class FramePass {
 public:
  FramePass(Program& program, const LegaliseContext& context, const FactsOf& facts, bool no_presets = false)
      : program_(program),
        context_(context),
        facts_(facts),
        states_(program, facts, context),
        target_(program, context, no_presets || presets_taken_back(program, context, facts, states_)),
        without_length_(program, context, facts),
        preset_ends_(program, context) {}

  void routine(Routine& r) {
    find_groups(r.body, label_uses(program_, r));
    Editor editor(program_, r, context_);
    rewrite_body(r.body, [&](Statement&& s, Body& out) {
      auto* b = std::get_if<Block>(&s.node);
      if (std::holds_alternative<End>(s.node)) return end(editor, std::move(s), states_.before(s), out);
      if (b != nullptr) change_plane(s, *b);
      if (b == nullptr || !concerns(*b)) {
        out.push_back(std::move(s));
        return;
      }
      block(editor, std::move(s), states_.before(s), out);
    });
  }

  /// Statements whose frame depends on the path.
  [[nodiscard]] const std::set<std::uint32_t>& lost() const { return lost_; }

 private:
  static bool concerns(const Block& b) {
    return std::any_of(b.actions.begin(), b.actions.end(),
                       [](const Action& a) {
                         return std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data);
                       }) ||
           (b.has_motion && b.motion.frame != FrameUse::normal);
  }

  static bool counts_from_machine(const FrameChange& change) {
    bool found = false;
    for (const auto& w : change.words) {
      walk(w.value.expr, [&found](const ExprPtr& e) {
        const auto* datum = std::get_if<SystemRef>(&e->node);
        found = found || (datum != nullptr && datum->datum == Datum::machine_position);
      });
    }
    return found;
  }

  void block(Editor& editor, Statement&& s, FrameState state, Body& out) {
    auto& b = std::get<Block>(s.node);
    if (b.has_motion && b.motion.frame != FrameUse::normal && !machine_move(s, b)) {
      out.push_back(std::move(s));
      return;
    }
    std::vector<Action> actions;
    std::optional<FrameState> first;           // before several changes in a row that build one frame
    std::shared_ptr<const FrameChange> begun;  // the first of a block's changes that say one frame together
    for (std::size_t n = 0; n < b.actions.size(); ++n) {
      Action& a = b.actions[n];
      if (const auto* w = std::get_if<WorkOffset>(&a.data)) {
        const FrameState before = state;
        state.select(*w, context_.source_machine);
        work_offset(s, a, *w);
        actions.push_back(a);
        if (!target_.shift_again(state, actions)) {
          refuse(s, program_, context_, "TRN-326",
                 "a work offset takes the shift back on the target, and how far it is shifted here is not known",
                 "select the work offset before the shift", a.pos);
          out.push_back(std::move(s));
          return;
        }
        const PlanarFrame was = before.slot(FrameSlot::preset), now = state.slot(FrameSlot::preset);
        const bool same = was == now && (now.known() || before.preset_waits() == state.preset_waits());
        if (program_.dialect == context_.target.dialect || same) continue;
        FrameChange gone;  // what the preset holds goes, or comes back
        gone.slot = FrameSlot::preset;
        gone.kind = FrameKind::translate;
        gone.combine = FrameCombine::clear;
        if (!rebuild(s, a, gone, before, state, actions)) {
          out.push_back(std::move(s));
          return;
        }
      } else if (const auto* f = std::get_if<FrameOp>(&a.data); f != nullptr && f->change) {
        if (program_.dialect != context_.target.dialect && target_.chains() && turns_nothing(*f->change)) continue;
        if (program_.dialect != context_.target.dialect && counts_from_machine(*f->change)) {
          refuse(s, program_, context_, "TRN-325",
                 "frame: a shift or preset that counts from the machine position, which is not known here",
                 "shift the zero point by a number", a.pos);
          out.push_back(std::move(s));
          return;
        }
        const FrameState before = first ? *first : state;
        state.apply(*f->change, facts_.before(s), b, context_.source_machine);
        if (composed(b, n + 1)) {
          if (!first) first = before;
          continue;
        }
        if (waits(s, b, n + 1, state)) {
          if (!first) first = before;
          if (!begun) begun = f->change;
          continue;
        }
        first.reset();
        const bool silent = a.pos.column == 0 && target_.part(before).known() && before == state;
        const auto distance = setting_in<Distance>(b, facts_.before(s), Setting::distance);
        // A preset that the source keeps out of force with its work offsets would act at once on the target.
        const bool kept_off = f->change->slot == FrameSlot::preset && state.preset_waits() &&
                              context_.target_machine.policies.frame_preset != machine::FramePreset::with_work_offset;
        auto same =
            pending_ || begun || kept_off ? std::nullopt : target_.as_it_is(*f->change, before, state, distance);
        // Where nothing is turned yet, a turn on top of it is the turn.
        if (same && same->slot == FrameSlot::rotation && same->combine == FrameCombine::replace &&
            same->words.empty() && !same->angle.is(0) && !target_.part(before).turns() &&
            target_.can(FrameSlot::rotation, FrameCombine::add))
          same->combine = FrameCombine::add;
        const bool said_otherwise = same && same->by_distance_mode != f->change->by_distance_mode;
        if (same && !(said_otherwise && target_.part(state).known())) {
          if (same->combine != f->change->combine || same->by_distance_mode != f->change->by_distance_mode)
            a.data = FrameOp{std::make_shared<const FrameChange>(std::move(*same))};
          preset_ends_.tell(s, a, true);
          actions.push_back(std::move(a));
        } else if (silent && !begun) {
          continue;  // a reset of what is not there, made by the reader
        } else if (auto moved = pending_ || begun || setting<Units>(facts_.before(s), Setting::units) != Units::metric
                                    ? std::nullopt
                                    : target_.preset_from_here(*f->change, state)) {
          a.data = FrameOp{std::make_shared<const FrameChange>(std::move(*moved))};
          preset_ends_.tell(s, a, false);
          actions.push_back(std::move(a));
        } else if (waiting_.count(s.id) != 0) {
          pending_ = true;
        } else if (!rebuild(s, a, begun ? *begun : *f->change, before, state, actions)) {
          out.push_back(std::move(s));
          return;
        } else {
          pending_ = false;
          preset_ends_.tell(s, a, false);
        }
      } else {
        actions.push_back(std::move(a));
      }
    }
    b.actions = std::move(actions);
    tell_mirror(s, state);
    settle(s);
    editor.put(out, {}, std::move(s));
  }

  /// The action goes on with the chain that the one before it began.
  bool composed(const Block& b, std::size_t n) const {
    if (n >= b.actions.size() || program_.dialect == context_.target.dialect || target_.chains()) return false;
    const auto* f = std::get_if<FrameOp>(&b.actions[n].data);
    return f != nullptr && f->change && f->change->slot == FrameSlot::chain &&
           f->change->combine == FrameCombine::compose;
  }

  /// The next change of the block makes a frame that is known out of one that is not (`now`), or takes all of it back.
  bool waits(const Statement& s, const Block& b, std::size_t n, FrameState now) const {
    if (program_.dialect == context_.target.dialect) return false;
    const bool known = target_.part(now).known();
    for (std::size_t k = n; k < b.actions.size(); ++k) {
      const auto* f = std::get_if<FrameOp>(&b.actions[k].data);
      if (f == nullptr || !f->change || f->change->slot == FrameSlot::chain || counts_from_machine(*f->change))
        return false;
      now.apply(*f->change, facts_.before(s), b, context_.source_machine);
      const PlanarFrame next = target_.part(now);
      if (known ? next.neutral() : next.known()) return true;
    }
    return false;
  }

  /// A mirror beside what the manual of one of the two controls leaves open.
  void tell_mirror(const Statement& s, const FrameState& state) {
    if (mirror_told_ || program_.dialect == context_.target.dialect) return;
    const PlanarFrame f = target_.part(state);
    if (!f.mirror || *f.mirror == 0) return;
    const auto mirrored = [&f](std::size_t axis) { return (*f.mirror >> axis & 1U) != 0; };
    const PlaneAxes in_plane = plane_axes(f.plane);
    const bool turned = f.turns() && mirrored(in_plane.u) != mirrored(in_plane.v);
    bool shifted = false;
    for (std::size_t axis = 0; axis < PlanarFrame::axes; ++axis)
      shifted = shifted || (mirrored(axis) && !(f.shift[axis] && f.shift[axis]->is(0)));
    const auto open = [&](const machine::Profile& m) {
      const auto order = m.policies.frame_mirror_order;
      return (turned && order != machine::FrameMirrorOrder::stated) ||
             (shifted && order == machine::FrameMirrorOrder::assumed);
    };
    if (!open(context_.source_machine) && !open(context_.target_machine)) return;
    mirror_told_ = true;
    context_.diagnostics.warning(
        "TRN-481", s.line.span,
        std::string("a mirror together with a ") + (turned ? "rotation" : "shift") +
            ": in which order they apply is not stated for one of the two controls (said once "
            "a program)",
        "check the first points behind it on the machine; the profile's option frame.mirror_order");
  }

  /// A shift that outlives the program on the target is taken back where the source forgets it.
  void end(Editor& editor, Statement&& s, const FrameState& state, Body& out) const {
    Body before;
    const bool needed =
        context_.target.shift_survives_end && program_.dialect != context_.target.dialect && !state.neutral();
    if (needed && target_.can(FrameSlot::shift, FrameCombine::clear)) {
      s.line.joined = false;
      for (auto& a : target_.taken_back(state)) before.push_back(make_block(s.line, std::move(a)));
    }
    editor.put(out, std::move(before), std::move(s));
  }

  /// A plane function while a rotation is in force: on some controls it may end it. Back in the plane of the rotation
  /// it is said again there.
  void change_plane(const Statement& s, Block& b) const {
    const auto may_end = [](const machine::Profile& m) {
      return m.policies.frame_plane_change == machine::FramePlaneChange::may_end_rotation;
    };
    const bool from = may_end(context_.source_machine), to = may_end(context_.target_machine);
    if ((!from && !to) || program_.dialect == context_.target.dialect) return;
    const auto set = std::find_if(b.actions.begin(), b.actions.end(), [](const Action& a) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      return m != nullptr && m->setting == Setting::plane;
    });
    if (set == b.actions.end()) return;
    const auto plane = static_cast<Plane>(std::get<ModalSet>(set->data).value);
    if (setting<Plane>(facts_.before(s), Setting::plane) == plane) return;
    const PlanarFrame now = target_.part(states_.before(s));
    if (!now.turns()) return;
    if (now.known() && now.plane == plane && !from && target_.can(FrameSlot::rotation, FrameCombine::replace)) {
      auto again = std::make_shared<FrameChange>();
      again->slot = FrameSlot::rotation;
      again->kind = FrameKind::rotate;
      again->combine = FrameCombine::replace;
      again->has_angle = true;
      again->angle = *now.angle;
      b.actions.insert(set + 1, action(FrameOp{std::move(again)}));
      return;
    }
    context_.diagnostics.warning(
        "TRN-327", word_span(s.line.span, set->pos),
        std::string("a plane function while a rotation is in force: ") +
            (from ? "the source's control may end the rotation here (its manual does not say), "
                    "the target keeps it"
                  : "the target may end the rotation here (its manual does not say), the "
                    "source keeps it"),
        "end the rotation before the plane function and set it again after it");
  }

  bool machine_move(Statement& s, Block& b) {
    if (!machine_words(s, b)) return false;
    const auto& uses = context_.target.frame_uses;
    if (uses.count(b.motion.frame) != 0) return true;
    if (b.motion.frame == FrameUse::machine_with_length && uses.count(FrameUse::machine) != 0) {
      if (!without_length_.holds(s))
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
    const auto positions = [](const machine::Profile& m) {
      return m.policies.machine_move_words == machine::MachineMoveWords::absolute;
    };
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

  /// The whole programmable frame in the target's slots. False: refused.
  bool rebuild(Statement& s, const Action& a, const FrameChange& c, const FrameState& before, const FrameState& after,
               std::vector<Action>& out) {
    const auto& b = std::get<Block>(s.node);
    const auto plane = setting_in<Plane>(b, facts_.before(s), Setting::plane);
    std::optional<PlanarFrame> held;
    if (!pending_) held = target_.part(before);
    const auto result = target_.rebuild(c, held, target_.part(after), target_.kept_by(c, before, after), plane, out);
    using Result = FrameTarget::Result;
    if (result == Result::done) return true;
    if (result == Result::impossible) {
      refuse(s, program_, context_, "TRN-326", "the target can't hold this frame",
             "transform the coordinates of the part", a.pos);
      return false;
    }
    const std::string what = result == Result::foreign
                                 ? "a scale of single axes, a rotation in space or a preset that is not carried over"
                                 : "what the programmable frame holds here depends on the path that leads here";
    if (result == Result::unknown) lost_.insert(s.id);
    refuse(s, program_, context_, "TRN-325", "frame: " + what, "set the whole frame in one place", a.pos);
    return false;
  }

  // ---- statements that build one frame together

  /// Frame statements that follow one another without motion and without a way into their midst build one frame. One
  /// waits for the next where the frame is not known before that, or where a chained target would say it all again.
  void find_groups(Body& body, const LabelUses& uses) {
    for (std::size_t i = 0; i < body.size(); ++i) {
      each_body(body[i], [this, &uses](Body& inner) { find_groups(inner, uses); });
      if (!only_frames(body[i])) continue;
      std::vector<std::size_t> members{i};
      for (std::size_t j = i + 1; j < body.size() && !is_range_end(body[members.back()], uses); ++j) {
        if (is_remark(body[j])) continue;
        if (!only_frames(body[j]) || is_target(body[j], uses)) break;
        members.push_back(j);
      }
      // From the last member whose frame is known back: what comes before it may wait.
      while (!members.empty() && !after(body[members.back()]).known()) members.pop_back();
      for (std::size_t m = 0; m + 1 < members.size(); ++m) {
        const PlanarFrame here = after(body[members[m]]), next = after(body[members[m + 1]]);
        if (!here.known() || (target_.chains() && !target_.extends(here, next))) waiting_.insert(body[members[m]].id);
      }
      if (!members.empty()) i = members.back();
    }
  }

  /// A block of nothing but frame statements that holds for every run.
  static bool only_frames(const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    return b != nullptr && !b->has_motion && !b->actions.empty() && s.line.skip_mask == 0 &&
           std::all_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
             const auto* f = std::get_if<FrameOp>(&a.data);
             return f != nullptr && f->change && f->change->combine != FrameCombine::preset;
           });
  }
  template <class Test>
  static bool any_label(const Statement& s, const Test& test) {
    const auto labels = labels_on(s.line);
    return std::any_of(labels.begin(), labels.end(), test);
  }
  static bool is_target(const Statement& s, const LabelUses& uses) {
    return any_label(s, [&uses](const LabelRef& l) { return uses.is_target(l); });
  }
  static bool is_range_end(const Statement& s, const LabelUses& uses) {
    return any_label(s, [&uses](const LabelRef& l) { return uses.is_end(l); });
  }
  PlanarFrame after(const Statement& s) const {
    const auto& b = std::get<Block>(s.node);
    FrameState state = states_.before(s);
    for (const auto& a : b.actions) {
      if (const auto* f = std::get_if<FrameOp>(&a.data); f != nullptr && f->change)
        state.apply(*f->change, facts_.before(s), b, context_.source_machine);
    }
    return target_.part(state);
  }

  Program& program_;
  const LegaliseContext& context_;
  const FactsOf& facts_;
  const FrameStates states_;
  const FrameTarget target_;
  const WithoutLength without_length_;
  std::set<std::uint32_t> waiting_, lost_;
  bool pending_ = false;  ///< statements before this one wait to be said here
  bool mirror_told_ = false;
  const PresetEnds preset_ends_;
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

/// Some statement adds to the frame that it finds.
bool adds_frames(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        const auto* f = std::get_if<FrameOp>(&a.data);
        found = found || (f != nullptr && f->change &&
                          (f->change->by_distance_mode || f->change->combine == FrameCombine::compose ||
                           f->change->combine == FrameCombine::add));
      }
    });
  }
  return found;
}

/// A try on a copy: statements that the pass would refuse because the frame depends on the path.
std::set<std::uint32_t> lost_frames(Program copy, const LegaliseContext& context) {
  Diagnostics unheard;
  const LegaliseContext quiet{context.target, context.source_machine, context.target_machine, context.options, unheard,
                              nullptr,        context.source_numbers, context.names};
  const FactsOf facts(copy, quiet);
  FramePass pass(copy, quiet, facts);
  for (auto& r : copy.routines) pass.routine(r);
  return pass.lost();
}

}  // namespace

void convert_frames(Program& program, const LegaliseContext& context) {
  if (!uses_frames(program)) return;
  if (program.dialect != context.target.dialect && adds_frames(program)) {
    number_statements(program);
    const auto lost = lost_frames(program, context);
    if (!lost.empty()) keep_frames_in_variables(program, context, lost);
  }
  const FactsOf facts(program, context);
  FramePass pass(program, context, facts);
  for (auto& r : program.routines) pass.routine(r);
}

void shift_lasting_presets(Program& program, const LegaliseContext& context) {
  if (!presets_outlast(program, context)) return;
  Diagnostics heard;
  const LegaliseContext quiet{context.target, context.source_machine, context.target_machine, context.options, heard,
                              nullptr,        context.source_numbers, context.names};
  Program tried = program;
  const FactsOf facts(tried, quiet);
  FramePass pass(tried, quiet, facts, true);
  for (auto& r : tried.routines) pass.routine(r);
  if (heard.error_count() == 0) program = std::move(tried);
  PresetEnds(program, context).tell_kept(program);
}

}  // namespace cnctrans::ir::passes
