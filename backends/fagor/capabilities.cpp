#include "backends/fagor/capabilities.h"

#include "backends/fagor/cycles.h"
#include "backends/fagor/expressions.h"
#include "backends/fagor/tables.h"
#include "dialects/fagor/limits.h"
#include "dialects/fagor/operators.h"

namespace cnctrans::backends::fagor {
namespace {

namespace facts = dialects::fagor;
using ir::FrameCombine;
using ir::FrameSlot;

void statements(ir::Capabilities& c) {  // ch. 12, 17, 18
  c.one_line_if_action = true;
  c.computed_jump = true;
  c.repeat_range = true;
  c.repeat_other_program = true;
  c.repeat_count_expression = false;
  c.repeat_max = facts::max_repeat;
  c.block_repeat = true;
  c.modal_call = c.modal_call_here = true;
  c.modal_cycle_by_call = false;
  c.declares_variables = false;
  c.assignment_joins_words = false;
  c.several_assignments = true;
  c.statement_joins_words = false;
  c.searches = {ir::Search::whole_first};
  c.identifier_labels = false;
  c.number_labels = true;
  c.label_max = facts::max_label;
  c.duplicate_labels = false;
  c.arguments = ir::ArgumentForm::letters;
  c.local_levels = true;
  c.shared_level_calls = true;
  c.call_count = false;
  c.call_range = false;
  c.computed_call = true;
  c.heading_below_header = false;
  c.named_routines = false;
  c.early_return = false;
  c.end_in_sub_ends_all = true;
  c.routine_number_min = 0;
  c.routine_number_max = facts::max_subroutine;
  c.output = ir::OutputForm::one_file_with_subs;
  c.skip_levels = facts::max_skip_levels;
  c.skip_several = true;
  c.message_values = true;
  c.message_length = static_cast<std::size_t>(facts::max_message);
}

std::vector<ir::VariableSpace> spaces() {  // 16.2
  ir::VariableSpace p;
  p.prefix = "P";
  for (const auto& range : facts::parameter_ranges) {
    ir::SpaceSegment s;
    s.lo = range.lo;
    s.hi = range.hi;
    s.scope = range.local ? ir::Scope::level : ir::Scope::global;
    s.persistent = !range.local;
    p.segments.push_back(s);
  }
  return {p};
}

void expressions(ir::Capabilities& c) {  // 16.3, 16.4
  c.expressions = ir::ExpressionForm::full;
  c.conditions = ir::ConditionForm::expression;
  c.word_expression = false;
  c.word_variable = c.word_variable_sign = true;
  c.word_indirect = true;
  c.word_indirect_value = false;
  c.relation_as_value = true;
  c.unary = {ir::UnaryOp::negate, ir::UnaryOp::logical_not, ir::UnaryOp::bit_not};
  for (const auto& o : facts::operators) c.binary.insert(o.op);
  c.binary.insert({ir::BinaryOp::bit_and, ir::BinaryOp::bit_or, ir::BinaryOp::bit_xor, ir::BinaryOp::int_divide});
  c.functions = sayable_functions();
  c.compare = ir::Compare::exact;
  c.constant_decimals = facts::constant_decimals;
  c.word_decimals = facts::decimals_mm;
  c.word_decimals_inch = facts::decimals_inch;
  c.spaces = spaces();
  // P294..P299 belong to the control's cycles; temporaries come from P200..P249 and the end of the user parameters.
  c.pools = {ir::VariablePool{"P", 100, facts::first_cycle_parameter - 1, ir::Scope::global, false},
             ir::VariablePool{"P", 1000, 1199, ir::Scope::global, false},
             ir::VariablePool{"P", 0, 25, ir::Scope::level, false},
             ir::VariablePool{"P", 200, 249, ir::Scope::global, true},
             ir::VariablePool{"P", 1200, 1255, ir::Scope::global, true}};
}

void frames(ir::Capabilities& c, bool lathe) {  // 8.3..8.5, 11.4, 11.5, 25.1
  c.frames = {{FrameSlot::preset, {FrameCombine::preset}},
              {FrameSlot::shift, {FrameCombine::replace, FrameCombine::replace_named, FrameCombine::clear}},
              {FrameSlot::scale, {FrameCombine::replace, FrameCombine::clear}},
              {FrameSlot::mirror, {FrameCombine::replace, FrameCombine::replace_named, FrameCombine::clear}}};
  c.frames[FrameSlot::chain] = {FrameCombine::replace_named};  // G72 with axes; of this control only
  if (!lathe) c.frames[FrameSlot::rotation] = {FrameCombine::replace, FrameCombine::add, FrameCombine::clear};
  c.frame_rotation = !lathe;
  c.frame_chain = false;
  c.work_offset_rows = 20;
  c.shift_survives_end = true;
  c.work_offset_off = true;
}

void words(ir::Capabilities& c, bool lathe) {  // ch. 3..8, 10, 11
  c.motions = {ir::MotionKind::modal,           ir::MotionKind::rapid,
               ir::MotionKind::linear,          ir::MotionKind::arc_cw,
               ir::MotionKind::arc_ccw,         ir::MotionKind::thread,
               ir::MotionKind::thread_variable, ir::MotionKind::arc_through_point,
               ir::MotionKind::arc_tangent,     ir::MotionKind::reference_point,
               ir::MotionKind::probe_toward,    ir::MotionKind::probe_away,
               ir::MotionKind::to_stop};
  c.frame_uses = {ir::FrameUse::normal, ir::FrameUse::machine};
  c.own_block = stands_alone;
  c.corners = {ir::CornerKind::round, ir::CornerKind::chamfer_leg};
  c.polar = c.line_angle = true;
  c.distance_per_word = c.distance_inside_block = false;
  c.centers = {ir::CenterMode::from_start, ir::CenterMode::absolute};
  c.center_scales = {{ir::CenterMode::from_start, ir::WordScale::radius},
                     {ir::CenterMode::absolute, ir::WordScale::modal}};
  c.radius_minor = c.radius_major = true;
  c.arc_through_point = c.arc_tangent = c.tangential_ends = true;
  c.arc_angle = false;
  c.helix_turns = false;
  c.helix_pitch = true;
  c.full_circle_needs_end = true;
  c.surfaces = lathe ? ir::SurfaceForm::c_with_plane : ir::SurfaceForm::none;
  c.surface_x_radius = lathe;
  c.diameter_switch = lathe;
  c.diameter_absolute_only = false;
  c.fixed_diameter = ir::DiameterMode::radius;
  c.exact_stop_modal = true;
  c.exact_stop_block = false;
  c.dwell_unit = 0.01;
  c.dwell_min = 0.01;
  c.dwell_max = facts::max_dwell / 100;
  c.dwell_revolutions = false;
  c.inverse_time = true;
  c.length_comp_switch = !lathe;
  c.retract_plane_switch = !lathe;
  c.feed_point_switch = !lathe;
  c.feed_override_switch = false;
  c.feed_memory = ir::FeedMemory::per_mode;
  c.units_with_feed = true;
  c.units_geometry_only = false;
  c.spindle_limit = true;
  c.gear_needed = false;
}

}  // namespace

bool stands_alone(const ir::Action& a) {
  if (std::holds_alternative<ir::WorkOffset>(a.data) || std::holds_alternative<ir::SpindleLimit>(a.data) ||
      std::holds_alternative<ir::PreparationStop>(a.data) || std::holds_alternative<ir::Dwell>(a.data) ||
      std::holds_alternative<ir::PoleSet>(a.data)) {
    return true;
  }
  if (const auto* s = std::get_if<ir::SurfaceSet>(&a.data)) {
    return s->surface != ir::Surface::none;
  }
  const auto* f = std::get_if<ir::FrameOp>(&a.data);
  return f != nullptr && f->change && f->change->slot != FrameSlot::mirror;
}

const ir::Capabilities& capabilities(bool lathe) {
  const auto make = [](bool is_lathe) {
    ir::Capabilities c;
    c.dialect = dialect_name;
    statements(c);
    expressions(c);
    frames(c, is_lathe);
    words(c, is_lathe);
    c.system_data = [is_lathe](const ir::SystemRef& s) { return !system_name(s, is_lathe).empty(); };
    c.native_cycle = is_lathe ? native_machining : native_cycle;
    return c;
  };
  static const ir::Capabilities of_lathe = make(true);
  static const ir::Capabilities of_mill = make(false);
  return lathe ? of_lathe : of_mill;
}

}  // namespace cnctrans::backends::fagor
