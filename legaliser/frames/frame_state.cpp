#include "legaliser/frames/frame_state.h"

#include <algorithm>

#include "ir/known_number.h"

namespace cnctrans::ir::passes {

namespace {

constexpr std::size_t axes = PlanarFrame::axes;

std::optional<Plane> plane_of_normal(AxisId normal) {
  for (const Plane p : {Plane::xy, Plane::zx, Plane::yz}) {
    if (plane_axes(p).w == normal) return p;
  }
  return std::nullopt;
}

}  // namespace

PlanarFrame FrameState::slot(FrameSlot s) const {
  if (s == FrameSlot::preset && preset_off_) return {};
  PlanarFrame f = slots_[static_cast<std::size_t>(s)];
  if (s == FrameSlot::preset && preset_unsure_ && !f.neutral()) f.foreign = true;
  return f;
}

void FrameState::select(const WorkOffset& w, const machine::Profile& machine) {
  if (machine.policies.frame_preset != machine::FramePreset::with_work_offset) return;
  preset_off_ = w.off || w.index.is(0);
  preset_unsure_ = false;
}

PlanarFrame FrameState::whole(const machine::Profile& machine, bool preset) const {
  PlanarFrame f;
  for (const auto s : machine.frame_order) {
    if (s != FrameSlot::preset || preset) f = compose(f, slot(s));
  }
  return f;
}

PlanarFrame FrameState::inner_of(FrameSlot slot_of, const machine::Profile& machine) const {
  PlanarFrame f;
  bool inside = false;
  for (const auto s : machine.frame_order) {
    if (inside) f = compose(f, slot(s));
    inside = inside || s == slot_of;
  }
  return f;
}

bool FrameState::neutral() const {
  return std::all_of(slots_.begin(), slots_.end(), [](const PlanarFrame& f) { return f.neutral(); });
}

void FrameState::forget() {
  for (std::size_t i = 0; i < frame_slots; ++i) {
    auto& f = slots_[i];
    for (std::size_t a = 0; a < axes; ++a) {
      if ((uses_[i].axes >> a & 1U) != 0) f.shift[a].reset();
    }
    if (uses_[i].turns) f.angle.reset();
    if (uses_[i].scales) f.factor.reset();
    if (uses_[i].mirrors) f.mirror.reset();
  }
}

void FrameState::forget_expressions() {
  for (auto& f : slots_) {
    f.each_value([](std::optional<Value>& v) {
      if (v && v->expr) v.reset();
    });
  }
}

bool FrameState::has_expressions() const {
  return std::any_of(slots_.begin(), slots_.end(), [](const PlanarFrame& f) { return f.has_expressions(); });
}

void FrameState::forget(const VarRef& var) {
  for (auto& f : slots_) {
    f.each_value([&var](std::optional<Value>& v) {
      if (v && v->expr && reads(v->expr, var)) v.reset();
    });
  }
}

void FrameState::join(const FrameState& other) {
  for (std::size_t i = 0; i < frame_slots; ++i) slots_[i].join(other.slots_[i]);
  preset_unsure_ = preset_unsure_ || other.preset_unsure_ || preset_off_ != other.preset_off_;
  preset_off_ = preset_off_ && other.preset_off_;
}

void FrameState::follow_units(const Block& b, const Facts& facts, const machine::Profile& machine) {
  for (const auto& a : b.actions) {
    const auto* m = std::get_if<ModalSet>(&a.data);
    if (m == nullptr || (m->setting != Setting::units && m->setting != Setting::diameter)) continue;
    const auto before = facts.settings[static_cast<std::size_t>(m->setting)];
    if (before && *before == m->value) continue;
    for (auto& f : slots_) {
      for (std::size_t i = 0; i < axes; ++i) {
        if (!f.shift[i] || f.shift[i]->is(0)) continue;
        const auto id = static_cast<AxisId>(i);
        const bool counts_otherwise = m->setting == Setting::units
                                          ? !is_rotary_letter(id)
                                          : is_diameter_axis(machine, id) && f.shift_scale[i] == WordScale::modal;
        if (counts_otherwise) f.shift[i].reset();
      }
    }
  }
}

void FrameState::translate(const FrameChange& c, const Facts& facts, const Block& b) {
  auto& f = at(c.slot);
  FrameCombine combine = c.combine;
  if (c.by_distance_mode) {
    const auto distance = setting_in<Distance>(b, facts, Setting::distance);
    if (!distance) {
      for (const auto& w : c.words) {
        if (w.axis < axes) f.shift[w.axis].reset();
      }
      return;
    }
    combine = *distance == Distance::incremental ? FrameCombine::add : FrameCombine::replace_named;
  }
  PlanarFrame moved;
  for (const auto& w : c.words) {
    if (w.axis >= axes) continue;
    moved.shift[w.axis] =
        combine == FrameCombine::replace || combine == FrameCombine::replace_named ? w.value : without_text(w.value);
    moved.shift_scale[w.axis] = w.scale;
  }
  if (combine == FrameCombine::replace) {
    f = moved;
  } else if (combine == FrameCombine::compose) {
    f = compose(f, moved);
  } else if (combine == FrameCombine::add) {
    f = compose(moved, f);
  } else {
    for (const auto& w : c.words) {
      if (w.axis >= axes) continue;
      f.shift[w.axis] = moved.shift[w.axis];
      f.shift_scale[w.axis] = w.scale;
      if (c.slot == FrameSlot::chain) f.shift[w.axis].reset();  // only the coarse or the fine part of it
    }
  }
}

void FrameState::rotate(const FrameChange& c, const Facts& facts, const Block& b, const machine::Profile& machine) {
  auto& f = at(c.slot);
  std::optional<Plane> plane = setting_in<Plane>(b, facts, Setting::plane);
  Value angle = c.angle;
  PlanarFrame centre;
  if (!c.has_angle) {  // words are angles about the axes
    const FrameWord* about = nullptr;
    bool several = false;
    for (const auto& w : c.words) {
      if (w.value.is(0)) continue;
      several = several || about != nullptr;
      about = &w;
    }
    if (several) plane.reset();
    if (about == nullptr) angle = Value{0.0};
    if (about != nullptr && !several) {
      plane = plane_of_normal(about->axis);
      angle = without_text(about->value);
    }
  } else {
    if (c.rotation_axis != axis::none) plane = plane_of_normal(c.rotation_axis);
    for (const auto& w : c.words) {
      if (w.axis >= axes) continue;
      centre.shift[w.axis] = without_text(w.value);
      centre.shift_scale[w.axis] = is_diameter_axis(machine, w.axis) ? WordScale::diameter : w.scale;
    }
    if (machine.policies.frame_rotation_centre == machine::FrameRotationCentre::scaled_and_mirrored &&
        centre.has_shift()) {
      const PlanarFrame inner = inner_of(c.slot, machine);
      centre = compose(inner, centre);
    }
  }
  if (!plane) {
    f.foreign = true;
    return;
  }
  PlanarFrame turn = rotation_about(centre, angle, *plane);
  if (c.combine == FrameCombine::add)
    f = compose(turn, f);
  else if (c.combine == FrameCombine::compose)
    f = compose(f, turn);
  else
    f = turn;
}

/// Scale and mirror.
void FrameState::stretch(const FrameChange& c, const Facts& facts, const machine::Profile& machine) {
  auto& f = at(c.slot);
  PlanarFrame g;
  std::uint32_t named = 0, on = 0;
  for (const auto& w : c.words) {
    if (w.axis < axes) named |= 1U << w.axis;
    if (w.axis < axes && !w.value.is(0)) on |= 1U << w.axis;
  }
  const bool keeps = c.combine == FrameCombine::replace_named || c.combine == FrameCombine::add;
  if (c.kind == FrameKind::mirror) {
    const bool fixed = std::all_of(c.words.begin(), c.words.end(), [](const auto& w) { return w.value.literal(); });
    g.mirror = on;
    if (!fixed) g.mirror.reset();
    if (keeps) {
      if (f.mirror && fixed)
        f.mirror = (*f.mirror & ~named) | on;
      else
        f.mirror.reset();
      return;
    }
  } else {
    const bool equal_words = !c.words.empty() && std::all_of(c.words.begin(), c.words.end(), [&c](const auto& w) {
      return equal(w.value, c.words[0].value);
    });
    const bool developed = setting<Surface>(facts, Setting::surface) != Surface::none;  // a face has Y beside X
    const bool all_axes = (!developed || (named >> axis::y & 1U) != 0) &&
                          std::all_of(machine.axes.begin(), machine.axes.end(), [named](const auto& a) {
                            return a.rotary || (a.id < axes && (named >> a.id & 1U) != 0);
                          });
    const bool one = equal_words && (c.uniform_scale || all_axes || c.words[0].value.is(1));
    if (equal_words) g.factor = without_text(c.words[0].value);
    if (equal_words && !one) g.scaled = named;
    g.foreign = !one;
    g.by_axes = equal_words && !one && named <= PlanarFrame::linear;
    if (keeps) {
      if ((!c.uniform_scale && !all_axes) || !one)
        f.foreign = true;
      else if (c.combine == FrameCombine::add)
        f = compose(f, g);
      else
        f.factor = g.factor;
      return;
    }
  }
  f = c.combine == FrameCombine::compose ? compose(f, g) : g;
}

/// The present point gets new coordinates: the origin moves by the difference. Positions by numbers only.
void FrameState::preset(const FrameChange& c, const Facts& facts, const Block& b, const machine::Profile& machine) {
  auto& f = at(FrameSlot::preset);
  const PlanarFrame inner = inner_of(FrameSlot::preset, machine);
  if (preset_unsure_ || inner.foreign || inner.turns() || inner.scales() || inner.mirrors()) f.foreign = true;
  for (const auto& w : c.words) {
    if (w.axis >= axes) continue;
    const auto& point = facts.position[w.axis];
    const auto factor = to_radius(w.axis, w.scale, Distance::absolute, b, facts, machine);
    if (!point || !factor || !w.value.literal()) {
      f.foreign = true;
      return;
    }
    f.shift_scale[w.axis] = w.scale;
    const Value by{*point / *factor - w.value.number};
    if (preset_off_)
      f.shift[w.axis] = by;  // the point was not counted from what it was preset to before
    else if (f.shift[w.axis])
      f.shift[w.axis] = add(*f.shift[w.axis], by);
  }
}

void FrameState::apply(const FrameChange& c, const Facts& facts, const Block& b, const machine::Profile& machine) {
  if (c.combine == FrameCombine::clear) {
    at(c.slot) = PlanarFrame{};
    if (c.slot != FrameSlot::chain) return;
    for (const auto s : machine.frame_order) {
      if (s != FrameSlot::preset) at(s) = PlanarFrame{};
    }
    return;
  }
  if (c.combine == FrameCombine::preset) return preset(c, facts, b, machine);
  if (c.slot == FrameSlot::preset) {
    at(c.slot).foreign = true;
    return;
  }
  switch (c.kind) {
    case FrameKind::translate: return translate(c, facts, b);
    case FrameKind::rotate: return rotate(c, facts, b, machine);
    case FrameKind::scale:
    case FrameKind::mirror: return stretch(c, facts, machine);
  }
}

}  // namespace cnctrans::ir::passes
