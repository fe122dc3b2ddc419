// The pass over arcs as a class: centres here, the other forms in arc_forms.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "ir/analysis/flow_states.h"
#include "ir/geometry/geometry.h"
#include "legaliser/analysis/words.h"
#include "legaliser/edit/editor.h"
#include "legaliser/motion/path_values.h"
#include "legaliser/motion/said_points.h"

namespace cnctrans::ir::passes {

/// Warns of arcs right behind a mirror or a rotation whose centre the target wants absolute.
void check_first_arcs(const Program& program, const LegaliseContext& context, const FactsOf& facts);
/// Refuses arcs whose radius differs between their ends by more than the target takes.
void check_radii(const Program& program, const LegaliseContext& context, const FactsOf& facts);

class ArcPass {
 public:
  ArcPass(Program& program, const LegaliseContext& context, const FactsOf& facts)
      : program_(program), context_(context), facts_(facts), said_domain_(facts, context.target) {
    if (starts_unknown()) path_.emplace(program, facts, context.source_machine, context);
    if (program.dialect != context.target.dialect && SaidPoints::needed(program)) said_.emplace(program, said_domain_);
  }

  void routine(Routine& r) {
    Editor editor(program_, r, context_);
    walk(r.body, editor);
  }

 private:
  void walk(Body& body, Editor& editor) {
    Body out;
    out.reserve(body.size());
    for (auto& s : body) {
      back_to_absolute_ = false;
      if (std::holds_alternative<Block>(s.node) && s.id != 0 && is_arc_block(s)) one(s);
      bool nested = false;
      each_body(s, [&](Body& inner) {
        nested = true;
        walk(inner, editor);
      });
      Body pieces{std::move(s)};
      if (!nested && back_to_absolute_)
        pieces.push_back(make_block(pieces.front().line, action(ModalSet{Setting::distance, absolute_, true, {}})));
      editor.put_group(out, std::move(pieces), 0);
    }
    body = std::move(out);
  }
  static constexpr auto absolute_ = static_cast<std::uint8_t>(Distance::absolute);

  bool is_arc_block(const Statement& s) const {
    const auto& b = std::get<Block>(s.node);
    if (!b.has_motion || !b.motion.moves() || positions_alone(b)) return false;
    const auto kind = motion_in(b, facts_.before(s));
    const bool words = !b.motion.centers.empty() || b.motion.radius_given;
    if (!kind) return words;
    return *kind == MotionKind::arc_cw || *kind == MotionKind::arc_ccw || *kind == MotionKind::arc_through_point ||
           *kind == MotionKind::arc_tangent;
  }

