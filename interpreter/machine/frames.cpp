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

bool BlockMachine::set_work_offset(const ir::WorkOffset& w) {
  const auto row = w.off ? 0 : saturate<std::int32_t>(std::round(value(w.index)));
  modal_.work_offset = row;
  zeros_.select(row);
  count_preset();
  return !failure_.set && rebuild_frame();
}

void BlockMachine::restore_modal(const ir::ModalState& state) {
  event_.file = failure_.where.file;  // what it changes shows where the routine ends
  event_.line = failure_.where.line;
  const bool other_offset = state.work_offset != modal_.work_offset;
  const ir::Surface surface = modal_.surface;
  set_comp(state.comp);
  modal_ = state;
  modal_.surface = surface;
  set_units();
  Spindle& main = spindles_.master();
  main.mode = modal_.spindle_mode;
  if (main.turns() && main.mode_changed()) emit_master();
  if (other_offset) set_work_offset(ir::WorkOffset{ir::Value(double(state.work_offset)), state.work_offset == 0});
}

void BlockMachine::count_preset() {
  parts_.count_preset(profile_.policies.frame_preset != machine::FramePreset::with_work_offset ||
                      modal_.work_offset != 0);
}

bool BlockMachine::rebuild_frame() {
  return use_frame(compose(zeros_.outside(), parts_.counted()));
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
  const bool keeps = keeps_programmed_ && modal_.surface == ir::Surface::none;
  for (const auto a : axes_) {
    if (keeps && std::abs(seen[a] - p_[a]) > 1e-12 && ((increments_.pending >> a) & 1U) == 0) {
      increments_.from[a] = p_[a];
      increments_.pending |= 1U << a;
    }
    p_[a] = seen[a];
  }
  if (profile_.policies.polar_pole_stays && polar_.pole_set && f.linear_part() == frame_.linear_part()) {
    const auto plane = ir::plane_axes(modal_.plane);
    Axes pole = p_;
    pole[plane.u] = polar_.pole.u;
    pole[plane.v] = polar_.pole.v;
    pole = inverse.apply(frame_.apply(pole));
    polar_.pole = {pole[plane.u], pole[plane.v]};
  }
  frame_ = f;
  inverse_ = inverse;
  plain_frame_ = f.is_translation();
  last_.known = false;
  ++frame_serial_;
  return true;
}

bool BlockMachine::change_frame(const ir::FrameChange& c) {
  if (!parts_.has(c.slot))
    return failure_.fail(code::frame, "the machine " + profile_.name + " has no such part in its frame");
  auto combine = c.combine;
  if (c.by_distance_mode) {
    combine = modal_.distance == ir::Distance::absolute ? ir::FrameCombine::replace_named : ir::FrameCombine::add;
  }
  for (const auto& w : c.words) {
    if (!check_axis(w.axis)) return false;
  }
  if (combine == ir::FrameCombine::clear) {
    parts_.clear(c.slot);
  } else if (combine == ir::FrameCombine::preset) {
    if (!preset(c)) return false;
  } else {
    change_part(c, combine);
  }
  // A frame outside of what the program puts with its own statements: increments count in it at once.
  const bool own = c.slot == ir::FrameSlot::chain || c.slot == ir::FrameSlot::preset;
  const bool keeps = std::exchange(keeps_programmed_, keeps_programmed_ && own);
  const bool done = !failure_.set && rebuild_frame();
  keeps_programmed_ = keeps;
  return done;
}

std::vector<ir::AxisId> BlockMachine::named_axes(const ir::FrameChange& c) {
  std::vector<ir::AxisId> axes;
  for (const auto& w : c.words) {
    if (std::find(axes.begin(), axes.end(), w.axis) == axes.end()) axes.push_back(w.axis);
  }
  return axes;
}

/// The part becomes the shift that gives the named axes these coordinates where the machine stands now.
bool BlockMachine::preset(const ir::FrameChange& c) {
  Frame outward;
  if (!invert(compose(zeros_.outside(), parts_.outside_of(c.slot)), outward))
    return failure_.fail(code::frame, "a scale of zero");
  const Axes wanted_at = outward.apply(frame_.apply(p_));
  Axes point = p_;
  for (const auto& w : c.words) point[w.axis] = coordinate(w.axis, w.value, w.scale, true);
  const Frame inside = parts_.inside_of(c.slot);
  Axes shift = inside.apply(point);
  for (const auto a : axes_) shift[a] = wanted_at[a] - shift[a];
  parts_.preset(c.slot, shift, inside.is_translation() ? named_axes(c) : axes_);
  return true;
}

void BlockMachine::change_part(const ir::FrameChange& c, ir::FrameCombine combine) {
  if (c.kind == ir::FrameKind::rotate) return parts_.rotate(c.slot, combine, turn_of(c));
  Axes values{};
  if (c.kind == ir::FrameKind::translate) {
    for (const auto& w : c.words) values[w.axis] = coordinate(w.axis, w.value, w.scale, true);
    return parts_.translate(c.slot, combine, values, named_axes(c), c.fine);
  }
  // Scale and mirror: a factor for each axis.
  const bool mirror = c.kind == ir::FrameKind::mirror;
  auto axes = named_axes(c);
  for (const auto& w : c.words) {
    const double x = value(w.value);
    values[w.axis] = mirror ? (x != 0 ? -1 : 1) : x;
  }
  if (!mirror && c.uniform_scale && !c.words.empty()) {
    const double all = value(c.words[0].value);
    for (const auto a : axes_) {
      if (axis_[a].rotary) continue;
      values[a] = all;
      if (std::find(axes.begin(), axes.end(), a) == axes.end()) axes.push_back(a);
    }
  }
  parts_.stretch(c.slot, combine, values, axes, !mirror);
}

