#include "backends/sinumerik/capabilities.h"

#include "backends/sinumerik/cycles.h"
#include "backends/sinumerik/expressions.h"
#include "backends/sinumerik/writer.h"
#include "base/text.h"
#include "dialects/sinumerik/addresses.h"
#include "dialects/sinumerik/limits.h"
#include "dialects/sinumerik/operators.h"
#include "dialects/sinumerik/variables.h"

namespace cnctrans::backends::sinumerik {
namespace {

namespace dialect = cnctrans::sinumerik;

void statements(ir::Capabilities& c) {  // reference-language 6, 7, 8
  c.structured_if = true;
  c.while_loop = c.until_loop = c.for_loop = c.endless_loop = true;
  c.for_step = false;
  c.switch_jump = true;
  c.computed_jump = true;  // GOTO "N"<<R1
  c.repeat_range = true;
  c.repeat_other_program = false;
  c.repeat_count_expression = true;
  c.repeat_needs_identifiers = true;
  c.repeat_max = dialect::call_count_max;
  c.block_repeat = false;
  c.modal_call = true;
  c.modal_cycle_by_call = true;
  c.declares_variables = true;
  c.assignment_joins_words = false;
  c.several_assignments = true;
  c.statement_joins_words = false;
  c.searches = {ir::Search::forward, ir::Search::backward, ir::Search::forward_then_backward};
  c.identifier_labels = true;
  c.plain_name = [](std::string_view name) {
    std::string plain = legal_name(to_upper_ascii(name));
    return ::cnctrans::sinumerik::is_reserved(plain) ? std::string{} : plain;
  };
  c.number_labels = true;
  c.duplicate_labels = true;
  c.arguments = ir::ArgumentForm::positional;
  c.local_levels = true;
  c.shared_level_calls = false;
  c.call_count = true;
  c.call_range = true;
  c.computed_call = true;
  c.named_routines = true;
  c.early_return = true;
  c.end_in_sub_ends_all = false;
  c.routine_number_min = 1;
  c.routine_number_max = 9999999;
  c.output = ir::OutputForm::one_file_per_program;
  c.skip_levels = dialect::skip_level_max + 1;
  c.skip_several = false;
  c.skip_on_structures = false;
  c.message_values = true;
  c.message_length = dialect::string_characters;
  c.block_length = dialect::block_characters;
}

void expressions(ir::Capabilities& c) {  // reference-language 4
  c.expressions = ir::ExpressionForm::full;
  c.conditions = ir::ConditionForm::expression;
  c.word_expression = c.word_variable = c.word_variable_sign = c.word_indirect = true;
  c.relation_as_value = true;
  c.compare = ir::Compare::relative_1e12;
  c.unary = {ir::UnaryOp::negate, ir::UnaryOp::logical_not, ir::UnaryOp::bit_not};
  for (const auto& row : dialect::operators) c.binary.insert(row.op);
  for (const auto& row : dialect::functions) c.functions.insert(row.function);
  // Said by others of its functions:
  c.functions.insert({ir::Function::atan, ir::Function::floor, ir::Function::log10, ir::Function::to_integer,
                      ir::Function::to_boolean, ir::Function::to_string});
  for (auto f = static_cast<int>(ir::Function::last_index_of); f <= static_cast<int>(ir::Function::frame_with); ++f)
    c.functions.insert(static_cast<ir::Function>(f));  // searches in texts, characters, axes and frames
  c.system_data = has_system_name;
  c.word_decimals = c.word_decimals_inch = 6;
  c.spaces = dialect::variable_spaces();
  c.pools = {ir::VariablePool{"R", 0, dialect::r_parameter_default_count - 1, ir::Scope::global, false},
             ir::VariablePool{"", 0, 0, ir::Scope::routine, true}};
}

void words(ir::Capabilities& c) {  // reference-language 14
  c.motions = {ir::MotionKind::modal,           ir::MotionKind::rapid,         ir::MotionKind::linear,
               ir::MotionKind::arc_cw,          ir::MotionKind::arc_ccw,       ir::MotionKind::arc_through_point,
               ir::MotionKind::arc_tangent,     ir::MotionKind::thread,        ir::MotionKind::thread_variable,
               ir::MotionKind::tap_rigid,       ir::MotionKind::tap_rigid_out, ir::MotionKind::tap_floating,
               ir::MotionKind::reference_point, ir::MotionKind::probe_toward,  ir::MotionKind::probe_away,
               ir::MotionKind::spline_akima,    ir::MotionKind::spline_b,      ir::MotionKind::spline_cubic,
               ir::MotionKind::polynomial};
  c.frame_uses = {ir::FrameUse::normal, ir::FrameUse::machine, ir::FrameUse::machine_with_length};
  c.own_block = [](const ir::Action& a) {
    return std::holds_alternative<ir::FrameOp>(a.data) || std::holds_alternative<ir::PoleSet>(a.data) ||
           std::holds_alternative<ir::CycleDefine>(a.data) || std::holds_alternative<ir::CycleCancel>(a.data) ||
           std::holds_alternative<ir::PreparationStop>(a.data) || std::holds_alternative<ir::SurfaceSet>(a.data);
  };
  c.surfaces = ir::SurfaceForm::y_words;
  c.machine_move_ends_offset = true;
  c.surface_needs_radius = c.surface_clears_frames = true;
  c.corner_modal = c.corner_feed = true;
  c.corners = {ir::CornerKind::round, ir::CornerKind::chamfer_leg, ir::CornerKind::chamfer_chord};
  c.polar = c.line_angle = true;
  c.distance_per_word = true;
  c.distance_inside_block = false;
  c.centers = {ir::CenterMode::from_start, ir::CenterMode::absolute};
  c.center_scales = {{ir::CenterMode::from_start, ir::WordScale::radius},
                     {ir::CenterMode::absolute, ir::WordScale::modal}};
  c.radius_minor = c.radius_major = true;
  c.arc_through_point = c.arc_tangent = c.arc_angle = true;
  c.helix_turns = true;
  c.helix_pitch = false;
  c.full_circle_needs_end = false;
  c.diameter_switch = c.diameter_absolute_only = true;
  c.exact_stop_modal = c.exact_stop_block = true;
  c.dwell_unit = 1;
  c.dwell_min = 0.001;
  c.dwell_max = 9999999;  // no limit is printed; real programs wait 999999 s
  c.dwell_revolutions = true;
  c.inverse_time = true;
  c.length_comp_switch = false;
  c.frame_rotation = c.frame_chain = true;
  c.frames = {{ir::FrameSlot::chain,
               {ir::FrameCombine::replace, ir::FrameCombine::compose, ir::FrameCombine::clear,
                ir::FrameCombine::replace_named}}};
  c.work_offset_rows = 99;
  c.work_offset_off = true;
  c.units_with_feed = c.units_geometry_only = true;
  c.retract_plane_switch = false;
  c.feed_point_switch = true;
  c.feed_override_switch = false;
  c.feed_memory = ir::FeedMemory::cleared;
  c.spindle_limit = true;
  c.native_cycle = native_cycle;
}

}  // namespace

const ir::Capabilities& capabilities() {
  static const ir::Capabilities all = [] {
    ir::Capabilities c;
    c.dialect = "sinumerik";
    statements(c);
    expressions(c);
    words(c);
    return c;
  }();
  return all;
}

}  // namespace cnctrans::backends::sinumerik
