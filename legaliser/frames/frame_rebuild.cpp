#include "legaliser/frames/frame_rebuild.h"

#include <algorithm>

#include "legaliser/analysis/words.h"

namespace cnctrans::ir::passes {

namespace {

Action make(FrameSlot slot, FrameKind kind, FrameCombine combine, std::vector<FrameWord> words = {}) {
  auto change = std::make_shared<FrameChange>();
  change->slot = slot;
  change->kind = kind;
  change->combine = combine;
  change->words = std::move(words);
  return action(FrameOp{std::move(change)});
}
Action turn(FrameSlot slot, FrameCombine combine, const PlanarFrame& f, std::optional<Plane> plane) {
  auto change = std::make_shared<FrameChange>();
  change->slot = slot;
  change->kind = FrameKind::rotate;
  change->combine = combine;
  change->has_angle = true;
  change->angle = *f.angle;
  if (plane != f.plane) change->rotation_axis = plane_axes(f.plane).w;
  return action(FrameOp{std::move(change)});
}
Action stretch(FrameSlot slot, FrameCombine combine, const PlanarFrame& f) {
  auto change = std::make_shared<FrameChange>();
  change->slot = slot;
  change->kind = FrameKind::scale;
  change->combine = combine;
  change->uniform_scale = f.scaled == PlanarFrame::linear;
  for (AxisId a = axis::x; a <= axis::z; ++a) {
    const bool said = change->uniform_scale ? a == axis::x : (f.scaled >> a & 1U) != 0;
    if (said) change->words.push_back({a, *f.factor, WordScale::radius, {}});
  }
  return action(FrameOp{std::move(change)});
}
std::vector<FrameWord> mirror_words(std::uint32_t axes, std::uint32_t on) {
  std::vector<FrameWord> words;
  for (AxisId a = 0; a < PlanarFrame::axes; ++a) {
    if ((axes >> a & 1U) == 0) continue;
    FrameWord w;
    w.axis = a;
    w.value = Value{(on >> a & 1U) != 0 ? 1.0 : 0.0};
    words.push_back(w);
  }
  return words;
}

/// Words for every axis whose shift changes or is not known to be right already.
std::vector<FrameWord> changed_words(const PlanarFrame* before, const PlanarFrame& after) {
  std::vector<FrameWord> words;
  for (std::size_t i = 0; i < PlanarFrame::axes; ++i) {
    const auto& to = *after.shift[i];
    if (before != nullptr && before->shift[i] && equal(*before->shift[i], to) &&
        (to.is(0) || before->shift_scale[i] == after.shift_scale[i]))
      continue;
    words.push_back(after.word(i));
  }
  return words;
}

}  // namespace

bool FrameTarget::can(FrameSlot slot, FrameCombine combine) const {
  const auto it = context_.target.frames.find(slot);
  return it != context_.target.frames.end() && it->second.count(combine) != 0;
}

/// The slots that hold something apply in the same order on both machines.
bool FrameTarget::same_order(const FrameState& before, const FrameState& after, FrameSlot changed) const {
  const auto uses = [&](FrameSlot s) { return s == changed || !before.slot(s).neutral() || !after.slot(s).neutral(); };
  const bool as_shift = !keeps_preset() && uses(FrameSlot::preset);
  std::vector<FrameSlot> source, target;
  for (const auto s : context_.source_machine.frame_order) {
    if (uses(s)) source.push_back(as_shift && s == FrameSlot::preset ? FrameSlot::shift : s);
  }
  source.erase(std::unique(source.begin(), source.end()), source.end());
  for (const auto s : context_.target_machine.frame_order) {
    if (s == FrameSlot::preset ? !as_shift && uses(s) : uses(s) || (as_shift && s == FrameSlot::shift))
      target.push_back(s);
  }
  return source == target;
}

/// No other slot of the source holds anything.
bool FrameTarget::only_chain(const FrameState& state) const {
  const auto& order = context_.source_machine.frame_order;
  return std::all_of(order.begin(), order.end(), [&](FrameSlot s) {
    return s == FrameSlot::chain || (s == FrameSlot::preset && keeps_preset()) || state.slot(s).neutral();
  });
}

/// A mirror image that ends on some axes: those that stay mirrored are named.
void FrameTarget::name_all_mirrored(FrameChange& change, const std::optional<std::uint32_t>& mirrored) const {
  const bool ends = std::any_of(change.words.begin(), change.words.end(),
                                [](const FrameWord& w) { return w.value.literal() && w.value.is(0); });
  if (change.combine != FrameCombine::replace_named || !ends || !mirrored) return;
  const FrameCombine combine = *mirrored == 0 ? FrameCombine::clear : FrameCombine::replace;
  if (!can(change.slot, combine)) return;
  const WordPos pos = change.words.front().pos;
  change.combine = combine;
  change.words.clear();
  for (AxisId axis = 0; axis < PlanarFrame::axes; ++axis) {
    if ((*mirrored >> axis & 1U) == 0) continue;
    FrameWord w;
    w.axis = axis;
    w.value = Value(1);
    w.pos = pos;
    change.words.push_back(std::move(w));
  }
}

std::optional<FrameChange> FrameTarget::as_it_is(const FrameChange& c, const FrameState& before,
                                                 const FrameState& after, std::optional<Distance> distance) const {
  FrameChange change = c;
  const bool same_dialect = context_.target.dialect == program_.dialect;
  if (c.by_distance_mode && !(same_dialect || can(c.slot, FrameCombine::add))) {
    if (!distance) return std::nullopt;
    change.by_distance_mode = false;
    change.combine = *distance == Distance::incremental ? FrameCombine::add : FrameCombine::replace_named;
  }
  if (!can(c.slot, change.combine) || (c.slot == FrameSlot::preset && preset_as_shift_)) return std::nullopt;
  if (same_dialect) return change;
  const bool innermost = c.slot == FrameSlot::chain && context_.source_machine.frame_order.back() == FrameSlot::chain;
  if (c.combine != FrameCombine::preset && !innermost && !same_order(before, after, c.slot)) return std::nullopt;
  const bool about_point = c.slot != FrameSlot::chain &&  // held by other slots
                           (before.slot(c.slot).has_shift() || after.slot(c.slot).has_shift());
  if (c.kind == FrameKind::rotate && ((c.has_angle && !c.words.empty()) || about_point)) return std::nullopt;
  if (c.slot == FrameSlot::chain && after.slot(c.slot).neutral()) return std::nullopt;
  if (c.slot == FrameSlot::chain && c.combine == FrameCombine::replace && !only_chain(before)) {
    if (!before.slot(FrameSlot::chain).neutral() || !can(FrameSlot::chain, FrameCombine::compose)) return std::nullopt;
    change.combine = FrameCombine::compose;  // what the other slots hold stands in the target's chain
  }
  const bool turned_about = before.slot(FrameSlot::rotation).has_shift() || after.slot(FrameSlot::rotation).has_shift();
  const bool holds_preset =
      !keeps_preset() && !(before.slot(FrameSlot::preset).neutral() && after.slot(FrameSlot::preset).neutral());
  const bool shared = turned_about || holds_preset;  // the target's shift is not this one alone
  if (c.kind == FrameKind::translate && c.combine != FrameCombine::preset && shared) return std::nullopt;
  if (c.kind == FrameKind::mirror) name_all_mirrored(change, after.slot(c.slot).mirror);
  return change;
}

std::optional<FrameChange> FrameTarget::preset_from_here(const FrameChange& c, const FrameState& after) const {
  if (c.combine != FrameCombine::preset || after.preset_waits() || part(after).known() ||
      !can(FrameSlot::chain, FrameCombine::compose))
    return std::nullopt;
  FrameChange shift;
  shift.slot = FrameSlot::chain;
  shift.combine = FrameCombine::compose;
  for (const auto& w : c.words) {
    const auto* source = context_.source_machine.axis(w.axis);
    const auto here = at_run(context_, Datum::programmed_position, w.axis);
    if (source == nullptr || source->diameter || !here) return std::nullopt;
    shift.words.push_back(w);
    shift.words.back().value = subtract(*here, w.value);
  }
  return shift;
}

FrameTarget::Parts FrameTarget::kept_by(const FrameChange& c, const FrameState& before, const FrameState& after) const {
  if (c.kind == FrameKind::rotate && !c.words.empty()) return {};
  if (c.slot == FrameSlot::chain) {  // one element inside what is there
    if (c.combine != FrameCombine::compose) return {};
    return {c.kind != FrameKind::translate, c.kind != FrameKind::rotate, c.kind != FrameKind::scale,
            c.kind != FrameKind::mirror};
  }
  if (c.slot != FrameSlot::shift && (before.slot(c.slot).has_shift() || after.slot(c.slot).has_shift())) return {};
  Parts kept;
  // A slot outside of others acts on their shift and rotation as well.
  const auto& order = context_.source_machine.frame_order;
  const auto place = std::find(order.begin(), order.end(), c.slot);
  bool shift_inside = false, turn_inside = false;
  for (auto it = place; it != order.end(); ++it) {
    if (it == place) continue;
    shift_inside = shift_inside || before.slot(*it).has_shift() || after.slot(*it).has_shift();
    turn_inside = turn_inside || before.slot(*it).turns() || after.slot(*it).turns();
  }
  kept.shift = c.slot != FrameSlot::shift && !shift_inside;
  kept.turn = c.slot != FrameSlot::rotation && !(c.slot == FrameSlot::mirror && turn_inside);
  kept.factor = c.slot != FrameSlot::scale;
  kept.mirror = c.slot != FrameSlot::mirror;
  return kept;
}

FrameTarget::Result FrameTarget::rebuild(const FrameChange& c, const std::optional<PlanarFrame>& before,
                                         const PlanarFrame& after, const Parts& kept, std::optional<Plane> plane,
                                         std::vector<Action>& out) const {
  const PlanarFrame next = chains() ? after.with_axes() : after;
  if (next.foreign) return Result::foreign;
  if (!next.known()) {
    const bool done = before && !before->foreign &&
                      (chains() ? inside(*before, after, kept, plane, out)
                                : added(c, *before, plane, out) || beside(*before, after, kept, plane, out));
    return done ? Result::done : Result::unknown;
  }
  const std::size_t first = out.size();
  const bool shift = c.kind == FrameKind::translate || c.combine == FrameCombine::clear;
  const auto here = before ? std::optional(before->with_axes()) : std::nullopt;
  const bool done = chains() ? to_chain(here, next, shift, plane, out) : to_slots(before, next, shift, plane, out);
  if (!done) return Result::impossible;
  for (std::size_t i = first; i < out.size(); ++i) out[i].pos = {};
  return Result::done;
}

namespace {
/// The number of leading parts (shift, rotation, scale, mirror) of `f` that `before` holds and nothing else; 4: all.
int kept_parts(const PlanarFrame& before, const PlanarFrame& f) {
  if (before.foreign || before.neutral() || !same_shift(before, f)) return 0;
  const bool turn_same = same_turn(before, f), factor_same = same_factor(before, f);
  if (turn_same && factor_same && same_mirror(before, f)) return 4;
  if (before.mirrors()) return 0;
  if (turn_same && factor_same) return 3;
  if (before.scales()) return 0;
  if (turn_same) return 2;
  return before.turns() ? 0 : 1;
}
}  // namespace

bool FrameTarget::extends(const PlanarFrame& here, const PlanarFrame& next) {
  return (here.neutral() && next.neutral()) || kept_parts(here, next) > 0;
}

/// Of a frame that is not known as a whole: what is new stands inside all of it.
bool FrameTarget::inside(const PlanarFrame& before, const PlanarFrame& after, const Parts& kept,
                         std::optional<Plane> plane, std::vector<Action>& out) const {
  if (!kept.shift || before.scales() || before.mirrors() || (!kept.turn && before.turns())) return false;
  if (!after.angle || !after.factor || !after.mirror || !can(FrameSlot::chain, FrameCombine::compose)) return false;
  if (!kept.turn && after.turns()) out.push_back(turn(FrameSlot::chain, FrameCombine::compose, after, plane));
  if (after.scales()) out.push_back(stretch(FrameSlot::chain, FrameCombine::compose, after));
  if (after.mirrors())
    out.push_back(
        make(FrameSlot::chain, FrameKind::mirror, FrameCombine::compose, mirror_words(*after.mirror, *after.mirror)));
  return true;
}

/// A rotation or a shift inside a frame that is not known as a whole, on a target that adds it to what its slot holds.
bool FrameTarget::added(const FrameChange& c, const PlanarFrame& before, std::optional<Plane> plane,
                        std::vector<Action>& out) const {
  if (c.slot != FrameSlot::chain || c.combine != FrameCombine::compose || before.mirrors() || before.scales())
    return false;
  const auto& order = context_.target_machine.frame_order;
  const auto shift = std::find(order.begin(), order.end(), FrameSlot::shift);
  if (std::find(order.begin(), shift, FrameSlot::rotation) != shift) return false;
  if (c.kind == FrameKind::rotate && can(FrameSlot::rotation, FrameCombine::add) && plane) {
    const AxisId normal = plane_axes(*plane).w;
    const bool by_word = !c.has_angle && c.words.size() == 1 && c.words[0].axis == normal;
    const bool by_angle =
        c.has_angle && c.words.empty() && (c.rotation_axis == axis::none || c.rotation_axis == normal);
    if ((!by_word && !by_angle) || (before.turns() && before.angle && before.plane != *plane)) return false;
    auto change = std::make_shared<FrameChange>();
    change->slot = FrameSlot::rotation;
    change->kind = FrameKind::rotate;
    change->combine = FrameCombine::add;
    change->has_angle = true;
    change->angle = by_word ? c.words[0].value : c.angle;
    out.push_back(action(FrameOp{std::move(change)}));
    return true;
  }
  if (c.kind != FrameKind::translate || before.turns() || !can(FrameSlot::shift, FrameCombine::add)) return false;
  out.push_back(make(FrameSlot::shift, FrameKind::translate, FrameCombine::add, c.words));
  return true;
}

/// Of a frame that is not known as a whole: the slots that change, where none acts on another.
bool FrameTarget::beside(const PlanarFrame& before, const PlanarFrame& after, const Parts& kept,
                         std::optional<Plane> plane, std::vector<Action>& out) const {
  const bool plain = !before.mirrors() && !before.scales() && !after.mirrors() && !after.scales();
  const auto& order = context_.target_machine.frame_order;
  const auto shift = std::find(order.begin(), order.end(), FrameSlot::shift);
  if (!plain || std::find(order.begin(), shift, FrameSlot::rotation) != shift) return false;
  if (!kept.turn && (!after.angle || (after.turns() && plane != after.plane))) return false;
  if (!kept.shift && std::any_of(after.shift.begin(), after.shift.end(), [](const auto& v) { return !v; }))
    return false;
  return (kept.shift || shift_slot(&before, after, out)) && (kept.turn || turn_slot(&before, after, out));
}

/// Shift, rotation, scale, mirror, each inside the one before: only what comes after the parts in force already.
bool FrameTarget::to_chain(const std::optional<PlanarFrame>& before, const PlanarFrame& f, bool shift,
                           std::optional<Plane> plane, std::vector<Action>& out) const {
  const FrameSlot slot = FrameSlot::chain;
  if (f.neutral()) {
    if (before && before->neutral() && !shift) return true;
    out.push_back(make(slot, FrameKind::translate, FrameCombine::clear));
    return true;
  }
  int kept = before ? kept_parts(*before, f) : 0;
  if (kept == 4 && !shift) return true;
  if (kept == 4) kept = 0;
  bool inside = kept > 0;
  const auto combine = [&inside, this]() -> std::optional<FrameCombine> {
    if (inside && !can(FrameSlot::chain, FrameCombine::compose)) return std::nullopt;
    const auto c = inside ? FrameCombine::compose : FrameCombine::replace;
    inside = true;
    return c;
  };
  if (kept < 1 && f.has_shift()) out.push_back(make(slot, FrameKind::translate, *combine(), f.shift_words(true)));
  if (kept < 2 && f.turns()) {
    const auto c = combine();
    if (!c) return false;
    out.push_back(turn(slot, *c, f, plane));
  }
  if (kept < 3 && f.scales()) {
    const auto c = combine();
    if (!c) return false;
    out.push_back(stretch(slot, *c, f));
  }
  if (f.mirrors()) {
    const auto c = combine();
    if (!c) return false;
    out.push_back(make(slot, FrameKind::mirror, *c, mirror_words(*f.mirror, *f.mirror)));
  }
  return true;
}

bool FrameTarget::shift_again(const FrameState& state, std::vector<Action>& out) const {
  if (!context_.target.work_offset_ends_shift || program_.dialect == context_.target.dialect) return true;
  const PlanarFrame now = part(state);
  if (!now.has_shift()) return true;
  if (std::any_of(now.shift.begin(), now.shift.end(), [](const auto& v) { return !v; })) return false;
  out.push_back(make(FrameSlot::shift, FrameKind::translate, FrameCombine::replace_named, now.shift_words(true)));
  return true;
}

std::vector<Action> FrameTarget::taken_back(const FrameState& state) const {
  const PlanarFrame now = part(state);
  std::vector<Action> out;
  const auto clear = [&](FrameSlot slot, FrameKind kind, bool there) {
    if (there && can(slot, FrameCombine::clear)) out.push_back(make(slot, kind, FrameCombine::clear));
  };
  clear(FrameSlot::shift, FrameKind::translate, true);
  clear(FrameSlot::rotation, FrameKind::rotate, now.turns());
  clear(FrameSlot::mirror, FrameKind::mirror, now.mirrors());
  clear(FrameSlot::scale, FrameKind::scale, now.scales());
  return out;
}

bool FrameTarget::to_slots(const std::optional<PlanarFrame>& before, const PlanarFrame& f, bool shift,
                           std::optional<Plane> plane, std::vector<Action>& out) const {
  const auto& order = context_.target_machine.frame_order;
  const auto to = in_slots(f, order);
  if (!to) return false;
  const auto from = before ? in_slots(*before, order) : std::nullopt;
  const PlanarFrame* was = from ? &*from : nullptr;
  if (f.turns() && plane != f.plane && !(was != nullptr && same_turn(*was, *to))) return false;
  const bool say = shift || was == nullptr || !same_shift(*was, *to);
  return (!say || shift_slot(was, *to, out)) && turn_slot(was, *to, out) && scale_slot(was, *to, out) &&
         mirror_slot(was, *to, out);
}

bool FrameTarget::shift_slot(const PlanarFrame* before, const PlanarFrame& f, std::vector<Action>& out) const {
  const FrameSlot slot = FrameSlot::shift;
  if (!f.has_shift() && can(slot, FrameCombine::clear)) {
    out.push_back(make(slot, FrameKind::translate, FrameCombine::clear));
  } else if (can(slot, FrameCombine::replace_named)) {
    auto words = changed_words(before, f);
    if (words.empty()) words = {f.word(0), f.word(1), f.word(2)};
    out.push_back(make(slot, FrameKind::translate, FrameCombine::replace_named, std::move(words)));
  } else if (can(slot, FrameCombine::replace)) {
    out.push_back(make(slot, FrameKind::translate, FrameCombine::replace, f.shift_words(true)));
  } else {
    return false;
  }
  return true;
}

bool FrameTarget::turn_slot(const PlanarFrame* before, const PlanarFrame& f, std::vector<Action>& out) const {
  if (before != nullptr && same_turn(*before, f)) return true;
  const FrameSlot slot = FrameSlot::rotation;
  const bool neutral = !f.turns(), was_neutral = before != nullptr && !before->turns();
  if (neutral && was_neutral) return true;
  if (can(slot, FrameCombine::replace)) {
    out.push_back(turn(slot, FrameCombine::replace, f, f.plane));
    return true;
  }
  if (can(slot, FrameCombine::add) && can(slot, FrameCombine::clear)) {
    if (!was_neutral) out.push_back(make(slot, FrameKind::rotate, FrameCombine::clear));
    if (!neutral) out.push_back(turn(slot, FrameCombine::add, f, f.plane));
    return true;
  }
  // A slot that was never touched is neutral: the reset of what is not there.
  return neutral && context_.target.frames.count(slot) == 0;
}

bool FrameTarget::scale_slot(const PlanarFrame* before, const PlanarFrame& f, std::vector<Action>& out) const {
  if (before != nullptr && same_factor(*before, f)) return true;
  const FrameSlot slot = FrameSlot::scale;
  if (!f.scales() && can(slot, FrameCombine::clear)) {
    out.push_back(make(slot, FrameKind::scale, FrameCombine::clear));
  } else if (can(slot, FrameCombine::replace)) {
    out.push_back(stretch(slot, FrameCombine::replace, f));
  } else {
    return !f.scales() && context_.target.frames.count(slot) == 0;
  }
  return true;
}

bool FrameTarget::mirror_slot(const PlanarFrame* before, const PlanarFrame& f, std::vector<Action>& out) const {
  if (before != nullptr && same_mirror(*before, f)) return true;
  const FrameSlot slot = FrameSlot::mirror;
  const std::uint32_t on = *f.mirror;
  std::uint32_t maybe = 0;  // axes that can be mirrored now
  for (const auto& a : context_.target_machine.axes) {
    if (!a.rotary && a.id < axis::u) maybe |= 1U << a.id;
  }
  if (before != nullptr && before->mirror) maybe = *before->mirror;
  const auto put = [&](FrameCombine combine, std::uint32_t named) {
    out.push_back(make(slot, FrameKind::mirror, combine, mirror_words(named, on)));
    return true;
  };
  if (on == 0 && can(slot, FrameCombine::clear)) return put(FrameCombine::clear, 0);
  const bool only_more = before != nullptr && before->mirror && (maybe & ~on) == 0;
  if (only_more && can(slot, FrameCombine::replace_named)) return put(FrameCombine::replace_named, on & ~maybe);
  if (can(slot, FrameCombine::replace)) return put(FrameCombine::replace, on);
  if (can(slot, FrameCombine::replace_named)) return put(FrameCombine::replace_named, on | maybe);
  return on == 0 && context_.target.frames.count(slot) == 0;
}

}  // namespace cnctrans::ir::passes
