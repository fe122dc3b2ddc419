// Carrying out one block; what all parts of the machine share.
#include "interpreter/block_machine.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "interpreter/run_codes.h"

namespace cnctrans::interpreter {

BlockMachine::BlockMachine(const machine::Profile& profile, Emitter& emitter, Failure& failure, ValueSource* values)
    : profile_(profile),
      emitter_(emitter),
      failure_(failure),
      values_(values),
      modal_(profile.power_on),
      work_offsets_(profile.work_offsets) {
  const auto is = [&profile](std::string_view option, std::string_view value) {
    return profile.option(option) == value;
  };
  policy_.cycle_rapid = is("cycle.positioning", "rapid");
  policy_.rotary_triggers = is("cycle.rotary_triggers", "yes");
  policy_.keeps_programmed = is("frame.change_keeps", "programmed");
  policy_.centre_through_frame = is("frame.rotation_centre", "scaled_and_mirrored");
  policy_.nearest_pitch = is("helix.pitch_mismatch", "nearest");
  policy_.machine_metric = is("machine_move.units", "machine");
  policy_.pole_follows_arc = is("polar.pole_follows_arc", "yes");
  policy_.offsets_at_once = is("work_offset.write", "at_once");
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
  for (auto& s : spindles_) s.mode = modal_.spindle_mode;
  set_units();
  if (const auto it = work_offsets_.find(modal_.work_offset); it != work_offsets_.end()) active_offset_ = it->second;
  // The start is a machine position: the first frame is put under it.
  frame_ = Frame{};
  rebuild_frame();
  base_pending_ = 0;
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
  if (a < ir::axis::count_max && axis_[a].present) return true;
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
  block_moves_ = false;
  if (b.actions.empty()) {
    if (b.has_motion && !motion(b, with_cycle)) return false;
    if (hole_ && with_cycle && cycle_triggers(b)) return run_cycle();
    return !failure_.set;
  }
  feed_stop_ = cycle_defined_here_ = cycle_waits_ = once_ = false;
  block_corner_.reset();
  if (!settings_first(b) || !actions(b, false)) return false;
  if (b.has_motion && !motion(b, with_cycle)) return false;
  if (block_corner_) {
    block_corner_.reset();
    return failure_.fail(code::corner_alone, "a corner function stands in a block that does not move");
  }
  if (hole_ && with_cycle) {
    const bool runs = cycle_defined_here_ ? !cycle_waits_ : cycle_triggers(b);
    if (runs && !run_cycle()) return false;
    if (once_) hole_.reset();
  }
  if (feed_stop_) emitter_.emit(plain(EventKind::feed_stop));
  return actions(b, true) && !failure_.set;
}

Event& BlockMachine::plain(EventKind kind) {
  event_.kind = kind;
  return event_;
}

void BlockMachine::message(std::string text, const Span& where) {
  const auto trimmed = trim(text);
  if (trimmed.empty()) return;
  auto& e = plain(EventKind::message);
  e.file = where.file;
  e.line = where.line;
  e.text = std::string(trimmed);
  emitter_.emit(e);
  e.text.clear();
}

bool BlockMachine::finish() {
  if (!pending_) return true;
  const bool fault = !pending_->modal;
  release_pending();
  if (!fault) return true;
  return failure_.fail(code::corner_alone, "the program ends before the element that should follow the corner");
}

void BlockMachine::end_event(EndReason reason, const Failure& failure, const Span& where) {
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

// --- machine data ----------------------------------------------------------------------------------------------

namespace {
std::string datum_key(const ir::SystemRef& ref, std::span<const double> args) {
  std::string key = ref.text;
  if (args.empty()) return key;
  key += '[';
  for (std::size_t i = 0; i < args.size(); ++i) key += (i == 0 ? "" : ",") + shortest(args[i]);
  return key + "]";
}
const machine::Tool* tool_of(const machine::Profile& p, double number) {
  const auto it = std::find_if(p.tools.begin(), p.tools.end(), [number](const auto& t) { return t.number == number; });
  return it == p.tools.end() ? nullptr : &*it;
}
}  // namespace

bool BlockMachine::read(const ir::SystemRef& ref, std::span<const double> args, double& out) {
  if (!written_.empty()) {
    if (const auto it = written_.find(datum_key(ref, args)); it != written_.end()) {
      out = it->second;
      if (!unread_.empty()) unread_.erase(it->first);
      return true;
    }
  }
  const bool has_axis = ref.axis < ir::axis::count_max && axis_[ref.axis].present;
  const auto* tool = tool_of(profile_, args.empty() ? tool_in_spindle_ : args[0]);
  switch (ref.datum) {
    case ir::Datum::programmed_position:
    case ir::Datum::work_position:
      if (!has_axis) break;
      out = p_[ref.axis] / axis_[ref.axis].scale_absolute;
      return true;
    case ir::Datum::machine_position:
      if (!has_axis) break;
      out = frame_.apply(p_)[ref.axis];
      return true;
    case ir::Datum::work_offset: {
      const auto row = work_offsets_.find(args.empty() ? modal_.work_offset : static_cast<std::int32_t>(args[0]));
      out = 0;
      if (row != work_offsets_.end() && row->second.contains(ref.axis)) out = row->second.at(ref.axis);
      return true;
    }
    case ir::Datum::active_offset: out = modal_.work_offset; return true;
    case ir::Datum::programmed_shift:
      if (!has_axis) break;
      out = frame_.t[ref.axis] - offset_frame().t[ref.axis];
      return true;
    case ir::Datum::tool_number: out = tool_in_spindle_; return true;
    case ir::Datum::next_tool: out = tool_; return true;
    case ir::Datum::offset_number: out = offset_; return true;
    case ir::Datum::tool_length:
      out = tool == nullptr ? 0 : (ref.axis == ir::axis::x ? tool->length_x : tool->length);
      return true;
    case ir::Datum::tool_radius: out = tool == nullptr ? 0 : tool->radius; return true;
    case ir::Datum::tool_wear:
    case ir::Datum::part_count:
    case ir::Datum::cycle_time: out = 0; return true;
    case ir::Datum::feed: out = feed_now() / feed_unit(); return true;
    case ir::Datum::spindle_speed: out = spindles_[1].value[static_cast<std::size_t>(spindles_[1].mode)]; return true;
    case ir::Datum::feed_override: out = 100; return true;
    case ir::Datum::call_has_argument:
      out = static_cast<double>(args.empty() ? arguments_given
                                             : ((arguments_given >> static_cast<unsigned>(args[0])) & 1U));
      return true;
    case ir::Datum::position_start:
    case ir::Datum::active_modal:
    case ir::Datum::other: break;
  }
  return failure_.fail(code::no_datum,
                       "the value of " + datum_key(ref, args) + " is known to the machine only; --set gives it one");
}

bool BlockMachine::write(const ir::SystemRef& ref, std::span<const double> args, double v) {
  switch (ref.datum) {
    case ir::Datum::work_offset: {
      const auto row = args.empty() ? modal_.work_offset : static_cast<std::int32_t>(args[0]);
      work_offsets_[row][ref.axis] = v;
      if (!policy_.offsets_at_once || row != modal_.work_offset) return true;
      active_offset_ = work_offsets_[row];
      return rebuild_frame();
    }
    case ir::Datum::programmed_position:
    case ir::Datum::machine_position:
    case ir::Datum::work_position:
    case ir::Datum::programmed_shift:
    case ir::Datum::active_offset:
      return failure_.fail(code::no_datum,
                           "writing " + datum_key(ref, args) + " would move the machine's zero; it is not carried");
    default: break;
  }
  written_[datum_key(ref, args)] = v;
  return true;
}

}  // namespace cnctrans::interpreter
