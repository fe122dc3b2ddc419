// Canned cycles (equivalences 22): native where the target has exactly the moves, else written out move by move. Some
// controls run the cycle where it is defined and at each later point, some only at later points by a modal call.
#include "ir/passes/lower_cycles.h"

#include <algorithm>
#include <utility>

#include "ir/passes/blocks.h"
#include "ir/passes/editor.h"
#include "ir/passes/passes.h"

namespace cnctrans::ir::passes {

namespace {

class CyclePass {
 public:
  CyclePass(Program& program, Routine& routine, const LegaliseContext& context, const FactsOf& facts)
      : program_(program),
        context_(context),
        facts_(facts),
        editor_(program, routine, context),
        height_(label_uses(program, routine)) {
    by_call_ = context.target.modal_cycle_by_call;
  }

  void run() {
    Body out;
    walk(editor_.routine.body, out);
    editor_.routine.body = std::move(out);
  }

 private:
  struct Active {
    CyclePtr source;
    CyclePtr native;  ///< null: written out
    CycleTrigger trigger = CycleTrigger::plane_axis_word;
    bool on_target = false;            ///< the target's own cycle is in force
    std::optional<double> defined_at;  ///< height of the tool at the definition, mm
    std::optional<double> height;      ///< of the tool over the holes, mm
  };

  void walk(Body& body, Body& out) {
    out.reserve(body.size());
    for (auto& s : body) {
      each_body(s, [this](Body& inner) {
        Body nested;
        walk(inner, nested);
        inner = std::move(nested);
      });
      one(std::move(s), out);
    }
  }

  void one(Statement&& s, Body& out) {
    const Statement seen = std::holds_alternative<Block>(s.node) ? s : made(s.line, Label{});
    const bool harmless = ToolHeight::keeps(s);
    const std::size_t first = out.size();
    const auto* source = std::get_if<Block>(&seen.node);
    lower(std::move(s), out);
    for (std::size_t i = first; i < out.size() && source != nullptr && !source->empty(); ++i) settle(out[i]);
    const auto* b = std::get_if<Block>(&seen.node);
    const bool ran = active_ && b != nullptr && (defines(*b) || triggers(*b, facts_.before(seen)));
    height_.follow(seen, facts_.before(seen), ran ? active_->source : nullptr, harmless);
  }
  static bool defines(const Block& b) {
    return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
      const auto* d = std::get_if<CycleDefine>(&a.data);
      return d != nullptr && d->here;
    });
  }

  void lower(Statement&& s, Body& out) {
    if (auto* m = std::get_if<ModalCall>(&s.node)) {
      if (m->off && active_) return cancel_statement(std::move(s), out);
      if (m->off && !by_call_ && !context_.target.modal_call && facts_.before(s).modal_call == 0) {
        // Only a cycle can be meant, or nothing.
        const bool nothing = facts_.before(s).cycle_active_known && !facts_.before(s).cycle_active;
        const bool bare = s.line.number.empty() && s.line.labels.empty() && s.line.comments.empty();
        if (nothing && bare) return;
        if (nothing) {
          s.node = Label{};
        } else {
          Block b;
          b.actions.push_back(action(CycleCancel{}));
          s.node = std::move(b);
        }
        out.push_back(std::move(s));
        return;
      }
      if (!m->off && m->cycle) return modal_call(std::move(s), out);
    }
    if (std::holds_alternative<Block>(s.node)) return block(std::move(s), out);
    if (active_ && !active_->native &&
        (std::holds_alternative<CallRoutine>(s.node) || std::holds_alternative<Repeat>(s.node))) {
      context_.diagnostics.error(
          "TRN-331", s.line.span,
          "a call or a repeated part while a cycle is active that the target lacks: which holes it drills "
          "can't be seen here",
          "cancel the cycle before the call");
    }
    out.push_back(std::move(s));
  }

