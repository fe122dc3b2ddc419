#include "interpreter/machine/frame_parts.h"

#include <algorithm>

namespace cnctrans::interpreter {

double& factor_of(Frame& f, ir::AxisId axis) {
  return axis < 3 ? f.m[axis][axis] : f.d[axis];
}

bool FrameParts::has(ir::FrameSlot slot) const {
  return std::find(order_.begin(), order_.end(), slot) != order_.end();
}

void FrameParts::add_counted(Frame& f, ir::FrameSlot slot) const {
  if (counts(slot) && (slot != ir::FrameSlot::preset || preset_counts_)) f = compose(f, parts_[index(slot)]);
}

Frame FrameParts::written() const {
  Frame f;
  for (const auto s : order_) f = compose(f, parts_[index(s)]);
  return f;
}

Frame FrameParts::counted() const {
  Frame f;
  for (const auto s : order_) add_counted(f, s);
  return f;
}

Frame FrameParts::outside_of(ir::FrameSlot slot) const {
  Frame f;
  for (auto s = order_.begin(); s != order_.end() && *s != slot; ++s) add_counted(f, *s);
  return f;
}

Frame FrameParts::inside_of(ir::FrameSlot slot) const {
  Frame f;
  auto s = std::find(order_.begin(), order_.end(), slot);
  if (s != order_.end()) ++s;
  for (; s != order_.end(); ++s) add_counted(f, *s);
  return f;
}

void FrameParts::suspend(ir::FrameSlot slot, bool off) {
  const auto bit = 1U << index(slot);
  suspended_ = static_cast<std::uint8_t>(off ? suspended_ | bit : suspended_ & ~bit);
}

void FrameParts::clear(ir::FrameSlot slot) {
  if (slot == ir::FrameSlot::chain) {
    fine_.fill(0);
    for (const auto s : order_) {
      if (s != ir::FrameSlot::preset) parts_[index(s)] = Frame{};
    }
  }
  parts_[index(slot)] = Frame{};
}

void FrameParts::replace_all(const Frame& f) {
  parts_.fill(Frame{});
  parts_[index(ir::FrameSlot::chain)] = f;
  fine_.fill(0);
}

Frame& FrameParts::change(ir::FrameSlot slot, ir::FrameCombine combine) {
  if (combine == ir::FrameCombine::replace && slot == ir::FrameSlot::chain) fine_.fill(0);
  return parts_[index(slot)];
}

void FrameParts::preset(ir::FrameSlot slot, const Axes& shift, const AxisList& axes) {
  for (const auto a : axes) parts_[index(slot)].t[a] = shift[a];
}

void FrameParts::translate(ir::FrameSlot slot, ir::FrameCombine combine, const Axes& shift, const AxisList& axes,
                           bool fine) {
  Frame& part = change(slot, combine);
  const bool chain = slot == ir::FrameSlot::chain;
  switch (combine) {
    case ir::FrameCombine::replace: part = translation(shift); break;
    case ir::FrameCombine::compose: {
      const Axes before = part.t;
      part = compose(part, translation(shift));
      for (std::size_t a = 0; chain && a < fine_.size(); ++a) fine_[a] += part.t[a] - before[a];  // counts as fine
      break;
    }
    case ir::FrameCombine::replace_named:
      for (const auto a : axes) {
        if (chain && fine) {
          part.t[a] += shift[a] - fine_[a];
          fine_[a] = shift[a];
        } else {
          part.t[a] = shift[a] + (chain ? fine_[a] : 0);
        }
      }
      break;
    case ir::FrameCombine::add:
      for (const auto a : axes) part.t[a] += shift[a];
      break;
    case ir::FrameCombine::clear:
    case ir::FrameCombine::preset: break;
  }
}

void FrameParts::rotate(ir::FrameSlot slot, ir::FrameCombine combine, const Frame& turn) {
  Frame& part = change(slot, combine);
  switch (combine) {
    case ir::FrameCombine::add: part = compose(turn, part); break;
    case ir::FrameCombine::compose: part = compose(part, turn); break;
    default: part = turn;
  }
}

void FrameParts::stretch(ir::FrameSlot slot, ir::FrameCombine combine, const Axes& factors, const AxisList& axes,
                         bool times) {
  Frame& part = change(slot, combine);
  if (combine == ir::FrameCombine::replace_named || combine == ir::FrameCombine::add) {
    const bool on_top = times && combine == ir::FrameCombine::add;
    for (const auto a : axes) factor_of(part, a) = factors[a] * (on_top ? factor_of(part, a) : 1);
    return;
  }
  Frame f;
  for (const auto a : axes) factor_of(f, a) = factors[a];
  part = combine == ir::FrameCombine::compose ? compose(part, f) : f;
}

}  // namespace cnctrans::interpreter
