// The height from which a cycle starts, where the controls go another way to its planes.
#include <cmath>

#include "ir/known_number.h"
#include "legaliser/cycles/cycle_pass.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

bool comes_in_two_moves(const CyclePtr& native, const LegaliseContext& context) {
  const auto* hole = native ? std::get_if<HoleCycle>(&native->node) : nullptr;
  return hole != nullptr && context.target.retract_plane_switch && hole->retract.given &&
         !(hole->retract.base == hole->reference.base && equal(hole->retract.value, hole->reference.value));
}

bool back_is_known(const HoleCycle& hole, std::optional<double> defined_at, const Block& b, const Facts& facts) {
  if (hole.retract.given || defined_at) return true;
  return setting_in<RetractPlane>(b, facts, Setting::retract_plane) == RetractPlane::reference;
}

std::optional<double> retract_mm(const HoleCycle* hole, std::optional<Units> units) {
  if (hole == nullptr || !units || !hole->retract.given || hole->retract.base != LevelBase::absolute ||
      !hole->retract.value.literal())
    return std::nullopt;
  return hole->retract.value.number * (*units == Units::inch ? 25.4 : 1);
}

bool CyclePass::below_retract_plane(const Block& b, const Facts& facts) const {
  const auto* hole = std::get_if<HoleCycle>(&active_->native->node);
  const auto w = tool_axis(active_->source, b, facts);
  const bool moves_tool = w && moves_along(b, *w);
  const auto height = in_units(moves_tool ? height_after(b, facts, *w) : active_->height, b, facts);
  // The plane was where the tool stood at the definition: a run of its own begins where it stands now.
  const auto* source = std::get_if<HoleCycle>(&active_->source->node);
  const bool own_run = moves_tool || !active_->on_target;
  if (own_run && active_->left_height && source != nullptr && source->reference.given &&
      source->reference.base == LevelBase::from_initial)
    return true;
  if (hole == nullptr || !hole->retract.given) return false;
  const auto fixed = [](const Level& l) { return l.base == LevelBase::absolute && l.value.literal(); };
  if (!fixed(hole->retract) || !stands_by_itself(*hole)) return false;
  const auto reference = fixed(hole->reference) ? std::optional(hole->reference.value.number) : std::nullopt;
  const double retract = hole->retract.value.number;
  const double to = fixed(hole->bottom) ? hole->bottom.value.number : reference.value_or(-HUGE_VAL);
  const double up = retract > to ? 1 : -1;
  // A computed reference plane is taken to lie below: that of the retract would be another one.
  const bool apart = !reference || (retract - *reference) * up > 1e-9;
  // It has gone to a height that only the run knows, and the target may come over its retract plane.
  if (!height && (moves_tool || active_->left_height)) return hole->approach_by_retract && apart;
  return height && (retract - *height) * up > 1e-9 && apart;
}

bool CyclePass::follow_retract_plane(const Block& b, const Facts& facts) {
  const bool sets = sets_retract_plane(b);
  const auto* hole = std::get_if<HoleCycle>(&active_->source->node);
  if (!sets || !active_->native || hole == nullptr || hole->retract.given) return false;
  auto form = native_form(active_->source, b, facts, context_, in_units(active_->defined_at, b, facts), sense_.now(),
                          &active_->needs);
  const bool was_native = active_->native != nullptr;
  const auto w = cycle_axis(*hole, b, facts);
  const auto height = w ? in_units(height_.at(*w), b, facts) : std::nullopt;
  if (form && !by_call_ && !stands_right(std::get<HoleCycle>((*form)->node), height)) form.reset();
  if (!back_is_known(*hole, active_->defined_at, b, facts)) form.reset();
  active_->native = form ? *form : nullptr;
  lacking_ = lacking_ || !active_->native;
  return was_native;
}

bool CyclePass::follow_height(const Block& b, const Facts& facts) {
  const auto w = tool_axis(active_->source, b, facts);
  active_->left_height = active_->left_height || (w && moves_along(b, *w));
  const auto* hole = std::get_if<HoleCycle>(&active_->source->node);
  if (!active_->left_height || !active_->native || by_call_ || hole == nullptr || !triggers(b, facts) ||
      back_is_known(*hole, active_->defined_at, b, facts))
    return false;
  active_->native = nullptr;
  lacking_ = true;
  return true;
}

