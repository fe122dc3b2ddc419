// Milling cycles: the radius of the tool, and the moves of the expansion, one event each.
#include <algorithm>
#include <array>
#include <string>

#include "base/text.h"
#include "interpreter/machine/block_machine.h"
#include "interpreter/machine/profile_contour.h"
#include "interpreter/trace/run_codes.h"
#include "ir/cycles/milling/pocket_moves.h"
#include "machine/cycle_context.h"
#include "machine/tool_data.h"

namespace cnctrans::interpreter {

namespace {

using ir::cycles::MillStep;

}  // namespace

double BlockMachine::tool_radius() {
  const std::int32_t number = tool_.number();
  auto names = machine::tool_data_names(profile_.policies.tool_radius_data, number, tool_.offset());
  constexpr std::string_view of_any_tool = "TOOL_RADIUS";  // no control's own name: always in mm
  names.emplace_back(of_any_tool);
  for (const std::string& name : names) {
    const double length = data_modal_ && name != of_any_tool ? unit() : 1;
    if (const double* given = data_.by_name(name)) return *given * (data_.in_mm(name) ? 1 : length);
  }
  const double row = tool_.offset();
  if (const double* written = data_.tool(ir::Datum::tool_radius, ir::axis::none, {&row, 1})) return *written;
  const auto tool = std::find_if(profile_.tools.begin(), profile_.tools.end(),
                                 [number](const auto& t) { return t.number == number; });
  return tool == profile_.tools.end() ? 0 : tool->radius;
}

bool BlockMachine::read_mill_contours(const ir::HoleCycle& hole) {
  mill_contours_.clear();
  const auto names = ir::cycles::contours_named(hole);
  if (names.empty() && ir::cycles::has_contours(hole)) {
    std::string error;
    auto travelled = ir::cycles::contours_in(hole, &error);
    if (!travelled) return failure_.fail(code::bad_cycle, error);
    mill_contours_ = std::move(*travelled);
    return true;
  }
  const bool several = names.size() == 1 && hole.mill.shape.starts_with("pocket.");
  for (const auto& named : names) {
    std::string error;
    if (program_ == nullptr)
      return failure_.fail(code::needs_whole_program, "a cycle with a contour needs the whole program");
    const auto routine = ir::cycles::profile_routine(named);
    const auto home = std::find_if(contour_homes_.begin(), contour_homes_.end(),
                                   [&routine](const auto& h) { return routine && h.first == *routine; });
    const ir::Program& program = home == contour_homes_.end() ? *program_ : *home->second;
    const auto blocks = ir::cycles::profile_blocks(program, *routine_, named, &error);
    if (blocks.empty()) return failure_.fail(code::bad_cycle, error);
    auto contours = mill_contours_of(profile_, modal_, blocks, several, values_, &error);
    if (!contours) return failure_.fail(code::bad_cycle, error);
    for (auto& contour : *contours) mill_contours_.push_back(std::move(contour));
  }
  return true;
}

bool BlockMachine::mill_context(ir::cycles::MillContext& context) {
  const auto plane = ir::plane_axes(modal_.plane);
  if (!check_axis(plane.u) || !check_axis(plane.v)) return false;
  if (modal_.comp != ir::CompSide::off)
    return failure_.fail(code::bad_cycle,
                         "a milling cycle runs without radius compensation: it goes by the radius itself");
  context.u = p_[plane.u];
  context.v = p_[plane.v];
  context.w = p_[plane.w];
  context.tool_radius = cycle_.mill.tool_radius.value_or(tool_radius());
  context.spindle_ccw = spindles_.master().state == ir::SpindleState::ccw;
  context.plane = modal_.retract_plane;
  context.contours = &mill_contours_;
  machine::tell_pocket(profile_.policies, context);
  return true;
}

/// Nobody gives the radius of the tool: the one taken before for it, else the first usual one with which the cycle can
/// be carried out. Where the tool stands behind the cycle, and what follows, is right for every radius but in few
/// shapes.
std::optional<std::vector<ir::cycles::MillMove>> BlockMachine::milling_by_assumed_radius(
    ir::cycles::MillContext& context, std::string* error) {
  constexpr std::array usual{5.0,  4.0,  3.0,  2.0,  1.5,  1.0,  0.5,  6.0, 8.0,
                             10.0, 12.5, 16.0, 20.0, 25.0, 31.5, 40.0, 50.0};
  const std::int32_t tool = tool_.number();
  std::vector<double> radii;
  for (const auto& a : assumed_radii_) {
    if (a.tool == tool) radii.insert(radii.begin(), a.radius);
  }
  const std::size_t before = radii.size();
  if (profile_.policies.cycle_unknown_radius == machine::CycleUnknownRadius::assumed)
    radii.insert(radii.end(), usual.begin(), usual.end());
  bool same = !radii.empty();
  for (std::size_t k = 0; k < radii.size(); ++k) {
    context.tool_radius = radii[k];
    std::string why;
    auto moves = ir::cycles::expand(cycle_.mill, *cycle_.hole, context, &why);
    if (moves && k >= before) assumed_radii_.push_back({failure_.where, tool, radii[k]});
    if (moves) return moves;
    if (k == 0) *error = why;
    same = same && why == *error;
  }
  if (same) return std::nullopt;  // with every tool: it is not the radius
  *error =
      "the passes of a milling cycle depend on the radius of the tool, which is not known: give it with --tools FILE, "
      "in the profile's \"tools\" or by --set TOOL_RADIUS=5";
  return std::nullopt;
}

void BlockMachine::tell_radii(Diagnostics& diagnostics) const {
  for (const auto& a : assumed_radii_) {
    const std::string tool = a.tool != 0 ? " T" + std::to_string(a.tool) : "";
    diagnostics.warning(
        code::radius_assumed, a.where,
        "nobody gives the radius of the tool" + tool +
            ": the passes of this milling cycle are those of a tool of radius " + shortest(a.radius) + " mm",
        "give it with --tools FILE, in the profile's \"tools\" or by --set TOOL_RADIUS=" + shortest(a.radius));
  }
}

bool BlockMachine::run_milling() {
  ir::cycles::MillContext context;
  if (!mill_context(context)) return false;
  const auto need = ir::cycles::needs_radius(cycle_.mill);
  if (context.tool_radius <= 0 && need == ir::cycles::RadiusNeed::lead)
    data_.assume(
        failure_.where, "TOOL_RADIUS", 0,
        "the way onto the contour and off it is counted from the tool's edge: give the radius with --tools FILE, in "
        "the profile's \"tools\" or by --set TOOL_RADIUS=5");
  std::string error;
  const bool unknown = context.tool_radius <= 0 && need == ir::cycles::RadiusNeed::moves;
  const auto moves = unknown ? milling_by_assumed_radius(context, &error)
                             : ir::cycles::expand(cycle_.mill, *cycle_.hole, context, &error);
  if (!moves) {
    return failure_.fail(error.ends_with("not carried out yet") ? code::not_carried : code::bad_cycle, error);
  }
  if (cycle_.mill.shape->kind == ir::cycles::MillKind::contour_pocket) pocket_orders_.push_back(failure_.where);
  const double speed = spindles_.master().rpm();
  const std::uint64_t first = emitter_.seen();
  const auto sense = spindles_.master().state;
  for (const auto& m : *moves) {
    if (m.step == MillStep::orient) {
      orient_master(m.angle);
    } else if (m.step == MillStep::reverse || m.step == MillStep::restart) {
      const bool turned = m.step == MillStep::reverse && sense != ir::SpindleState::off;
      const bool cw = (sense == ir::SpindleState::cw) != turned;
      run_master(sense == ir::SpindleState::off ? sense : cw ? ir::SpindleState::cw : ir::SpindleState::ccw);
    } else if (!milling_move(m, speed)) {
      return false;
    }
  }
  using ir::cycles::MillKind;
  const MillKind shape = cycle_.mill.shape->kind;
  const bool pocket = shape == MillKind::rectangle || shape == MillKind::circle || shape == MillKind::slot;
  if (cycle_runs_ != nullptr && pocket) keep_place(first, "pocket", cycle_.hole->surface, context.tool_radius);
  return true;
}

void BlockMachine::keep_place(std::uint64_t first, std::string_view family, double level, double kind) {
  const auto plane = ir::plane_axes(modal_.plane);
  CycleRun run;
  run.family = family;
  run.first = first;
  run.last = emitter_.seen();
  run.plane = modal_.plane;
  run.radius = kind;
  Axes low = p_, high = p_;
  low[plane.w] = level;
  high[plane.w] = level + 1;
  low = frame_.apply(low);
  high = frame_.apply(high);
  run.surface = low[plane.w];
  const double rise = high[plane.w] - low[plane.w];  // a scale makes it longer, a mirror negative
  run.out = rise < 0 ? -cycle_.hole->up : cycle_.hole->up;
  const auto stays = [&](ir::AxisId axis) { return std::abs(high[axis] - low[axis]) < 1e-9; };
  run.comparable = std::abs(rise) > 1e-9 && stays(plane.u) && stays(plane.v) && plane.w == cycle_.axis;
  cycle_runs_->push_back(std::move(run));
}

bool BlockMachine::milling_move(const ir::cycles::MillMove& m, double speed) {
  if (m.step == MillStep::speed || m.step == MillStep::restore_speed) {
    auto& spindle = spindles_.master();
    spindle.set_rpm(m.step == MillStep::speed ? m.amount : speed);
    if (spindle.turns()) emit_master();
    return true;
  }
  if (m.step == MillStep::comp_left || m.step == MillStep::comp_right || m.step == MillStep::comp_off) {
    set_comp(m.step == MillStep::comp_off    ? ir::CompSide::off
             : m.step == MillStep::comp_left ? ir::CompSide::left
                                             : ir::CompSide::right);
    return true;
  }
  const auto plane = ir::plane_axes(modal_.plane);
  Move move = move_from_here();
  move.to[plane.u] = m.u;
  move.to[plane.v] = m.v;
  move.to[plane.w] = m.w;
  move.kind = m.step == MillStep::rapid    ? Move::Kind::rapid
              : m.step == MillStep::arc    ? Move::Kind::arc
              : m.step == MillStep::thread ? Move::Kind::thread
                                           : Move::Kind::linear;
  move.feed = (m.has_feed ? m.feed : feed_now()) * m.feed_factor;
  move.feed_degrees.reset();
  if (move.kind == Move::Kind::arc) {
    move.plane = modal_.plane;
    move.centre = {m.cu, m.cv};
    move.ccw = m.ccw;
  }
  if (move.kind == Move::Kind::thread) {
    move.pitch = m.amount;
    move.start_angle = m.angle;
  } else if (move.kind != Move::Kind::rapid && move.feed <= 0)
    return failure_.fail(code::bad_cycle, "a milling cycle needs a feed: its own, or the one in force");
  if (!emit_move(move, false)) return false;
  p_ = move.to;
  last_.known = false;
  return true;
}

}  // namespace cnctrans::interpreter
