// From resolved moves to events; corners between two elements.
#include <algorithm>
#include <cmath>

#include "interpreter/machine/block_machine.h"
#include "interpreter/machine/plane_points.h"
#include "interpreter/trace/run_codes.h"

namespace cnctrans::interpreter {

namespace {

void put(Axes& p, const ir::PlaneAxes& plane, Vec v) {
  p[plane.u] = v.u;
  p[plane.v] = v.v;
}

Element element_of(const Move& m) {
  const auto plane = ir::plane_axes(m.plane);
  Element e;
  e.arc = m.kind == Move::Kind::arc;
  e.a = at(m.from, plane);
  e.b = at(m.to, plane);
  e.c = m.centre;
  e.ccw = m.ccw;
  return e;
}

bool is_contour(const Move& m) {
  return m.kind == Move::Kind::linear || m.kind == Move::Kind::arc;
}

bool in_plane(const Move& m) {
  const auto plane = ir::plane_axes(m.plane);
  return m.kind == Move::Kind::arc || length(at(m.to, plane) - at(m.from, plane)) > same_point;
}

/// The other axes of a point at `part` of the move.
Axes between(const Move& m, double part) {
  Axes p = m.from;
  for (std::size_t i = 0; i < p.size(); ++i) p[i] += part * (m.to[i] - m.from[i]);
  return p;
}

}  // namespace

/// A mirrored axis of the plane swaps left and right on every control.
void BlockMachine::put_centre_side(Event& e, ir::CompSide side, ir::Plane plane) const {
  e.centre_side = side;
  if (side == ir::CompSide::off) return;
  e.plane = plane;
  if (plain_frame_ || !plane_map(frame_, plane).mirrored) return;
  e.centre_side = side == ir::CompSide::left ? ir::CompSide::right : ir::CompSide::left;
}

/// A move goes out, or waits because its end is a corner.
bool BlockMachine::send(const Move& given) {
  if (curve_.open && !close_curve(&given)) return false;
  Move move = given;
  const Axes end = move.to;
  if (pending_ && !join(move)) return false;
  if (pending_) return true;  // nothing moved: the corner still waits
  if (!hold_if_corner(move) && !emit_move(move, false)) return false;
  Move done = given;
  done.to = end;
  arrived(done);
  return true;
}

void BlockMachine::arrived(const Move& move) {
  if (increments_.pending != 0) {  // increments go on from here, whatever said the end point
    for (const auto a : axes_) increments_.pending &= move.to[a] != move.from[a] ? ~(1U << a) : ~0U;
  }
  p_ = move.to;
  if (move.kind == Move::Kind::arc || move.from != move.to) {
    for (std::size_t i = 0; i < 3; ++i) last_.before[i] = move.from[i];
    last_.arc = move.kind == Move::Kind::arc;
    last_.centre = move.centre;
    last_.ccw = move.ccw;
    last_.known = true;
  }
}

bool BlockMachine::hold_if_corner(const Move& move) {
  if (!now_.corner && (now_.sharp || modal_corner_.size <= 0 || !is_contour(move))) return false;
  if (!in_plane(move)) {
    if (now_.corner && without_corner("a corner function needs a move in the plane")) now_.corner.reset();
    return false;
  }
  if (now_.corner) {
    pending_ = now_.corner;
    now_.corner.reset();
  } else {
    pending_ = Pending{};
    pending_->modal = true;
    pending_->size = modal_corner_.size;
    pending_->has_feed = modal_corner_.has_feed;
    pending_->feed = modal_corner_.feed;
  }
  pending_->move = move;
  pending_->frame_serial = frame_serial_;
  emitter_.hold();
  return true;
}

void BlockMachine::release_pending() {
  const Move move = pending_->move;
  pending_.reset();
  emit_move(move, true);
  emitter_.release();
}

/// A corner function that finds no second element. False: a fault.
bool BlockMachine::without_corner(const std::string& why) {
  if (profile_.policies.corner_without_successor != machine::CornerWithoutSuccessor::left_out)
    return failure_.fail(code::corner_alone, why);
  const auto& where = failure_.where;
  const auto same = [&](const auto& c) { return c.first == where; };
  if (std::none_of(corners_left_out_.begin(), corners_left_out_.end(), same))
    corners_left_out_.emplace_back(where, why);
  return true;
}

/// The waiting move meets its successor: both are cut back and the corner goes between them.
bool BlockMachine::join(Move& next) {
  if (next.kind != Move::Kind::arc && next.from == next.to) return true;
  const Pending p = *pending_;
  const bool ends_contour =
      !is_contour(next) || !in_plane(next) || p.frame_serial != frame_serial_ || p.move.plane != next.plane;
  if (p.modal && ends_contour) {
    release_pending();
    return true;
  }
  if (next.kind == Move::Kind::thread || !in_plane(next) || p.frame_serial != frame_serial_ ||
      p.move.plane != next.plane) {
    release_pending();
    return without_corner("what follows the corner is no move in the same plane and frame");
  }
  const Element a = element_of(p.move), b = element_of(next);
  Fillet f;
  std::string error;
  if (!corner_between(p, a, b, f, error)) {
    release_pending();
    const bool back = p.modal && ir::geometry::interior_angle(a, b) < 1e-4;
    return back ? without_corner(error) : failure_.fail(code::corner_fit, error);
  }
  if (f.none) {
    release_pending();
    if (p.modal || p.tangential || profile_.policies.corner_straight_on != machine::CornerStraightOn::refused)
      return true;
    return failure_.fail(code::corner_fit, "a corner function between two elements that meet without a corner");
  }
  const auto plane = ir::plane_axes(next.plane);
  Move first = p.move, corner = p.move;
  if (!p.tangential || !p.exit) {
    if (!p.tangential) first.to = between(p.move, a.part_at(f.from));
    put(first.to, plane, f.from);
  }
  if (!p.tangential || p.exit) {
    next.from = between(next, b.part_at(f.to));
    put(next.from, plane, f.to);
  }
  corner.from = first.to;
  corner.to = next.from;
  put(corner.to, plane, f.to);
  corner.turns = 0;
  const bool straight = !p.tangential && p.corner != ir::CornerKind::round;
  corner.kind = straight ? Move::Kind::linear : Move::Kind::arc;
  corner.centre = f.centre;
  corner.ccw = f.ccw;
  if (p.has_feed) corner.feed = p.feed;
  corner.feed_degrees.reset();
  pending_.reset();
  return emit_joint(first, corner);
}

bool BlockMachine::emit_joint(const Move& first, const Move& corner) {
  const bool good = emit_move(first, true) && emit_move(corner, true);
  emitter_.release();
  path_event_.file = failure_.where.file;
  path_event_.line = failure_.where.line;
  return good;
}

bool BlockMachine::corner_between(const Pending& p, const Element& a, const Element& b, Fillet& f, std::string& error) {
  if (p.tangential) return p.exit ? tangential_exit(a, b, p.size, f, error) : tangential_entry(a, b, p.size, f, error);
  if (p.corner == ir::CornerKind::round) return fillet(a, b, p.size, f, error);
  double leg = p.size;
  if (p.corner == ir::CornerKind::chamfer_chord) {
    const double s = sin_degrees(interior_angle(a, b) / 2);
    if (s > 0) leg = p.size / (2 * s);
  }
  const bool at_arc = (a.arc || b.arc) && profile_.policies.corner_chamfer_at_arc;
  return at_arc ? ir::geometry::chamfer_along(a, b, leg, f, error) : chamfer(a, b, leg, f, error);
}

/// The way that each axis goes; on an arc to its outermost points and back.
void BlockMachine::add_travel(const Axes& from, const Event& e) {
  const bool arc = e.kind == EventKind::arc;
  const auto plane = ir::plane_axes(e.plane);
  for (const auto a : axes_) {
    if (!arc || (a != plane.u && a != plane.v)) travel_.way[a] += std::abs(e.to.value[a] - from[a]);
  }
  if (!arc) return;
  const double radius = std::hypot(from[plane.u] - e.center_u, from[plane.v] - e.center_v);
  const double begin = std::atan2(from[plane.v] - e.center_v, from[plane.u] - e.center_u);
  const double end = std::atan2(e.to.value[plane.v] - e.center_v, e.to.value[plane.u] - e.center_u);
  const double pi = std::acos(-1.0);
  double sweep = e.cw ? begin - end : end - begin;
  while (sweep <= 1e-9) sweep += 2 * pi;
  sweep += 2 * pi * e.turns;
  // Between two neighbouring extremes the cosine falls or rises all the way.
  const auto way = [&](double at) {
    double sum = 0, done = 0;
    while (done < sweep) {
      const double here = e.cw ? at - done : at + done;
      const double step =
          e.cw ? here - pi * (std::ceil(here / pi - 1e-12) - 1) : pi * (std::floor(here / pi + 1e-12) + 1) - here;
      const double next = std::min(done + step, sweep);
      sum += std::abs(std::cos(e.cw ? at - next : at + next) - std::cos(here));
      done = next;
    }
    return sum * radius;
  };
  travel_.way[plane.u] += way(begin);
  travel_.way[plane.v] += way(begin - pi / 2);
}

/// Maps a move to the machine and emits it; a move that changes nothing makes no event (a full circle does).
bool BlockMachine::emit_move(const Move& move, bool past_held) {
  if (curve_.open && !past_held && !close_curve(&move)) return false;
  Axes to = move.to;
  if (plain_frame_) {
    for (const auto a : axes_) to[a] += frame_.t[a];
  } else {
    to = frame_.apply(to);
  }
  auto& e = path_event_;
  const Axes from = e.to.value;
  std::uint32_t moved = 0;
  bool linear = move.kind == Move::Kind::arc || !move.feed_degrees;
  for (const auto a : axes_) {
    if (std::abs(to[a] - e.to.value[a]) <= no_move) continue;
    e.to.value[a] = to[a];
    moved |= 1U << a;
    linear = linear || !axis_[a].rotary;
  }
  if (moved == 0 && move.kind != Move::Kind::arc) return true;
  e.file = move.file;
  e.line = move.line;
  e.feed = linear ? move.feed : *move.feed_degrees;
  e.feed_mode = move.feed_mode;
  e.in_machine = move.in_machine;
  e.zero_open = zeros_.open() && !move.in_machine;
  e.number = spindles_.master_number();
  e.stop = move.stop;
  put_centre_side(e, move.comp, move.plane);
  tool_.put_offset(e, moved, modal_);
  switch (move.kind) {
    case Move::Kind::rapid: e.kind = EventKind::rapid; break;
    case Move::Kind::linear: e.kind = EventKind::linear; break;
    case Move::Kind::probe:
      e.kind = EventKind::probe;
      e.change = move.toward;
      break;
    case Move::Kind::thread:
      e.kind = EventKind::thread;
      e.pitch = move.pitch;
      e.pitch_change = move.pitch_change;
      e.start_angle = move.start_angle;
      e.css = spindles_.master().mode == ir::SpindleMode::css;
      e.value = spindles_.master().speed();
      break;
    case Move::Kind::arc: {
      const auto plane = ir::plane_axes(move.plane);
      Axes centre = move.to;
      put(centre, plane, move.centre);
      PlaneMap map{true, false};
      if (!plain_frame_) map = plane_map(frame_, move.plane);
      if (!map.circles) {
        return failure_.fail(code::arc_frame,
                             "an arc under unequal scales or in a tilted frame is not carried out yet");
      }
      centre = frame_.apply(centre);
      e.kind = EventKind::arc;
      e.plane = move.plane;
      e.center_u = centre[plane.u];
      e.center_v = centre[plane.v];
      e.cw = move.ccw == map.mirrored;
      e.turns = move.turns;
      break;
    }
  }
  add_travel(from, e);
  if (past_held) {
    emitter_.pass(e);
  } else {
    emitter_.emit(e);
  }
  if (e.kind == EventKind::thread) thread_.end = emitter_.seen();
  return true;
}

}  // namespace cnctrans::interpreter
