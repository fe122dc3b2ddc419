// Carrying out one block; what all parts of the machine share.
#include "interpreter/machine/block_machine.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "interpreter/trace/message_form.h"
#include "interpreter/trace/run_codes.h"

namespace cnctrans::interpreter {

BlockMachine::BlockMachine(const machine::Profile& profile, Emitter& emitter, Failure& failure, ValueSource* values,
                           const machine::World* world)
    : profile_(profile),
      world_(world),
      emitter_(emitter),
      failure_(failure),
      values_(values),
      modal_(profile.power_on),
      zeros_(profile.work_offsets),
      parts_(profile.frame_order),
      spindles_(profile.power_on.spindle_mode),
      tool_(profile),
      data_(profile) {
  const machine::Policies& policies = profile.policies;
  keeps_programmed_ = policies.frame_change_keeps == machine::FrameChangeKeeps::programmed;
  data_modal_ = policies.machine_data_units == machine::MachineDataUnits::modal;
  curve_.tolerance = std::clamp(policies.path_curve_tolerance, 1e-6, 1.0);
  for (const auto& a : profile.axes) {
    axis_[a.id].present = true;
    axis_[a.id].rotary = a.rotary;
    axis_[a.id].diameter = a.diameter;
    axes_.push_back(a.id);
    p_[a.id] = a.start;
    path_event_.to.value[a.id] = a.start;
    path_event_.to.known |= 1U << a.id;
  }
  feed_[static_cast<std::size_t>(modal_.feed_mode)] = profile.power_on_feed;
  feed_degrees_ = feed_;
  set_units();
  zeros_.load(modal_.work_offset);
  count_preset();
  if (world_ != nullptr && world_->zeros) zeros_.start_at(world_->start_offset(profile_));
  // The start is a machine position: the first frame is put under it.
  frame_ = Frame{};
  rebuild_frame();
  increments_.pending = 0;
}

Standing BlockMachine::standing() const {
  return {modal_,
          p_,
          !contour_.elements.empty(),
          feed_now() / feed_unit(),
          spindles_.master_number(),
          spindles_.master().speed(),
          cycle_.hole.has_value()};
}

double BlockMachine::expression(const ir::Value& v) {
  if (values_ != nullptr) return values_->number_of(v.expr);
  const auto constant = ir::constant_value(v.expr);
  if (!constant)
    failure_.fail(code::needs_whole_program, "a computed value cannot be read in a stream of plain blocks");
  return constant.value_or(0);
}

double BlockMachine::feed_unit() const {
  return modal_.units == ir::Units::inch && modal_.units_feed_too && modal_.feed_mode != ir::FeedMode::inverse_time
             ? 25.4
             : 1;
}

bool BlockMachine::check_axis(ir::AxisId a) {
  if (a < ir::axis::count_max && axis_[a].present) return !ir::turns_part(modal_.surface) || surface_axis(a);
  const auto name = a < ir::axis::first_extra ? std::string(ir::fixed_axis_name(a)) : "number " + std::to_string(a);
  return failure_.fail(code::no_axis, "the machine " + profile_.name + " has no axis " + name);
}

/// mm (radius) or degrees that a word of this axis means.
double BlockMachine::coordinate(ir::AxisId a, const ir::Value& v, ir::WordScale scale, bool absolute) {
  const auto& axis = axis_[a];
  const double x = value(v);
  if (scale == ir::WordScale::modal) return x * (absolute ? axis.scale_absolute : axis.scale_incremental);
  const double factor = axis.rotary ? 1 : unit();
  return scale == ir::WordScale::diameter ? x * factor / 2 : x * factor;
}

bool BlockMachine::block(const ir::Block& b, const Span& where, bool with_cycle) {
  failure_.where = where;
  path_event_.file = event_.file = where.file;
  path_event_.line = event_.line = where.line;
  now_.moves = now_.sharp = false;
  // On some machines a word of the tool axis under a cycle would be the depth, which can't change there.
  const auto axis_word = [&] {
    if (!cycle_.hole || !b.has_motion || b.motion.frame != ir::FrameUse::normal) return false;
    const bool there = std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                                   [this](const ir::CoordWord& w) { return w.axis == cycle_.axis; });
    if (!there || profile_.policies.cycle_axis_word != machine::CycleAxisWord::refused) return false;
    failure_.fail(code::bad_cycle, "a word of the tool axis in a block while a drilling cycle is active");
    return true;
  };
  now_.marks = b.actions.empty() ? ir::contour::Marks{} : ir::contour::marks_of(b);
  if (b.actions.empty()) {
    pattern_.here = now_.cycle_defined = false;
    if (axis_word() || (b.has_motion && !motion(b, with_cycle))) return false;
    if (cycle_.hole && with_cycle && cycle_triggers(b)) return run_cycle();
    return !failure_.set;
  }
  const auto feed_before = feed_;
  const auto degrees_before = feed_degrees_;
  const bool own_feed = std::any_of(b.actions.begin(), b.actions.end(), [](const ir::Action& a) {
    const auto* f = std::get_if<ir::SetFeed>(&a.data);
    return f != nullptr && f->block_only;
  });
  if (pattern_.open == &b) return go_on_with_pattern(b);
  now_.machining = nullptr;
  now_.cycle_defined = now_.cycle_waits = now_.cycle_once = pattern_.here = false;
  now_.corner.reset();
  if (!settings_first(b) || !actions(b, false)) return false;
  if (own_feed) feeds(b, true);
  if (!(now_.cycle_defined && now_.cycle_waits) && axis_word()) return false;
  if (b.has_motion && !motion(b, with_cycle)) return false;
  if (own_feed) {
    feed_ = feed_before;
    feed_degrees_ = degrees_before;
    feeds(b, false);
  }
  if (now_.corner) {
    now_.corner.reset();
    return failure_.fail(code::corner_alone, "a corner function stands in a block that does not move");
  }
  if (now_.machining != nullptr && with_cycle && !run_machining(*now_.machining)) return false;
  if (pattern_.here && with_cycle) {
    if (!run_pattern()) return false;
    if (single_points && now_.moves) {  // what acts behind it waits for its last point
      pattern_.open = &b;
      return !failure_.set;
    }
  } else if (cycle_.hole && with_cycle) {
    const bool runs = now_.cycle_defined ? !now_.cycle_waits : cycle_triggers(b);
    if (runs && !run_cycle()) return false;
    if (now_.cycle_once) end_single_cycle();
  }
  if (std::exchange(now_.feed_stop, false) && now_.moves) emitter_.emit(plain(EventKind::feed_stop));
  return actions(b, true) && !failure_.set;
}

