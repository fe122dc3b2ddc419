// Motion of a block: end points of lines, threads, probing, machine coordinates.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/machine/block_machine.h"
#include "interpreter/machine/plane_points.h"
#include "interpreter/trace/run_codes.h"
#include "ir/motion_kinds.h"
#include "machine/data_at_rest.h"

namespace cnctrans::interpreter {

namespace {

constexpr std::string_view no_machine_point =
    "a point of the machine in X, Y or C while they are coordinates of the face or the cylinder";

/// Words of the axes that the face and the cylinder of a turning part take up.
bool names_turned_axes(const ir::Motion& m) {
  return std::any_of(m.coords.begin(), m.coords.end(), [](const ir::CoordWord& w) {
    return w.axis == ir::axis::x || w.axis == ir::axis::y || w.axis == ir::axis::c;
  });
}
}  // namespace

bool BlockMachine::motion(const ir::Block& b, bool with_cycle) {
  const auto& m = b.motion;
  auto kind = m.kind;
  // A straight code beside a point of a curve with a number says nothing: its blocks are points.
  const bool point = curve_.from_first_point && ir::is_spline(modal_.motion) &&
                     (kind == ir::MotionKind::rapid || kind == ir::MotionKind::linear);
  if (kind == ir::MotionKind::modal || point) {
    kind = modal_.motion;
  } else if (m.keeps_modal) {
    modal_.motion = ir::left_in_force(kind);
  }
  if (curve_.open && !leave_curve(kind)) return false;
  if (m.explicit_code && ir::is_spline(kind)) curve_.broken = false;
  if (kind == ir::MotionKind::reference_point) {
    if (profile_.policies.cycle_plane_function == machine::CyclePlaneFunction::ends)
      cycle_.hole.reset();  // the search for home ends it as well
    return reference_move(m);
  }
  if (kind == ir::MotionKind::fixed_point) return fixed_point_move(m);
  if (!m.moves()) return true;
  if (!m.coords.empty() && m.centers.empty() && !m.extra &&
      std::all_of(m.coords.begin(), m.coords.end(),
                  [](const auto& w) { return w.positioning != ir::Positioning::with_path; })) {
    return positioning_moves(m);
  }
  now_.moves = true;
  if (cycle_.hole && profile_.policies.cycle_positioning == machine::CyclePositioning::rapid && !m.explicit_code &&
      kind != ir::MotionKind::rapid && with_cycle && (now_.cycle_defined || cycle_triggers(b))) {
    kind = ir::MotionKind::rapid;
  }
  if (ir::is_spline(kind)) return spline_point(m, kind);
  if (kind == ir::MotionKind::polynomial) return polynomial(m);
  const bool rapid = kind == ir::MotionKind::rapid;
  if (m.frame == ir::FrameUse::normal) {
    const bool quick = plain_frame_ && !m.extra && contour_.elements.empty() && !now_.marks.any() &&
                       increments_.pending == 0 && !pending_ && !now_.corner && modal_corner_.size == 0 && !curve_.open;
    if (quick && (rapid || kind == ir::MotionKind::linear)) return quick_line(m, rapid);
    return general_motion(m, kind);
  }
  if (m.frame != ir::FrameUse::no_programmable) return machine_move(m, kind);
  const Frame whole = frame_;
  const bool done = use_frame(zeros_.outside()) && general_motion(m, kind);
  return done && use_frame(whole);
}

/// The common case: straight, Cartesian, nothing but a shift between work and machine.
bool BlockMachine::quick_line(const ir::Motion& m, bool rapid) {
  auto& to = path_event_.to.value;
  const std::array<double, 3> from{p_[0], p_[1], p_[2]};
  std::uint32_t moved = 0;
  bool linear = false;
  for (const auto& w : m.coords) {
    const auto a = w.axis;
    if (!check_axis(a)) return false;
    const auto& axis = axis_[a];
    const bool absolute = w.mode == ir::WordMode::absolute ||
                          (w.mode == ir::WordMode::modal && modal_.distance == ir::Distance::absolute);
    double x = 0;
    if (w.scale == ir::WordScale::modal) {
      x = value(w.value) * (absolute ? axis.scale_absolute : axis.scale_incremental);
    } else {
      x = coordinate(a, w.value, w.scale, absolute);
    }
    if (!absolute) {
      x += p_[a];
    } else if (w.direction != ir::RotaryDirection::as_value) {
      x = rotary_target(w, x);
    }
    p_[a] = x;
    x += frame_.t[a];
    if (std::abs(x - to[a]) > no_move) {
      moved |= 1U << a;
      linear = linear || !axis.rotary;
    }
    travel_.way[a] += std::abs(x - to[a]);
    to[a] = x;
  }
  if (failure_.set) return false;
  if (moved == 0) return true;
  last_.before = from;
  last_.arc = false;
  last_.known = true;
  path_event_.kind = rapid ? EventKind::rapid : EventKind::linear;
  path_event_.feed = linear ? feed_now() : feed_degrees();
  path_event_.feed_mode = modal_.feed_mode;
  path_event_.in_machine = false;
  path_event_.zero_open = zeros_.open();
  path_event_.number = spindles_.master_number();
  path_event_.stop = path_stop();
  path_event_.centre_side = modal_.comp;
  if (modal_.comp != ir::CompSide::off) path_event_.plane = modal_.plane;
  tool_.put_offset(path_event_, moved, modal_);
  emitter_.emit(path_event_);
  return true;
}

namespace {

/// Absolute target on a modulo axis, unwrapped from where the axis stands.
double unwrapped(ir::RotaryDirection direction, double v, double here) {
  double target = v;
  if (direction == ir::RotaryDirection::by_sign) {
    direction = std::signbit(v) ? ir::RotaryDirection::negative : ir::RotaryDirection::positive;
    target = std::abs(v);
  }
  double turn = std::fmod(target - here, 360);
  if (std::abs(turn) < no_move || std::abs(std::abs(turn) - 360) < no_move) return here;
  switch (direction) {
    case ir::RotaryDirection::positive:
      if (turn < 0) turn += 360;
      break;
    case ir::RotaryDirection::negative:
      if (turn > 0) turn -= 360;
      break;
    case ir::RotaryDirection::shortest:
      if (turn > 180) turn -= 360;
      if (turn <= -180) turn += 360;
      break;
    case ir::RotaryDirection::as_value:
    case ir::RotaryDirection::by_sign: return v;
  }
  return here + turn;
}

}  // namespace

/// The sign of 0 is the one that the word says (`C-L1` turns backwards to 0): variables hold no zero with a sign.
double BlockMachine::rotary_target(const ir::CoordWord& w, double v) const {
  if (v == 0 && !w.value.literal()) {
    const auto* minus = std::get_if<ir::Unary>(&w.value.expr->node);
    v = minus != nullptr && minus->op == ir::UnaryOp::negate ? -0.0 : 0.0;
  }
  return unwrapped(w.direction, v, p_[w.axis]);
}

PathStop BlockMachine::path_stop() const {
  return {now_.feed_stop || modal_.path_mode == ir::PathMode::exact_stop, now_.feed_stop};
}

Move BlockMachine::move_from_here() const {
  Move move;
  move.from = move.to = p_;
  move.plane = modal_.plane;
  move.comp = modal_.comp;
  move.feed = feed_now();
  move.feed_degrees = feed_degrees();
  move.feed_mode = modal_.feed_mode;
  move.stop = path_stop();
  move.file = failure_.where.file;
  move.line = failure_.where.line;
  return move;
}

bool BlockMachine::general_motion(const ir::Motion& m, ir::MotionKind kind) {
  Move move = move_from_here();
  if (!contour_.elements.empty() || now_.marks.any()) return contour_element(m, kind, move);
  if (!end_point(m, move)) return false;
  switch (kind) {
    case ir::MotionKind::rapid: move.kind = Move::Kind::rapid; break;
    case ir::MotionKind::linear:
    case ir::MotionKind::to_stop:
    case ir::MotionKind::tap_floating: move.kind = Move::Kind::linear; break;
    case ir::MotionKind::tap_rigid:
    case ir::MotionKind::tap_rigid_out:
    case ir::MotionKind::thread:
    case ir::MotionKind::thread_variable:
      if (!thread(m, kind == ir::MotionKind::thread_variable, move)) return false;
      break;
    case ir::MotionKind::probe_toward:
    case ir::MotionKind::probe_away:
      move.kind = Move::Kind::probe;
      move.toward = kind == ir::MotionKind::probe_toward;
      break;
    default:
      if (ir::is_any_arc(kind) && !arc(m, kind, move)) return false;
  }
  if (m.extra && m.extra->has_probe_edge) {
    if (move.kind != Move::Kind::linear && move.kind != Move::Kind::rapid)
      return failure_.fail(code::not_carried, "only straight moves are carried out with a probe");
    move.kind = Move::Kind::probe;
    // Up to the falling edge: until the probe is free.
    move.toward = m.extra->probe_goes_on || value(m.extra->probe_edge) >= 0;
  }
  if (failure_.set || !send(move)) return false;
  if (kind == ir::MotionKind::tap_rigid_out) run_master(ir::SpindleState::off);  // it has followed the axis to its end
  return true;
}

/// Coordinates of the end in the work frame: Cartesian words, polar words, a line by its angle.
bool BlockMachine::end_point(const ir::Motion& m, Move& move) {
  for (const auto& w : m.coords) {
    const auto a = w.axis;
    if (!check_axis(a)) return false;
    const bool absolute = w.mode == ir::WordMode::absolute ||
                          (w.mode == ir::WordMode::modal && modal_.distance == ir::Distance::absolute);
    const double x = coordinate(a, w.value, w.scale, absolute);
    const bool from_base = ((increments_.pending >> a) & 1U) != 0;
    if (absolute) {
      move.to[a] = w.direction == ir::RotaryDirection::as_value ? x : rotary_target(w, x);
    } else {
      move.to[a] = x + (from_base ? increments_.from[a] : p_[a]);
    }
    increments_.pending &= ~(1U << a);
  }
  if (failure_.set || !m.extra) return !failure_.set;
  if (!m.extra->computed.empty() && !computed_words(m, move)) return false;
  const auto kind = m.kind == ir::MotionKind::modal ? modal_.motion : m.kind;
  const bool about_pole = kind == ir::MotionKind::arc_cw || kind == ir::MotionKind::arc_ccw;  // see polar_arc
  if ((m.extra->has_polar_radius || m.extra->has_polar_angle) && !about_pole) return polar_end(m, move);
  return !m.extra->has_line_angle || line_by_angle(m, move);
}

bool BlockMachine::polar_end(const ir::Motion& m, Move& move) {
  const auto& x = *m.extra;
  const auto plane = ir::plane_axes(modal_.plane);
  const bool cartesian = std::any_of(m.coords.begin(), m.coords.end(),
                                     [&](const auto& w) { return w.axis == plane.u || w.axis == plane.v; });
  if (!check_axis(plane.u) || !check_axis(plane.v)) return false;
  const Vec here = Vec{p_[plane.u], p_[plane.v]} - polar_.pole;
  double radius = length(here);
  double angle = radius < same_point ? 0 : std::atan2(here.v, here.u) * 180 / std::numbers::pi;
  if (x.has_polar_radius) {
    polar_.radius = radius = value(x.polar_radius) * unit() + (counts_absolutely(x.polar_mode) ? 0 : radius);
  } else if (profile_.policies.polar_radius == machine::PolarRadius::programmed && polar_.radius) {
    radius = *polar_.radius;
  }
  if (x.has_polar_angle) angle = value(x.polar_angle) + (counts_absolutely(x.polar_angle_mode) ? 0 : angle);
  if (radius < 0) return failure_.fail(code::polar, "the polar radius becomes negative");
  if (cartesian) return failure_.fail(code::polar, "a coordinate of the plane stands beside polar words");
  move.to[plane.u] = polar_.pole.u + radius * cos_degrees(angle);
  move.to[plane.v] = polar_.pole.v + radius * sin_degrees(angle);
  increments_.pending &= ~(1U << plane.u | 1U << plane.v);
  return !failure_.set;
}

/// The direction of the line and one coordinate of the plane give the other.
bool BlockMachine::line_by_angle(const ir::Motion& m, Move& move) {
  const auto plane = ir::plane_axes(modal_.plane);
  const double angle = value(m.extra->line_angle);
  const double s = sin_degrees(angle), c = cos_degrees(angle);
  bool has_u = false, has_v = false;
  for (const auto& w : m.coords) {
    has_u = has_u || w.axis == plane.u;
    has_v = has_v || w.axis == plane.v;
  }
  if (has_u == has_v)
    return failure_.fail(code::polar, "a line by its angle needs exactly one coordinate of the plane");
  if (!check_axis(plane.u) || !check_axis(plane.v)) return false;
  const double along = has_u ? c : s, across = has_u ? s : c;
  const double travel = has_u ? move.to[plane.u] - move.from[plane.u] : move.to[plane.v] - move.from[plane.v];
  if (std::abs(along) < 1e-12 && std::abs(travel) > no_move) {
    return failure_.fail(code::polar, "a line at this angle never reaches the coordinate");
  }
  const double other = std::abs(travel) <= no_move ? 0 : travel * across / along;
  increments_.pending &= ~(1U << plane.u | 1U << plane.v);
  if (has_u) {
    move.to[plane.v] = move.from[plane.v] + other;
  } else {
    move.to[plane.u] = move.from[plane.u] + other;
  }
  return !failure_.set;
}

bool BlockMachine::thread(const ir::Motion& m, bool variable, Move& move) {
  move.kind = Move::Kind::thread;
  const bool joins = thread_.end == emitter_.seen() && modal_.path_mode == ir::PathMode::continuous;
  if (joins) move.start_angle = path_event_.start_angle;  // on in the groove of the thread before it
  if (m.extra) {
    const auto& x = *m.extra;
    if (x.has_lead) thread_.lead = value(x.lead) * unit();
    if (variable) move.pitch_change = value(x.lead_change) * unit();
    if (x.has_start_angle) move.start_angle = value(x.start_angle);
    if (profile_.policies.thread_start_angle == machine::ThreadStartAngle::modal && x.has_start_angle)
      thread_.start_angle = move.start_angle;
  }
  if (profile_.policies.thread_start_angle == machine::ThreadStartAngle::modal) move.start_angle = thread_.start_angle;
  // No pitch and no change of it behind a thread of variable pitch: on with the pitch reached there.
  if (variable && thread_.lead == 0 && move.pitch_change == 0) thread_.lead = thread_.reached_pitch;
  move.pitch = thread_.lead;
  if (thread_.lead == 0) return failure_.fail(code::thread_pitch, "the thread has no pitch");
  const auto way = [&move](ir::AxisId a) { return std::abs(move.to[a] - move.from[a]); };
  double travel = 0;
  for (const auto a : axes_) travel = std::max(travel, way(a));
  // The trace has the pitch along the longest way.
  if (m.extra && m.extra->has_lead && m.extra->lead_axis != ir::axis::none && way(m.extra->lead_axis) > no_move)
    move.pitch *= travel / way(m.extra->lead_axis);
  const double square = thread_.lead * thread_.lead + 2 * move.pitch_change * travel;
  if (square < 0) return failure_.fail(code::thread_pitch, "the pitch of the thread falls to zero before its end");
  thread_.reached_pitch = std::copysign(std::sqrt(square), thread_.lead);
  return !failure_.set;
}

/// Coordinates of the machine itself; the frame stays out of it.
bool BlockMachine::machine_move(const ir::Motion& m, ir::MotionKind kind) {
  if (ir::turns_part(modal_.surface) && names_turned_axes(m))
    return failure_.fail(code::surface, std::string(no_machine_point));
  if (pending_ || now_.corner || !contour_.elements.empty())
    return failure_.fail(code::corner_alone,
                         "a corner or an open contour cannot stand beside a move in machine coordinates");
  if (kind != ir::MotionKind::rapid && kind != ir::MotionKind::linear) {
    return failure_.fail(code::not_carried, "only straight moves are carried out in machine coordinates");
  }
  if (!zeros_.base().is_identity()) {  // some controls keep the base frames here, depending on the code
    return failure_.fail(code::not_carried, "moves in machine coordinates under a base frame are not carried out");
  }
  Axes machine = frame_.apply(p_);
  const double metric =
      profile_.policies.machine_move_units == machine::MachineMoveUnits::machine && modal_.units == ir::Units::inch
          ? 1 / 25.4
          : 1;
  for (const auto& w : m.coords) {
    if (!check_axis(w.axis)) return false;
    const bool incremental =
        w.mode == ir::WordMode::incremental ||
        (w.mode == ir::WordMode::modal && profile_.policies.machine_move_words != machine::MachineMoveWords::absolute &&
         modal_.distance == ir::Distance::incremental);
    const double x = coordinate(w.axis, w.value, w.scale, !incremental) * (axis_[w.axis].rotary ? 1 : metric);
    if (incremental)
      machine[w.axis] += x;
    else
      machine[w.axis] = w.direction == ir::RotaryDirection::as_value ? x : unwrapped(w.direction, x, machine[w.axis]);
    increments_.pending &= ~(1U << w.axis);
  }
  if (failure_.set) return false;
  Move move = move_from_here();
  move.kind = kind == ir::MotionKind::rapid ? Move::Kind::rapid : Move::Kind::linear;
  move.to = inverse_.apply(machine);
  move.in_machine = true;
  return send(move);
}

/// To the reference point of the named axes (machine coordinates of the profile), in rapid.
bool BlockMachine::reference_move(const ir::Motion& m) {
  if (ir::turns_part(modal_.surface) && names_turned_axes(m))
    return failure_.fail(code::surface, std::string(no_machine_point));
  std::vector<double> points;
  for (const auto& w : m.coords) {
    if (!check_axis(w.axis)) return false;
    points.push_back(profile_.axis(w.axis)->reference_point);
  }
  return to_machine_points(m, points);
}

/// To a fixed point of the machine, in rapid; only the profile says where it is.
bool BlockMachine::fixed_point_move(const ir::Motion& m) {
  if (ir::turns_part(modal_.surface) && names_turned_axes(m))
    return failure_.fail(code::surface, std::string(no_machine_point));
  const double n = m.extra && m.extra->has_fixed_point ? std::round(value(m.extra->fixed_point)) : 1;
  if (failure_.set) return false;
  std::vector<double> points;
  for (const auto& w : m.coords) {
    if (!check_axis(w.axis)) return false;
    const auto& spec = *profile_.axis(w.axis);
    const std::string name = "fixed point " + number_text(n) + " of axis " + spec.name;
    if (const auto rest = machine::data_at_rest(profile_, name); rest && n >= 1 && spec.fixed_points.empty()) {
      data_.assume(failure_.where, name, *rest, "\"fixed_points\" of the axis in the profile give the real one");
      points.push_back(*rest);
      continue;
    }
    if (!(n >= 1 && n <= static_cast<double>(spec.fixed_points.size()))) {
      return failure_.fail(code::no_datum,
                           name + " is known to the machine only; \"fixed_points\" in the profile gives it");
    }
    points.push_back(spec.fixed_points[static_cast<std::size_t>(n) - 1]);
  }
  return to_machine_points(m, points);
}

bool BlockMachine::to_machine_points(const ir::Motion& named, const std::vector<double>& points) {
  ir::Motion to;
  to.frame = ir::FrameUse::machine;
  const double metric =
      profile_.policies.machine_move_units == machine::MachineMoveUnits::machine && modal_.units == ir::Units::inch
          ? 1
          : unit();
  for (std::size_t i = 0; i < named.coords.size(); ++i) {
    ir::CoordWord word;
    word.axis = named.coords[i].axis;
    word.scale = ir::WordScale::radius;
    word.mode = ir::WordMode::absolute;
    word.value = ir::Value(points[i] / (axis_[word.axis].rotary ? 1 : metric));
    to.coords.push_back(word);
  }
  now_.moves = !to.coords.empty();
  return to.coords.empty() || machine_move(to, ir::MotionKind::rapid);
}

/// Axes that move by themselves, each at its own feed, one after the other in the order of the words.
bool BlockMachine::positioning_moves(const ir::Motion& m) {
  if (m.frame != ir::FrameUse::normal)
    return failure_.fail(code::not_carried, "a positioning axis in machine coordinates is not carried out");
  for (const auto& w : m.coords) {
    ir::Motion one;
    one.coords.push_back(w);
    Move move = move_from_here();
    if (!end_point(one, move)) return false;
    const double feed = axis_feed_[w.axis];
    move.kind = feed > 0 ? Move::Kind::linear : Move::Kind::rapid;
    move.feed = feed;
    move.feed_degrees.reset();
    move.feed_mode = ir::FeedMode::per_minute;
    if (!send(move)) return false;
  }
  return true;
}

/// Words whose axis a variable names.
bool BlockMachine::computed_words(const ir::Motion& m, Move& move) {
  for (const auto& w : m.extra->computed) {
    const double a = std::round(value(ir::Value(w.axis)));
    if (failure_.set) return false;
    if (!(a >= 0 && a < ir::axis::count_max)) return failure_.fail(code::no_axis, "this variable names no axis");
    const auto axis = static_cast<ir::AxisId>(a);
    if (!check_axis(axis)) return false;
    ir::Motion one;
    ir::CoordWord word;
    word.axis = axis;
    word.mode = w.mode;
    word.value = w.value;
    one.coords.push_back(word);
    if (!end_point(one, move)) return false;
  }
  return true;
}

}  // namespace cnctrans::interpreter