bool CyclePass::refuse_other_levels(Statement& s, Body& out) const {
  const Facts& facts = facts_.before(s);
  const auto* assign = std::get_if<Assign>(&s.node);
  const auto* b = std::get_if<Block>(&s.node);
  if (!facts.reachable || (facts.cycle_active_known && !facts.cycle_active)) return false;
  if (b != nullptr && (action_in<CycleDefine>(*b) != nullptr || action_in<CycleCancel>(*b) != nullptr)) return false;
  const auto plane =
      b != nullptr ? setting_in<Plane>(*b, facts, Setting::plane) : setting<Plane>(facts, Setting::plane);
  const auto along = [&plane](AxisId axis) { return !plane || axis == plane_axes(*plane).w; };
  const auto written = [&](const Assign::Item& i) {
    const auto index = i.system.args.empty() ? std::nullopt : constant_value(i.system.args.front());
    const bool elsewhere = index && facts.work_offset && *index != *facts.work_offset;
    return i.to_system && i.system.datum == Datum::work_offset && !elsewhere && along(i.system.axis);
  };
  const auto changed = [&](const Action& a) {
    const auto* f = std::get_if<FrameOp>(&a.data);
    const FrameChange* c = f != nullptr ? f->change.get() : nullptr;
    return c != nullptr && c->combine != FrameCombine::preset && c->kind != FrameKind::rotate &&
           (c->uniform_scale ||
            std::any_of(c->words.begin(), c->words.end(), [&](const FrameWord& w) { return along(w.axis); }));
  };
  const bool other = (assign != nullptr && std::any_of(assign->items.begin(), assign->items.end(), written)) ||
                     (b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), changed));
  const auto* offset = b != nullptr ? action_in<WorkOffset>(*b) : nullptr;
  const bool on = active_ && (active_->on_target || active_->maybe_on_target);
  const bool ends = on && offset != nullptr && offset->off;
  if (!other && !ends) return false;
  refuse(
      s, program_, context_, "TRN-331",
      ends
          ? std::string(offset_ends)
          : std::string(assign != nullptr ? "the zero point" : "the scale, the shift or the mirror") +
                " along the tool changes while a cycle is active: whether its levels go along is not the same on every "
                "control",
      "cancel the cycle before this block and define it again behind it");
  out.push_back(std::move(s));
  return true;
}

bool CyclePass::moves_coordinates(const Statement& s) const {
  if (const auto* a = std::get_if<Assign>(&s.node)) {
    return std::any_of(a->items.begin(), a->items.end(), [](const Assign::Item& i) {
      return i.to_system && (i.system.datum == Datum::work_offset || (i.value && i.value->type == Type::frame));
    });
  }
  const auto* b = std::get_if<Block>(&s.node);
  return b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), [&](const Action& a) {
           if (const auto* w = std::get_if<WorkOffset>(&a.data)) {
             const auto in_force = facts_.before(s).work_offset;
             return !in_force || (w->off ? 0.0 : known_number(w->index)) != *in_force;
           }
           return std::holds_alternative<FrameOp>(a.data);
         });
}

void CyclePass::lose_height(const Statement& s) {
  active_->height = active_->defined_at = std::nullopt;
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || action_in<WorkOffset>(*b) != nullptr) {
    active_->left_height = true;
    return;
  }
  const auto w = tool_axis(active_->source, *b, facts_.before(s));
  const auto along = [&w](const Action& a) {
    const auto* f = std::get_if<FrameOp>(&a.data);
    const FrameChange* c = f != nullptr ? f->change.get() : nullptr;
    if (c == nullptr || c->combine == FrameCombine::clear) return false;
    if (c->kind == FrameKind::rotate) return c->rotation_axis != axis::none && c->rotation_axis != w;
    return !w || c->uniform_scale ||
           std::any_of(c->words.begin(), c->words.end(), [&w](const FrameWord& x) { return x.axis == w; });
  };
  const auto takes_back = [](const Action& a) {
    const auto* f = std::get_if<FrameOp>(&a.data);
    return f != nullptr && (!f->change || f->change->combine == FrameCombine::clear);
  };
  const auto& here = b->actions;
  active_->left_height = active_->left_height || std::any_of(here.begin(), here.end(), along) ||
                         (std::any_of(here.begin(), here.end(), takes_back) && any_action(program_, along));
}

void CyclePass::leave_height(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || !active_) return;
  const auto w = tool_axis(active_->source, *b, facts_.before(s));
  active_->left_height = active_->left_height || (w && moves_along(*b, *w));
}

/// A single run whose retract plane is not the height it starts from: the target's cycle would go there first. It
/// returns to the reference plane instead, and the rest is a move of its own. The place to go to; empty: as it is.
std::optional<Value> CyclePass::leave_by_own_move(CyclePtr& cycle, const Active& a) const {
  const auto* hole = std::get_if<HoleCycle>(&cycle->node);
  if (hole == nullptr || !hole->retract.given || hole->retract.base != LevelBase::absolute ||
      hole->reference.base != LevelBase::absolute || equal(hole->retract.value, hole->reference.value))
    return std::nullopt;
  if (!hole->retract.value.literal() || a.height == hole->retract.value.number) return std::nullopt;
  HoleCycle low = *hole;
  low.retract = low.reference;
  for (const bool approach : {low.approach_by_retract, !low.approach_by_retract}) {
    low.approach_by_retract = approach;
    auto made = std::make_shared<Cycle>();
    made->node = low;
    if (!context_.target.native_cycle(*made)) continue;
    const Value to = hole->retract.value;
    cycle = std::move(made);
    return to;
  }
  return std::nullopt;
}

