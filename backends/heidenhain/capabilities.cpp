#include "backends/heidenhain/capabilities.h"

#include "backends/heidenhain/cycles.h"
#include "dialects/heidenhain/functions.h"
#include "dialects/heidenhain/limits.h"
#include "dialects/heidenhain/variables.h"

namespace cnctrans::backends::heidenhain {
namespace {

namespace facts = dialects::heidenhain;
using ir::BinaryOp;
using ir::FrameCombine;
using ir::FrameSlot;

void statements(ir::Capabilities& c) {  // reference 11, 12.3
  c.assignment_joins_words = c.several_assignments = false;
  c.repeat_range = c.repeat_ends_here = true;
  c.repeat_count_variable = false;
  c.repeat_max = 65534;
  c.conditions = ir::ConditionForm::single_relation;
  c.searches = {ir::Search::whole_first};
  c.label_max = facts::label_max;
  c.identifier_labels = true;
  c.call_count = false;
  c.cycle_each_call = true;
  c.named_routines = true;
  c.end_in_sub_ends_all = true;
  c.routine_number_max = facts::label_max;
  c.heading_below_header = true;
  c.output = ir::OutputForm::one_file_with_subs;
  c.skip_levels = 1;
  c.skip_on_structures = false;
}

void expressions(ir::Capabilities& c) {  // reference 12.2, 13.1
  c.expressions = ir::ExpressionForm::full;
  c.unary = {ir::UnaryOp::negate};
  for (const auto& row : facts::operators) c.binary.insert(row.op);
  for (const auto& row : facts::fn_rows) {
    if (row.use == facts::FnUse::jump) c.binary.insert(row.op);
  }
  c.binary.insert({BinaryOp::le, BinaryOp::ge});  // two jumps
  for (const auto& row : facts::functions) c.functions.insert(row.function);
  c.constant_max = facts::constant_max;
  c.word_decimals = c.word_decimals_inch = facts::linear_decimals;
  c.spaces = facts::spaces();
  // A QL belongs to a program file: no call of a label opens a new set, so they are no levels of calls.
  for (auto& segment : c.spaces[facts::space_ql].segments) segment.scope = ir::Scope::program;
  // Q1 to Q20 belong to the contour cycles; a program that has none of them may use them.
  c.pools = {{"Q", 0, 99, ir::Scope::global, false}, {"Q", 1600, 1999, ir::Scope::global, true}};
}

void words(ir::Capabilities& c) {  // reference 5, 8, 9, 10
  c.motion_in_each_block = true;
  c.motions = {ir::MotionKind::modal,  ir::MotionKind::rapid,   ir::MotionKind::linear,
               ir::MotionKind::arc_cw, ir::MotionKind::arc_ccw, ir::MotionKind::arc_tangent};
  c.frame_uses = {ir::FrameUse::normal, ir::FrameUse::machine};
  c.own_block = [](const ir::Action& a) {
    return std::holds_alternative<ir::FrameOp>(a.data) || std::holds_alternative<ir::WorkOffset>(a.data) ||
           std::holds_alternative<ir::Dwell>(a.data) || std::holds_alternative<ir::CycleDefine>(a.data) ||
           std::holds_alternative<ir::CycleCancel>(a.data);
  };
  c.corners = {ir::CornerKind::round, ir::CornerKind::chamfer_leg};
  c.corner_feed = true;
  c.distance_per_word = true;
  c.centers = {ir::CenterMode::absolute, ir::CenterMode::from_start};
  c.arc_tangent = true;
  c.helix_angle = true;
  c.full_circle_needs_end = true;
  c.diameter_switch = false;
  c.exact_stop_modal = false;
  c.dwell_min = 0.001;
  c.dwell_max = facts::dwell_max;
  c.inverse_time = false;
  c.frames[FrameSlot::shift] = {FrameCombine::replace, FrameCombine::replace_named, FrameCombine::add,
                                FrameCombine::clear};
  c.frames[FrameSlot::mirror] = {FrameCombine::replace, FrameCombine::clear};
  c.frames[FrameSlot::rotation] = {FrameCombine::replace, FrameCombine::add, FrameCombine::clear};
  c.frames[FrameSlot::scale] = {FrameCombine::replace, FrameCombine::clear};
  c.shift_survives_end = true;      // whether M30 takes the coordinates back is the machine maker's choice (18.1)
  c.work_offset_ends_shift = true;  // cycle 247 (18.3)
  c.work_offset_off = false;
  c.feed_point_switch = false;
  c.spindle_limit = false;
  c.messages = false;
  c.feed_memory = ir::FeedMemory::cleared;

  c.native_cycle = native_cycle;
}

}  // namespace

const ir::Capabilities& capabilities() {
  static const ir::Capabilities all = [] {
    ir::Capabilities c;
    c.dialect = "heidenhain";
    statements(c);
    expressions(c);
    words(c);
    return c;
  }();
  return all;
}

}  // namespace cnctrans::backends::heidenhain
