// Machining cycles of a lathe in the cycle pass.
#include <algorithm>
#include <utility>

#include "base/text.h"
#include "ir/cycles/assumed.h"
#include "ir/source_line.h"
#include "legaliser/cycles/cycle_pass.h"

namespace cnctrans::ir::passes {

namespace {

/// What the profile was read with.
std::string contour_values(const NamedCycle& cycle) {
  for (const auto& [word, v] : cycle.words) {
    const auto* text = v.expr ? std::get_if<String>(&v.expr->node) : nullptr;
    if (word == "contour_values" && text != nullptr) return text->text;
  }
  return {};
}

Statement rapid_to(const LineInfo& like, const TurnStart& place) {
  Block b;
  b.has_motion = true;
  b.motion.kind = MotionKind::rapid;
  b.motion.explicit_code = true;
  b.motion.keeps_modal = false;
  for (const auto& [axis, v] : {std::pair(axis::x, place.x), std::pair(axis::z, place.z)}) {
    CoordWord w;
    w.axis = axis;
    w.mode = WordMode::absolute;
    w.value = v.value_or(Value{});
    b.motion.coords.push_back(w);
  }
  return made(like, std::move(b));
}

}  // namespace

/// A machining cycle of a lathe: the target's own with the same moves, else its moves, with a note.
void CyclePass::write_out_machining(Statement&& s, const NamedCycle& cycle, Body&& pieces, Body& out) {
  auto& b = std::get<Block>(s.node);
  if (const std::string option = cycles::assumed_option(cycle); !option.empty())
    return refuse_assumed(std::move(s), option, out);
  if (setting<CompSide>(facts_.before(s), Setting::comp) == CompSide::off) {  // it is off already
    const auto off = [](const Action& a) {
      const auto* set = std::get_if<ModalSet>(&a.data);
      return set != nullptr && a.text.empty() && set->setting == Setting::comp &&
             set->value == static_cast<std::uint8_t>(CompSide::off);
    };
    std::erase_if(late_, off);
    std::erase_if(b.actions, off);
  }
  if (const auto form = turning_.native(cycle, s, b, facts_.before(s))) {
    Body calls;
    if (form->from.x) calls.push_back(rapid_to(s.line, form->from));
    calls.push_back(single_run(s.line, std::make_shared<const Cycle>(Cycle{form->cycle})));
    return put_moves(std::move(s), std::move(calls), std::move(pieces), out);
  }
  std::string not_similar;
  if (auto form = turning_.similar(cycle, s, b, facts_, false, &not_similar))
    return put_similar(std::move(s), std::move(*form), std::move(pieces), out);
  if (!not_similar.empty())
    context_.diagnostics.note("TRN-416", s.line.span,
                              "the target's own cycle would not leave the same part: " + not_similar);
  std::string error;
  auto moves = turning_.write_out(cycle, s, b, facts_.before(s), &error);
  const bool loops = !moves;
  bool head = false;
  std::string values = contour_values(cycle);
  if (loops) {
    std::string why;
    moves = turning_.write_out_computed(cycle, s, b, facts_.before(s), editor_, &why);
    if (!moves) {
      std::string there, fault;
      moves = turning_.write_out(cycle, s, b, facts_.before(s), &fault, &there);
      if (values.empty()) values = there;
      head = moves.has_value();
      if (error.starts_with("its words are computed") && !why.starts_with("its words are computed"))
        error = why;
      else if (!fault.empty())
        error = fault;
    }
  }
  if (!moves) {
    std::string none;
    if (auto form = turning_.similar(cycle, s, b, facts_, true, &none))
      return put_similar(std::move(s), std::move(*form), std::move(pieces), out);
    return no_moves(std::move(s), error, out);
  }
  context_.diagnostics.note("TRN-333", s.line.span,
                            loops && !head
                                ? "the cycle is written out as a loop over its passes: the target has none that "
                                  "moves the same way"
                                : "the cycle is written out as its " + std::to_string(moves->size()) +
                                      " moves: the target has none that moves the same way");
  if (!values.empty()) {
    context_.diagnostics.warning(
        "TRN-337", s.line.span, "the moves of the cycle are those for the values at the head of the program: " + values,
        "translate again when these lines change");
  }
  remark_words(s.line, out);
  put_moves(std::move(s), std::move(*moves), std::move(pieces), out);
}

void CyclePass::refuse_assumed(Statement&& s, const std::string& option, Body& out) {
  refuse(s, program_, context_, "TRN-690",
         "the manuals at hand do not describe the moves of this cycle; they are those of the option " + option +
             ", which the source's machine profile does not set",
         "compare with the machine, then set " + option + " in the profile");
  out.push_back(std::move(s));
}

void CyclePass::remark_words(const LineInfo& line, Body& out) {
  if (!context_.options.cycle_remarks || line.joined) return;
  const std::string words(trim(source_line(line.span, program_)));
  if (!words.empty()) out.push_back(make_comment("< " + words, program_));
}

/// Copies of profiles, behind the end of the routine.
void CyclePass::add_copies(Body& out) {
  bool copies = false;  // what stands behind the end of the routine is not carried out
  for (std::size_t i = 0; i < uses_of_profiles_.size(); ++i) {
    const auto& use = uses_of_profiles_[i];
    const auto here = uses_of_profiles_.begin() + static_cast<std::ptrdiff_t>(i);
    const auto same = [&](const ProfileUse& o) { return o.first_label == use.first_label; };
    if (use.copy.empty() || std::find_if(uses_of_profiles_.begin(), here, same) != here) continue;
    const bool falls = out.empty() || (!std::holds_alternative<Return>(out.back().node) &&
                                       !std::holds_alternative<End>(out.back().node) && !copies);
    if (falls && editor_.routine.kind != RoutineKind::main) out.push_back(made(editor_.routine.header, Return{}));
    copies = true;
    for (auto& s : copied_profile(use, editor_.program)) out.push_back(std::move(s));
  }
}

/// A profile that another cycle reads in another way has labels of its own, and blocks of its own.
void CyclePass::own_labels(SimilarForm& form) {
  ProfileUse& use = *form.use;
  const auto stands = [&](const ProfileUse& o) { return o == use && o.copy.empty() == use.copy.empty(); };
  if (std::any_of(uses_of_profiles_.begin(), uses_of_profiles_.end(), stands)) return;
  const auto clash = [&](const ProfileUse& o) {
    return o.first_label == use.first_label || o.last_label == use.last_label;
  };
  const auto used = use.numbers ? block_numbers(editor_.program) : std::set<std::int64_t>{};
  const auto taken = [&] {
    return use.numbers && (used.count(std::stol(use.first_label)) != 0 || used.count(std::stol(use.last_label)) != 0);
  };
  while (taken() || std::any_of(uses_of_profiles_.begin(), uses_of_profiles_.end(), clash)) {
    if (use.copy.empty()) use.copy = use.blocks;
    for (auto* label : {&use.first_label, &use.last_label})
      *label = use.numbers ? std::to_string(std::stol(*label) + 20) : *label + 'A';
  }
  use.name(form.cycle);
}

/// The target's own cycle in the place of one that makes other passes: the same part, place and state behind it.
void CyclePass::put_similar(Statement&& s, SimilarForm&& form, Body&& pieces, Body& out) {
  Body calls;
  const LineInfo like = s.line;
  if (form.use) own_labels(form);
  if (form.before.x) calls.push_back(rapid_to(like, form.before));
  if (form.feed_before) calls.push_back(make_block(like, action(SetFeed{*form.feed_before, false})));
  calls.push_back(single_run(like, std::make_shared<const Cycle>(Cycle{form.cycle})));
  if (form.after.x) {
    calls.push_back(rapid_to(like, form.after));
    std::get<Block>(calls.back().node).motion.keeps_modal = form.rapid_stays;
  }
  if (form.motion) {
    Block b;
    b.has_motion = true;
    b.motion.kind = *form.motion;
    b.motion.explicit_code = true;
    calls.push_back(made(like, std::move(b)));
  }
  if (form.feed) calls.push_back(make_block(like, action(SetFeed{*form.feed, false})));
  if (form.use) uses_of_profiles_.push_back(*form.use);
  context_.diagnostics.warning("TRN-415", like.span,
                               "the target's own cycle takes the place of this one: the same contour, depth and "
                               "allowance by other passes: " +
                                   form.differs,
                               "check the way of the tool; --cycles=exact writes the moves out instead");
  put_moves(std::move(s), std::move(calls), std::move(pieces), out);
}

/// The target's cycle in the block of the move to its place, where that is all the block says.
void CyclePass::run_at_the_point(Block& b, const Facts& facts, Body& blocks) const {
  if (setting_in<Plane>(b, facts, Setting::plane) != Plane::xy || context_.target.retract_plane_switch) return;
  auto* call = blocks.empty() ? nullptr : std::get_if<Block>(&blocks.front().node);
  if (by_call_ || call == nullptr || call->has_motion || !b.has_motion || !b.motion.moves() || b.motion.extra) return;
  const bool runs = std::any_of(call->actions.begin(), call->actions.end(),
                                [](const Action& a) { return std::holds_alternative<CycleDefine>(a.data); });
  const bool rapid = b.motion.kind == MotionKind::rapid && b.motion.frame == FrameUse::normal;
  const bool late = std::any_of(b.actions.begin(), b.actions.end(),
                                [](const Action& a) { return a.order == Order::after || makes_event(a); });
  const bool in_plane = std::all_of(b.motion.coords.begin(), b.motion.coords.end(),
                                    [](const CoordWord& c) { return c.axis == axis::x || c.axis == axis::y; });
  if (!runs || !rapid || late || !in_plane ||
      context_.target_machine.policies.cycle_positioning != machine::CyclePositioning::rapid)
    return;
  if (!b.motion.keeps_modal) by_itself(b);
  if (b.motion.kind == MotionKind::rapid) return;
  for (auto& a : call->actions) b.actions.push_back(std::move(a));
  blocks.erase(blocks.begin());
}

bool CyclePass::put_similar_pocket(const HoleCycle& hole, Statement& s, Body& pieces, std::optional<double> height,
                                   bool last_resort, Body& out) {
  auto& b = std::get<Block>(s.node);
  std::string none;
  auto form = milling_.similar(hole, s, b, facts_.before(s), active_->defined_at ? active_->defined_at : height,
                               sense_.now(), last_resort, &none);
  const bool asked = context_.options.cycles == CycleWriting::native && !last_resort;
  if (!form && asked && !none.empty())
    context_.diagnostics.note("TRN-416", s.line.span, "the target's own cycle would not leave the same part: " + none);
  if (!form) return false;
  context_.diagnostics.warning("TRN-415", s.line.span,
                               "the target's own cycle takes the place of this one: the same " +
                                   std::string(hole.mill.shape.starts_with("slot.") ? "slot" : "pocket") +
                                   " by other passes: " + form->differs,
                               "check the tool on the target, and the way it takes");
  position_rapid(b, context_);
  active_->height = form->end_height;
  run_at_the_point(b, facts_.before(s), form->blocks);
  put_moves(std::move(s), std::move(form->blocks), std::move(pieces), out);
  return true;
}

bool CyclePass::feed_is_used() const {
  for (const Statement* s = rest_.first; s != rest_.second; ++s) {
    if (std::holds_alternative<End>(s->node)) return false;
    if (std::holds_alternative<Message>(s->node) || std::holds_alternative<Label>(s->node) ||
        std::holds_alternative<Assign>(s->node))
      continue;
    const auto* b = std::get_if<Block>(&s->node);
    if (b == nullptr || (s->line.skip_mask != 0 && !b->empty())) return true;
    bool given = false;
    for (const auto& a : b->actions) {
      const auto* set = std::get_if<ModalSet>(&a.data);
      const bool harmless = std::holds_alternative<SetSpindle>(a.data) || std::holds_alternative<SpindleRun>(a.data) ||
                            std::holds_alternative<SpindleLimit>(a.data) ||
                            std::holds_alternative<SpindleGear>(a.data) || std::holds_alternative<ToolSelect>(a.data) ||
                            std::holds_alternative<ToolChange>(a.data) || std::holds_alternative<ToolOffset>(a.data) ||
                            std::holds_alternative<Coolant>(a.data) || std::holds_alternative<WorkOffset>(a.data) ||
                            std::holds_alternative<CycleCancel>(a.data) || std::holds_alternative<Stop>(a.data) ||
                            (set != nullptr && set->setting != Setting::feed_mode && set->setting != Setting::units);
      if (std::holds_alternative<SetFeed>(a.data) && a.order != Order::after)
        given = true;
      else if (!harmless)
        return true;
    }
    if (given) return false;
    if (b->has_motion && motion_in(*b, facts_.before(*s)) != MotionKind::rapid) return true;
  }
  return true;
}

void CyclePass::drop_idle_feed(Body& moves) const {
  if (moves.size() < 2) return;
  const auto* b = std::get_if<Block>(&moves.back().node);
  const bool lone = b != nullptr && !b->has_motion && b->actions.size() == 1 &&
                    std::holds_alternative<SetFeed>(b->actions.front().data);
  if (lone && !feed_is_used()) moves.pop_back();
}

/// What a cycle has become, in the place of its block.
void CyclePass::put_moves(Statement&& s, Body&& moves, Body&& pieces, Body& out) {
  drop_idle_feed(moves);
  auto& b = std::get<Block>(s.node);
  const std::size_t main = pieces.size();
  auto first = moves.begin();
  if (b.empty() && first != moves.end()) s.node = std::move((first++)->node);
  pieces.push_back(std::move(s));
  for (; first != moves.end(); ++first) pieces.push_back(std::move(*first));
  put_group(out, std::move(pieces), main);
}

}  // namespace cnctrans::ir::passes
