// System variables: what has a neutral meaning becomes a datum, a frame or a constant; the rest is known by its name.
#include <algorithm>
#include <array>
#include <memory>

#include "base/text.h"
#include "dialects/sinumerik/addresses.h"
#include "dialects/sinumerik/g_functions.h"
#include "dialects/sinumerik/variables.h"
#include "frontends/sinumerik/state/expr.h"
#include "ir/active_units.h"
#include "ir/modal.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

namespace {

struct DatumRow {
  std::string_view name;
  ir::Datum datum;
  bool axis;  ///< the first index is an axis
};
// What has a neutral meaning (motion reference 24.1); everything else is known by its name only.
constexpr DatumRow data[] = {
    {"$P_EP", ir::Datum::programmed_position, true},  {"$AA_IW", ir::Datum::work_position, true},
    {"$AA_IM", ir::Datum::machine_position, true},    {"$P_TOOLNO", ir::Datum::tool_number, false},
    {"$P_TOOLP", ir::Datum::next_tool, false},        {"$P_TOOL", ir::Datum::offset_number, false},
    {"$P_TOOLR", ir::Datum::tool_radius, false},      {"$AC_ACTUAL_PARTS", ir::Datum::part_count, false},
    {"$AC_CYCLE_TIME", ir::Datum::cycle_time, false}, {"$P_SUBPAR", ir::Datum::call_has_argument, false},
    {"$AA_IB", ir::Datum::machine_position, true},    {"$AA_IBN", ir::Datum::machine_position, true},
    {"$AA_IEN", ir::Datum::settable_position, true},  {"$AA_MW", ir::Datum::measured_work, true},
    {"$AA_MM", ir::Datum::measured_machine, true},    {"$AC_MEA", ir::Datum::probe_state, false},
    {"$AA_MM1", ir::Datum::measured_machine, true},   {"$AA_MM2", ir::Datum::measured_machine, true},
    {"$AA_MM3", ir::Datum::measured_machine, true},   {"$AA_MM4", ir::Datum::measured_machine, true},
    {"$AA_MW1", ir::Datum::measured_work, true},      {"$AA_MW2", ir::Datum::measured_work, true},
    {"$AA_MW3", ir::Datum::measured_work, true},      {"$AA_MW4", ir::Datum::measured_work, true},
    {"$P_UIFRNUM", ir::Datum::active_offset, false},  {"$P_F", ir::Datum::feed, false},
    {"$P_S", ir::Datum::spindle_speed, false},
};
// FALSE in a plain run (reference-language 13).
constexpr std::string_view false_in_a_run[] = {"$P_SEARCH", "$P_SIM", "$P_ISTEST", "$P_DRYRUN", "$P_SEARCHL"};

}  // namespace

ir::SystemRef ExprLowering::system(const Expr& e) {
  ir::SystemRef ref;
  ref.text = e.text;
  std::size_t first = 0;
  for (const auto& row : data) {
    if (row.name != e.text) continue;
    ref.datum = row.datum;
    if (row.axis && !e.args.empty() && e.args[0].kind == ExprKind::name) {
      ref.axis = c_.machine.axis(e.args[0].text);
      first = 1;
    }
    if (row.axis && ref.axis == ir::axis::none) ref.datum = ir::Datum::other;
    if (e.text == "$AA_IBN" && c_.said.contains("$P_BFRAME")) ref.datum = ir::Datum::other;  // under a base frame
  }
  // $P_UIFR[row, axis, TR]: a value of the table of settable offsets
  const bool shift = e.args.size() == 3 && (e.args[2].text == "TR" || e.args[2].text == "FI");
  if (e.text == "$P_UIFR" && shift && e.args[1].kind == ExprKind::name) {
    ref.axis = c_.machine.axis(e.args[1].text);
    if (ref.axis != ir::axis::none) {
      ref.datum = e.args[2].text == "TR" ? ir::Datum::work_offset : ir::Datum::work_offset_fine;
      if (auto row = lower_as(e.args[0], ir::Type::integer)) ref.args.push_back(std::move(row));
      return ref;
    }
  }
  for (std::size_t i = ref.datum == ir::Datum::other ? 0 : first; i < e.args.size(); ++i) {
    const Expr& a = e.args[i];
    // Components and axis names of data we don't know stay text.
    if (a.kind == ExprKind::name && c_.symbol(a.text) == nullptr && c_.machine.axis(a.text) == ir::axis::none) {
      ref.args.push_back(make_expr(ir::String{a.text}, ir::Type::string, a.pos));
    } else if (auto index = lower(a)) {
      ref.args.push_back(std::move(index));
    }
  }
  return ref;
}

