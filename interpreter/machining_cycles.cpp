// Machining cycles of a lathe: the moves of the expansion, one event each.
#include <algorithm>

#include "interpreter/block_machine.h"
#include "interpreter/run_codes.h"
#include "ir/cycles/machining.h"

namespace cnctrans::interpreter {

namespace {

using ir::cycles::Quantity;
using ir::cycles::TurnStep;

}  // namespace

bool BlockMachine::machining_numbers(const ir::NamedCycle& c, ir::cycles::TurnNumbers& out) {
  for (const auto& [word, v] : c.words) {
    const auto* p = ir::cycles::find_parameter(word);
    if (p == nullptr) return failure_.fail(code::bad_cycle, "the cycle " + c.name + " has no parameter " + word);
    double x = value(v);
    switch (p->quantity) {
      case Quantity::cross: x *= axis_[ir::axis::x].scale_absolute; break;
      case Quantity::along: x *= axis_[ir::axis::z].scale_absolute; break;
      case Quantity::length: x *= unit(); break;
      case Quantity::feed: x *= feed_unit(); break;
      case Quantity::centiseconds: x *= 0.01; break;
      case Quantity::plain: break;
    }
    out[p->name] = x;
  }
  return !failure_.set;
}

bool BlockMachine::run_machining(const ir::NamedCycle& c) {
  const auto* cycle = ir::cycles::find_machining(c.name);
  if (cycle == nullptr) return failure_.fail(code::not_carried, "the cycle " + c.name + " is not carried out yet");
  if (pending_) {
    release_pending();
    return failure_.fail(code::corner_alone, "a cycle follows a corner function");
  }
  if (!check_axis(ir::axis::x) || !check_axis(ir::axis::z)) return false;
  ir::cycles::TurnNumbers numbers;
  if (!machining_numbers(c, numbers)) return false;
  // A length the source left out has the control's default of 1 mm in millimetres already.
  ir::cycles::TurnContext context;
  context.start = {p_[ir::axis::x], p_[ir::axis::z]};
  const auto tool = std::find_if(profile_.tools.begin(), profile_.tools.end(),
                                 [this](const auto& t) { return t.number == tool_in_spindle_; });
  if (tool != profile_.tools.end()) context.nose_width = tool->nose_width;
  std::string error;
  const auto moves = ir::cycles::expand(*cycle, numbers, context, &error);
  if (!moves) {
    const bool missing = error.ends_with("not carried out yet") || error.ends_with("is not carried out");
    return failure_.fail(missing ? code::not_carried : code::bad_cycle, error);
  }
  auto& spindle = spindles_[1];
  const bool taps = cycle->kind == ir::cycles::MachiningKind::drill && numbers["peck"] == 0;
  if (taps && spindle.state == ir::SpindleState::off) run_spindle(1, ir::SpindleState::cw);
  const auto sense = spindle.state;
  for (const auto& m : *moves) {
    if (!machining_move(m, sense)) return false;
  }
  return true;
}

bool BlockMachine::machining_move(const ir::cycles::TurnMove& m, ir::SpindleState sense) {
  switch (m.step) {
    case TurnStep::dwell: emit_dwell(m.seconds, false); return true;
    case TurnStep::spindle_reverse:
      run_spindle(1, sense == ir::SpindleState::cw ? ir::SpindleState::ccw : ir::SpindleState::cw);
      return true;
    case TurnStep::spindle_restore: run_spindle(1, sense); return true;
    case TurnStep::spindle_stop: run_spindle(1, ir::SpindleState::off); return true;
    default: break;
  }
  Move move = move_from_here();
  move.to[ir::axis::x] = m.to.x;
  move.to[ir::axis::z] = m.to.z;
  move.feed = m.has_feed ? m.feed : feed_now();
  move.feed_degrees.reset();
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
      if (!cycle_pitch(like, move.pitch)) return false;
      move.start_angle = m.start_angle;
      move.pitch_change = m.pitch_change;
      break;
    }
    default: move.kind = Move::Kind::linear; break;
  }
  if (!emit_move(move, false)) return false;
  p_ = move.to;
  has_path_ = false;
  return true;
}

}  // namespace cnctrans::interpreter