bool CyclePass::rises_first(const Active& a, const Block& b, const Facts& facts) const {
  const auto* hole = a.native ? std::get_if<HoleCycle>(&a.native->node) : nullptr;
  if (hole == nullptr ||
      context_.target_machine.policies.cycle_below_reference != machine::CycleBelowReference::refused)
    return false;
  if (!hole->reference.given || hole->reference.base != LevelBase::absolute || comes_in_two_moves(a.native, context_))
    return false;
  const auto height = in_units(a.height, b, facts);
  if (!hole->reference.value.literal()) return old_may_run(facts);  // another cycle left the tool somewhere
  if (!height) return false;
  const double reference = hole->reference.value.number;
  const bool upward =
      hole->bottom.value.literal() && hole->bottom.base == LevelBase::absolute && hole->bottom.value.number > reference;
  return !upward && reference - *height > 1e-9;
}

void CyclePass::rise_and_define(Statement&& s, const Active& a, bool modal, Body&& pieces, Body& out) {
  auto& b = std::get<Block>(s.node);
  const Facts& facts = facts_.before(s);
  const auto& hole = std::get<HoleCycle>(a.native->node);
  const LineInfo like = s.line;
  if (old_may_run(facts)) pieces.push_back(off_statement(like, false));
  position_rapid(b, context_);
  Block up;
  up.has_motion = true;
  up.motion.kind = MotionKind::rapid;
  up.motion.explicit_code = true;
  up.motion.keeps_modal = false;
  CoordWord z;
  z.axis = cycle_axis(hole, b, facts).value_or(axis::z);
  z.mode = WordMode::absolute;
  z.value = hole.reference.value;
  z.value.text = {};
  up.motion.coords.push_back(z);
  const bool apart = levels_by_mode(a.native, b, facts);
  const std::size_t main = pieces.size();
  if (b.empty()) {
    s.node = std::move(up);
    pieces.push_back(std::move(s));
  } else {
    pieces.push_back(std::move(s));
    pieces.push_back(made(like, std::move(up)));
  }
  Block words;
  if (apart) words.actions.push_back(distance_set(Distance::absolute));
  feed_for_tap(words, a);
  words.actions.push_back(action(CycleDefine{a.native, modal, true, CycleTrigger::plane_axis_word}));
  if (const auto feed = feed_after_tap(a, facts); feed && !modal) then_.push_back(*feed);
  pieces.push_back(made(like, std::move(words)));
  if (apart) pieces.push_back(make_block(like, distance_set(Distance::incremental)));
  put_group(out, std::move(pieces), main);
}

std::optional<Level> CyclePass::kept_bottom(const HoleCycle& change, const Block& b, const Facts& facts) const {
  const auto& before = std::get<HoleCycle>(active_->source->node);
  Level kept = before.bottom;
  const bool along = kept.base == LevelBase::from_reference || kept.base == LevelBase::from_surface;
  if (!along || !change.reference.given) return kept;
  const auto initial = in_units(active_->defined_at, b, facts);
  const Level& reference = before.reference;
  if (kept.base == LevelBase::from_surface || !kept.value.literal() || !reference.value.literal()) return std::nullopt;
  if (reference.base == LevelBase::absolute) {
    kept.value = Value(reference.value.number + kept.value.number);
  } else if (reference.base == LevelBase::from_initial && initial) {
    kept.value = Value(*initial + reference.value.number + kept.value.number);
  } else {
    return std::nullopt;
  }
  kept.base = LevelBase::absolute;
  return kept;
}

bool CyclePass::refuse_lost_bottom(Statement& s, const CycleDefine& d, Body& out) {
  const auto* hole = std::get_if<HoleCycle>(&d.cycle->node);
  if (hole == nullptr || !hole->keeps_initial || hole->bottom.given) return false;
  if (kept_bottom(*hole, std::get<Block>(s.node), facts_.before(s))) return false;
  refuse(s, program_, context_, "TRN-330",
         "the reference plane of a cycle is changed, and at which height its bottom stays is not known here",
         "write the cycle again, or its depth (I) as well");
  out.push_back(std::move(s));
  return true;
}

}  // namespace cnctrans::ir::passes