Frame BlockMachine::turn_of(const ir::FrameChange& c) {
  Frame turn;
  if (!c.has_angle) {  // words are angles about the axes: first about X, then Y, then Z, all fixed
    for (const auto k : {ir::axis::x, ir::axis::y, ir::axis::z}) {
      for (const auto& w : c.words) {
        if (w.axis != k) continue;
        const auto u = static_cast<ir::AxisId>((k + 1) % 3), v = static_cast<ir::AxisId>((k + 2) % 3);
        turn = compose(rotation(u, v, value(w.value)), turn);
      }
    }
    return turn;
  }
  auto plane = ir::plane_axes(modal_.plane);
  if (c.rotation_axis == ir::axis::x) plane = ir::plane_axes(ir::Plane::yz);
  if (c.rotation_axis == ir::axis::y) plane = ir::plane_axes(ir::Plane::zx);
  if (c.rotation_axis == ir::axis::z) plane = ir::plane_axes(ir::Plane::xy);
  turn = rotation(plane.u, plane.v, value(c.angle));
  Axes centre{};
  for (const auto& w : c.words) centre[w.axis] = coordinate(w.axis, w.value, w.scale, true);
  if (profile_.policies.frame_rotation_centre == machine::FrameRotationCentre::scaled_and_mirrored)
    centre = parts_.inside_of(c.slot).apply(centre);
  const Axes turned = turn.apply(centre);
  for (std::size_t i = 0; i < 3; ++i) turn.t[i] = centre[i] - turned[i];
  return turn;
}

/// The pole: absolute in the work frame; `add`: from the last pole; `compose`: from the present point. Nothing given:
/// the present point; an absolute pole without words: the zero point of the work frame.
void BlockMachine::set_pole(const ir::PoleSet& p) {
  const auto plane = ir::plane_axes(modal_.plane);
  polar_.pole_set = true;
  const Vec here{p_[plane.u], p_[plane.v]};
  if (p.at == nullptr) {
    polar_.pole = here;
    return;
  }
  Vec base = p.at->combine == ir::FrameCombine::add ? polar_.pole
                                                    : (p.at->combine == ir::FrameCombine::compose ? here : Vec{});
  const bool relative = p.at->combine == ir::FrameCombine::add || p.at->combine == ir::FrameCombine::compose;
  if (!relative && !p.at->words.empty()) base = polar_.pole;
  for (const auto& w : p.at->words) {
    if (!check_axis(w.axis)) return;
    const double x = coordinate(w.axis, w.value, w.scale, !relative);
    if (w.axis == plane.u) base.u = relative ? base.u + x : x;
    if (w.axis == plane.v) base.v = relative ? base.v + x : x;
  }
  polar_.pole = base;
}

bool BlockMachine::read_frame(const ir::SystemRef& ref, std::span<const double> args, Frame& out) {
  switch (ref.datum) {
    case ir::Datum::frame_programmed: out = parts_.written(); return true;
    case ir::Datum::frame_active: out = zeros_.settable(); return true;
    case ir::Datum::frame_total: out = frame_; return true;
    case ir::Datum::frame_settable: {
      const auto row = args.empty() ? modal_.work_offset : saturate<std::int32_t>(std::round(args[0]));
      if (row == ir::frame_rows::measured && args.size() == measured_count) {
        out = measured_frame(args.subspan<1, measured_count - 1>()).frame;
        for (std::size_t a = 0; a < 3; ++a) out.t[a] *= unit();
        return true;
      }
      out = zeros_.stored(row);
      return true;
    }
    default: break;
  }
  return failure_.fail(code::no_datum, "the frame " + ref.text + " is known to the machine only");
}

bool BlockMachine::write_frame(const ir::SystemRef& ref, std::span<const double> args, const Frame& f) {
  switch (ref.datum) {
    case ir::Datum::frame_programmed: parts_.replace_all(f); return rebuild_frame();
    case ir::Datum::frame_active: zeros_.set_settable(f, axes_); return rebuild_frame();
    case ir::Datum::frame_settable: {
      const auto row = args.empty() ? modal_.work_offset : saturate<std::int32_t>(std::round(args[0]));
      if (row >= ir::frame_rows::neutral)
        return failure_.fail(code::no_datum, "the frame " + ref.text + " can only be read");
      if (row >= ir::frame_rows::active_base) {
        zeros_.set_base(row, f);
        return rebuild_frame();
      }
      zeros_.store(row, f, axes_);
      return offset_written(row);
    }
    default: break;
  }
  return failure_.fail(code::no_datum, "writing the frame " + ref.text + " is not carried");
}

/// Of the row in force some controls use the new values at once, the others when it is selected again.
bool BlockMachine::offset_written(std::int32_t row) {
  if (profile_.policies.work_offset_write != machine::WorkOffsetWrite::at_once || row != modal_.work_offset)
    return true;
  zeros_.load(row);
  return rebuild_frame();
}

}  // namespace cnctrans::interpreter