Event& BlockMachine::plain(EventKind kind) {
  event_.kind = kind;
  return event_;
}

void BlockMachine::message(std::string text, const Span& where) {
  const std::string shown = shown_message(text);
  const auto trimmed = trim(shown);
  if (trimmed.empty()) return;
  auto& e = plain(EventKind::message);
  e.file = where.file;
  e.line = where.line;
  e.text = std::string(trimmed);
  e.state = message_form(text);
  emitter_.emit(e);
  e.text.clear();
  e.state.clear();
}

bool BlockMachine::finish() {
  if (curve_.open && !close_curve(nullptr)) return false;
  if (!contour_.elements.empty())
    return failure_.fail(code::contour_open, "the program ends before the element that closes the contour");
  if (!pending_) return true;
  const bool fault = !pending_->modal;
  release_pending();
  if (!fault) return true;
  return without_corner("the program ends before the element that should follow the corner");
}

void BlockMachine::end_event(EndReason reason, const Failure& failure, const Span& where) {
  if (curve_.open) close_curve(nullptr);
  if (pending_) release_pending();
  Event e;
  e.kind = EventKind::end;
  e.file = where.file;
  e.line = where.line;
  e.reason = reason;
  if (reason == EndReason::error) {
    e.code = failure.code;
    e.text = failure.text;
  }
  emitter_.finish(e);
}

}  // namespace cnctrans::interpreter