/// Under G70 a position is read in the unit of the words; whether the control gives it so is not said for each datum.
void ExprLowering::tell_position(const Expr& e) {
  if (!c_.words_in_inches || !c_.first_time("G70 " + e.text)) return;
  c_.warning("SIN-105", e.pos,
             e.text + " is read under G70 in inches, as words are written; the manual lets only words change with G70",
             "read it under G71 or G700, where both say the same");
}

ir::ExprPtr ExprLowering::system_operand(const Expr& e) {
  if (e.text == "$PI") {
    return make_expr(ir::Number{3.14159265358979323846, {}, false}, ir::Type::real, e.pos);
  }
  if (std::find(std::begin(false_in_a_run), std::end(false_in_a_run), e.text) != std::end(false_in_a_run)) {
    c_.note("SIN-015", e.pos, e.text + " is read as FALSE: neither block search nor simulation is running");
    return make_expr(ir::Number{0, {}, true}, ir::Type::boolean, e.pos);
  }
  if (e.text.size() > 2 && e.text[1] == 'R' && e.args.empty() &&
      std::all_of(e.text.begin() + 2, e.text.end(), [](char c) { return c >= '0' && c <= '9'; })) {
    Expr r;  // $R10 is the cell R10
    r.kind = ExprKind::variable;
    r.text = "R";
    r.pos = e.pos;
    Expr index;
    index.kind = ExprKind::number;
    index.text = e.text.substr(2);
    index.number = std::stod(index.text);
    index.pos = e.pos;
    r.args.push_back(std::move(index));
    return named(r);
  }
  if (e.text == "$P_GG" && e.args.size() == 1) {
    if (auto made = active_g_function(e)) return made;
  }
  constexpr std::string_view geometry_axes[] = {"$P_AXN1", "$P_AXN2", "$P_AXN3"};
  for (ir::AxisId a = 0; a < std::size(geometry_axes); ++a) {
    if (e.text == geometry_axes[a]) return make_expr(ir::AxisName{c_.machine.geometry.of(a)}, ir::Type::axis, e.pos);
  }
  if (e.text == "$P_SUBPAR" && e.args.size() == 1) {  // counted from 1
    ir::SystemRef given;
    given.text = e.text;
    given.datum = ir::Datum::call_has_argument;
    auto n = lower_as(e.args[0], ir::Type::integer);
    if (!n) return nullptr;
    const auto constant = ir::constant_value(n);
    given.args.push_back(constant ? ir::number(*constant - 1)
                                  : ir::binary(ir::BinaryOp::subtract, std::move(n), ir::number(1)));
    return make_expr(std::move(given), ir::Type::boolean, e.pos);
  }
  const std::uint32_t before = c_.errors;
  const bool offset = e.text == "$P_UIFR" && e.args.size() == 3 && (e.args[2].text == "TR" || e.args[2].text == "FI");
  if (!offset) {
    auto name = frame_name(e);
    if (c_.errors != before) return nullptr;
    if (name && !name->component) return name->whole;
    if (name) {
      tell_position(e);
      return make_expr(ir::Call{ir::Function::frame_part, {name->whole, name->axis, name->component}}, ir::Type::real,
                       e.pos);
    }
  }
  ir::SystemRef ref = system(e);
  if (c_.errors != before) return nullptr;
  if (ref.datum == ir::Datum::programmed_position || ref.datum == ir::Datum::work_position ||
      ref.datum == ir::Datum::settable_position || ref.datum == ir::Datum::measured_work)
    tell_position(e);
  if (ref.datum == ir::Datum::other && c_.first_time(e.text)) {
    c_.warning("SIN-015", e.pos,
               e.text + " is known only to the machine: a run takes the profile's value, or stops where it is read");
  }
  const ir::Type type = ref.datum == ir::Datum::call_has_argument ? ir::Type::boolean : ir::Type::real;
  return make_expr(std::move(ref), type, e.pos);
}

