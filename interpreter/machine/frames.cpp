// Work offsets, the programmable frame and the pole.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/saturate.h"
#include "interpreter/machine/block_machine.h"
#include "interpreter/trace/run_codes.h"
#include "interpreter/values/measured_frame.h"
#include "ir/frame_rows.h"

namespace cnctrans::interpreter {

namespace {
std::size_t index_of(ir::FrameSlot s) {
  return static_cast<std::size_t>(s);
}

double& diagonal(Frame& f, ir::AxisId a) {
  return a < 3 ? f.m[a][a] : f.d[a];
}
}  // namespace

/// Everything outside of what the program has put: base frames and the settable one.
Frame BlockMachine::offset_frame() const {
  return base_frames_.empty() ? settable_frame() : compose(base_frame(), settable_frame());
}

Frame BlockMachine::base_frame(std::int32_t from) const {
  Frame f;
  for (const auto& [row, part] : base_frames_) {
    if (row >= ir::frame_rows::active_base + from) f = compose(f, part);
  }
  return f;
}

/// The stored base frames come into force.
void BlockMachine::load_base() {
  namespace rows = ir::frame_rows;
  for (auto it = offset_shapes_.lower_bound(rows::stored_base);
       it != offset_shapes_.end() && it->first < rows::active_base; ++it) {
    Frame f = it->second;
    for (const auto& [axis, v] : work_offsets_[it->first]) f.t[axis] += v;
    base_frames_[it->first - rows::stored_base + rows::active_base] = f;
  }
}

Frame BlockMachine::settable_frame() const {
  Axes t{};
  for (const auto& [axis, v] : active_offset_) t[axis] = v;
  Frame f = active_shape_;
  f.t = t;
  return f;
}

/// The row of the table becomes the one in force.
void BlockMachine::load_offset(std::int32_t row) {
  active_offset_.clear();
  active_shape_ = Frame{};
  if (const auto it = work_offsets_.find(row); it != work_offsets_.end()) active_offset_ = it->second;
  if (const auto it = fine_offsets_.find(row); it != fine_offsets_.end()) {
    for (const auto& [axis, v] : it->second) active_offset_[axis] += v;
  }
  if (const auto it = offset_shapes_.find(row); it != offset_shapes_.end()) active_shape_ = it->second;
}

/// Everything that the program has put between its coordinates and the settable offset.
Frame BlockMachine::programmable_frame() const {
  Frame f;
  for (const auto s : profile_.frame_order) f = compose(f, slots_[index_of(s)]);
  return f;
}

bool BlockMachine::set_work_offset(const ir::WorkOffset& w) {
  const auto row = w.off ? 0 : saturate<std::int32_t>(std::round(value(w.index)));
  modal_.work_offset = row;
  zero_open_ = false;
  load_offset(row);
  load_base();
  return !failure_.set && rebuild_frame();
}

void BlockMachine::restore_modal(const ir::ModalState& state) {
  const bool other_offset = state.work_offset != modal_.work_offset;
  const ir::Surface surface = modal_.surface;
  set_comp(state.comp);
  modal_ = state;
  modal_.surface = surface;
  set_units();
  spindles_[master_].mode = modal_.spindle_mode;
  const Spindle& main = spindles_[master_];
  if (main.state != ir::SpindleState::off && !main.oriented && main.mode != main.shown_mode) emit_spindle(master_);
  if (other_offset) set_work_offset(ir::WorkOffset{ir::Value(double(state.work_offset)), state.work_offset == 0});
}

/// What the slot adds now: nothing while it is suspended.
Frame BlockMachine::slot_frame(ir::FrameSlot slot) const {
  const bool off = (suspended_ >> index_of(slot) & 1U) != 0 ||
                   (slot == ir::FrameSlot::preset && policy_.preset_is_offset && modal_.work_offset == 0);
  return off ? Frame{} : slots_[index_of(slot)];
}

/// The parts of the frame inside `slot`.
Frame BlockMachine::inner_of(ir::FrameSlot slot) const {
  Frame f;
  bool inside = false;
  for (const auto s : profile_.frame_order) {
    if (inside) f = compose(f, slot_frame(s));
    inside = inside || s == slot;
  }
  return f;
}

bool BlockMachine::rebuild_frame() {
  Frame f = offset_frame();
  for (const auto s : profile_.frame_order) f = compose(f, slot_frame(s));
  return use_frame(f);
}

/// The machine stays where it is; its point is seen in the new frame.
bool BlockMachine::use_frame(const Frame& f) {
  if (f == frame_ && frame_serial_ != 0) return true;
  Frame inverse;
  if (!invert(f, inverse)) return failure_.fail(code::frame, "a scale of zero");
  if (pending_) {  // the move before goes out in the coordinates that it was written in
    const bool asked = !pending_->modal;
    release_pending();
    if (asked && !without_corner("what follows the corner is no move in the same plane and frame")) return false;
  }
  const Axes machine = frame_.apply(p_);
  const Axes seen = inverse.apply(machine);
  const bool keeps = policy_.keeps_programmed && modal_.surface == ir::Surface::none;
  for (const auto a : axes_) {
    if (keeps && std::abs(seen[a] - p_[a]) > 1e-12 && ((base_pending_ >> a) & 1U) == 0) {
      increment_base_[a] = p_[a];
      base_pending_ |= 1U << a;
    }
    p_[a] = seen[a];
  }
  if (policy_.pole_stays && pole_set_ && f.linear_part() == frame_.linear_part()) {
    const auto plane = ir::plane_axes(modal_.plane);
    Axes pole = p_;
    pole[plane.u] = pole_.u;
    pole[plane.v] = pole_.v;
    pole = inverse.apply(frame_.apply(pole));
    pole_ = {pole[plane.u], pole[plane.v]};
  }
  frame_ = f;
  inverse_ = inverse;
  plain_frame_ = f.is_translation();
  has_path_ = false;
  ++frame_serial_;
  return true;
}

bool BlockMachine::change_frame(const ir::FrameChange& c) {
  auto& slot = slots_[index_of(c.slot)];
  if (std::find(profile_.frame_order.begin(), profile_.frame_order.end(), c.slot) == profile_.frame_order.end()) {
    return failure_.fail(code::frame, "the machine " + profile_.name + " has no such part in its frame");
  }
  auto combine = c.combine;
  if (c.by_distance_mode) {
    combine = modal_.distance == ir::Distance::absolute ? ir::FrameCombine::replace_named : ir::FrameCombine::add;
  }
  for (const auto& w : c.words) {
    if (!check_axis(w.axis)) return false;
  }
  const bool whole = combine == ir::FrameCombine::clear || combine == ir::FrameCombine::replace;
  if (whole && c.slot == ir::FrameSlot::chain) fine_shift_.fill(0);
  if (combine == ir::FrameCombine::clear) {
    if (c.slot == ir::FrameSlot::chain) {
      for (const auto s : profile_.frame_order) {
        if (s != ir::FrameSlot::preset) slots_[index_of(s)] = Frame{};
      }
    }
    slot = Frame{};
  } else if (combine == ir::FrameCombine::preset) {
    if (!preset(c, slot)) return false;
  } else if (!change_slot(c, combine, slot)) {
    return false;
  }
  // A frame outside of what the program puts with its own statements: increments count in it at once.
  const bool own = c.slot == ir::FrameSlot::chain || c.slot == ir::FrameSlot::preset;
  const bool keeps = std::exchange(policy_.keeps_programmed, policy_.keeps_programmed && own);
  const bool done = !failure_.set && rebuild_frame();
  policy_.keeps_programmed = keeps;
  return done;
}

bool BlockMachine::change_slot(const ir::FrameChange& c, ir::FrameCombine combine, Frame& slot) {
  switch (c.kind) {
    case ir::FrameKind::translate: return translate(c, combine, slot);
    case ir::FrameKind::rotate: return rotate(c, combine, slot);
    case ir::FrameKind::scale:
    case ir::FrameKind::mirror: break;
  }
  return stretch(c, combine, slot);
}

/// The slot becomes the shift that gives the named axes these coordinates where the machine stands now.
bool BlockMachine::preset(const ir::FrameChange& c, Frame& slot) {
  Frame outer = offset_frame();
  for (const auto s : profile_.frame_order) {
    if (s == c.slot) break;
    outer = compose(outer, slot_frame(s));
  }
  Frame outward;
  if (!invert(outer, outward)) return failure_.fail(code::frame, "a scale of zero");
  const Axes wanted_at = outward.apply(frame_.apply(p_));
  Axes point = p_;
  for (const auto& w : c.words) point[w.axis] = coordinate(w.axis, w.value, w.scale, true);
  const Axes seen = inner_of(c.slot).apply(point);
  const bool straight = inner_of(c.slot).is_translation();
  const auto set = [&](ir::AxisId a) { slot.t[a] = wanted_at[a] - seen[a]; };
  if (straight) {
    for (const auto& w : c.words) set(w.axis);
  } else {
    for (const auto a : axes_) set(a);
  }
  return true;
}

bool BlockMachine::translate(const ir::FrameChange& c, ir::FrameCombine combine, Frame& slot) {
  Axes t{};
  for (const auto& w : c.words) t[w.axis] = coordinate(w.axis, w.value, w.scale, true);
  switch (combine) {
    case ir::FrameCombine::replace: slot = translation(t); break;
    case ir::FrameCombine::compose: {
      const Axes before = slot.t;
      slot = compose(slot, translation(t));
      if (c.slot == ir::FrameSlot::chain) {  // what is added counts as the fine part
        for (const auto a : axes_) fine_shift_[a] += slot.t[a] - before[a];
      }
      break;
    }
    case ir::FrameCombine::replace_named:
      for (const auto& w : c.words) {
        double& fine = fine_shift_[w.axis];
        const bool parts = c.slot == ir::FrameSlot::chain;
        if (parts && c.fine) {
          slot.t[w.axis] += t[w.axis] - fine;
          fine = t[w.axis];
        } else {
          slot.t[w.axis] = t[w.axis] + (parts ? fine : 0);
        }
      }
      break;
    case ir::FrameCombine::add:
      for (const auto& w : c.words) slot.t[w.axis] += t[w.axis];
      break;
    case ir::FrameCombine::clear:
    case ir::FrameCombine::preset: break;
  }
  return true;
}

bool BlockMachine::rotate(const ir::FrameChange& c, ir::FrameCombine combine, Frame& slot) {
  Frame turn;
  if (c.has_angle) {
    auto plane = ir::plane_axes(modal_.plane);
    if (c.rotation_axis == ir::axis::x) plane = ir::plane_axes(ir::Plane::yz);
    if (c.rotation_axis == ir::axis::y) plane = ir::plane_axes(ir::Plane::zx);
    if (c.rotation_axis == ir::axis::z) plane = ir::plane_axes(ir::Plane::xy);
    turn = rotation(plane.u, plane.v, value(c.angle));
    Axes centre{};
    for (const auto& w : c.words) centre[w.axis] = coordinate(w.axis, w.value, w.scale, true);
    if (policy_.centre_through_frame) centre = inner_of(c.slot).apply(centre);
    const Axes turned = turn.apply(centre);
    for (std::size_t i = 0; i < 3; ++i) turn.t[i] = centre[i] - turned[i];
  } else {  // words are angles about the axes: first about X, then Y, then Z, all fixed
    for (const auto k : {ir::axis::x, ir::axis::y, ir::axis::z}) {
      for (const auto& w : c.words) {
        if (w.axis != k) continue;
        const auto u = static_cast<ir::AxisId>((k + 1) % 3), v = static_cast<ir::AxisId>((k + 2) % 3);
        turn = compose(rotation(u, v, value(w.value)), turn);
      }
    }
  }
  switch (combine) {
    case ir::FrameCombine::add: slot = compose(turn, slot); break;
    case ir::FrameCombine::compose: slot = compose(slot, turn); break;
    default: slot = turn;
  }
  return true;
}

/// Scale and mirror: a factor per axis.
bool BlockMachine::stretch(const ir::FrameChange& c, ir::FrameCombine combine, Frame& slot) {
  const bool mirror = c.kind == ir::FrameKind::mirror;
  Frame f;
  std::array<bool, ir::axis::count_max> named{};
  for (const auto& w : c.words) {
    const double x = value(w.value);
    diagonal(f, w.axis) = mirror ? (x != 0 ? -1 : 1) : x;
    named[w.axis] = true;
  }
  if (!mirror && c.uniform_scale && !c.words.empty()) {
    for (const auto a : axes_) {
      if (axis_[a].rotary) continue;
      diagonal(f, a) = value(c.words[0].value);
      named[a] = true;
    }
  }
  switch (combine) {
    case ir::FrameCombine::compose: slot = compose(slot, f); break;
    case ir::FrameCombine::replace_named:
    case ir::FrameCombine::add:
      for (const auto a : axes_) {
        if (!named[a]) continue;
        const bool times = !mirror && combine == ir::FrameCombine::add;
        diagonal(slot, a) = times ? diagonal(slot, a) * diagonal(f, a) : diagonal(f, a);
      }
      break;
    default: slot = f;
  }
  return true;
}

/// The pole: absolute in the work frame; `add`: from the last pole; `compose`: from the present point. Nothing given:
/// the present point; an absolute pole without words: the zero point of the work frame.
void BlockMachine::set_pole(const ir::PoleSet& p) {
  const auto plane = ir::plane_axes(modal_.plane);
  pole_set_ = true;
  const Vec here{p_[plane.u], p_[plane.v]};
  if (p.at == nullptr) {
    pole_ = here;
    return;
  }
  Vec base =
      p.at->combine == ir::FrameCombine::add ? pole_ : (p.at->combine == ir::FrameCombine::compose ? here : Vec{});
  const bool relative = p.at->combine == ir::FrameCombine::add || p.at->combine == ir::FrameCombine::compose;
  if (!relative && !p.at->words.empty()) base = pole_;
  for (const auto& w : p.at->words) {
    if (!check_axis(w.axis)) return;
    const double x = coordinate(w.axis, w.value, w.scale, !relative);
    if (w.axis == plane.u) base.u = relative ? base.u + x : x;
    if (w.axis == plane.v) base.v = relative ? base.v + x : x;
  }
  pole_ = base;
}

bool BlockMachine::read_frame(const ir::SystemRef& ref, std::span<const double> args, Frame& out) {
  switch (ref.datum) {
    case ir::Datum::frame_programmed: out = programmable_frame(); return true;
    case ir::Datum::frame_active: out = settable_frame(); return true;
    case ir::Datum::frame_total: out = frame_; return true;
    case ir::Datum::frame_settable: {
      const auto row = args.empty() ? modal_.work_offset : saturate<std::int32_t>(std::round(args[0]));
      out = Frame{};
      if (row == ir::frame_rows::measured && args.size() == measured_count) {
        out = measured_frame(args.subspan<1, measured_count - 1>()).frame;
        for (std::size_t a = 0; a < 3; ++a) out.t[a] *= unit();
        return true;
      }
      if (row == ir::frame_rows::total_base) {
        out = base_frame(ir::frame_rows::own_base);
        return true;
      }
      if (const auto it = base_frames_.find(row); it != base_frames_.end()) {
        out = it->second;
        return true;
      }
      if (const auto it = offset_shapes_.find(row); it != offset_shapes_.end()) out = it->second;
      if (const auto it = work_offsets_.find(row); it != work_offsets_.end()) {
        for (const auto& [axis, v] : it->second) out.t[axis] += v;
      }
      if (const auto it = fine_offsets_.find(row); it != fine_offsets_.end()) {
        for (const auto& [axis, v] : it->second) out.t[axis] += v;
      }
      return true;
    }
    default: break;
  }
  return failure_.fail(code::no_datum, "the frame " + ref.text + " is known to the machine only");
}

bool BlockMachine::write_frame(const ir::SystemRef& ref, std::span<const double> args, const Frame& f) {
  writes_zeros_ = writes_zeros_ || ref.datum == ir::Datum::frame_active || ref.datum == ir::Datum::frame_settable;
  const auto table = [&](std::map<ir::AxisId, double>& row) {
    row.clear();
    for (const auto a : axes_) {
      if (f.t[a] != 0) row[a] = f.t[a];
    }
  };
  switch (ref.datum) {
    case ir::Datum::frame_programmed:
      for (const auto s : profile_.frame_order) slots_[index_of(s)] = Frame{};
      slots_[index_of(ir::FrameSlot::chain)] = f;
      fine_shift_.fill(0);
      return rebuild_frame();
    case ir::Datum::frame_active:
      table(active_offset_);
      active_shape_ = f.linear_part();
      return rebuild_frame();
    case ir::Datum::frame_settable: {
      const auto row = args.empty() ? modal_.work_offset : saturate<std::int32_t>(std::round(args[0]));
      if (row >= ir::frame_rows::neutral)
        return failure_.fail(code::no_datum, "the frame " + ref.text + " can only be read");
      if (row >= ir::frame_rows::active_base) {
        base_frames_[row] = f;
        return rebuild_frame();
      }
      table(work_offsets_[row]);
      fine_offsets_.erase(row);
      offset_shapes_[row] = f.linear_part();
      if (!policy_.offsets_at_once || row != modal_.work_offset) return true;
      load_offset(row);
      return rebuild_frame();
    }
    default: break;
  }
  return failure_.fail(code::no_datum, "writing the frame " + ref.text + " is not carried");
}

}  // namespace cnctrans::interpreter
