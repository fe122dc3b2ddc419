#include "backends/num/style.h"

#include <array>
#include <cmath>

#include "backends/num/data_names.h"
#include "dialects/num/functions.h"
#include "dialects/num/limits.h"
#include "dialects/num/options.h"
#include "dialects/num/variables.h"

namespace cnctrans::backends::num {

namespace facts = dialects::num;
using ir::BinaryOp;
using ir::Setting;

namespace {

// Reference 5.1, 16: one code a setting.
constexpr std::array modal_codes{
    ModalCode{Setting::plane, code_value(ir::Plane::xy), "G17"},
    ModalCode{Setting::plane, code_value(ir::Plane::zx), "G18"},
    ModalCode{Setting::plane, code_value(ir::Plane::yz), "G19"},
    ModalCode{Setting::distance, code_value(ir::Distance::absolute), "G90"},
    ModalCode{Setting::distance, code_value(ir::Distance::incremental), "G91"},
    ModalCode{Setting::units, code_value(ir::Units::inch), "G70"},
    ModalCode{Setting::units, code_value(ir::Units::metric), "G71"},
    ModalCode{Setting::feed_mode, code_value(ir::FeedMode::inverse_time), "G93"},
    ModalCode{Setting::feed_mode, code_value(ir::FeedMode::per_minute), "G94"},
    ModalCode{Setting::feed_mode, code_value(ir::FeedMode::per_rev), "G95"},
    ModalCode{Setting::spindle_mode, code_value(ir::SpindleMode::css), "G96"},
    ModalCode{Setting::spindle_mode, code_value(ir::SpindleMode::rpm), "G97"},
    ModalCode{Setting::comp, code_value(ir::CompSide::off), "G40"},
    ModalCode{Setting::comp, code_value(ir::CompSide::left), "G41"},
    ModalCode{Setting::comp, code_value(ir::CompSide::right), "G42"},
    ModalCode{Setting::feed_override, code_value(ir::OnOff::on), "M48"},
    ModalCode{Setting::feed_override, code_value(ir::OnOff::off), "M49"},
};
constexpr std::array motion_codes{
    MotionCode{ir::MotionKind::rapid, "G0"},   MotionCode{ir::MotionKind::linear, "G1"},
    MotionCode{ir::MotionKind::arc_cw, "G2"},  MotionCode{ir::MotionKind::arc_ccw, "G3"},
    MotionCode{ir::MotionKind::thread, "G38"},
};
constexpr std::array<std::string_view, 1> skip_marks{"/"};

// All operators have one level: the printer of this language writes chains (see writer.cpp). Conditions stand in G79.
constexpr std::array binary_texts{
    BinaryText{BinaryOp::eq, "=", 1, false},       BinaryText{BinaryOp::ne, "<>", 1, false},
    BinaryText{BinaryOp::lt, "<", 1, false},       BinaryText{BinaryOp::le, "<=", 1, false},
    BinaryText{BinaryOp::gt, ">", 1, false},       BinaryText{BinaryOp::ge, ">=", 1, false},
    BinaryText{BinaryOp::add, "+", 2, false},      BinaryText{BinaryOp::subtract, "-", 2, false},
    BinaryText{BinaryOp::multiply, "*", 2, false}, BinaryText{BinaryOp::divide, "/", 2, false},
    BinaryText{BinaryOp::bit_and, "&", 2, false},  BinaryText{BinaryOp::bit_or, "!", 2, false},
};
constexpr std::array unary_texts{UnaryText{ir::UnaryOp::negate, "-", 3}};

std::vector<ir::VariablePool> pools(bool later) {
  std::vector<ir::VariablePool> list;
  // L0-L19 first: they cost no stop of the preparation. L900-L959 next; L100-L199 wait for the block before.
  list.push_back({"L", 0, 19, ir::Scope::global, true});
  if (later) list.push_back({"L", 900, 959, ir::Scope::global, false});
  // Reference 14.1: L100-L199 are not for blocks under G41 and G42.
  list.push_back({"L", 100, 199, ir::Scope::global, false, true});
  return list;
}

/// Reference 11: the 7xx has one plane (ER) where the feed starts and where the tool goes back to.
bool one_plane(const ir::HoleCycle& c) {
  return c.retract.given && c.retract.base == c.reference.base && ir::equal(c.retract.value, c.reference.value);
}

ir::Capabilities make_capabilities(bool lathe, bool later, bool structured) {
  ir::Capabilities c;
  c.dialect = "num";
  // Reference 13.9: the structured words came with the 10xx; an earlier control has G79 only.
  c.structured_if = c.while_loop = c.until_loop = c.for_loop = c.for_step = c.loop_exit = structured;
  c.skip_on_structures = false;
  c.repeat_range = true;
  c.repeat_max = facts::call_repeat_max;
  c.conditions = ir::ConditionForm::single_relation;
  c.searches = {ir::Search::whole_first};
  c.label_max = facts::label_max;
  c.expressions = ir::ExpressionForm::left_to_right;
  c.unary = {ir::UnaryOp::negate};
  c.binary = {BinaryOp::add,     BinaryOp::subtract, BinaryOp::multiply, BinaryOp::divide,
              BinaryOp::bit_and, BinaryOp::bit_or,   BinaryOp::eq,       BinaryOp::ne,
              BinaryOp::lt,      BinaryOp::le,       BinaryOp::gt,       BinaryOp::ge};
  for (const auto& f : facts::functions) c.functions.insert(f.function);
  c.constant_decimals = 8;
  c.constant_max = 99999999;
  c.word_decimals = facts::linear_decimals;
  c.word_decimals_inch = facts::linear_decimals_inch;
  c.call_range = true;
  c.output = ir::OutputForm::programs_in_one_file;
  c.routine_number_min = facts::program_min;
  c.routine_number_max = facts::program_max;
  c.spaces = facts::spaces();
  if (!structured) c.spaces.resize(facts::space_symbol);  // symbols came with the structured words
  c.pools = pools(later);
  c.distance_inside_block = true;
  c.centers = {ir::CenterMode::follows_distance};
  c.corners = {ir::CornerKind::round, ir::CornerKind::chamfer_leg};
  c.radius_major = false;
  c.helix_pitch = true;
  c.line_angle = true;
  if (lathe) c.motions.insert(ir::MotionKind::thread);
  c.full_circle_needs_end = true;
  c.thread_stays = false;
  c.center_scales[ir::CenterMode::follows_distance] = ir::WordScale::modal;
  c.diameter_switch = false;
  c.fixed_diameter = lathe ? ir::DiameterMode::diameter : ir::DiameterMode::radius;
  c.exact_stop_modal = false;
  c.exact_stop_block = true;
  c.dwell_min = facts::dwell_min;
  c.dwell_max = facts::dwell_max;
  c.frame_uses = {ir::FrameUse::normal, ir::FrameUse::machine};
  c.frames[ir::FrameSlot::shift] = {ir::FrameCombine::replace, ir::FrameCombine::replace_named, ir::FrameCombine::add,
                                    ir::FrameCombine::clear};
  c.frames[ir::FrameSlot::rotation] = {ir::FrameCombine::replace, ir::FrameCombine::clear};
  c.frames[ir::FrameSlot::scale] = {ir::FrameCombine::replace, ir::FrameCombine::clear};
  c.frames[ir::FrameSlot::mirror] = {ir::FrameCombine::replace_named, ir::FrameCombine::clear};
  c.frames[ir::FrameSlot::preset] = {ir::FrameCombine::preset};
  c.work_offset_rows = 1;
  c.feed_override_switch = true;
  c.gear_needed = true;  // reference 7: none is in force at power-on
  c.skip_levels = 1;
  c.message_length = facts::message_length;
  c.block_length = facts::block_length;
  c.own_block = [](const ir::Action& a) {
    return std::holds_alternative<ir::Dwell>(a.data) || std::holds_alternative<ir::FrameOp>(a.data) ||
           std::holds_alternative<ir::SpindleLimit>(a.data);
  };
  c.surfaces = lathe ? ir::SurfaceForm::y_from_x : ir::SurfaceForm::none;
  c.surface_x_radius = true;
  c.system_data = [](const ir::SystemRef& s) { return is_parameter_name(s.text); };
  c.data_form = [lathe, structured](const ir::SystemRef& s) { return data_form(s, lathe, structured); };
  if (!lathe) c.work_position = work_position;
  c.native_cycle = [later](const ir::Cycle& cycle) {
    const auto* hole = std::get_if<ir::HoleCycle>(&cycle.node);
    const auto* named = std::get_if<ir::NamedCycle>(&cycle.node);
    if (hole != nullptr && hole->kind == ir::HoleKind::mill) return later && native_pocket(*hole);
    return hole != nullptr ? native_hole(*hole) && (later || one_plane(*hole))
                           : named != nullptr && named->name == "thread.chased";
  };
  return c;
}

/// A level that a word of the cycle can name: an absolute coordinate.
bool nameable(const ir::Level& l) {
  return l.given && l.base == ir::LevelBase::absolute;
}
/// The height of the call: said by leaving the word out.
bool at_call(const ir::Level& l) {
  return l.given && l.base == ir::LevelBase::from_initial && l.value.is(0);
}

/// The tip is freed as G86 does it: by 2 mm in the direction of the stop.
bool oriented_clearance(const ir::HoleCycle& c) {
  if (!c.orient_angle.literal()) return c.shift_u.expr != nullptr && c.shift_v.expr != nullptr;
  if (!c.shift_u.literal() || !c.shift_v.literal()) return false;
  const double angle = c.orient_angle.number * std::acos(-1.0) / 180;
  const auto fits = [&](double length) {
    return std::fabs(c.shift_u.number - length * std::cos(angle)) < 1e-6 &&
           std::fabs(c.shift_v.number - length * std::sin(angle)) < 1e-6;
  };
  return fits(facts::oriented_clearance) || fits(facts::oriented_clearance / 25.4);
}

}  // namespace

const Style& style() {
  static const Style s = [] {
    Style made;
    made.dialect = "num";
    made.comment = {"(", ")", false, true, true, true, "()", "[]", 1, true};
    made.modal_codes = modal_codes;
    made.motion_codes = motion_codes;
    made.kept_decimals = facts::linear_decimals;
    made.made_decimals = facts::linear_decimals;
    made.two_digit_m = true;
    made.line_length = facts::block_length;
    made.exact_stop_block = "G9";
    made.skip_marks = skip_marks;
    return made;
  }();
  return s;
}

const ExpressionStyle& expression_style() {
  static const ExpressionStyle s = [] {
    ExpressionStyle made;
    made.binary = binary_texts;
    made.unary = unary_texts;
    return made;
  }();
  return s;
}

const ir::Capabilities& capabilities(bool lathe, bool later, bool structured) {
  static const std::array<ir::Capabilities, 6> all{
      make_capabilities(false, false, false), make_capabilities(false, true, false),
      make_capabilities(false, true, true),   make_capabilities(true, false, false),
      make_capabilities(true, true, false),   make_capabilities(true, true, true)};
  return all[(lathe ? 3U : 0U) + (later ? 1U : 0U) + (later && structured ? 1U : 0U)];
}

bool structured(const facts::Options& options) {
  return later_family(options) && options.structured;
}

bool later_family(const facts::Options& options) {
  return options.family != facts::Family::n7xx;
}

bool native_hole(const ir::HoleCycle& c) {
  const bool full = c.kind == ir::HoleKind::peck_full, chips = c.kind == ir::HoleKind::peck_break;
  const bool peck = full || chips;
  switch (c.kind) {
    case ir::HoleKind::drill:
    case ir::HoleKind::ream:
    case ir::HoleKind::peck_full:
    case ir::HoleKind::peck_break: break;
    case ir::HoleKind::tap_floating:
    case ir::HoleKind::tap:
      if (!c.dwell_bottom.is(0) || c.pecks.law != ir::PeckLaw::none || c.pitch.is(0) == (c.kind == ir::HoleKind::tap))
        return false;
      break;
    case ir::HoleKind::bore_shift:
      if (!c.dwell_bottom.is(0) || !c.shift_w.is(0) || !oriented_clearance(c)) return false;
      break;
    case ir::HoleKind::bore_manual:  // the spindle turns on
      if (!c.dwell_bottom.is(0) || c.spindle_bottom != ir::SpindleStep::none) return false;
      break;
    default: return false;
  }
  const bool own_spindle = c.spindle_before != ir::SpindleStep::usual || c.spindle_after != ir::SpindleStep::usual ||
                           c.orient_first || c.has_speed || c.has_speed_out || c.spindle_after_retract;
  if (own_spindle || c.keeps_initial) return false;
  if (c.kind != ir::HoleKind::bore_manual && c.spindle_bottom != ir::SpindleStep::usual) return false;
  if (chips && !c.dwell_bottom.is(0)) return false;
  if (c.has_feed || c.has_feed_out || !c.dwell_top.is(0) || c.dwell_in_revolutions || c.reference_may_be_below)
    return false;
  if (!nameable(c.bottom) || !(nameable(c.reference) || at_call(c.reference))) return false;
  if (c.retract.given && !nameable(c.retract) && !at_call(c.retract)) return false;
  if (!c.dwell_bottom.literal() && c.dwell_scale != 1) return false;
  if (c.dwell_bottom.literal() &&
      (c.dwell_bottom.number * c.dwell_scale > facts::dwell_max || c.dwell_bottom.number < 0))
    return false;
  if (!peck) return true;
  const ir::Pecks& p = c.pecks;
  const bool law = p.law == ir::PeckLaw::constant || p.law == ir::PeckLaw::linear;
  return law && !p.first_to.given && !p.first_from_surface && !p.reapproach_automatic && !p.has_first_feed_factor &&
         (chips || p.dwell.is(0)) && p.lift.is(0) && !p.lift_rapid;
}

}  // namespace cnctrans::backends::num
