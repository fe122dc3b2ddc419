// Patterns of points: the way to each, and the machining in force there.
#include <cmath>

#include "interpreter/machine/block_machine.h"
#include "interpreter/trace/run_codes.h"
#include "ir/cycles/pattern.h"

namespace cnctrans::interpreter {

bool BlockMachine::start_pattern(const ir::NamedCycle& c) {
  if (pattern_.open != nullptr)
    return failure_.fail(code::not_carried, "a pattern in a modal subprogram that runs at the points of a pattern");
  pattern_.cycle = &c;
  pattern_.points.clear();
  pattern_.next = 0;
  const auto* pattern = ir::cycles::find_pattern(c.name);
  ir::cycles::PatternNumbers numbers;
  for (const auto& [word, v] : c.words) {
    const auto* p = ir::cycles::find_pattern_parameter(word);
    if (p == nullptr) return failure_.fail(code::bad_cycle, "the pattern " + c.name + " has no parameter " + word);
    const double x = value(v);
    const bool length = p->quantity == ir::cycles::PatternQuantity::length;
    numbers[p->name] = length ? x * unit() : p->quantity == ir::cycles::PatternQuantity::feed ? x * feed_unit() : x;
  }
  if (failure_.set) return false;
  const auto plane = ir::plane_axes(modal_.plane);
  if (!check_axis(plane.u) || !check_axis(plane.v)) return false;
  std::string error;
  auto points = ir::cycles::pattern_points(*pattern, numbers, p_[plane.u], p_[plane.v], &error);
  if (!points) return failure_.fail(code::bad_cycle, error);
  pattern_.points = std::move(*points);
  return true;
}

/// All points; one at a time where a modal subprogram runs between them.
bool BlockMachine::run_pattern() {
  if (pending_) {
    release_pending();
    return failure_.fail(code::corner_alone, "a pattern follows a corner function");
  }
  const auto* spec = pattern_.cycle != nullptr ? ir::cycles::find_pattern(pattern_.cycle->name) : nullptr;
  if (spec != nullptr && spec->from_tool && !cycle_.hole && !single_points) {
    return failure_.fail(code::bad_cycle,
                         "points of a pattern where no cycle and no modal subprogram is in force: nothing to repeat");
  }
  while (pattern_.next < pattern_.points.size()) {
    if (!to_point(pattern_.points[pattern_.next++])) return false;
    if (cycle_.hole && !run_cycle()) return false;
    if (single_points) break;
  }
  return true;
}

/// Behind a run of the modal subprogram: to the next point, or what the block does behind its last one.
bool BlockMachine::go_on_with_pattern(const ir::Block& b) {
  if (pattern_.next < pattern_.points.size()) return run_pattern();
  pattern_.open = nullptr;
  return actions(b, true) && !failure_.set;
}

bool BlockMachine::to_point(const ir::cycles::PatternPoint& to) {
  using Way = ir::cycles::PatternPoint::Way;
  const auto plane = ir::plane_axes(modal_.plane);
  Move move = move_from_here();
  move.to[plane.u] = to.u;
  move.to[plane.v] = to.v;
  move.kind = to.way == Way::rapid ? Move::Kind::rapid : to.way == Way::linear ? Move::Kind::linear : Move::Kind::arc;
  if (move.kind != Move::Kind::rapid) move.feed = to.feed;
  if (move.kind == Move::Kind::arc) {
    move.plane = modal_.plane;
    move.centre = {to.centre_u, to.centre_v};
    move.ccw = to.way == Way::ccw;
  }
  now_.moves = true;
  if (!emit_move(move, false)) return false;
  p_ = move.to;
  increments_.pending &= ~(1U << plane.u | 1U << plane.v);  // increments go on from the point
  last_.known = false;
  return true;
}

}  // namespace cnctrans::interpreter
