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
#include "legaliser/frames/machine_moves.h"
#include "legaliser/frames/preset_ends.h"
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
        machine_moves_(program, context, facts),
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

  /// The frame changes of one block, in their order.
  struct Changes {
    Block& block;
    FrameState state;                               ///< behind those that have been looked at
    std::vector<Action> actions;                    ///< what becomes of the block's
    std::optional<FrameState> first = {};           ///< before several changes in a row that build one frame
    std::shared_ptr<const FrameChange> begun = {};  ///< the first of those that say one frame together
  };

  void block(Editor& editor, Statement&& s, FrameState state, Body& out) {
    auto& b = std::get<Block>(s.node);
    bool good = !b.has_motion || b.motion.frame == FrameUse::normal || machine_moves_.fit(s, b);
    Changes c{b, std::move(state), {}};
    for (std::size_t n = 0; n < b.actions.size() && good; ++n) {
      Action& a = b.actions[n];
      if (const auto* w = std::get_if<WorkOffset>(&a.data)) {
        good = offset(s, a, *w, c);
      } else if (const auto* f = std::get_if<FrameOp>(&a.data); f != nullptr && f->change) {
        good = change(s, n, f->change, c);
      } else {
        c.actions.push_back(std::move(a));
      }
    }
    if (!good) return out.push_back(std::move(s));
    b.actions = std::move(c.actions);
    tell_mirror(s, c.state);
    settle(s);
    editor.put(out, {}, std::move(s));
  }

  /// False: refused.
  bool offset(Statement& s, const Action& a, const WorkOffset& w, Changes& c) {
    const FrameState before = c.state;
    c.state.select(w, context_.source_machine);
    work_offset(s, a, w);
    c.actions.push_back(a);
    if (!target_.shift_again(c.state, c.actions)) {
      refuse(s, program_, context_, "TRN-326",
             "a work offset takes the shift back on the target, and how far it is shifted here is not known",
             "select the work offset before the shift", a.pos);
      return false;
    }
    const PlanarFrame was = before.slot(FrameSlot::preset), now = c.state.slot(FrameSlot::preset);
    const bool same = was == now && (now.known() || before.preset_waits() == c.state.preset_waits());
    if (program_.dialect == context_.target.dialect || same) return true;
    FrameChange gone;  // what the preset holds goes, or comes back
    gone.slot = FrameSlot::preset;
    gone.kind = FrameKind::translate;
    gone.combine = FrameCombine::clear;
    return rebuild(s, a, gone, before, c.state, c.actions);
  }

  /// The n-th action of the block. False: refused.
  bool change(Statement& s, std::size_t n, const std::shared_ptr<const FrameChange>& f, Changes& c) {
    Action& a = c.block.actions[n];
    if (program_.dialect != context_.target.dialect && target_.chains() && turns_nothing(*f)) return true;
    if (program_.dialect != context_.target.dialect && counts_from_machine(*f)) {
      refuse(s, program_, context_, "TRN-325",
             "frame: a shift or preset that counts from the machine position, which is not known here",
             "shift the zero point by a number", a.pos);
      return false;
    }
    const FrameState before = c.first ? *c.first : c.state;
    c.state.apply(*f, facts_.before(s), c.block, context_.source_machine);
    const bool goes_on = composed(c.block, n + 1);
    if (goes_on || waits(s, c.block, n + 1, c.state)) {
      if (!c.first) c.first = before;
      if (!goes_on && !c.begun) c.begun = f;
      return true;
    }
    c.first.reset();
    return say(s, a, *f, before, c);
  }

  /// The change as the target says it. False: refused.
  bool say(Statement& s, Action& a, const FrameChange& f, const FrameState& before, Changes& c) {
    const FrameState& state = c.state;
    const bool silent = a.pos.column == 0 && target_.part(before).known() && before == state;
    const auto distance = setting_in<Distance>(c.block, facts_.before(s), Setting::distance);
    // A preset that the source keeps out of force with its work offsets would act at once on the target.
    const bool kept_off = f.slot == FrameSlot::preset && state.preset_waits() &&
                          context_.target_machine.policies.frame_preset != machine::FramePreset::with_work_offset;
    const bool several = pending_ || c.begun;
    auto same = several || kept_off ? std::nullopt : target_.as_it_is(f, before, state, distance);
    // Where nothing is turned yet, a turn on top of it is the turn.
    if (same && same->slot == FrameSlot::rotation && same->combine == FrameCombine::replace && same->words.empty() &&
        !same->angle.is(0) && !target_.part(before).turns() && target_.can(FrameSlot::rotation, FrameCombine::add))
      same->combine = FrameCombine::add;
    const bool said_otherwise = same && same->by_distance_mode != f.by_distance_mode;
    if (same && !(said_otherwise && target_.part(state).known())) {
      if (same->combine != f.combine || same->by_distance_mode != f.by_distance_mode)
        a.data = FrameOp{std::make_shared<const FrameChange>(std::move(*same))};
      preset_ends_.tell(s, a, true);
      c.actions.push_back(std::move(a));
      return true;
    }
    if (silent && !c.begun) return true;  // a reset of what is not there, made by the reader
    const bool metric = setting<Units>(facts_.before(s), Setting::units) == Units::metric;
    if (auto moved = several || !metric ? std::nullopt : target_.preset_from_here(f, state)) {
      a.data = FrameOp{std::make_shared<const FrameChange>(std::move(*moved))};
      preset_ends_.tell(s, a, false);
      c.actions.push_back(std::move(a));
      return true;
    }
    if (waiting_.count(s.id) != 0) {
      pending_ = true;
      return true;
    }
    if (!rebuild(s, a, c.begun ? *c.begun : f, before, state, c.actions)) return false;
    pending_ = false;
    preset_ends_.tell(s, a, false);
    return true;
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
  const MachineMoves machine_moves_;
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