  /// The start of some arc is no number.
  [[nodiscard]] bool starts_unknown() const {
    bool found = false;
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        if (found || !std::holds_alternative<Block>(s.node) || !is_arc_block(s)) return;
        const auto& at = facts_.before(s).position;
        found = !at[axis::x] || !at[axis::y] || !at[axis::z];
      });
    }
    return found;
  }

  /// What is known about the arc of the statement at hand.
  struct Arc {
    Statement& s;
    Block& b;
    const Facts& facts;
    PlaneAxes axes;
    std::optional<bool> ccw;
    std::optional<Distance> distance;
    std::array<std::optional<double>, 3> start, end;  ///< u, v, w; radius
    std::array<AxisId, 3> axis;
  };

  void fail(Arc& arc, std::string_view code, std::string text, std::string hint) {
    refuse(arc.s, program_, context_, code, std::move(text), std::move(hint), arc.b.motion.code_pos);
  }

  Arc look(Statement& s) {
    auto& b = std::get<Block>(s.node);
    const Facts& facts = facts_.before(s);
    auto plane = setting_in<Plane>(b, facts, Setting::plane);
    if (!plane) plane = plane_of_words(b.motion);
    const PlaneAxes axes = plane_axes(plane.value_or(context_.source_machine.power_on.plane));
    Arc arc{s,
            b,
            facts,
            axes,
            std::nullopt,
            setting_in<Distance>(b, facts, Setting::distance),
            {},
            {},
            {axes.u, axes.v, axes.w}};
    plane_known_ = plane.has_value();
    const auto kind = motion_in(b, facts);
    if (kind == MotionKind::arc_cw) arc.ccw = false;
    if (kind == MotionKind::arc_ccw) arc.ccw = true;
    for (std::size_t i = 0; i < 3; ++i) {
      arc.start[i] = facts.position[arc.axis[i]];
      arc.end[i] = arc.start[i];
    }
    for (const auto& c : b.motion.coords) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (arc.axis[i] == c.axis) arc.end[i] = end_of(arc, c, arc.start[i]);
      }
    }
    return arc;
  }

  std::optional<double> end_of(const Arc& arc, const CoordWord& c, std::optional<double> start) const {
    const auto d = distance_of(c, arc.b, arc.facts);
    const auto f = to_radius(c.axis, c.scale, d, arc.b, arc.facts, context_.source_machine);
    if (!c.value.literal() || !d || !f) return std::nullopt;
    if (*d == Distance::absolute) return c.value.number * *f;
    if (!start) return std::nullopt;
    return *start + c.value.number * *f;
  }

  void one(Statement& s) {
    Arc arc = look(s);
    Motion& m = arc.b.motion;
    const auto kind = motion_in(arc.b, arc.facts);
    if (kind == MotionKind::arc_tangent && !context_.target.arc_tangent) {
      return fail(arc, "TRN-301", "a tangent arc: the target has none", "program the arc by its centre or radius");
    }
    if (kind == MotionKind::arc_through_point) {
      if (!through_in_plane(arc)) return;
      if (context_.target.arc_through_point && !leaves_plane(arc, context_.target_machine)) return;
      if (!through_point(arc)) return;
    }
    if (m.extra && !extras(arc)) return;
    if (!in_plane(arc)) return;
    if (near_its_start(arc) && keep_closed(arc)) return;
    if (m.radius_given) {
      if (!radius(arc)) return;
    }
    if (!m.centers.empty()) {
      centers(arc);
    } else if (m.radius_given && plane_known_ &&
               setting_in<Surface>(arc.b, arc.facts, Setting::surface) == Surface::none) {
      both_ends(arc, false);
    }
    if (std::holds_alternative<Block>(s.node)) almost_closed(arc);
    if (std::holds_alternative<Block>(s.node) && context_.target.helix_angle) helix_angle(arc);
  }

  // --- start and end beside each other (arc_ends.cpp) --------------------------------------------------------------

  /// Start and end are numbers so near to each other that rounding may change the full circle to none, or back.
  [[nodiscard]] bool near_its_start(const Arc& arc) const;
  /// Where the target's control begins and ends the arc.
  struct Ends {
    geometry::Vec start, end;
  };
  [[nodiscard]] Ends on_target(const Arc& arc) const;
  [[nodiscard]] bool stays_closed(const Arc& arc) const;  ///< of a full circle: both are one point
  /// A full circle without a word of its end, which would be another point than its start when it is written.
  [[nodiscard]] bool loses_start(const Arc& arc) const;
  /// A full circle, or nearly one, that the target's own start and rounded end would make short: its end is said as
  /// its start, whatever that is. False: it is none.
  bool keep_closed(Arc& arc);
  /// A short arc that the target would take for a full circle; nearly a full circle by its radius.
  void almost_closed(Arc& arc);
  void say_line(Arc& arc);

  WordScale radius_scale(AxisId axis) const {
    return is_diameter_axis(context_.source_machine, axis) ? WordScale::radius : WordScale::modal;
  }

  // --- forms ----------------------------------------------------------------------------------------------------

  void set_center(Arc& arc, geometry::Vec c) {
    Motion& m = arc.b.motion;
    m.radius_given = false;
    m.radius = Value{};
    m.centers.clear();
    const geometry::Vec at{c.u - *arc.start[0], c.v - *arc.start[1]};
    for (std::size_t i = 0; i < 2; ++i) {
      CenterWord w;
      w.axis = arc.axis[i];
      w.mode = CenterMode::from_start;
      w.scale = WordScale::radius;
      w.value = Value{i == 0 ? at.u : at.v};
      m.centers.push_back(w);
    }
  }
  static bool known(const std::array<std::optional<double>, 3>& p) { return p[0] && p[1]; }
  static geometry::Vec point(const std::array<std::optional<double>, 3>& p) { return {*p[0], *p[1]}; }

  /// An offset of the centre that lies outside of the plane: 0 says nothing and is left out. False: refused.
  bool in_plane(Arc& arc);

  /// Radius: kept when the target has the form for it. False: refused.
  bool radius(Arc& arc);

  bool through_point(Arc& arc);
  /// A word of the point on the arc that lies outside of the plane: it is left out where it says nothing. False:
  /// refused.
  bool through_in_plane(Arc& arc);
  /// The arc also moves along the normal of its plane, or may, on a machine where three points are a circle in space.
  [[nodiscard]] bool leaves_plane(const Arc& arc, const machine::Profile& machine) const;

  static void drop_empty_extra(Motion& m) {
    const MotionExtra& e = *m.extra;
    if (!e.has_turns && !e.has_pitch && !e.has_angle && e.through.empty() && !e.has_polar_radius &&
        !e.has_polar_angle && !e.has_line_angle && !e.has_lead && !e.has_start_angle)
      m.extra.reset();
  }

  /// Turns, pitch, opening angle. False: refused.
  bool extras(Arc& arc) {
    Motion& m = arc.b.motion;
    const auto& t = context_.target;
    if (m.extra->has_angle && !t.arc_angle && !opening_angle(arc)) return false;
    if (m.extra && m.extra->has_pitch && !t.helix_pitch && !pitch_to_turns(arc)) return false;
    if (m.extra && m.extra->has_pitch && t.helix_pitch && !exact_pitch(arc)) return false;
    if (m.extra && m.extra->has_turns && !t.helix_turns && !t.helix_angle && !turns_to_pitch(arc)) return false;
    return true;
  }

  bool opening_angle(Arc& arc);

  /// Both end words of the plane, absolute or incremental as the block is.
  void set_end(Arc& arc);

  std::optional<geometry::Vec> center_point(const Arc& arc) const;
  static bool is_relative(CenterMode mode, std::optional<Distance> distance) {
    return mode == CenterMode::from_start ||
           (mode == CenterMode::follows_distance && distance == Distance::incremental);
  }

  std::optional<double> partial_angle(const Arc& arc) const;
  /// A full turn where it ends in its plane where it begins, wherever that is.
  [[nodiscard]] std::optional<double> angle_turned(const Arc& arc) const;
  /// Along the normal of the plane, without its sign.
  [[nodiscard]] std::optional<Value> travel_across(const Arc& arc) const;

  bool pitch_to_turns(Arc& arc);

  /// A pitch that the source rounds to whole turns, for a target that wants it to fit. False: refused.
  bool exact_pitch(Arc& arc);

  bool turns_to_pitch(Arc& arc);

  /// A helix says the whole angle through which it turns.
  void helix_angle(Arc& arc);
  void end_on_circle(Arc& arc);
  [[nodiscard]] bool closes(const Arc& arc) const;

  // --- centres --------------------------------------------------------------------------------------------------

  /// Start of the arc along one axis in radius: a number, or a formula that holds on every way to it.
  std::optional<Value> start_of(const Arc& arc, AxisId axis) const {
    if (arc.facts.position[axis]) return Value{*arc.facts.position[axis]};
    return path_ ? path_->place(arc.s, axis) : std::nullopt;
  }

  void centers(Arc& arc) {
    Motion& m = arc.b.motion;
    const auto& t = context_.target;
    if (std::any_of(m.centers.begin(), m.centers.end(),
                    [&m](const CenterWord& w) { return w.mode != m.centers.front().mode; })) {
      const auto center = center_point(arc);
      if (center && known(arc.start))
        set_center(arc, *center);
      else if (!in_one_way(arc))
        return fail(arc, "TRN-313",
                    "the centre is absolute on one axis only, and where the arc begins is not known here",
                    "give both words of the centre in one way");
    }
    const CenterMode from = m.centers.front().mode;
    const bool whole = t.centers.count(from) != 0 && !incomplete(arc, from);
    if (!plane_known_ && (!whole || t.full_circle_needs_end)) {
      context_.diagnostics.error("TRN-312", word_span(arc.s.line.span, m.code_pos),
                                 "the plane of this arc depends on the path that leads here",
                                 "write the plane before this block on every path");
      return;
    }
    if (!whole) {
      const auto to = wanted_mode(arc, from);
      const bool steps = steps_from_unknown(arc) || loses_start(arc);
      if (to == CenterMode::follows_distance && steps && by_increments(arc)) return;
      if (!to || !convert_centers(arc, from, *to)) {
        if (by_increments(arc)) return;
        return fail(arc, "TRN-313",
                    "the centre of this arc is given in a form that the target lacks, and its start is not known here",
                    "give the point before the arc as numbers on every path");
      }
    }
    both_ends(arc, true);
  }

  /// The end is given by increments and where they count from is no number: the words can't become absolute.
  static bool steps_from_unknown(const Arc& arc) {
    return std::any_of(arc.b.motion.coords.begin(), arc.b.motion.coords.end(), [&arc](const CoordWord& c) {
      return c.mode == WordMode::incremental && !arc.facts.position[c.axis];
    });
  }

  /// The block under increments of its own: neither its start nor its end need be known then. False: an absolute word.
  bool by_increments(Arc& arc) {
    Motion& m = arc.b.motion;
    const auto& modes = context_.target.centers;
    const auto to = modes.count(CenterMode::from_start) != 0 ? CenterMode::from_start : CenterMode::follows_distance;
    const bool relative = std::all_of(m.centers.begin(), m.centers.end(),
                                      [&arc](const CenterWord& w) { return is_relative(w.mode, arc.distance); });
    const bool steps = std::all_of(m.coords.begin(), m.coords.end(),
                                   [](const CoordWord& c) { return c.mode == WordMode::incremental; });
    if (!plane_known_ || arc.distance != Distance::absolute || !relative || !steps || modes.count(to) == 0 ||
        arc.b.repeat_given != 0)
      return false;
    if (!m.radius_given) complete(arc, m.centers, to, true);
    for (auto& w : m.centers) w.mode = to;
    for (auto& c : m.coords) c.mode = WordMode::modal;
    for (const AxisId axis : {arc.axis[0], arc.axis[1]}) {
      if (std::any_of(m.coords.begin(), m.coords.end(), [axis](const CoordWord& c) { return c.axis == axis; }))
        continue;
      CoordWord w;
      w.axis = axis;
      w.scale = radius_scale(axis);
      w.mode = WordMode::incremental;
      w.value = Value{0.0};
      m.coords.push_back(w);
    }
    const auto incremental = static_cast<std::uint8_t>(Distance::incremental);
    arc.b.actions.insert(arc.b.actions.begin(), action(ModalSet{Setting::distance, incremental, true, {}}));
    back_to_absolute_ = true;
    return true;
  }

  /// Absolute centres must name both coordinates: a missing word would be 0, not the start.
  static bool incomplete(const Arc& arc, CenterMode mode) {
    const bool may_be_absolute = !is_relative(mode, arc.distance) || mode == CenterMode::follows_distance;
    return may_be_absolute && arc.b.motion.centers.size() < 2;
  }

  std::optional<CenterMode> wanted_mode(const Arc& arc, CenterMode from) const {
    const auto& modes = context_.target.centers;
    if (modes.count(from) != 0) return from;
    if (from == CenterMode::follows_distance) {
      if (!arc.distance) return std::nullopt;
      const auto same = *arc.distance == Distance::absolute ? CenterMode::absolute : CenterMode::from_start;
      if (modes.count(same) != 0) return same;
    }
    if (modes.count(CenterMode::follows_distance) != 0 && arc.distance) return CenterMode::follows_distance;
    for (const auto mode : {CenterMode::from_start, CenterMode::absolute}) {
      if (modes.count(mode) != 0) return mode;
    }
    return std::nullopt;
  }

  bool convert_centers(Arc& arc, CenterMode from, CenterMode to) {
    const bool was_relative = is_relative(from, arc.distance), relative = is_relative(to, arc.distance);
    std::vector<CenterWord> words = arc.b.motion.centers;
    if ((!relative || to == CenterMode::follows_distance) && !complete(arc, words, from, was_relative)) return false;
    for (auto& w : words) {
      w.mode = to;
      if (was_relative != relative && !counted_otherwise(arc, w, relative)) return false;
    }
    if (words.empty()) return false;
    arc.b.motion.centers = std::move(words);
    return true;
  }
  /// From the start of the arc (`relative`) where it was absolute, and the other way round. False: the start is not
  /// known.
  bool counted_otherwise(const Arc& arc, CenterWord& w, bool relative) const {
    const auto f = to_radius(w.axis, w.scale, relative ? Distance::absolute : Distance::incremental, arc.b, arc.facts,
                             context_.source_machine);
    const auto start = start_of(arc, w.axis);
    if (!f || !start) return false;
    const Value radius = scale(w.value, *f);
    w.value = relative ? subtract(radius, *start) : add(*start, radius);
    w.value.text = {};
    w.scale = WordScale::radius;
    return true;
  }
  /// Centre words of two kinds, where the start is known along the axes of one kind. False: it is not.
  bool in_one_way(Arc& arc) const {
    if (!arc.distance) return false;
    for (const bool relative : {true, false}) {
      std::vector<CenterWord> words = arc.b.motion.centers;
      const bool all = std::all_of(words.begin(), words.end(), [&](CenterWord& w) {
        const bool was_relative = is_relative(w.mode, arc.distance);
        w.mode = relative ? CenterMode::from_start : CenterMode::absolute;
        return was_relative == relative || counted_otherwise(arc, w, relative);
      });
      if (!all) continue;
      arc.b.motion.centers = std::move(words);
      return true;
    }
    return false;
  }

  /// Adds the centre word that stands for an offset of zero: said absolutely, the start. False: that is not known.
  bool complete(const Arc& arc, std::vector<CenterWord>& words, CenterMode from, bool was_relative) const {
    for (std::size_t i = 0; i < 2; ++i) {
      if (std::any_of(words.begin(), words.end(), [&](const CenterWord& w) { return w.axis == arc.axis[i]; })) continue;
      CenterWord w;
      w.axis = arc.axis[i];
      w.mode = from;
      w.scale = WordScale::radius;
      if (!was_relative) {
        const auto start = start_of(arc, w.axis);
        if (!start) return false;
        w.value = *start;
        w.value.text = {};
      }
      words.insert(i == 0 ? words.begin() : words.end(), w);
    }
    return true;
  }

  /// Both end words where the target wants them. `needed`: refused where the missing one is not known, else left to the
  /// writer.
  void both_ends(Arc& arc, bool needed);

  Program& program_;
  const LegaliseContext& context_;
  const FactsOf& facts_;
  const SaidPoints said_domain_;
  std::optional<FlowStates<SaidPoints>> said_;  ///< none: every point is said
  std::optional<PathStates> path_;              ///< none: every start is a number
  bool plane_known_ = true;
  bool back_to_absolute_ = false;  ///< the block at hand counts in increments, the ones behind it don't
};

}  // namespace cnctrans::ir::passes
