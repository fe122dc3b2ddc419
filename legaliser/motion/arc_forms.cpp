// Arcs by radius, through a point, by angle, with pitch or turns.
#include "legaliser/motion/arc_pass.h"

namespace cnctrans::ir::passes {

using namespace geometry;

bool ArcPass::in_plane(Arc& arc) {
  if (!plane_known_ || program_.dialect == context_.target.dialect) return true;
  auto& centers = arc.b.motion.centers;
  std::erase_if(centers, [&arc](const CenterWord& c) {
    return c.axis != arc.axes.u && c.axis != arc.axes.v && c.mode == CenterMode::from_start && c.value.is(0);
  });
  const auto outside = [&arc](const CenterWord& c) { return c.axis != arc.axes.u && c.axis != arc.axes.v; };
  if (std::none_of(centers.begin(), centers.end(), outside)) return true;
  fail(arc, "TRN-653", "a word of the centre of this arc belongs to an axis outside of its plane",
       "select the plane of the arc before it (G17, G18, G19), or name the machine with --machine");
  return false;
}

bool ArcPass::radius(Arc& arc) {
  const Value& r = arc.b.motion.radius;
  const auto& t = context_.target;
  if (!r.literal()) {
    if (t.radius_minor && t.radius_major) return true;
    if (t.radius_minor) {
      context_.diagnostics.warning(
          "TRN-302", word_span(arc.s.line.span, arc.b.motion.radius_pos),
          "the radius is computed; the target takes positive ones only (arcs up to 180 degrees)",
          "make sure that the value is never negative");
      return true;
    }
  } else if (r.number < 0 ? t.radius_major : t.radius_minor) {
    return true;
  }
  if (!r.literal() || !known(arc.start) || !known(arc.end) || !arc.ccw) {
    fail(arc, "TRN-303", "an arc by radius that the target needs by its centre, and its start is not known here",
         "program the arc by its centre");
    return false;
  }
  const auto c = centre_by_radius(point(arc.start), point(arc.end), r.number, *arc.ccw, long_chord);
  if (!c) {
    fail(arc, "TRN-304", "no arc of radius " + shortest(std::fabs(r.number)) + " joins these points",
         "check the radius");
    return false;
  }
  set_center(arc, *c);
  return true;
}

bool ArcPass::through_point(Arc& arc) {
  Motion& m = arc.b.motion;
  std::array<std::optional<double>, 3> mid = arc.start;
  if (m.extra) {
    for (const auto& w : m.extra->through) {
      for (std::size_t i = 0; i < 2; ++i) {
        if (w.axis != arc.axis[i]) continue;
        const bool relative = w.mode == CenterMode::from_start ||
                              (w.mode == CenterMode::follows_distance && arc.distance != Distance::absolute);
        const auto f = to_radius(w.axis, w.scale, relative ? Distance::incremental : Distance::absolute, arc.b,
                                 arc.facts, context_.source_machine);
        mid[i] = f && w.value.literal()
                     ? std::optional(w.value.number * *f + (relative && arc.start[i] ? *arc.start[i] : 0))
                     : std::nullopt;
      }
    }
  }
  if (!known(arc.start) || !known(arc.end) || !known(mid)) {
    fail(arc, "TRN-305", "an arc through a point, and its points are not all known here",
         "program the arc by its centre");
    return false;
  }
  Vec c;
  bool ccw = false;
  if (!centre_by_three_points(point(arc.start), point(mid), point(arc.end), c, ccw)) {
    fail(arc, "TRN-306", "the three points of the arc are in line", "check the point on the arc");
    return false;
  }
  arc.ccw = ccw;
  m.kind = ccw ? MotionKind::arc_ccw : MotionKind::arc_cw;
  m.explicit_code = true;
  m.code_text = {};
  auto extra = std::make_shared<MotionExtra>(*m.extra);
  extra->through.clear();
  m.extra = std::move(extra);
  drop_empty_extra(m);
  set_center(arc, c);
  return true;
}

bool ArcPass::leaves_plane(const Arc& arc, const machine::Profile& machine) const {
  if (machine.policies.arc_through_point != machine::ArcThroughPoint::in_space ||
      program_.dialect == context_.target.dialect)
    return false;
  const Motion& m = arc.b.motion;
  if (m.extra && (m.extra->has_turns || m.extra->has_pitch)) return true;
  const bool named =
      std::any_of(m.coords.begin(), m.coords.end(), [&arc](const CoordWord& c) { return c.axis == arc.axes.w; });
  return named && !(arc.start[2] && arc.end[2] && std::fabs(*arc.start[2] - *arc.end[2]) < same_point);
}

bool ArcPass::through_in_plane(Arc& arc) {
  Motion& m = arc.b.motion;
  if (program_.dialect == context_.target.dialect || !plane_known_ || !m.extra) return true;
  const auto steps = [&arc](const CenterWord& w) {
    return w.mode == CenterMode::from_start ||
           (w.mode == CenterMode::follows_distance && arc.distance == Distance::incremental);
  };
  const auto outside = [&arc](const CenterWord& w) { return w.axis != arc.axes.u && w.axis != arc.axes.v; };
  const auto elsewhere = [&](const CenterWord& w) {
    if (!outside(w)) return false;
    if (w.axis != arc.axes.w || !w.value.literal()) return true;
    return steps(w) ? w.value.number != 0 : !arc.start[2] || std::fabs(*arc.start[2] - w.value.number) >= same_point;
  };
  MotionExtra extra = *m.extra;
  auto& through = extra.through;
  if (std::any_of(through.begin(), through.end(), elsewhere) || leaves_plane(arc, context_.source_machine)) {
    fail(arc, "TRN-653", "the point on this arc or its end lies, or may lie, outside of the plane: an arc in space",
         "give the height before the arc as a number, or select the plane in which the arc lies");
    return false;
  }
  std::erase_if(through, outside);
  for (auto& w : through) {  // a mode of its own, said as that of the block
    const auto& from = arc.start[w.axis == arc.axes.u ? 0 : 1];
    if (w.mode == CenterMode::follows_distance || context_.target.distance_per_word || !w.value.literal() || !from ||
        !arc.distance)
      continue;
    if (is_diameter_axis(context_.source_machine, w.axis)) continue;
    const bool now = *arc.distance == Distance::incremental;
    if (steps(w) != now) w.value = Value{w.value.number + (now ? -*from : *from)};
    w.mode = CenterMode::follows_distance;
  }
  m.extra = std::make_shared<const MotionExtra>(std::move(extra));
  return true;
}

bool ArcPass::opening_angle(Arc& arc) {
  Motion& m = arc.b.motion;
  const auto center = center_point(arc);
  const Value angle = m.extra->opening_angle;
  if (!angle.literal() || !known(arc.start) || !arc.ccw || (!center && !known(arc.end))) {
    fail(arc, "TRN-308", "an arc by its angle, and its start is not known here",
         "program the arc by its centre and end");
    return false;
  }
  auto extra = std::make_shared<MotionExtra>(*m.extra);
  extra->has_angle = false;
  m.extra = std::move(extra);
  drop_empty_extra(m);
  const double sweep = std::fabs(angle.number);
  if (center) {
    const Vec end = turned(point(arc.start), *center, *arc.ccw ? sweep : -sweep);
    arc.end[0] = end.u;
    arc.end[1] = end.v;
    set_end(arc);
    set_center(arc, *center);
    return true;
  }
  const Vec a = point(arc.start), b = point(arc.end);
  const double r = std::hypot(b.u - a.u, b.v - a.v) / (2 * std::sin(sweep * 0.00872664625997164788));
  const auto c = centre_by_radius(a, b, sweep > 180 ? -std::fabs(r) : std::fabs(r), *arc.ccw, long_chord);
  if (c) set_center(arc, *c);
  return c.has_value();
}

void ArcPass::set_end(Arc& arc) {
  std::erase_if(arc.b.motion.coords,
                [&](const CoordWord& c) { return c.axis == arc.axis[0] || c.axis == arc.axis[1]; });
  for (std::size_t i = 0; i < 2; ++i) {
    CoordWord w;
    w.axis = arc.axis[i];
    w.scale = radius_scale(w.axis);
    const bool relative = arc.distance == Distance::incremental;
    if (!arc.distance) w.mode = WordMode::absolute;
    w.value = Value{relative ? *arc.end[i] - *arc.start[i] : *arc.end[i]};
    arc.b.motion.coords.push_back(w);
  }
}

std::optional<Vec> ArcPass::center_point(const Arc& arc) const {
  if (arc.b.motion.centers.empty() || !known(arc.start)) return std::nullopt;
  std::array<double, 2> c{*arc.start[0], *arc.start[1]};
  for (const auto& w : arc.b.motion.centers) {
    for (std::size_t i = 0; i < 2; ++i) {
      if (w.axis != arc.axis[i]) continue;
      const bool relative = is_relative(w.mode, arc.distance);
      const auto f = to_radius(w.axis, w.scale, relative ? Distance::incremental : Distance::absolute, arc.b, arc.facts,
                               context_.source_machine);
      if (!w.value.literal() || !f) return std::nullopt;
      c[i] = w.value.number * *f + (relative ? *arc.start[i] : 0);
    }
  }
  return Vec{c[0], c[1]};
}

std::optional<double> ArcPass::partial_angle(const Arc& arc) const {
  if (!known(arc.start) || !known(arc.end) || !arc.ccw) return std::nullopt;
  auto c = center_point(arc);
  if (arc.b.motion.radius_given && arc.b.motion.radius.literal()) {
    c = centre_by_radius(point(arc.start), point(arc.end), arc.b.motion.radius.number, *arc.ccw, long_chord);
  }
  if (!c) return std::nullopt;
  return swept_angle(point(arc.start), point(arc.end), *c, *arc.ccw);
}

std::optional<double> ArcPass::angle_turned(const Arc& arc) const {
  const auto angle = partial_angle(arc);
  return angle || !plane_known_ || !closes(arc) ? angle : 360;
}

std::optional<Value> ArcPass::travel_across(const Arc& arc) const {
  if (arc.start[2] && arc.end[2]) return Value{std::fabs(*arc.end[2] - *arc.start[2])};
  for (const CoordWord& w : arc.b.motion.coords) {
    const auto counts = distance_of(w, arc.b, arc.facts);
    const auto f = to_radius(w.axis, w.scale, counts, arc.b, arc.facts, context_.source_machine);
    if (w.axis != arc.axes.w || counts != Distance::incremental || !f) continue;
    const Value travel = scale(w.value, *f);
    return travel.literal() ? Value{std::fabs(travel.number)} : Value{call(Function::abs, {travel.expr})};
  }
  return std::nullopt;
}

bool ArcPass::pitch_to_turns(Arc& arc) {
  Motion& m = arc.b.motion;
  const Value pitch = m.extra->pitch;
  const auto angle = angle_turned(arc);
  const auto travel = travel_across(arc);
  if (!pitch.literal() || pitch.number == 0 || !angle || !travel || !travel->literal()) {
    fail(arc, "TRN-309", "a helix by its pitch, and its start or end is not known here; the target wants the turns",
         "program start, end and pitch as numbers");
    return false;
  }
  const double revolutions = travel->number / std::fabs(pitch.number);
  const double turns = std::max(0.0, std::round(revolutions - *angle / 360));
  const bool nearest = context_.source_machine.policies.helix_pitch_mismatch == machine::HelixPitchMismatch::nearest;
  if (!nearest && std::fabs(revolutions - turns - *angle / 360) > 0.01 * std::max(1.0, revolutions)) {
    fail(arc, "TRN-310", "the travel of the helix does not fit its pitch", "check pitch and end point");
    return false;
  }
  auto extra = std::make_shared<MotionExtra>(*m.extra);
  extra->has_pitch = false;
  extra->has_turns = turns > 0;
  extra->turns = Value{turns};
  m.extra = std::move(extra);
  drop_empty_extra(m);
  return true;
}

bool ArcPass::exact_pitch(Arc& arc) {
  const auto nearest = [](const machine::Profile& m) {
    return m.policies.helix_pitch_mismatch == machine::HelixPitchMismatch::nearest;
  };
  if (!nearest(context_.source_machine) || nearest(context_.target_machine)) return true;
  Motion& m = arc.b.motion;
  const Value pitch = m.extra->pitch;
  const auto angle = angle_turned(arc);
  const auto across = travel_across(arc);
  if (!pitch.literal() || pitch.number == 0 || !angle || !across || !across->literal()) {
    fail(arc, "TRN-309", "a helix by its pitch that need not fit its travel, and its start or end is not known here",
         "program start, end and pitch as numbers");
    return false;
  }
  const double travel = across->number;
  auto extra = std::make_shared<MotionExtra>(*m.extra);
  if (travel == 0) {  // no helix
    extra->has_pitch = false;
    m.extra = std::move(extra);
    drop_empty_extra(m);
    return true;
  }
  const double turns = std::max(0.0, std::round(travel / std::fabs(pitch.number) - *angle / 360)) + *angle / 360;
  if (turns == 0 || std::fabs(std::fabs(pitch.number) * turns - travel) < 1e-9) return true;
  extra->pitch = Value{travel / turns};
  m.extra = std::move(extra);
  return true;
}

bool ArcPass::turns_to_pitch(Arc& arc) {
  Motion& m = arc.b.motion;
  const Value turns = m.extra->turns;
  auto extra = std::make_shared<MotionExtra>(*m.extra);
  extra->has_turns = false;
  if (turns.is(0)) {
    m.extra = std::move(extra);
    drop_empty_extra(m);
    return true;
  }
  const auto angle = angle_turned(arc);
  const auto travel = travel_across(arc);
  if (!turns.literal() || !angle || !travel || travel->is(0) || !context_.target.helix_pitch) {
    fail(arc, "TRN-311",
         "a helix by its number of turns, and its start or end is not known here; the target wants the pitch",
         "program start, end and turns as numbers");
    return false;
  }
  extra->has_pitch = true;
  const double rounds = turns.number + *angle / 360;
  extra->pitch = travel->literal() ? Value{travel->number / rounds}
                                   : Value{binary(BinaryOp::divide, travel->expr, number(rounds))};
  m.extra = std::move(extra);
  return true;
}

/// It ends where it begins in its plane, whatever the values of its words are.
bool ArcPass::closes(const Arc& arc) const {
  const Motion& m = arc.b.motion;
  if (m.radius_given) return false;
  return std::all_of(m.coords.begin(), m.coords.end(), [&](const CoordWord& w) {
    if (w.axis != arc.axis[0] && w.axis != arc.axis[1]) return true;
    const auto counts = distance_of(w, arc.b, arc.facts);
    if (counts == Distance::incremental) return w.value.is(0);
    const auto from = start_of(arc, w.axis);
    const auto f = to_radius(w.axis, w.scale, counts, arc.b, arc.facts, context_.source_machine);
    return counts && f && from && equal(scale(w.value, *f), *from);
  });
}

/// By its angle an arc ends at the radius with which it begins. Where the source's end lies beside that circle by what
/// controls allow, the centre moves to the nearest place with the same distance from both: the end stays where it is.
/// Not where the path would move further than the end lies beside it: a circle that nearly closes moves with its
/// centre.
void ArcPass::end_on_circle(Arc& arc) {
  const auto c = center_point(arc);
  if (!c || !known(arc.end) || !arc.ccw) return;
  const Vec from = point(arc.start), to = point(arc.end), chord = to - from;
  const double length = geometry::length(chord);
  const double beside = std::fabs(geometry::length(*c - from) - geometry::length(*c - to));
  constexpr double fine = 1e-4;
  if (length < fine || beside < fine) return;
  const double along = geometry::dot(*c - from, chord) / length - length / 2;
  const Vec moved = *c - (along / length) * chord;
  const bool turns = arc.b.motion.extra && arc.b.motion.extra->has_turns;
  const double by = turns ? geometry::length(moved - *c) : geometry::apart({from, to, *c}, {from, to, moved}, *arc.ccw);
  if (by <= beside * (1 + fine)) set_center(arc, moved);
}

void ArcPass::helix_angle(Arc& arc) {
  Motion& m = arc.b.motion;
  const bool rises =
      std::any_of(m.coords.begin(), m.coords.end(), [&arc](const CoordWord& c) { return c.axis == arc.axes.w; });
  const bool turns = m.extra && m.extra->has_turns;
  if ((!rises && !turns) || program_.dialect == context_.target.dialect) return;
  if (!plane_known_ || !angle_turned(arc) || (turns && !m.extra->turns.literal()))
    return fail(arc, "TRN-311",
                "a helix whose start or end is not known here; the target wants the angle through which it turns",
                "program start, end and turns as numbers");
  if (m.radius_given) {
    const auto c = centre_by_radius(point(arc.start), point(arc.end), m.radius.number, *arc.ccw, long_chord);
    if (c) set_center(arc, *c);
  }
  end_on_circle(arc);
  const auto angle = angle_turned(arc);
  auto extra = m.extra ? std::make_shared<MotionExtra>(*m.extra) : std::make_shared<MotionExtra>();
  extra->has_turns = false;
  extra->has_angle = true;
  extra->opening_angle = Value{*angle + (turns ? 360 * m.extra->turns.number : 0)};
  m.extra = std::move(extra);
}

void ArcPass::both_ends(Arc& arc, bool needed) {
  if (!context_.target.full_circle_needs_end) return;
  auto& coords = arc.b.motion.coords;
  const auto missing = [&](AxisId axis) {
    return std::none_of(coords.begin(), coords.end(), [axis](const CoordWord& w) { return w.axis == axis; });
  };
  const bool u = missing(arc.axis[0]), v = missing(arc.axis[1]);
  if ((!u && !v) || (!needed && u && v)) return;
  const auto unknown = [&](AxisId axis) { return missing(axis) && !start_of(arc, axis); };
  if ((loses_start(arc) || unknown(arc.axis[0]) || unknown(arc.axis[1])) && by_increments(arc)) return;
  const auto other = std::find_if(coords.begin(), coords.end(), [&arc](const CoordWord& w) {
    return w.axis == arc.axis[0] || w.axis == arc.axis[1];
  });
  const bool beside_increment = other != coords.end() && other->mode == WordMode::incremental;
  std::vector<CoordWord> more;
  for (const AxisId axis : {arc.axis[0], arc.axis[1]}) {
    if (!missing(axis)) continue;
    CoordWord w;
    w.axis = axis;
    w.scale = radius_scale(w.axis);
    if (arc.distance == Distance::incremental || beside_increment) {
      w.mode = WordMode::incremental;
      w.value = Value{0.0};
    } else {
      auto start = start_of(arc, w.axis);
      if (!start && arc.distance) {
        start = at_run(context_, Datum::programmed_position, w.axis);
        w.scale = WordScale::modal;
      }
      if ((!start || !arc.distance) && !needed) return;
      if (!start || !arc.distance) {
        return fail(arc, "TRN-314",
                    "the target wants both end coordinates of an arc, and the point before is not known here",
                    "write both end coordinates");
      }
      w.value = *start;
    }
    more.push_back(std::move(w));
  }
  for (auto& w : more) coords.insert(w.axis == arc.axis[0] ? coords.begin() : coords.end(), std::move(w));
}

}  // namespace cnctrans::ir::passes
