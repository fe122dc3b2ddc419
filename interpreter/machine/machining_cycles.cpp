// Machining cycles of a lathe: the moves of the expansion, one event each.
#include <algorithm>
#include <cmath>

#include "interpreter/machine/block_machine.h"
#include "interpreter/machine/profile_contour.h"
#include "interpreter/trace/run_codes.h"
#include "ir/cycles/machining.h"
#include "ir/cycles/milling/pocket_call.h"
#include "ir/cycles/profile_blocks.h"
#include "machine/cycle_context.h"
#include "machine/tool_data.h"

namespace cnctrans::interpreter {

namespace {

using ir::cycles::Quantity;
using ir::cycles::TurnStep;

}  // namespace

bool BlockMachine::machining_numbers(const ir::NamedCycle& c, ir::cycles::TurnNumbers& out) {
  for (const auto& [word, v] : c.words) {
    const auto* p = ir::cycles::find_parameter(word);
    if (p == nullptr) return failure_.fail(code::bad_cycle, "the cycle " + c.name + " has no parameter " + word);
    if (p->quantity == Quantity::text || ir::cycles::is_text(v)) continue;
    ir::cycles::TurnUnits units;
    units.cross = axis_[ir::axis::x].scale_absolute;
    units.along = axis_[ir::axis::z].scale_absolute;
    units.length = unit();
    units.feed = feed_unit();
    out[p->name] = value(v) * ir::cycles::factor_of(p->quantity, units);
  }
  return !failure_.set;
}

std::optional<ir::cycles::TurnProfile> BlockMachine::machining_profile(const ir::NamedCycle& c,
                                                                       const ir::cycles::TurnNumbers& numbers) {
  std::string error;
  const auto fail = [&](std::string_view fault) {
    failure_.fail(fault, error);
    return std::nullopt;
  };
  if (program_ == nullptr) {
    error = "a cycle with a profile needs the whole program";
    return fail(code::needs_whole_program);
  }
  const auto blocks = ir::cycles::profile_blocks(*program_, *routine_, c, &error);
  if (blocks.empty()) return fail(code::bad_cycle);
  const auto start = ir::cycles::contour_start(numbers, modal_);
  auto out = contour_of(profile_, start, blocks, values_, &error);
  return out ? out : fail(code::bad_cycle);
}

bool BlockMachine::run_machining(const ir::NamedCycle& c) {
  if (ir::cycles::is_pocket_cycle(c.name)) return run_pocket(c);
  const auto* cycle = ir::cycles::find_machining(c.name);
  if (cycle == nullptr) return failure_.fail(code::not_carried, "the cycle " + c.name + " is not carried out yet");
  if (pending_) {
    release_pending();
    if (!without_corner("a cycle follows a corner function")) return false;
  }
  if (!check_axis(ir::axis::x) || !check_axis(ir::axis::z)) return false;
  ir::cycles::TurnNumbers numbers;
  if (!machining_numbers(c, numbers)) return false;
  ir::cycles::TurnContext context;
  context.start = {p_[ir::axis::x], p_[ir::axis::z]};
  machine::tell_tool(profile_, tool_.in_spindle(), context);
  for (const std::string& name :
       machine::tool_data_names(profile_.policies.tool_width_data, tool_.in_spindle(), tool_.offset())) {
    const double* given = data_.by_name(name);
    if (given == nullptr) continue;
    context.nose_width = *given * (data_modal_ && !data_.in_mm(name) ? unit() : 1);
    break;
  }
  std::optional<ir::cycles::TurnProfile> contour;
  if (ir::cycles::has_profile(c)) {
    contour = machining_profile(c, numbers);
    if (!contour) return false;
    context.profile = &*contour;
  }
  std::string error;
  ir::cycles::LeftContours left;
  if (cycle_runs_ != nullptr) context.left = &left;
  const auto moves = ir::cycles::expand(*cycle, numbers, context, &error);
  if (!moves) {
    const bool missing = error.ends_with("not carried out yet") || error.ends_with("is not carried out");
    return failure_.fail(missing ? code::not_carried : code::bad_cycle, error);
  }
  const bool taps = cycle->kind == ir::cycles::MachiningKind::drill && numbers["peck"] == 0;
  CycleRun run;
  run.family = ir::cycles::family_of(c.name);
  run.first = emitter_.seen();
  const Spindle before = spindles_.master();
  if (!machining_moves(*cycle, *moves, taps)) return false;
  auto& now = spindles_.master();
  const bool other = now.mode != before.mode || now.value != before.value;
  if (c.name == "part.off" && other && context.choices.parting_restores) {
    set_spindle_mode(before.mode, true);
    now.value = before.value;
    if (now.state != ir::SpindleState::off) emit_master();
  }
  if (cycle_runs_ == nullptr || run.family.empty()) return true;
  run.last = emitter_.seen();
  keep_contours(left, run);
  cycle_runs_->push_back(std::move(run));
  return true;
}

bool BlockMachine::machining_moves(const ir::cycles::MachiningCycle& cycle,
                                   const std::vector<ir::cycles::TurnMove>& moves, bool taps) {
  auto& spindle = spindles_.master();
  if (taps && !spindle.turns()) run_master(ir::SpindleState::cw);
  const auto sense = spindle.state;
  for (const auto& m : moves) {
    if (!machining_move(m, sense)) return false;
  }
  if (cycle.ends_modes) {
    modal_.motion = ir::MotionKind::rapid;
    // The feed of the last pass stays in force.
    const auto last = std::find_if(moves.rbegin(), moves.rend(), [](const auto& m) { return m.has_feed; });
    if (last != moves.rend()) feed_[static_cast<std::size_t>(modal_.feed_mode)] = last->feed;
  }
  return true;
}

/// What a cycle leaves, in the coordinates of the machine: arcs as chords that are less than 0.001 mm off.
void BlockMachine::keep_contours(const ir::cycles::LeftContours& left, CycleRun& run) const {
  constexpr double off = 5e-4;
  const auto map = [this](ir::cycles::TurnPoint t) {
    Axes p = p_;
    p[ir::axis::x] = t.x;
    p[ir::axis::z] = t.z;
    p = frame_.apply(p);
    return CyclePoint{p[ir::axis::x], p[ir::axis::z]};
  };
  const auto points = [&](const std::vector<ir::cycles::ProfileElement>& elements, std::vector<CyclePoint>& out) {
    for (const auto& e : elements) {
      if (out.empty()) out.push_back(map(e.from));
      if (e.arc) {
        const double r = std::hypot(e.from.x - e.centre.x, e.from.z - e.centre.z);
        const double start = std::atan2(e.from.x - e.centre.x, e.from.z - e.centre.z);
        double sweep = std::atan2(e.to.x - e.centre.x, e.to.z - e.centre.z) - start;
        constexpr double full = 6.283185307179586;
        if (e.ccw && sweep < 0) sweep += full;
        if (!e.ccw && sweep > 0) sweep -= full;
        const double step = r > off ? 2 * std::acos(1 - off / r) : full;
        const double n = std::min(std::ceil(std::abs(sweep) / step), 1e5);
        for (double k = 1; k < n; ++k) {
          const double a = start + sweep * k / n;
          out.push_back(map({e.centre.x + r * std::sin(a), e.centre.z + r * std::cos(a)}));
        }
      }
      out.push_back(map(e.to));
    }
  };
  points(left.rough, run.rough);
  points(left.finish, run.finish);
  run.face = left.face;
  const CyclePoint zero = map({0, 0}), x = map({1, 0}), z = map({0, 1});
  const auto near = [](double a, double b) { return std::abs(a - b) < 1e-9; };
  run.comparable =
      near(x.z, zero.z) && near(z.x, zero.x) && near(std::abs(x.x - zero.x), 1) && near(std::abs(z.z - zero.z), 1);
  run.out = left.out * (left.face ? z.z - zero.z : x.x - zero.x);
}

bool BlockMachine::machining_move(const ir::cycles::TurnMove& m, ir::SpindleState sense) {
  constexpr int live = 3;
  switch (m.step) {
    case TurnStep::dwell: emit_dwell(m.seconds, false); return true;
    case TurnStep::spindle_reverse:
      run_master(sense == ir::SpindleState::cw ? ir::SpindleState::ccw : ir::SpindleState::cw);
      return true;
    case TurnStep::spindle_restore: run_master(sense); return true;
    case TurnStep::spindle_stop: run_master(ir::SpindleState::off); return true;
    case TurnStep::spindle_orient: orient_master(m.start_angle); return true;
    case TurnStep::spindle_speed:
    case TurnStep::spindle_cutting_speed: turn_at(m); return true;
    case TurnStep::live_run:
      spindles_[live].mode = ir::SpindleMode::rpm;
      spindles_[live].set_rpm(std::abs(m.speed));
      run_spindle(live, m.speed < 0 ? ir::SpindleState::ccw : ir::SpindleState::cw);
      return true;
    case TurnStep::live_stop: run_spindle(live, ir::SpindleState::off); return true;
    case TurnStep::comp_left: set_comp(ir::CompSide::left); return true;
    case TurnStep::comp_right: set_comp(ir::CompSide::right); return true;
    case TurnStep::comp_off: set_comp(ir::CompSide::off); return true;
    default: return machining_path(m);
  }
}

void BlockMachine::turn_at(const ir::cycles::TurnMove& m) {
  const bool cut = m.step == TurnStep::spindle_cutting_speed;
  set_spindle_mode(cut ? ir::SpindleMode::css : ir::SpindleMode::rpm, true);
  set_spindle_value({spindles_.master_number(), ir::Value{m.speed}});
  if (m.limit > 0) set_spindle_limit({spindles_.master_number(), ir::Value{m.limit}, false});
  if (m.sense != 0)
    run_master(m.sense > 0 ? ir::SpindleState::cw : ir::SpindleState::ccw);
  else if (spindles_.master().state != ir::SpindleState::off)
    emit_master();
}

bool BlockMachine::machining_path(const ir::cycles::TurnMove& m) {
  Move move = move_from_here();
  move.to[ir::axis::x] = m.to.x;
  move.to[ir::axis::z] = m.to.z;
  move.feed = feed_now();
  move.feed_degrees.reset();
  if (m.per_minute) {
    move.feed_mode = ir::FeedMode::per_minute;
    move.feed = feed_[static_cast<std::size_t>(ir::FeedMode::per_minute)];
    if (!m.has_feed && move.feed == 0)
      return failure_.fail(code::bad_cycle, "a cycle of a driven tool needs a feed in millimetres per minute");
  }
  if (m.has_feed) move.feed = m.feed;
  if (m.sharp) move.stop = {true, true};
  switch (m.step) {
    case TurnStep::rapid: move.kind = Move::Kind::rapid; break;
    case TurnStep::arc:
      move.kind = Move::Kind::arc;
      move.plane = ir::Plane::zx;
      move.centre = {m.centre.z, m.centre.x};
      move.ccw = m.ccw;
      break;
    case TurnStep::thread: {
      move.kind = Move::Kind::thread;
      ir::cycles::CycleMove like;
      like.pitch = m.pitch;
      if (m.pitch == 0 && m.speed != 0)
        move.pitch = move.feed / std::abs(m.speed);
      else if (!cycle_pitch(like, move.pitch))
        return false;
      move.start_angle = m.start_angle;
      move.pitch_change = m.pitch_change;
      break;
    }
    default: move.kind = Move::Kind::linear; break;
  }
  if (!emit_move(move, false)) return false;
  p_ = move.to;
  last_.known = false;
  return true;
}

}  // namespace cnctrans::interpreter
