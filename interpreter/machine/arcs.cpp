// Arcs of a block: centre, sense, turns.
#include <cmath>
#include <string>

#include "base/saturate.h"
#include "base/text.h"
#include "interpreter/machine/block_machine.h"
#include "interpreter/machine/plane_points.h"
#include "interpreter/trace/run_codes.h"

namespace cnctrans::interpreter {

bool BlockMachine::arc(const ir::Motion& m, ir::MotionKind kind, Move& move) {
  const auto plane = ir::plane_axes(move.plane);
  if (!check_axis(plane.u) || !check_axis(plane.v)) return false;
  move.kind = Move::Kind::arc;
  move.ccw = kind == ir::MotionKind::arc_ccw;
  if (kind == ir::MotionKind::arc_through_point) return through_arc(m, move) && arc_turns(m, move);
  if (kind == ir::MotionKind::arc_tangent)
    return tangent_arc(move) && (move.kind != Move::Kind::arc || arc_turns(m, move));
  const auto* x = m.extra.get();
  if (x != nullptr && (x->has_polar_angle || x->has_polar_radius)) return polar_arc(m, move) && arc_turns(m, move);
  if (x != nullptr && x->has_angle) return opening_arc(m, move) && arc_turns(m, move);
  if (m.radius_given) {
    std::string error;
    const Vec p0 = at(move.from, plane), p1 = at(move.to, plane);
    const double r = value(m.radius) * unit();
    if (failure_.set) return false;
    if (!centre_by_radius(p0, p1, r, move.ccw, profile_.arc_tolerance, move.centre, error)) {
      return failure_.fail(code::arc_radius, error);
    }
    return arc_turns(m, move);
  }
  return arc_centre(m, move) && check_radii(move) && arc_turns(m, move);
}

/// Centre by its coordinates; a coordinate that is not given is that of the start.
bool BlockMachine::arc_centre(const ir::Motion& m, Move& move) {
  const auto plane = ir::plane_axes(move.plane);
  if (m.centers.empty()) return failure_.fail(code::arc_undefined, "the arc has neither centre nor radius");
  Vec c = at(move.from, plane);
  for (const auto& w : m.centers) {
    if (w.axis != plane.u && w.axis != plane.v) {
      constexpr const char* names[] = {"XY", "ZX", "YZ"};
      std::string text = "a centre coordinate does not lie in the plane of the arc, ";
      text += names[static_cast<std::size_t>(move.plane)];
      if (move.plane == profile_.power_on.plane)
        text += "; if the machine is switched on in another plane, give it (--machine), or select the plane first";
      return failure_.fail(code::arc_undefined, text);
    }
    const bool absolute = w.mode == ir::CenterMode::absolute ||
                          (w.mode == ir::CenterMode::follows_distance && modal_.distance == ir::Distance::absolute);
    const double x = coordinate(w.axis, w.value, w.scale, absolute);
    double& slot = w.axis == plane.u ? c.u : c.v;
    slot = absolute ? x : move.from[w.axis] + x;
  }
  move.centre = c;
  return !failure_.set;
}

bool BlockMachine::check_radii(const Move& move) {
  const auto plane = ir::plane_axes(move.plane);
  const double r0 = length(at(move.from, plane) - move.centre), r1 = length(at(move.to, plane) - move.centre);
  if (r0 < same_point) return failure_.fail(code::arc_radius, "the centre of the arc is its start");
  if (std::abs(r0 - r1) <= profile_.arc_tolerance) return true;
  return failure_.fail(code::arc_radii, "the arc's radius is " + rounded(r0, 4) + " mm at its start and " +
                                            rounded(r1, 4) + " mm at its end; the machine takes a difference of " +
                                            rounded(profile_.arc_tolerance, 4) + " mm");
}

/// End by its angle about the centre (given, or the pole): absolute, or the signed angle turned through.
bool BlockMachine::polar_arc(const ir::Motion& m, Move& move) {
  const auto plane = ir::plane_axes(move.plane);
  const auto& x = *m.extra;
  if (m.centers.empty()) {
    move.centre = polar_.pole;
  } else if (!arc_centre(m, move)) {
    return false;
  }
  const Vec p0 = at(move.from, plane);
  const double r0 = length(p0 - move.centre);
  double r = r0;
  if (x.has_polar_radius)
    polar_.radius = r = value(x.polar_radius) * unit() + (counts_absolutely(x.polar_mode) ? 0 : r0);
  if (x.has_polar_angle || (x.has_polar_radius && r0 > same_point)) {  // without its word the angle stays
    const double a = x.has_polar_angle ? value(x.polar_angle) : 0;
    Vec direction{cos_degrees(a), sin_degrees(a)};
    if (!counts_absolutely(x.polar_angle_mode) || !x.has_polar_angle) {
      const Vec d = (1 / r0) * (p0 - move.centre);
      direction = {d.u * direction.u - d.v * direction.v, d.u * direction.v + d.v * direction.u};
    }
    const Vec p1 = move.centre + r * direction;
    move.to[plane.u] = p1.u;
    move.to[plane.v] = p1.v;
  }
  return !failure_.set && check_radii(move);
}

/// By the opening angle: with the end point (the centre follows) or with the centre (the end follows).
bool BlockMachine::opening_arc(const ir::Motion& m, Move& move) {
  const auto plane = ir::plane_axes(move.plane);
  double angle = value(m.extra->opening_angle);
  if (m.extra->opening_signed) move.ccw = angle > 0;
  angle = std::abs(angle);
  if (failure_.set) return false;
  if (angle == 0 || angle > 360)
    return failure_.fail(code::arc_undefined, "the opening angle of an arc is above 0 and at most 360");
  const Vec p0 = at(move.from, plane);
  if (m.centers.empty()) {
    const double chord = length(at(move.to, plane) - p0);
    const double s = sin_degrees(angle / 2);
    if (chord < same_point || s == 0)
      return failure_.fail(code::arc_undefined, "the opening angle does not give an arc to this end");
    const double r = chord / (2 * s);
    std::string error;
    const bool found =
        centre_by_radius(p0, at(move.to, plane), angle > 180 ? -r : r, move.ccw, same_point, move.centre, error);
    return found || failure_.fail(code::arc_radius, error);
  }
  if (!arc_centre(m, move)) return false;
  const Vec d = p0 - move.centre;
  const double turn = move.ccw ? angle : -angle;
  const double s = sin_degrees(turn), c = cos_degrees(turn);
  move.to[plane.u] = move.centre.u + d.u * c - d.v * s;
  move.to[plane.v] = move.centre.v + d.u * s + d.v * c;
  return check_radii(move);
}

bool BlockMachine::through_arc(const ir::Motion& m, Move& move) {
  const auto plane = ir::plane_axes(move.plane);
  Vec middle = at(move.from, plane);
  if (!m.extra || m.extra->through.empty())
    return failure_.fail(code::arc_undefined, "the point on the arc is missing");
  for (const auto& w : m.extra->through) {
    const bool absolute = w.mode == ir::CenterMode::absolute ||
                          (w.mode == ir::CenterMode::follows_distance && modal_.distance == ir::Distance::absolute);
    const double x = coordinate(w.axis, w.value, w.scale, absolute);
    if (w.axis == plane.u) {
      middle.u = absolute ? x : move.from[plane.u] + x;
    } else if (w.axis == plane.v) {
      middle.v = absolute ? x : move.from[plane.v] + x;
    } else if (std::abs((absolute ? x : move.from[w.axis] + x) - move.from[w.axis]) > same_point) {
      return failure_.fail(code::not_carried, "an arc in space is not carried out yet");
    }
  }
  const bool rises = std::abs(move.to[plane.w] - move.from[plane.w]) > same_point;
  if (rises && profile_.policies.arc_through_point == machine::ArcThroughPoint::in_space)
    return failure_.fail(code::not_carried, "an arc in space is not carried out yet");
  if (failure_.set) return false;
  if (centre_by_three_points(at(move.from, plane), middle, at(move.to, plane), move.centre, move.ccw)) return true;
  return failure_.fail(code::arc_undefined, "the three points of the arc lie on a line");
}

bool BlockMachine::tangent_arc(Move& move) {
  const auto plane = ir::plane_axes(move.plane);
  const Vec direction = last_direction(plane);
  if (length(direction) == 0)
    return failure_.fail(code::arc_undefined, "there is no path element before the tangent arc");
  const Vec start = at(move.from, plane), end = at(move.to, plane);
  if (centre_by_tangent(start, direction, end, move.centre, move.ccw)) return true;
  const Vec way = end - start;
  if (profile_.policies.arc_tangent_straight == machine::ArcTangentStraight::line &&
      way.u * direction.u + way.v * direction.v > 0) {
    move.kind = Move::Kind::linear;
    return true;
  }
  return failure_.fail(code::arc_undefined, "the end of the tangent arc lies straight ahead");
}

/// Direction in which the last element of the plane ended; (0, 0) when there is none.
Vec BlockMachine::last_direction(const ir::PlaneAxes& plane) const {
  if (!last_.known) return {};
  const Vec here{p_[plane.u], p_[plane.v]};
  if (!last_.arc) return normalised(here - Vec{last_.before[plane.u], last_.before[plane.v]});
  const Vec n = left_of(normalised(here - last_.centre));
  return last_.ccw ? n : -1.0 * n;
}

/// Full turns: given, or from a pitch: total turns = travel / pitch, the arc itself included.
bool BlockMachine::arc_turns(const ir::Motion& m, Move& move) {
  const auto plane = ir::plane_axes(move.plane);
  if (profile_.policies.polar_pole_follows_arc) {
    polar_.pole = move.centre;
    polar_.pole_set = true;
  }
  if (!m.extra) return !failure_.set;
  if (m.extra->has_turns) {
    const double given = value(m.extra->turns), n = std::round(given);
    if (!(n >= 0) || n > 1e6)
      return failure_.fail(code::bad_count, "the number of turns of the helix is not between 0 and 1000000");
    if (std::abs(given - n) > 1e-6)
      return failure_.fail(code::bad_count, "the number of turns of the helix is not whole: " + shortest(given));
    move.turns = static_cast<std::int32_t>(n);
  } else if (m.extra->has_pitch) {
    const double pitch = std::abs(value(m.extra->pitch)) * unit();
    const double travel = std::abs(move.to[plane.w] - move.from[plane.w]);
    if (failure_.set) return false;
    if (pitch < same_point) return failure_.fail(code::helix_pitch, "the pitch of the helix is zero");
    const double part = swept_angle(at(move.from, plane), at(move.to, plane), move.centre, move.ccw) / 360;
    const double turns = std::max(0.0, std::round(travel / pitch - part));
    if (profile_.policies.helix_pitch_mismatch != machine::HelixPitchMismatch::nearest &&
        std::abs(travel - pitch * (turns + part)) > 0.01 * pitch) {
      return failure_.fail(code::helix_pitch, "a pitch of " + rounded(pitch, 4) + " mm does not fit a travel of " +
                                                  rounded(travel, 4) + " mm over " + rounded(part * 360, 3) +
                                                  " degrees");
    }
    move.turns = saturate<std::int32_t>(turns);
  }
  // A full circle counts as one turn with 0 added; `turns` are added to it.
  return !failure_.set;
}

}  // namespace cnctrans::interpreter