  void put(Body& out, Body&& pieces, Statement&& s) {
    const std::size_t main = pieces.size();
    pieces.push_back(std::move(s));
    put_group(out, std::move(pieces), main);
  }
  void put_group(Body& out, Body&& pieces, std::size_t main) {
    if (!late_.empty()) {
      Block behind;
      behind.actions = std::exchange(late_, {});
      pieces.push_back(made(pieces[main].line, std::move(behind)));
    }
    editor_.put_group(out, std::move(pieces), main);
  }
  /// What acts after the motion acts after the hole: behind all its pieces.
  void hold_back(Block& b, bool native) {
    const bool stays = native && (!by_call_ || std::none_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
                         return a.order == Order::after && makes_event(a);
                       }));
    if (!stays) late_ = take_after(b);
  }

  // --- definitions ----------------------------------------------------------------------------------------------

  std::optional<double> height_mm(const Block& b, const Facts& facts, AxisId w) const {
    const auto units = setting_in<Units>(b, facts, Setting::units);
    if (!facts.position[w] || !units) return std::nullopt;
    return *facts.position[w] * (*units == Units::inch ? 25.4 : 1);
  }

  Active define(const CyclePtr& cycle, CycleTrigger trigger, const Block& b, const Facts& facts) const {
    Active a;
    a.source = cycle;
    a.trigger = trigger;
    const auto* hole = std::get_if<HoleCycle>(&cycle->node);
    const auto w = hole != nullptr ? cycle_axis(*hole, b, facts) : std::nullopt;
    if (w) a.height = height_mm(b, facts, *w);
    if (!a.height && w) a.height = height_.at(*w);
    a.defined_at = a.height;
    if (auto native = native_form(cycle, b, facts, context_, in_units(a.height, b, facts))) a.native = *native;
    return a;
  }
  static std::optional<double> in_units(std::optional<double> mm, const Block& b, const Facts& facts) {
    const auto units = setting_in<Units>(b, facts, Setting::units);
    if (!mm || !units) return std::nullopt;
    return *units == Units::inch ? *mm / 25.4 : *mm;
  }

  void cancel_statement(Statement&& s, Body& out) {
    const bool on = active_->on_target;
    active_.reset();
    if (on) {
      if (!by_call_) {
        Block b;
        b.actions.push_back(action(CycleCancel{}));
        s.node = std::move(b);
      }
      out.push_back(std::move(s));
      return;
    }
    if (s.line.number.empty() && s.line.labels.empty() && s.line.comments.empty()) return;
    s.node = Label{};
    out.push_back(std::move(s));
  }

  /// `MCALL CYCLE..`: the cycle runs at later points.
  void modal_call(Statement&& s, Body& out) {
    const ModalCall m = std::get<ModalCall>(s.node);
    active_ = define(m.cycle, CycleTrigger::path_motion, Block{}, facts_.before(s));
    if (by_call_ && active_->native) {
      std::get<ModalCall>(s.node).cycle = active_->native;
      active_->on_target = true;
      out.push_back(std::move(s));
      return;
    }
    // The target defines and runs in one: each point gets its own.
    if (s.line.number.empty() && s.line.labels.empty() && s.line.comments.empty()) return;
    s.node = Label{};
    out.push_back(std::move(s));
  }

  // --- blocks ---------------------------------------------------------------------------------------------------

  void block(Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    WordPos pos;
    const bool cancelled = take_cancel(b);
    const auto definition = take_definition(b, pos);
    Body pieces;
    if (cancelled) cancel(s, b, definition.has_value(), pieces);
    if (definition) {
      define_in_block(std::move(s), *definition, std::move(pieces), out);
      return;
    }
    if (active_) {
      point(std::move(s), std::move(pieces), out);
      return;
    }
    if (b.empty() && !pieces.empty()) {
      pieces.back().line = s.line;
      out.push_back(std::move(pieces.back()));
      return;
    }
    put(out, std::move(pieces), std::move(s));
  }

  void cancel(const Statement& s, Block& b, bool defines_again, Body& pieces) {
    // A cancel where nothing can be active is a habit of safe starts; as a modal call it would only puzzle.
    const Facts& facts = facts_.before(s);
    const bool none = by_call_ && facts.cycle_active_known && !facts.cycle_active;
    const bool on = active_ ? active_->on_target : !defines_again && !written_out_ && !none;
    active_.reset();
    if (!on || defines_again) return;
    if (by_call_)
      pieces.push_back(off_statement(s.line, true));
    else
      b.actions.insert(b.actions.begin(), action(CycleCancel{}));
  }

  void define_in_block(Statement&& s, const CycleDefine& d, Body&& pieces, Body& out) {
    auto& b = std::get<Block>(s.node);
    const Facts& facts = facts_.before(s);
    const auto old_on = active_ && active_->on_target;
    Active a = define(d.cycle, d.trigger, b, facts);
    const auto* hole = std::get_if<HoleCycle>(&d.cycle->node);
    const auto w = hole != nullptr ? cycle_axis(*hole, b, facts) : std::nullopt;
    const bool point_here = w && has_plane_word(b, *w);
    if (d.here) hold_back(b, a.native != nullptr);
    if (!a.native) {
      if (old_on) pieces.push_back(off_statement(s.line, by_call_));
      written_out_ = true;
      active_ = a;
      if (d.here)
        write_out(std::move(s), std::move(pieces), out);
      else
        put(out, std::move(pieces), std::move(s));
      if (!d.modal) active_.reset();
      return;
    }
    if (!by_call_) {
      CycleDefine native = d;
      native.cycle = a.native;
      native.trigger = CycleTrigger::plane_axis_word;
      if (!d.here) {  // the next point runs it
        active_ = a;
        put(out, std::move(pieces), std::move(s));
        return;
      }
      b.actions.push_back(action(native));
      if (d.modal) {
        a.on_target = true;
        active_ = a;
      }
      put(out, std::move(pieces), std::move(s));
      return;
    }
    define_by_call(std::move(s), d, std::move(a), point_here, std::move(pieces), out);
  }

  void define_by_call(Statement&& s, const CycleDefine& d, Active&& a, bool point_here, Body&& pieces, Body& out) {
    auto& b = std::get<Block>(s.node);
    if (!d.modal) {
      if (point_here || !b.empty()) {
        pieces.push_back(std::move(s));
        const LineInfo like = pieces.back().line;
        const std::size_t main = pieces.size() - 1;
        pieces.push_back(single_run(like, a.native));
        put_group(out, std::move(pieces), main);
      } else {
        b.actions.push_back(action(CycleDefine{a.native, false, true, CycleTrigger::path_motion}));
        put(out, std::move(pieces), std::move(s));
      }
      return;
    }
    a.on_target = true;
    const LineInfo like = s.line;
    if (!b.actions.empty()) {  // F and S first: the call takes them
      Block first;
      first.actions = std::move(b.actions);
      b.actions.clear();
      pieces.push_back(made(like, std::move(first)));
    }
    if (d.here && !point_here) {
      if (b.has_motion && b.motion.moves()) {
        Statement mover = made(like, Block{});
        std::get<Block>(mover.node).has_motion = true;
        std::get<Block>(mover.node).motion = std::move(b.motion);
        pieces.push_back(std::move(mover));
      }
      pieces.push_back(single_run(like, a.native));
      s.node = ModalCall{};
      std::get<ModalCall>(s.node).cycle = a.native;
      pieces.push_back(std::move(s));
      active_ = a;
      const std::size_t main = pieces.size() - 1;
      put_group(out, std::move(pieces), main);
      return;
    }
    pieces.push_back(on_statement(like, a.native));
    if (point_here) {
      position_kind(b);
      pieces.push_back(std::move(s));
    } else {
      pieces.back().line = s.line;
    }
    active_ = a;
    const std::size_t main = pieces.size() - 1;
    put_group(out, std::move(pieces), main);
  }

  /// The way to a hole: rapid on controls that always position so.
  void position_kind(Block& b, bool native = true) const {
    const bool source_rapid = context_.source_machine.option("cycle.positioning") == "rapid";
    const bool target_rapid = native && context_.target_machine.option("cycle.positioning") == "rapid" && !by_call_;
    if (!source_rapid || target_rapid || !b.has_motion) return;
    if (b.motion.kind != MotionKind::modal) return;
    b.motion.kind = MotionKind::rapid;
    b.motion.explicit_code = true;
    b.motion.keeps_modal = false;
  }

  bool triggers(const Block& b, const Facts& facts) const {
    if (active_->trigger == CycleTrigger::path_motion) {
      if (b.has_motion && b.motion.frame != FrameUse::normal) return false;
      if (b.has_motion && b.motion.moves()) return true;
      const auto kind = motion_in(b, facts);  // a bare G0 or G1, and F or S under one of them, run it as well
      if (kind && kind != MotionKind::rapid && kind != MotionKind::linear) return false;
      return disturbs_call(b);
    }
    if (!b.has_motion || !b.motion.moves() || b.motion.frame != FrameUse::normal) return false;
    const auto* hole = std::get_if<HoleCycle>(&active_->source->node);
    const auto w = hole != nullptr ? cycle_axis(*hole, b, facts) : std::nullopt;
    return !w || has_plane_word(b, *w);
  }

  /// A block while a cycle is active.
  void point(Statement&& s, Body&& pieces, Body& out) {
    auto& b = std::get<Block>(s.node);
    const Facts& facts = facts_.before(s);
    const bool was_on = active_->on_target;
    const bool changed = follow_retract_plane(b, facts);
    const bool hole_here = triggers(b, facts);
    const LineInfo like = s.line;
    if (changed && !active_->native && was_on) {
      active_->on_target = false;
      pieces.push_back(off_statement(like, by_call_));
    } else if (changed && was_on && by_call_) {
      pieces.push_back(on_statement(like, active_->native));
    } else if (changed && was_on) {
      active_->on_target = false;  // the next point defines it again
      if (!hole_here) pieces.push_back(off_statement(like, false));
    }
    if (hole_here) hold_back(b, active_->native != nullptr);
    if (!active_->native) {
      if (hole_here)
        write_out(std::move(s), std::move(pieces), out);
      else
        plain(std::move(s), std::move(pieces), out);
      return;
    }
    if (by_call_) {
      if (hole_here) position_kind(b);
      const bool wrap = !hole_here && disturbs_call(b) && active_->on_target;
      if (wrap) pieces.push_back(off_statement(like, true));
      const std::size_t main = pieces.size();
      pieces.push_back(std::move(s));
      if (wrap) pieces.push_back(on_statement(like, active_->native));
      put_group(out, std::move(pieces), main);
      return;
    }
    if (!hole_here) return plain(std::move(s), std::move(pieces), out);
    native_point(std::move(s), std::move(pieces), out);
  }

  /// A point on a target that defines the cycle in the block of its first point.
  void native_point(Statement&& s, Body&& pieces, Body& out) {
    auto& b = std::get<Block>(s.node);
    const Facts& facts = facts_.before(s);
    const auto* hole = std::get_if<HoleCycle>(&active_->source->node);
    const auto w = hole != nullptr ? cycle_axis(*hole, b, facts) : std::nullopt;
    const auto kind = motion_in(b, facts);
    const bool target_rapid = context_.target_machine.option("cycle.positioning") == "rapid";
    const bool moves_tool = w && std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                                             [w](const CoordWord& c) { return c.axis == *w; });
    const bool simple = w && has_plane_word(b, *w) && !moves_tool && (!target_rapid || kind == MotionKind::rapid) &&
                        b.motion.centers.empty() && !b.motion.radius_given;
    if (active_->trigger == CycleTrigger::plane_axis_word && active_->on_target) {
      return put(out, std::move(pieces), std::move(s));
    }
    const LineInfo like = s.line;
    if (simple && active_->on_target) return put(out, std::move(pieces), std::move(s));
    if (simple || active_->trigger == CycleTrigger::plane_axis_word) {
      b.actions.push_back(action(CycleDefine{active_->native, true, true, CycleTrigger::plane_axis_word}));
      active_->on_target = true;
      return put(out, std::move(pieces), std::move(s));
    }
    // Moved there in another way than the target's cycle does: the move, then one run of the cycle.
    if (active_->on_target) pieces.push_back(off_statement(like, false));
    active_->on_target = false;
    late_ = take_after(b);
    const std::size_t main = pieces.size();
    pieces.push_back(std::move(s));
    pieces.push_back(single_run(like, active_->native));
    put_group(out, std::move(pieces), main);
  }

  void plain(Statement&& s, Body&& pieces, Body& out) {
    auto& b = std::get<Block>(s.node);
    if (b.has_motion && b.motion.moves()) {
      const auto* hole = std::get_if<HoleCycle>(&active_->source->node);
      const auto w = hole != nullptr ? cycle_axis(*hole, b, facts_.before(s)) : std::nullopt;
      for (const auto& c : b.motion.coords) {
        if (!w || c.axis != *w) continue;
        const auto mode = c.mode == WordMode::modal      ? setting_in<Distance>(b, facts_.before(s), Setting::distance)
                          : c.mode == WordMode::absolute ? std::optional(Distance::absolute)
                                                         : std::nullopt;
        const auto units = setting_in<Units>(b, facts_.before(s), Setting::units);
        active_->height.reset();
        if (mode == Distance::absolute && units && c.value.literal())
          active_->height = c.value.number * (*units == Units::inch ? 25.4 : 1);
      }
    }
    put(out, std::move(pieces), std::move(s));
  }

  /// A new retract plane while the cycle is active is a new cycle. True: the target's own one has changed.
  bool follow_retract_plane(const Block& b, const Facts& facts) {
    const bool sets = std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      return m != nullptr && m->setting == Setting::retract_plane;
    });
    const auto* hole = std::get_if<HoleCycle>(&active_->source->node);
    if (!sets || !active_->native || hole == nullptr || hole->retract.given) return false;
    const auto form = native_form(active_->source, b, facts, context_, in_units(active_->defined_at, b, facts));
    const bool was_native = active_->native != nullptr;
    active_->native = form ? *form : nullptr;
    return was_native;
  }

  // --- written out ----------------------------------------------------------------------------------------------

  void write_out(Statement&& s, Body&& pieces, Body& out) {
    auto& b = std::get<Block>(s.node);
    const Facts& facts = facts_.before(s);
    const auto* hole = std::get_if<HoleCycle>(&active_->source->node);
    std::string error;
    std::optional<Explosion> moves;
    std::optional<double> height = active_->height;
    const auto w = hole != nullptr ? cycle_axis(*hole, b, facts) : std::nullopt;
    if (w && !height) height = height_mm(b, facts, *w);
    if (hole == nullptr)
      error = "cycles of this kind are not carried yet";
    else if (!height)
      error = "the height of the tool before it is not known here";
    else
      moves = explode(*hole, s.line, b, facts, *height, active_->defined_at.value_or(*height), &error);
    if (!moves) {
      refuse(s, program_, context_, "TRN-330", "a cycle that the target lacks can't be written out: " + error,
             "give the cycle's words and the height before it as numbers");
      late_.clear();
      out.push_back(std::move(s));
      return;
    }
    position_kind(b, false);
    active_->height = moves->end_height;
    const std::size_t main = pieces.size();
    auto first = moves->blocks.begin();
    if (b.empty() && first != moves->blocks.end()) s.node = std::move((first++)->node);  // nothing of the line is left
    pieces.push_back(std::move(s));
    for (; first != moves->blocks.end(); ++first) pieces.push_back(std::move(*first));
    put_group(out, std::move(pieces), main);
  }
  Program& program_;
  const LegaliseContext& context_;
  const FactsOf& facts_;
  Editor editor_;
  ToolHeight height_;
  bool by_call_ = false;
  bool written_out_ = false;
  std::optional<Active> active_;
  std::vector<Action> late_;  ///< of the block at hand, behind the hole
};

}  // namespace

void lower_cycles(Program& program, const LegaliseContext& context) {
  if (!uses_cycles(program)) return;
  if (program.dialect == context.target.dialect && !program.dialect.empty() &&
      context.options.cycles == CycleWriting::native)
    return;
  const FactsOf facts(program, context);
  for (auto& r : program.routines) CyclePass(program, r, context, facts).run();
}

}  // namespace cnctrans::ir::passes
