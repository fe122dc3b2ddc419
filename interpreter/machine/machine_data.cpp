// Machine data that a program can read and write.
#include <algorithm>
#include <cmath>

#include "base/saturate.h"
#include "base/text.h"
#include "interpreter/machine/block_machine.h"
#include "interpreter/trace/run_codes.h"
#include "interpreter/values/contour_crossing.h"
#include "interpreter/values/measured_frame.h"
#include "ir/active_units.h"
#include "ir/frame_rows.h"
#include "machine/data_at_rest.h"

namespace cnctrans::interpreter {

namespace {

using ir::Datum;

constexpr std::size_t crossing_count = 3 + 2 * element_values;

const machine::Tool* tool_of(const machine::Profile& p, double number) {
  const auto it = std::find_if(p.tools.begin(), p.tools.end(), [number](const auto& t) { return t.number == number; });
  return it == p.tools.end() ? nullptr : &*it;
}
/// active_modal also says whether a part of the programmable frame counts: setting_count + 2 + FrameSlot.
std::optional<ir::FrameSlot> frame_slot(std::span<const double> args) {
  const int n = args.size() == 3 ? saturate<int>(args[1]) - static_cast<int>(ir::setting_count) - 2 : -1;
  if (n < 0 || n > static_cast<int>(ir::FrameSlot::chain)) return std::nullopt;
  return static_cast<ir::FrameSlot>(n);
}
bool tool_length_unit(Datum d) {
  return d == Datum::tool_radius || d == Datum::tool_length || d == Datum::tool_wear || d == Datum::tool_nose_width;
}
double value_of(const ir::ModalState& state, int setting) {
  if (setting == static_cast<int>(ir::setting_count)) return static_cast<double>(state.motion);
  if (setting == static_cast<int>(ir::setting_count) + 1) return state.work_offset;
  if (setting == ir::units_feed_too_setting) return state.units_feed_too ? 1 : 0;
  return setting >= 0 && setting < static_cast<int>(ir::setting_count)
             ? static_cast<double>(state.get(static_cast<ir::Setting>(setting)))
             : -1;
}

}  // namespace

/// A length that the program wrote is kept in mm, whatever unit is in force when it is read.
double BlockMachine::unit_of_written(const std::string& name) const {
  return data_modal_ && data_.in_mm(name) ? unit() : 1;
}

bool BlockMachine::read(const ir::SystemRef& ref, std::span<const double> args, double& out) {
  if (const double* given = data_.find(ref, args)) {
    out = *given / unit_of_written(datum_key(ref, args));
    data_.read_now(ref, args);
    return true;
  }
  if (curve_.open && (ref.datum == Datum::work_position || ref.datum == Datum::machine_position)) {
    return failure_.fail(code::curve_place,
                         "the position is read between the points of a spline: reading it stops the preparation, which "
                         "ends the curve");
  }
  if (ref.datum == Datum::tool_radius || ref.datum == Datum::tool_length) {
    // Another name of the control may have written the same datum.
    if (const double* written = data_.tool(ref.datum, ref.axis, args)) {
      out = *written / (data_modal_ ? unit() : 1);
      return true;
    }
  }
  if (ref.datum == Datum::tool_radius && args.empty() && ref.args.empty()) {
    const double radius = tool_radius();
    out = (radius == 0 ? radius_of_world(tool_.offset()) : radius) / (data_modal_ ? unit() : 1);
    return true;
  }
  if (read_position(ref, args, out) || read_technology(ref, args, out) || read_state(ref, args, out)) return true;
  const std::string name = datum_key(ref, args);
  if (read_of_run(ref, args, name, out) || read_at_rest(name, out)) return true;
  return failure_.fail(
      code::no_datum,
      "the value of " + name + " is known to the machine only; the profile's \"data\" or --set gives it one");
}

/// Data that the run follows, which the profile names.
bool BlockMachine::read_of_run(const ir::SystemRef& ref, std::span<const double> args, const std::string& name,
                               double& out) {
  const auto answer = machine::data_of_run(profile_, name);
  if (!answer) return false;
  const Spindle& s = spindles_[static_cast<int>(answer->spindle)];
  switch (answer->datum) {
    case machine::RunDatum::travelled: {
      if (ref.axis >= ir::axis::count_max || !axis_[ref.axis].present) return false;
      const double start = travel_.set[ref.axis];
      if ((travel_.given >> ref.axis & 1U) == 0)
        data_.assume(failure_.where, name + " before the start", start, "the program sets it: (" + name + "=0)");
      out = (start + travel_.way[ref.axis]) / (data_modal_ && !axis_[ref.axis].rotary ? unit() : 1);
      return true;
    }
    case machine::RunDatum::next_offset: out = tool_.offset(); return true;
    case machine::RunDatum::spindle_angle: out = s.angle; return true;
    case machine::RunDatum::rpm: out = s.rpm(); return true;
    case machine::RunDatum::cutting_speed: out = s.cutting_speed(); return true;
    case machine::RunDatum::spindle_limit: out = s.limit_in_force(); return true;
    case machine::RunDatum::call_level: out = static_cast<double>(calls_open); return true;
    case machine::RunDatum::next_tool: out = tool_.selected(); return true;
    case machine::RunDatum::spindle_position: out = s.angle; return s.oriented;
    case machine::RunDatum::turning_speed: {
      if (s.turns() && s.mode == ir::SpindleMode::css) return false;
      out = s.turns() ? s.rpm() : 0;
      data_.assume(failure_.where, name, out, {});
      return true;
    }
    case machine::RunDatum::plane_normal: {
      const auto normal = std::find(axes_.begin(), axes_.end(), ir::plane_axes(modal_.plane).w);
      out = normal == axes_.end() ? 0 : static_cast<double>(normal - axes_.begin() + 1);
      return true;
    }
    case machine::RunDatum::program_number: {
      const auto* main = program_ != nullptr ? program_->main() : nullptr;
      out = main != nullptr ? ir::main_number(*main).value_or(-1) : -1;
      return out >= 0;
    }
    case machine::RunDatum::numbered_position: return place_in_table(ref.axis, args, out);
    case machine::RunDatum::block_coordinate: {
      const auto found =
          args.size() == 2 ? ir::block_coordinate(program_, library_, ref.axis, args[0], args[1]) : std::nullopt;
      out = found.value_or(0);
      return found.has_value();
    }
    case machine::RunDatum::last_label: {
      const auto number = parse_decimal(last_label);
      out = number.value_or(0);
      return number.has_value();
    }
  }
  return false;
}

/// So many places on from the present one in the table of the axis; that of a rotary axis goes round.
bool BlockMachine::place_in_table(ir::AxisId axis, std::span<const double> args, double& out) const {
  if (axis >= ir::axis::count_max || !axis_[axis].present || args.size() != 1) return false;
  constexpr double near = 1e-6, whole_turn = 360;
  constexpr std::int64_t most = 1000;
  const std::string front = "CAC[" + profile_.axis(axis)->name + ",";
  std::vector<double> table;
  while (table.size() < static_cast<std::size_t>(most)) {
    const auto place = profile_.data.find(front + std::to_string(table.size()) + "]");
    if (place == profile_.data.end()) break;
    table.push_back(place->second);
  }
  const double here = p_[axis] / axis_[axis].scale_absolute;
  const auto stands = std::find_if(table.begin(), table.end(), [&](double place) {
    const double way = axis_[axis].rotary ? std::remainder(place - here, whole_turn) : place - here;
    return std::abs(way) < near;
  });
  if (stands == table.end()) return false;
  const auto count = static_cast<std::int64_t>(table.size());
  std::int64_t n = stands - table.begin() + saturate<std::int64_t>(std::round(args[0]));
  if (axis_[axis].rotary) n = (n % count + count) % count;
  if (n < 0 || n >= count) return false;
  out = table[static_cast<std::size_t>(n)];
  return true;
}

bool BlockMachine::read_at_rest(const std::string& name, double& out) {
  const auto value = machine::data_at_rest(profile_, name);
  if (!value) return false;
  out = *value;
  data_.assume(failure_.where, name, *value, {});
  return true;
}

bool BlockMachine::read_position(const ir::SystemRef& ref, std::span<const double> args, double& out) const {
  const bool has_axis = ref.axis < ir::axis::count_max && axis_[ref.axis].present;
  const double length = data_modal_ ? unit() : 1;
  const auto along = [&](const Frame& f) { return (f.t[ref.axis]) / (axis_[ref.axis].rotary ? 1 : length); };
  switch (ref.datum) {
    case Datum::programmed_position:
    case Datum::work_position:
      if (!has_axis) return false;
      out = p_[ref.axis] / axis_[ref.axis].scale_absolute;
      return true;
    case Datum::machine_position:
      if (!has_axis) return false;
      out =
          frame_.apply(p_)[ref.axis] / (profile_.policies.machine_position_scale == machine::MachinePositionScale::words
                                            ? axis_[ref.axis].scale_absolute
                                        : axis_[ref.axis].rotary ? 1
                                                                 : length);
      return true;
    case Datum::work_offset: out = zeros_.coarse(offset_row(args), ref.axis) / length; return true;
    case Datum::active_offset: out = modal_.work_offset; return true;
    case Datum::active_shift:
      if (!has_axis) return false;
      out = along(compose(zeros_.outside(), parts_[ir::FrameSlot::preset]));
      return true;
    case Datum::work_offset_fine: out = zeros_.fine(offset_row(args), ref.axis) / length; return true;
    case Datum::measured_work:
      if (!has_axis) return false;
      out = p_[ref.axis] / axis_[ref.axis].scale_absolute;
      return true;
    case Datum::measured_machine:
      if (!has_axis) return false;
      out = frame_.apply(p_)[ref.axis] / axis_[ref.axis].scale_absolute;
      return true;
    case Datum::settable_position:
      if (!has_axis) return false;
      out = parts_.written().apply(p_)[ref.axis] / axis_[ref.axis].scale_absolute;
      return true;
    case Datum::frame_settable:
      if (args.size() == crossing_count && args[0] == ir::frame_rows::crossing) return crossing(args, failure_, out);
      if (args.size() != measured_count || args[0] != ir::frame_rows::measured) return false;
      out = measured_frame(args.subspan<1, measured_count - 1>()).quality;
      return true;
    case Datum::probe_state: out = 0; return true;  // no probe is modelled: it is never touched
    case Datum::axis_feed:
      if (!has_axis) return false;
      out = axis_feed_[ref.axis];
      return true;
    case Datum::programmed_shift:
      if (!has_axis) return false;
      out = (frame_.t[ref.axis] - zeros_.outside().t[ref.axis]) / length;
      return true;
    case Datum::pole_first: out = polar_.pole.u / axis_[ir::plane_axes(modal_.plane).u].scale_absolute; return true;
    case Datum::pole_second: out = polar_.pole.v / axis_[ir::plane_axes(modal_.plane).v].scale_absolute; return true;
    default: return false;
  }
}

bool BlockMachine::read_technology(const ir::SystemRef& ref, std::span<const double> args, double& out) const {
  const double row = args.empty() ? tool_.in_spindle() : args[0];
  const auto* tool = tool_of(profile_, row);
  const double length = data_modal_ ? unit() : 1;
  const auto feed = [&](ir::FeedMode m) {
    const bool inch = m != ir::FeedMode::inverse_time && modal_.units == ir::Units::inch && modal_.units_feed_too;
    return feed_[static_cast<std::size_t>(m)] / (inch ? 25.4 : 1);
  };
  const Spindle& spindle = spindles_.first();
  switch (ref.datum) {
    case Datum::tool_number: out = tool_.in_spindle(); return true;
    case Datum::next_tool: out = tool_.selected(); return true;
    case Datum::offset_number: out = tool_.offset(); return true;
    case Datum::tool_length:
      out = tool == nullptr ? 0 : (ref.axis == ir::axis::x ? tool->length_x : tool->length) / length;
      if (out == 0 && world_ != nullptr) out = world_->tool_length(row, ref.axis) / length;
      return true;
    case Datum::tool_radius: out = (tool == nullptr ? radius_of_world(row) : tool->radius) / length; return true;
    case Datum::tool_nose: out = tool == nullptr ? 0 : tool->nose; return true;
    case Datum::tool_nose_width: out = tool == nullptr ? 0 : tool->nose_width / length; return true;
    case Datum::tool_wear:
    case Datum::part_count:
    case Datum::cycle_time: out = 0; return true;
    case Datum::feed: out = feed_now() / feed_unit(); return true;
    case Datum::feed_per_minute: out = feed(ir::FeedMode::per_minute); return true;
    case Datum::feed_per_rev: out = feed(ir::FeedMode::per_rev); return true;
    case Datum::feed_inverse_time: out = feed(ir::FeedMode::inverse_time); return true;
    case Datum::spindle_speed: out = spindle.speed(); return true;
    case Datum::rpm: out = spindle.rpm(); return true;
    case Datum::cutting_speed: out = spindle.cutting_speed(); return true;
    case Datum::spindle_limit: out = spindle.limit_in_force(); return true;
    case Datum::spindle_state:
      out = args.size() == 2 && !spindle.oriented && static_cast<double>(spindle.state) == args[1] ? 1 : 0;
      return true;
    case Datum::feed_override: out = 100; return true;
    default: return false;
  }
}

bool BlockMachine::read_state(const ir::SystemRef& ref, std::span<const double> args, double& out) const {
  const auto order = [this](ir::AxisId a) { return std::find(axes_.begin(), axes_.end(), a) - axes_.begin(); };
  const Frame& scale = parts_[ir::FrameSlot::scale];
  const Frame& rotation = parts_[ir::FrameSlot::rotation];
  const Frame& mirror = parts_[ir::FrameSlot::mirror];
  const auto factor = [](const Frame& f, ir::AxisId a) { return a < 3 ? f.m[a][a] : f.d[a]; };
  const auto plane = ir::plane_axes(modal_.plane);
  switch (ref.datum) {
    case Datum::call_has_argument:
      if (args.empty()) {
        out = static_cast<double>(arguments_given);
        return true;
      }
      if (args[0] < 0) return false;
      out = args[0] < 64 ? static_cast<double>((arguments_given >> saturate<unsigned>(args[0])) & 1U) : 0;
      return true;
    case Datum::active_modal:
      if (args.size() != 3) return false;
      if (const auto slot = frame_slot(args)) {
        out = parts_.counts(*slot) ? 1 : 0;
        return true;
      }
      out = value_of(modal_, saturate<int>(args[1])) == args[2] ? 1 : 0;
      return true;
    case Datum::active_plane: out = static_cast<double>(16 * (order(plane.u) + 1) + order(plane.v) + 1); return true;
    case Datum::mirrored_axes:
      out = 0;
      for (const auto a : axes_) out += factor(mirror, a) < 0 ? static_cast<double>(1U << order(a)) : 0;
      return true;
    case Datum::scale_factor: out = scale.m[0][0]; return true;
    case Datum::axis_scale:
      if (ref.axis >= ir::axis::count_max || !axis_[ref.axis].present) return false;
      out = factor(scale, ref.axis) * factor(parts_[ir::FrameSlot::chain], ref.axis);
      return true;
    case Datum::rotation_angle: {
      const double angle =
          std::atan2(rotation.m[plane.v][plane.u], rotation.m[plane.u][plane.u]) * 180 / std::acos(-1.0);
      out = angle < -1e-12 ? angle + 360 : std::abs(angle);
      return true;
    }
    case Datum::diameter_on: out = modal_.diameter == ir::DiameterMode::radius ? 0 : 1; return true;
    default: return false;
  }
}

/// The row that an index names; without one, the row in force.
std::int32_t BlockMachine::offset_row(std::span<const double> args) const {
  return args.empty() ? modal_.work_offset : saturate<std::int32_t>(args[0]);
}

double BlockMachine::length_of(ir::AxisId axis, double value) const {
  return axis < ir::axis::count_max && axis_[axis].present ? value * axis_[axis].scale_absolute : value;
}

std::string BlockMachine::axis_name(ir::AxisId axis) const {
  const auto* spec = profile_.axis(axis);
  return spec != nullptr ? spec->name : std::string{};
}

bool BlockMachine::write(const ir::SystemRef& ref, std::span<const double> args, double v) {
  const auto in_table = [&] {
    const bool linear = ref.axis < ir::axis::count_max && !axis_[ref.axis].rotary;
    return v * (data_modal_ && linear ? unit() : 1);
  };
  switch (ref.datum) {
    case Datum::work_offset:
      zeros_.set_coarse(offset_row(args), ref.axis, in_table());
      return offset_written(offset_row(args));
    case Datum::active_modal: {
      const auto slot = frame_slot(args);
      if (!slot) return failure_.fail(code::no_datum, datum_key(ref, args) + " can only be read");
      parts_.suspend(*slot, v == 0);
      return rebuild_frame();
    }
    case Datum::work_offset_fine: zeros_.set_fine(offset_row(args), ref.axis, in_table()); return true;
    case Datum::axis_feed:
      if (!check_axis(ref.axis)) return false;
      if (v < 0) return failure_.fail(code::no_datum, "the feed of an axis cannot be negative");
      axis_feed_[ref.axis] = v * (axis_[ref.axis].rotary || !modal_.units_feed_too ? 1 : unit());
      return true;
    case Datum::diameter_on:
      modal_.diameter = v != 0 ? ir::DiameterMode::diameter : ir::DiameterMode::radius;
      set_units();
      return true;
    case Datum::programmed_position:
    case Datum::machine_position:
    case Datum::work_position:
    case Datum::programmed_shift:
    case Datum::active_shift:
    case Datum::active_offset:
      return failure_.fail(code::no_datum,
                           "writing " + datum_key(ref, args) + " would move the machine's zero; it is not carried");
    default: break;
  }
  if (const auto answer = machine::data_of_run(profile_, datum_key(ref, args));
      answer && answer->datum == machine::RunDatum::travelled) {
    if (!check_axis(ref.axis)) return false;
    travel_.set[ref.axis] = v * (data_modal_ && !axis_[ref.axis].rotary ? unit() : 1);
    travel_.way[ref.axis] = 0;
    travel_.given |= 1U << ref.axis;
    return true;
  }
  const std::string key = datum_key(ref, args);
  const bool length = tool_length_unit(ref.datum) || machine::is_length_datum(profile_, key);
  if (length && data_modal_) v *= unit();
  data_.write(key, v, length);
  if (ref.datum == Datum::tool_radius || ref.datum == Datum::tool_length)
    data_.write_tool(ref.datum, ref.axis, args, v);
  return true;
}

}  // namespace cnctrans::interpreter
