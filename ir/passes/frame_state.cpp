#include "ir/passes/frame_state.h"

#include <algorithm>

namespace cnctrans::ir::passes {

FrameState::FrameState() {
  shift_.fill(Value{0.0});
  angle_ = Value{0.0};
}

bool FrameState::known() const {
  return !foreign_ && angle_ && std::all_of(shift_.begin(), shift_.end(), [](const auto& v) { return v.has_value(); });
}

FrameWord FrameState::word(std::size_t a) const {
  FrameWord w;
  w.axis = static_cast<AxisId>(a);
  w.value = preset_[a] == 0 ? *shift_[a] : add(*shift_[a], Value{preset_[a]});
  return w;
}

std::vector<FrameWord> FrameState::shift_words(bool drop_zero) const {
  std::vector<FrameWord> words;
  for (std::size_t a = 0; a < axes; ++a) {
    if (shift_[a] && !(drop_zero && word(a).value.is(0))) words.push_back(word(a));
  }
  return words;
}

bool FrameState::neutral() const {
  return known() && angle_->is(0) && shift_words(true).empty();
}

void FrameState::limit(std::uint32_t axes_touched, bool rotates) {
  touched_ = axes_touched;
  rotates_ = rotates;
}

void FrameState::forget() {
  for (std::size_t a = 0; a < axes; ++a) {
    if ((touched_ >> a & 1U) != 0) shift_[a].reset();
  }
  if (rotates_) angle_.reset();
}

void FrameState::forget_expressions() {
  for (auto& s : shift_) {
    if (s && s->expr) s.reset();
  }
  if (angle_ && angle_->expr) angle_.reset();
}

void FrameState::forget(const VarRef& v) {
  for (auto& s : shift_) {
    if (s && s->expr && reads(s->expr, v)) s.reset();
  }
  if (angle_ && angle_->expr && reads(angle_->expr, v)) angle_.reset();
}

void FrameState::join(const FrameState& other) {
  for (std::size_t a = 0; a < axes; ++a) {
    if (shift_[a] && (!other.shift_[a] || !equal(*shift_[a], *other.shift_[a]))) shift_[a].reset();
  }
  if (angle_ && (!other.angle_ || !equal(*angle_, *other.angle_))) angle_.reset();
  foreign_ = foreign_ || other.foreign_ || preset_ != other.preset_;
}

bool FrameState::operator==(const FrameState& o) const {
  const auto same = [](const std::optional<Value>& a, const std::optional<Value>& b) {
    return a.has_value() == b.has_value() && (!a || equal(*a, *b));
  };
  for (std::size_t a = 0; a < axes; ++a) {
    if (!same(shift_[a], o.shift_[a])) return false;
  }
  return same(angle_, o.angle_) && foreign_ == o.foreign_ && preset_ == o.preset_;
}

void FrameState::clear(FrameSlot slot) {
  if (slot == FrameSlot::shift || slot == FrameSlot::chain) shift_.fill(Value{0.0});
  if (slot == FrameSlot::rotation || slot == FrameSlot::chain) angle_ = Value{0.0};
  if (slot == FrameSlot::preset) preset_.fill(0);
  if (slot == FrameSlot::chain) foreign_ = false;
}

void FrameState::translate(const FrameChange& c, const Facts& facts, const Block& b) {
  FrameCombine combine = c.combine;
  if (c.by_distance_mode) {
    const auto distance = setting_in<Distance>(b, facts, Setting::distance);
    if (!distance) return forget();
    combine = *distance == Distance::incremental ? FrameCombine::add : FrameCombine::replace_named;
  }
  if (combine == FrameCombine::replace && c.slot == FrameSlot::chain) clear(FrameSlot::chain);
  if (combine == FrameCombine::replace) shift_.fill(Value{0.0});
  if (combine == FrameCombine::compose && !(angle_ && angle_->is(0))) {  // inside a rotation: by numbers only
    foreign_ = true;
    return;
  }
  for (const auto& w : c.words) {
    if (w.axis >= axes) continue;
    Value v = w.value;
    v.text = {};
    const bool adds = combine == FrameCombine::add || combine == FrameCombine::compose;
    if (!adds)
      shift_[w.axis] = w.value;
    else if (shift_[w.axis])
      shift_[w.axis] = add(*shift_[w.axis], v);
  }
}

void FrameState::rotate(const FrameChange& c) {
  if (!c.words.empty() || c.rotation_axis != axis::none || !c.has_angle) {
    foreign_ = true;
    return;
  }
  if (c.combine == FrameCombine::replace) {
    if (c.slot == FrameSlot::chain) clear(FrameSlot::chain);
    angle_ = c.angle;
  } else if (angle_) {
    angle_ = add(*angle_, c.angle);
  }
}

/// The present point gets new coordinates: the origin moves by the difference. Positions by numbers only.
void FrameState::preset(const FrameChange& c, const Facts& facts, const Block& b, const machine::Profile& machine) {
  if (!(angle_ && angle_->is(0))) foreign_ = true;
  for (const auto& w : c.words) {
    const auto& at = facts.position[w.axis];
    const auto factor = to_radius(w.axis, w.scale, Distance::absolute, b, facts, machine);
    if (w.axis >= axes || !at || !factor || !w.value.literal()) {
      foreign_ = true;
      return;
    }
    preset_[w.axis] += *at / *factor - w.value.number;
  }
}

void FrameState::apply(const FrameChange& c, const Facts& facts, const Block& b, const machine::Profile& machine) {
  if (c.combine == FrameCombine::clear) return clear(c.slot);
  if (c.combine == FrameCombine::preset) return preset(c, facts, b, machine);
  if (c.slot == FrameSlot::preset) {
    foreign_ = true;
    return;
  }
  switch (c.kind) {
    case FrameKind::translate: return translate(c, facts, b);
    case FrameKind::rotate: return rotate(c);
    case FrameKind::scale:
    case FrameKind::mirror: break;
  }
  if (c.combine == FrameCombine::replace && c.slot == FrameSlot::chain) clear(FrameSlot::chain);
  foreign_ = true;
}

}  // namespace cnctrans::ir::passes
