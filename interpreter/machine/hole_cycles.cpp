// Hole cycles: definition, what triggers them, one hole.
#include <cmath>

#include "interpreter/machine/block_machine.h"
#include "interpreter/trace/run_codes.h"
#include "ir/cycles/milling/pocket_call.h"

namespace cnctrans::interpreter {

bool BlockMachine::resolve_cycle(const ir::CyclePtr& cycle, std::optional<ir::cycles::HoleNumbers>& out,
                                 ir::AxisId& axis) {
  const auto* hole = cycle ? std::get_if<ir::HoleCycle>(&cycle->node) : nullptr;
  if (hole == nullptr) {
    const auto* named = cycle ? std::get_if<ir::NamedCycle>(&cycle->node) : nullptr;
    return failure_.fail(code::not_carried, "the cycle " + (named != nullptr ? named->name : std::string("here")) +
                                                " is not carried out yet");
  }
  axis = hole->axis == ir::axis::none ? ir::plane_axes(modal_.plane).w : hole->axis;
  if (!check_axis(axis)) return false;
  ir::cycles::HoleContext context;
  context.length_unit = unit();
  context.level_unit = axis_[axis].scale_absolute;
  context.feed_unit = feed_unit();
  context.distance = modal_.distance;
  context.height = hole->keeps_initial && cycle_.hole ? cycle_.hole->initial : p_[axis];
  const auto evaluate = [this](const ir::Value& v) -> std::optional<double> {
    const double x = value(v);
    if (failure_.set) return std::nullopt;
    return x;
  };
  // A change of the cycle in force: the levels it does not name stay where they are.
  std::optional<ir::HoleCycle> merged;
  if (hole->keeps_initial) {
    if (!cycle_.hole) return failure_.fail(code::bad_cycle, "the words of a cycle are changed, and no cycle is active");
    merged = *hole;
    const auto stays = [&](ir::Level& l, double height) {
      if (l.given) return;
      l = ir::Level{ir::Value(height / context.level_unit), ir::LevelBase::absolute, ir::LevelBase::absolute, true};
    };
    stays(merged->reference, cycle_.hole->reference);
    stays(merged->bottom, cycle_.hole->bottom);
    hole = &*merged;
  }
  std::string error;
  out = ir::cycles::resolve(*hole, context, evaluate, &error);
  hole_entries_.clear();
  if (out && (hole->kind == ir::HoleKind::mill || !hole->mill.shape.empty())) {
    const auto plane = ir::plane_axes(modal_.plane);
    if (axis != plane.w) return failure_.fail(code::bad_cycle, "a milling cycle works along the normal of the plane");
    const ir::cycles::MillUnits units{axis_[plane.u].scale_absolute, axis_[plane.v].scale_absolute, unit(),
                                      feed_unit()};
    auto mill = ir::cycles::resolve(hole->mill, units, evaluate, &error);
    if (!mill && !failure_.set) return failure_.fail(code::bad_cycle, error);
    if (!mill) return false;
    cycle_.mill = std::move(*mill);
    if (!read_mill_contours(*hole)) return false;
    if (hole->kind != ir::HoleKind::mill && !find_pocket_entries()) return false;
  }
  if (out) return true;
  return failure_.fail(code::bad_cycle, error);
}

bool BlockMachine::define_cycle(const ir::CycleDefine& c) {
  const auto* named = c.cycle ? std::get_if<ir::NamedCycle>(&c.cycle->node) : nullptr;
  const bool pocket = named != nullptr && ir::cycles::is_pocket_cycle(named->name);
  if (named != nullptr && !c.modal && c.here && (pocket || ir::cycles::find_machining(named->name) != nullptr)) {
    now_.machining = named;
    return true;
  }
  if (named != nullptr && !c.modal && c.here && ir::cycles::find_pattern(named->name) != nullptr) {
    pattern_.here = true;
    return start_pattern(*named);
  }
  if (block_again && c.modal && cycle_.hole) return true;
  std::optional<ir::cycles::HoleNumbers> numbers;
  ir::AxisId axis = ir::axis::z;
  const ActiveCycle before = c.modal ? ActiveCycle{} : cycle_;  // resolving it writes into the present one
  if (!resolve_cycle(c.cycle, numbers, axis)) return false;
  const auto* hole = std::get_if<ir::HoleCycle>(&c.cycle->node);
  const auto* own = profile_.axis(axis);
  // Where the tool stands before the program has moved it is the machine's affair.
  const bool placed = own != nullptr && std::abs(path_event_.to.value[axis] - own->start) > 1e-9;
  if (placed && hole != nullptr && !hole->keeps_initial && numbers &&
      profile_.policies.cycle_below_reference == machine::CycleBelowReference::refused &&
      p_[axis] < numbers->reference - 1e-9 && p_[axis] > numbers->bottom + 1e-9) {
    return failure_.fail(code::bad_cycle,
                         "the tool stands between the reference plane and the depth where the cycle is called");
  }
  modal_cycle_.reset();
  if (before.hole) modal_cycle_ = before;
  cycle_.hole = numbers;
  cycle_.axis = axis;
  cycle_.follows_plane = c.trigger == ir::CycleTrigger::path_motion && hole != nullptr && hole->axis == ir::axis::none;
  cycle_.trigger = c.trigger;
  now_.cycle_once = !c.modal;
  now_.cycle_defined = true;
  now_.cycle_waits = !c.here;
  return true;
}

/// The modal cycle goes on behind a cycle that was called by itself.
void BlockMachine::end_single_cycle() {
  if (modal_cycle_) {
    cycle_ = std::move(*modal_cycle_);
    modal_cycle_.reset();
  } else {
    cycle_.hole.reset();
  }
}

bool BlockMachine::modal_cycle(const ir::CyclePtr& cycle, ir::CycleTrigger trigger, bool here) {
  if (!cycle) {
    cycle_.hole.reset();
    return true;
  }
  ir::CycleDefine c;
  c.cycle = cycle;
  c.trigger = trigger;
  c.here = here;
  if (!define_cycle(c)) return false;
  now_.cycle_once = false;
  return !here || run_cycle();
}

/// F, S or a bare motion code while rapid or linear motion is in force.
bool BlockMachine::path_words(const ir::Block& b) const {
  if (modal_.motion != ir::MotionKind::rapid && modal_.motion != ir::MotionKind::linear) return false;
  if (b.has_motion && b.motion.explicit_code) return true;
  for (const auto& a : b.actions) {
    if (std::holds_alternative<ir::SetFeed>(a.data) || std::holds_alternative<ir::SetSpindle>(a.data)) return true;
  }
  return false;
}

bool BlockMachine::cycle_triggers(const ir::Block& b) const {
  const auto& m = b.motion;
  if (b.has_motion && m.frame != ir::FrameUse::normal) return false;
  if (cycle_.trigger == ir::CycleTrigger::path_motion) {
    return (b.has_motion && m.moves()) || path_words(b);
  }
  if (!b.has_motion) return false;
  const auto plane = ir::plane_axes(modal_.plane);
  for (const auto& w : m.coords) {
    if (w.axis == cycle_.axis) continue;
    if (w.axis == plane.u || w.axis == plane.v || w.axis == plane.w) return true;
    if (profile_.policies.cycle_rotary_triggers && axis_[w.axis].rotary) return true;
  }
  return m.extra && (m.extra->has_polar_angle || m.extra->has_polar_radius);
}

/// The plane at the point counts; the levels, in millimetres, stay.
bool BlockMachine::turn_hole() {
  const ir::AxisId axis = ir::plane_axes(modal_.plane).w;
  if (axis == cycle_.axis) return true;
  if (!check_axis(axis)) return false;
  if (axis_[axis].scale_absolute != axis_[cycle_.axis].scale_absolute)
    return failure_.fail(code::bad_cycle, "the plane of a modal cycle was changed, and its levels would be diameters");
  cycle_.axis = axis;
  return true;
}

bool BlockMachine::run_cycle() {
  if (pending_) {
    release_pending();
    if (!without_corner("a cycle follows a corner function")) return false;
  }
  if (cycle_.follows_plane && !turn_hole()) return false;
  if (cycle_.hole->kind == ir::HoleKind::mill) return run_milling();
  if (hole_entries_.empty()) return run_hole();
  const auto plane = ir::plane_axes(modal_.plane);
  for (const auto& [u, v] : hole_entries_) {
    Move move = move_from_here();
    move.kind = Move::Kind::rapid;
    move.to[plane.u] = u;
    move.to[plane.v] = v;
    if (!emit_move(move, false)) return false;
    p_ = move.to;
    if (!run_hole()) return false;
  }
  return true;
}

/// The hole at the place where the tool stands.
bool BlockMachine::run_hole() {
  std::string error;
  cycle_.hole->told_in_full = profile_.policies.cycle_stops == machine::CycleStops::all;
  const auto moves = ir::cycles::expand(*cycle_.hole, p_[cycle_.axis], modal_.retract_plane, &error);
  if (!error.empty()) return failure_.fail(code::not_carried, error);
  const bool taps = cycle_.hole->kind == ir::HoleKind::tap || cycle_.hole->kind == ir::HoleKind::tap_floating;
  auto& spindle = spindles_.master();
  // A tap that turns the spindle itself by its pitch needs none running.
  const bool turns_itself = cycle_.hole->orient_first || cycle_.hole->spindle_bottom == ir::SpindleStep::none;
  if (taps && !turns_itself && !spindle.turns()) run_master(ir::SpindleState::cw);
  const auto sense = spindle.state;
  const Axes hole = p_;
  const std::uint64_t first = emitter_.seen();
  for (const auto& m : moves) {
    if (!cycle_move(m, hole, sense)) return false;
  }
  if (cycle_runs_ != nullptr && taps)
    keep_tap(first, cycle_.hole->pitch < 0 || (!turns_itself && sense == ir::SpindleState::ccw));
  return true;
}

void BlockMachine::keep_tap(std::uint64_t first, bool left_hand) {
  keep_place(first, "tap", cycle_.hole->reference, left_hand ? -1 : 1);
}

bool BlockMachine::cycle_move(const ir::cycles::CycleMove& m, const Axes& hole, ir::SpindleState sense) {
  using ir::cycles::CycleStep;
  const auto opposite = sense == ir::SpindleState::cw ? ir::SpindleState::ccw : ir::SpindleState::cw;
  switch (m.step) {
    case CycleStep::rapid:
    case CycleStep::feed:
    case CycleStep::thread: return cycle_path(m, hole);
    case CycleStep::dwell: emit_dwell(m.amount, m.revolutions); break;
    case CycleStep::spindle_reverse: run_master(sense == ir::SpindleState::off ? sense : opposite); break;
    case CycleStep::spindle_restore:
      if (sense != ir::SpindleState::off || spindles_.master().oriented) run_master(sense);
      break;
    case CycleStep::spindle_stop: run_master(ir::SpindleState::off); break;
    case CycleStep::spindle_cw: run_master(ir::SpindleState::cw); break;
    case CycleStep::spindle_ccw: run_master(ir::SpindleState::ccw); break;
    case CycleStep::spindle_speed: spindles_.master().set_rpm(m.amount); break;
    case CycleStep::spindle_orient: orient_master(m.amount); break;
    case CycleStep::operator_stop: emit_stop(false); break;
  }
  return true;
}

bool BlockMachine::cycle_path(const ir::cycles::CycleMove& m, const Axes& hole) {
  using ir::cycles::CycleStep;
  const auto plane = ir::plane_axes(modal_.plane);
  Move move = move_from_here();
  move.to[cycle_.axis] = m.w;
  if (plane.u != cycle_.axis) move.to[plane.u] = hole[plane.u] + m.du;
  if (plane.v != cycle_.axis) move.to[plane.v] = hole[plane.v] + m.dv;
  move.feed = (m.has_feed ? m.feed : feed_now()) * m.feed_factor;
  move.feed_degrees.reset();
  move.kind = m.step == CycleStep::rapid ? Move::Kind::rapid : Move::Kind::linear;
  if (m.step == CycleStep::thread) {
    move.kind = Move::Kind::thread;
    if (!cycle_pitch(m, move.pitch)) return false;
  }
  if (!emit_move(move, false)) return false;
  p_ = move.to;
  last_.known = false;
  return true;
}

/// Pitch of a tap: its own, else feed per revolution, else feed over spindle speed.
bool BlockMachine::cycle_pitch(const ir::cycles::CycleMove& m, double& pitch) {
  pitch = m.pitch;
  if (pitch != 0) return true;
  const double feed = m.has_feed ? m.feed : feed_now();
  if (modal_.feed_mode == ir::FeedMode::per_rev) {
    pitch = feed;
    return true;
  }
  const double speed = spindles_.master().rpm();
  if (speed <= 0) return failure_.fail(code::bad_cycle, "tapping needs a pitch, or a feed and a spindle speed");
  pitch = feed / speed;
  return true;
}

}  // namespace cnctrans::interpreter