/// $P_GG[6]: the index in its group of the code in force; 0 for a group whose codes are not carried as settings.
ir::ExprPtr ExprLowering::active_g_function(const Expr& e) {
  if (e.args[0].kind != ExprKind::number) return nullptr;
  const auto group = static_cast<std::uint8_t>(e.args[0].number);
  ir::ExprPtr sum;
  for (const GFunction& g : g_functions()) {
    if (g.group != group || g.index == 0 || g.name == "DIAMCYCOF") continue;
    int setting = -1;
    double value = g.a;
    if (g.use == GUse::setting) {
      setting = g.a;
      value = g.b;
      if (static_cast<ir::Setting>(g.a) == ir::Setting::plane)
        value = static_cast<double>(c_.machine.geometry.plane(static_cast<ir::Plane>(g.b)));
    }
    if (g.use == GUse::motion) setting = static_cast<int>(ir::setting_count);
    if (g.use == GUse::work_offset) setting = static_cast<int>(ir::setting_count) + 1;
    if (g.use == GUse::units) setting = static_cast<int>(ir::Setting::units);
    if (setting < 0) continue;
    ir::SystemRef ref;
    ref.datum = ir::Datum::active_modal;
    ref.text = e.text;
    const int code = g.number >= 0 ? g.number : -(100 * g.group + g.index);  // DIAMON and its like have no number
    ref.args = {ir::number(code), ir::number(setting), ir::number(value)};
    auto term = ir::binary(ir::BinaryOp::multiply, ir::number(g.index), make_expr(ref, ir::Type::real, e.pos));
    if (g.use == GUse::units) {  // G70 and G700 differ in what is in inches
      ref.args = {ir::number(code), ir::number(ir::units_feed_too_setting), ir::number(g.b)};
      term = ir::binary(ir::BinaryOp::multiply, std::move(term), make_expr(std::move(ref), ir::Type::real, e.pos));
    }
    sum = sum ? ir::binary(ir::BinaryOp::add, std::move(sum), std::move(term)) : std::move(term);
  }
  return sum ? ir::at(sum, e.pos) : nullptr;
}

/// AXSTRING, AXNAME, MODAXVAL, ISAXIS and the functions that make frames (9.6; motion reference 7.3).
ir::ExprPtr ExprLowering::axis_function(const Expr& e, bool& known) {
  known = true;
  if (e.text == "CTRANS" || e.text == "CFINE" || e.text == "CROT" || e.text == "CROTS" || e.text == "CSCALE" ||
      e.text == "CMIRROR" || e.text == "CRPL" || e.text == "INVFRAME" || e.text == "MEAFRAME") {
    return frame(e);
  }
  if (e.text == "AXNAME" && e.args.size() == 1 && e.args[0].kind == ExprKind::string) {
    const ir::AxisId id = c_.machine.axis(to_upper_ascii(e.args[0].text));
    if (id != ir::axis::none) return make_expr(ir::AxisName{id}, ir::Type::axis, e.pos);
    c_.keep("SIN-003", e.pos, "the machine " + c_.machine.profile->name + " has no axis " + e.args[0].text);
    return nullptr;
  }
  if ((e.text == "AXSTRING" || e.text == "AXTOSPI") && e.args.size() == 1 && e.args[0].text == "SPI" &&
      e.args[0].args.size() == 1) {
    auto number = lower_as(e.args[0].args[0], ir::Type::integer);
    if (!number || e.text == "AXTOSPI") return number;
    auto text = make_expr(ir::Call{ir::Function::to_string, {std::move(number)}}, ir::Type::string, e.pos);
    return make_expr(ir::Binary{ir::BinaryOp::concat, ir::string_literal("S"), std::move(text), ir::Compare::exact},
                     ir::Type::string, e.pos);
  }
  if (e.text == "AXTOSPI" && e.args.size() == 1) return spindle_of_axis(e);
  if (e.text == "AXSTRING" && e.args.size() == 1) {
    auto axis = axis_operand(e.args[0]);
    if (!axis) return nullptr;
    return make_expr(ir::Call{ir::Function::axis_text, {std::move(axis)}}, ir::Type::string, e.pos);
  }
  if (e.text.starts_with("CTAB")) return table_function(e);
  if (e.text == "ISAXIS" && e.args.size() == 1 && e.args[0].kind == ExprKind::number) {
    const double n = e.args[0].number;
    bool there = false;
    for (const auto& a : c_.machine.profile->axes) there = there || (a.id <= ir::axis::z && a.id + 1 == n);
    return make_expr(ir::Number{there ? 1.0 : 0.0, {}, true}, ir::Type::boolean, e.pos);
  }
  if (e.text == "MODAXVAL" && e.args.size() == 2) {
    const auto axis = axis_operand(e.args[0]);
    const auto* name = axis ? std::get_if<ir::AxisName>(&axis->node) : nullptr;
    auto value = lower_as(e.args[1], ir::Type::real);
    if (!value || (axis && name == nullptr)) {
      if (value) c_.keep("SIN-007", e.pos, "MODAXVAL() of an axis in a variable is not carried yet");
      return nullptr;
    }
    if (name == nullptr) return nullptr;
    const auto* spec = c_.machine.profile->axis(name->axis);
    if (spec == nullptr || !spec->rotary) return value;
    const auto turns = ir::call(ir::Function::floor, {ir::binary(ir::BinaryOp::divide, value, ir::number(360))});
    return ir::at(ir::binary(ir::BinaryOp::subtract, value, ir::binary(ir::BinaryOp::multiply, turns, ir::number(360))),
                  e.pos);
  }
  known = false;
  return nullptr;
}

}  // namespace cnctrans::sinumerik
