// Safe start (equivalences rule 2): nothing modal is inherited from the target's power-on state. What the source's
// machine has at the start, and the program does not say before its first motion, is said in a block at the head.
#include <algorithm>
#include <array>

#include "ir/edit/rewrite.h"
#include "ir/edit/search.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/analysis/feed_state.h"
#include "legaliser/edit/editor.h"
#include "legaliser/frames/shifted_axes.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

class SafeStart {
 public:
  SafeStart(Program& program, Routine& main, const LegaliseContext& context)
      : program_(program), main_(main), context_(context), facts_(program, context) {
    head_feed_ = uses_power_on_feed(program, context, facts_);
  }

  void run() {
    look();
    Block head;
    for (const Setting s : wanted()) {
      if (said_[static_cast<std::size_t>(s)] || (s == Setting::comp && begins_with_arc())) continue;
      const auto value = context_.source_machine.power_on.get(s);
      ModalSet set{s, value, true, {}};
      if (s == Setting::units) set.feed_too = context_.target.units_with_feed;
      if (s == Setting::feed_mode) set.feed_memory = context_.target.feed_memory;
      head.actions.push_back(action(set));
    }
    if (head_feed_) head.actions.push_back(action(SetFeed{Value{context_.source_machine.power_on_feed}, false}));
    if (!first_motion() && motion_from_power_on()) {  // reached through a loop or a branch: said at the head
      head.has_motion = true;
      head.motion.kind = context_.source_machine.power_on.motion;
      head.motion.explicit_code = true;
    }
    Body blocks;
    if (!head.empty()) blocks.push_back(made(LineInfo{}, std::move(head)));
    const auto offset = context_.source_machine.power_on.work_offset;
    if (!offset_said_ && head_selects_offset(context_)) {
      blocks.push_back(make_block(LineInfo{}, action(WorkOffset{Value{static_cast<double>(offset)}, false})));
    }
    if (!offset_said_ && offset == 0) tell_offset();
    const bool taken_back = offset_said_ && context_.target.work_offset_ends_shift;
    if (!shift_cleared_ && !taken_back && clears_shift()) blocks.push_back(make_block(LineInfo{}, clear_shift()));
    main_.body.insert(below_head(main_.body), std::make_move_iterator(blocks.begin()),
                      std::make_move_iterator(blocks.end()));
  }

