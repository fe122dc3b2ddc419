// Arcs whose end lies beside their start: what is a full circle and what is a short arc must stay so when the target
// rounds its words. The start is not always a rounded word: behind a line by its angle the control stands on the exact
// point, and an end that is written rounded is another one.
#include "legaliser/motion/arc_pass.h"

namespace cnctrans::ir::passes {

using namespace geometry;

namespace {

int places_of(const Capabilities& target, std::optional<Units> units) {
  return units == Units::inch ? target.word_decimals_inch : target.word_decimals;
}
double as_written(double v, int places) {
  return parse_decimal(rounded(v, places)).value_or(v);
}

}  // namespace

bool ArcPass::near_its_start(const Arc& arc) const {
  if (program_.dialect == context_.target.dialect || !plane_known_ || !known(arc.start) || !known(arc.end))
    return false;
  const int places = places_of(context_.target, setting_in<Units>(arc.b, arc.facts, Setting::units));
  return length(point(arc.end) - point(arc.start)) <= 2 * std::pow(10, -places);
}

ArcPass::Ends ArcPass::on_target(const Arc& arc) const {
  const int places = places_of(context_.target, setting_in<Units>(arc.b, arc.facts, Setting::units));
  const auto* said = said_ ? said_->before(arc.s) : nullptr;
  const auto one = [&](std::size_t i) {
    const double from = *arc.start[i], to = *arc.end[i];
    const bool by_word = !said_ || (said != nullptr && (*said >> arc.axis[i] & 1U) != 0);
    const double start = by_word ? as_written(from, places) : from;
    const auto& coords = arc.b.motion.coords;
    const auto word =
        std::find_if(coords.begin(), coords.end(), [&](const CoordWord& c) { return c.axis == arc.axis[i]; });
    const bool stays = word == coords.end() && !context_.target.full_circle_needs_end;
    if (stays) return std::pair(start, start);
    if (word != coords.end() ? distance_of(*word, arc.b, arc.facts) == Distance::incremental
                             : arc.distance == Distance::incremental)
      return std::pair(start, start + as_written(to - from, places));
    return std::pair(start, as_written(to, places));
  };
  const auto u = one(0), v = one(1);
  return {{u.first, v.first}, {u.second, v.second}};
}

bool ArcPass::stays_closed(const Arc& arc) const {
  const Ends ends = on_target(arc);
  return length(ends.end - ends.start) <= 1e-9;
}

bool ArcPass::loses_start(const Arc& arc) const {
  const auto& coords = arc.b.motion.coords;
  const bool ends = std::any_of(coords.begin(), coords.end(),
                                [&arc](const CoordWord& c) { return c.axis == arc.axis[0] || c.axis == arc.axis[1]; });
  return context_.target.full_circle_needs_end && !ends && known(arc.start) && known(arc.end) && !stays_closed(arc);
}

bool ArcPass::keep_closed(Arc& arc) {
  Motion& m = arc.b.motion;
  const auto center = center_point(arc);
  if (m.radius_given || m.centers.empty() || !center || !arc.ccw) return false;
  const Ends ends = on_target(arc);
  const double source = swept_angle(point(arc.start), point(arc.end), *center, *arc.ccw);
  const bool lost = source > 180 && swept_angle(ends.start, ends.end, *center, *arc.ccw) <= 180;
  const bool full = source >= 360;
  if (!lost && (!full || stays_closed(arc))) return false;  // not closed: the next one begins elsewhere
  if (!full)
    context_.diagnostics.warning("TRN-315", word_span(arc.s.line.span, m.code_pos),
                                 "an arc that ends less than two of the target's last places before its start is "
                                 "written as a full circle");
  const Block before = arc.b;
  set_center(arc, *center);
  const auto in_plane = [&arc](const CoordWord& c) { return c.axis == arc.axis[0] || c.axis == arc.axis[1]; };
  std::erase_if(m.coords, in_plane);
  if (!context_.target.full_circle_needs_end) {
    centers(arc);
    return true;
  }
  // X0 Y0 as increments: the end is the start, whatever that is.
  bool sayable = true;
  for (auto& c : m.coords) {
    const auto d = distance_of(c, arc.b, arc.facts);
    const auto f = to_radius(c.axis, c.scale, d, arc.b, arc.facts, context_.source_machine);
    const auto from = arc.facts.position[c.axis];
    if (d == Distance::absolute && c.value.literal() && f && from) {
      c.value = Value{c.value.number * *f - *from};
      c.scale = radius_scale(c.axis);
      c.mode = WordMode::incremental;
    }
    sayable = sayable && distance_of(c, arc.b, arc.facts) == Distance::incremental;
  }
  if (arc.distance == Distance::incremental) {
    if (sayable) centers(arc);
  } else {
    sayable = sayable && by_increments(arc);
  }
  if (!sayable && !lost) {
    arc.b = before;
    return false;
  }
  if (!sayable)
    fail(arc, "TRN-314",
         "a full circle whose start the control computes itself: its end can't be written as the same point here",
         "give the point before the circle as coordinates");
  return true;
}

void ArcPass::say_line(Arc& arc) {
  Motion& m = arc.b.motion;
  m.kind = MotionKind::linear;
  m.explicit_code = true;
  m.keeps_modal = false;
  m.code_text = {};
  m.centers.clear();
  m.radius_given = false;
  const int places = places_of(context_.target, setting_in<Units>(arc.b, arc.facts, Setting::units));
  context_.diagnostics.warning("TRN-315", word_span(arc.s.line.span, m.code_pos),
                               "an arc shorter than the last place of the target's words is written as a line: the "
                               "path differs by less than " +
                                   shortest(std::pow(10, -places)));
}

void ArcPass::almost_closed(Arc& arc) {
  const auto units = setting_in<Units>(arc.b, arc.facts, Setting::units);
  const int places = places_of(context_.target, units);
  if (!known(arc.start) || !known(arc.end) || arc.b.motion.extra) return;
  const Vec a = point(arc.start), b = point(arc.end);
  const double chord = length(b - a), place = std::pow(10, -places);
  if (a.u == b.u && a.v == b.v) return;
  const auto angle = partial_angle(arc);
  Motion& m = arc.b.motion;
  if (m.radius_given && m.radius.literal() && m.radius.number < 0 && arc.ccw) {
    // Nearly a full circle by its radius: rounding turns the chord, and the centre with it.
    constexpr double centre_tolerance = 0.002;
    const auto fits = [place](double v) { return std::fabs(v / place - std::round(v / place)) < 1e-6; };
    if (fits(a.u) && fits(a.v) && fits(b.u) && fits(b.v)) return;
    const auto c = centre_by_radius(a, b, m.radius.number, *arc.ccw, long_chord);
    if (c && std::fabs(m.radius.number) * place > centre_tolerance * chord) {
      set_center(arc, *c);
      centers(arc);
    }
    return;
  }
  if (chord > 2 * place || !angle || *angle > 180) return;
  const Ends ends = on_target(arc);
  const bool together = length(ends.end - ends.start) < 0.01 * place;
  const auto center = together ? std::nullopt : center_point(arc);
  const bool turns_over = center && arc.ccw && swept_angle(ends.start, ends.end, *center, *arc.ccw) > 180;
  if (together || turns_over) say_line(arc);
}

}  // namespace cnctrans::ir::passes