 private:
  /// Which zero point holds where a program selects none.
  static std::string zero_point(const machine::Profile& machine) {
    if (machine.policies.work_offset_kept) return "the one selected last, by whatever program";
    const auto row = machine.power_on.work_offset;
    return row == 0 ? std::string("no offset") : "offset " + std::to_string(row) + " of its table";
  }
  void tell_offset() const {
    const std::string source = zero_point(context_.source_machine), target = zero_point(context_.target_machine);
    const Statement* first = source == target || lost_ ? nullptr : first_move();
    if (first == nullptr || action_in<WorkOffset>(std::get<Block>(first->node)) != nullptr) return;
    const auto there = facts_.before(*first).work_offset;  // selected behind a branch: on all ways
    if (there && *there != context_.source_machine.power_on.work_offset) return;
    context_.diagnostics.warning("TRN-394", first->line.span,
                                 "no work offset is selected before the first move: the source works with " + source +
                                     " then, the target with " + target,
                                 "select the work offset in the source, or check the zero point on the target");
  }
  const Statement* first_move() const {
    const Statement* found = nullptr;
    for_each_statement(main_.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (found == nullptr && b != nullptr && b->has_motion && b->motion.moves() && b->motion.frame == FrameUse::normal)
        found = &s;
    });
    return found;
  }
  /// Compensation ends in a straight move: where neither machine has it on, nothing is said before an arc.
  bool begins_with_arc() const {
    const Statement* first = first_move();
    if (first == nullptr || context_.source_machine.power_on.comp != CompSide::off ||
        context_.target_machine.power_on.comp != CompSide::off)
      return false;
    const MotionKind kind = std::get<Block>(first->node).motion.kind;
    return kind == MotionKind::arc_cw || kind == MotionKind::arc_ccw || kind == MotionKind::arc_tangent ||
           kind == MotionKind::arc_through_point;
  }
  std::vector<Setting> wanted() const {
    std::vector<Setting> list{Setting::plane, Setting::comp};
    if (context_.target.exact_stop_modal) list.push_back(Setting::path_mode);
    list.insert(list.end(), {Setting::units, Setting::distance, Setting::feed_mode});
    const auto& axes = context_.target_machine.axes;
    const bool diameter = std::any_of(axes.begin(), axes.end(), [](const machine::AxisSpec& a) { return a.diameter; });
    if (diameter && context_.target.diameter_switch) list.push_back(Setting::diameter);
    return list;
  }

  /// Settings that stand before the first motion, cycle, frame with values, call or branch.
  void look() {
    for (const auto& s : main_.body) {
      if (std::holds_alternative<Assign>(s.node) || std::holds_alternative<Declare>(s.node) ||
          std::holds_alternative<Message>(s.node) || std::holds_alternative<Label>(s.node))
        continue;
      const auto* o = std::get_if<Opaque>(&s.node);
      lost_ = o != nullptr && !o->harmless;
      if (o != nullptr && o->harmless) continue;
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) break;
      const bool moves = b->has_motion && b->motion.moves();
      bool uses = moves;
      for (const auto& a : b->actions) {
        const auto* f = std::get_if<FrameOp>(&a.data);
        uses = uses || std::holds_alternative<CycleDefine>(a.data) ||
               (f != nullptr && f->change && f->change->combine != FrameCombine::clear && !f->change->words.empty());
        if (s.line.skip_mask != 0 || (moves && a.order == Order::after)) continue;
        if (const auto* m = std::get_if<ModalSet>(&a.data)) said_[static_cast<std::size_t>(m->setting)] = true;
        if (std::holds_alternative<WorkOffset>(a.data)) offset_said_ = true;
        if (f != nullptr && f->change && f->change->combine == FrameCombine::clear) shift_cleared_ = true;
      }
      if (uses) return;
    }
  }

  /// The first move says its function. False: it stands behind a statement that may lead elsewhere.
  bool first_motion() {
    const LabelUses uses = label_uses(program_, main_);
    bool hole = false;  // a cycle is defined here or before
    for (auto& s : main_.body) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr && !std::holds_alternative<Assign>(s.node) && !std::holds_alternative<Declare>(s.node) &&
          !std::holds_alternative<Message>(s.node) && !std::holds_alternative<Label>(s.node))
        return false;
      for (const auto& l : labels_on(s.line)) {
        if (uses.is_target(l)) return false;  // comes here again with another function
      }
      hole = hole || (b != nullptr && action_in<CycleDefine>(*b) != nullptr);
      if (b == nullptr || !b->has_motion) continue;
      if (s.line.skip_mask != 0) return false;  // the move behind it may be the first one
      // A hole that is reached in rapid whatever function is in force says nothing of it.
      if (b->motion.kind != MotionKind::modal && b->motion.keeps_modal) return !hole || !holes_in_rapid();
      if (b->motion.kind != MotionKind::modal || !b->motion.moves()) continue;
      if (!b->motion.centers.empty()) return false;  // a straight line beside its centre: no code fits it
      if (hole && holes_in_rapid()) return false;
      b->motion.kind = context_.source_machine.power_on.motion;
      b->motion.explicit_code = true;
      return true;
    }
    return true;
  }

  [[nodiscard]] bool holes_in_rapid() const {
    return context_.target_machine.policies.cycle_positioning == machine::CyclePositioning::rapid;
  }

  /// A move without a code that goes by the function in force at power-on, which is another one on the target; or one
  /// to a hole, whose code is left out there as it is in force.
  bool motion_from_power_on() {
    const auto own = context_.source_machine.power_on.motion;
    if (own == context_.target_machine.power_on.motion) return false;
    number_statements(program_);
    ModalState other = context_.source_machine.power_on;
    other.motion = own == MotionKind::rapid ? MotionKind::linear : MotionKind::rapid;
    const FactTable as_is = analyse(program_, context_.source_machine.power_on), changed = analyse(program_, other);
    bool found = false;
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        const auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr || !b->has_motion) return;
        const auto& facts = as_is.before(s.id);
        const bool hole = holes_in_rapid() && b->motion.kind == facts.motion && b->motion.keeps_modal &&
                          action_in<CycleDefine>(*b) != nullptr;
        const bool modal = b->motion.kind == MotionKind::modal && b->motion.moves();
        if (!facts.reachable || (!hole && !modal)) return;
        found = found || !facts.motion || facts.motion != changed.before(s.id).motion;
      });
    }
    return found;
  }

  /// A programmed shift is cleared where the source starts without one: a shift of another program may still be in
  /// force where the target keeps it over the end of a program, and the program's own may where it is run in parts.
  bool clears_shift() const {
    const auto slot = context_.target.frames.find(FrameSlot::shift);
    if (slot == context_.target.frames.end() || slot->second.count(FrameCombine::clear) == 0) return false;
    const auto keeps = [](const machine::Profile& m) { return m.policies.work_offset_kept; };
    return (keeps(context_.target_machine) && !keeps(context_.source_machine)) || shifts_itself();
  }
  bool shifts_itself() const {
    return any_action(program_, [](const Action& a) { return std::holds_alternative<FrameOp>(a.data); });
  }
  static Action clear_shift() {
    auto change = std::make_shared<FrameChange>();
    change->slot = FrameSlot::shift;
    change->combine = FrameCombine::clear;
    return action(FrameOp{std::move(change)});
  }

  Program& program_;
  Routine& main_;
  const LegaliseContext& context_;
  std::array<bool, setting_count> said_{};
  bool offset_said_ = false, shift_cleared_ = false;
  FactsOf facts_;
  bool head_feed_ = false;  ///< a cut may go by the feed of power-on
  bool lost_ = false;       ///< what stands before the first motion is not carried: it may select anything
};

}  // namespace

void safe_start(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect && !program.dialect.empty()) return;
  for (auto& r : program.routines) {
    if (r.kind == RoutineKind::main) SafeStart(program, r, context).run();
  }
}

}  // namespace cnctrans::ir::passes
