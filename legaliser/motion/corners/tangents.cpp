// Tangential entries, exits and arcs, for targets that have none (equivalences 11 and 9.3): the points of the path are
// numbers here, so that the arcs they stand for can be written out.
#include <cmath>
#include <numbers>
#include <set>

#include "base/tiny.h"
#include "ir/geometry/geometry.h"
#include "legaliser/analysis/path_points.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"
#include "legaliser/motion/path_values.h"
#include "legaliser/motion/polar_words.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

using namespace geometry;

namespace {

class TangentPass {
 public:
  TangentPass(Program& program, const LegaliseContext& context, const FactsOf& facts)
      : program_(program), context_(context), facts_(facts), points_(context, facts) {}

  /// Points behind a change of the frame are no facts, but follow from the frames.
  void begin_where_values_say(const std::set<std::uint32_t>& statements) {
    wanted_ = statements;
    const PathStates path(program_, facts_, context_.target_machine, context_);
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        const auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr || statements.count(s.id) == 0 || moves_frames(*b)) return;
        const auto plane = setting_in<Plane>(*b, facts_.before(s), Setting::plane);
        if (!plane) return;
        const auto u = path.number(s, plane_axes(*plane).u), v = path.number(s, plane_axes(*plane).v);
        if (u && v) points_.begins_at(s, {*u, *v});
      });
    }
  }

  void routine(Routine& r) {
    uses_ = label_uses(program_, r);
    walk(r.body);
  }

 private:
  void walk(Body& body) {
    std::optional<Path> before;
    Body out;
    out.reserve(body.size());
    for (std::size_t i = 0; i < body.size(); ++i) {
      Statement& s = body[i];
      bool nested = false;
      each_body(s, [&](Body& inner) {
        nested = true;
        walk(inner);
      });
      auto* b = std::get_if<Block>(&s.node);
      if (nested || entered(s) || (b == nullptr && !passes_by(s))) before.reset();
      std::optional<Statement> arc;
      if (b != nullptr) {
        if (kind_of(*b, s) == MotionKind::arc_tangent) tangent_arc(s, before);
        b = std::get_if<Block>(&s.node);
        if (b != nullptr && take_tangential(*b)) arc = expand(s, body, i);
        b = std::get_if<Block>(&s.node);
      }
      if (b != nullptr && moves_frames(*b)) before.reset();
      if (b != nullptr && b->has_motion && b->motion.moves() && !arc) {
        const auto path = points_.path_of(s, true);
        if (!path || length(path->e.b - path->e.a) > tiny || path->e.arc) before = path;
      }
      if (arc) before = last_;
      out.push_back(std::move(s));
      if (arc) out.push_back(std::move(*arc));
    }
    body = std::move(out);
  }

  [[nodiscard]] bool entered(const Statement& s) const {
    const auto labels = labels_on(s.line);
    return std::any_of(labels.begin(), labels.end(),
                       [this](const LabelRef& l) { return uses_.is_target(l) || uses_.computed; });
  }
  static bool passes_by(const Statement& s) {
    return std::holds_alternative<Assign>(s.node) || std::holds_alternative<Message>(s.node) ||
           std::holds_alternative<Declare>(s.node) || std::holds_alternative<Label>(s.node);
  }
  std::optional<MotionKind> kind_of(const Block& b, const Statement& s) const {
    if (!b.has_motion || !b.motion.moves()) return std::nullopt;
    return motion_in(b, facts_.before(s));
  }

  void tangent_arc(Statement& s, const std::optional<Path>& before) {
    auto& m = std::get<Block>(s.node).motion;
    const auto kind = m.kind;
    m.kind = MotionKind::linear;  // to look at its points
    const auto points = points_.path_of(s);
    m.kind = kind;
    if (goes_straight(points, before)) {
      m.kind = MotionKind::linear;
      m.explicit_code = true;
      m.code_text = {};
      return;
    }
    if (context_.target.arc_tangent && !(wanted_.count(s.id) != 0 && before && points)) {
      if (!points || !before) tell_unknown(s);
      return;
    }
    if (!before || !points || before->plane != points->plane) {
      return refuse(s, program_, context_, "TRN-301",
                    "a tangent arc, which the target lacks; the element before it is not known here as numbers",
                    "program the arc by its centre or radius", m.code_pos);
    }
    Vec centre;
    bool ccw = false;
    if (!centre_by_tangent(points->e.a, before->e.end_direction(), points->e.b, centre, ccw)) {
      return refuse(s, program_, context_, "TRN-301", "the end of the tangent arc lies straight ahead",
                    "program a straight line", m.code_pos);
    }
    m.kind = ccw ? MotionKind::arc_ccw : MotionKind::arc_cw;
    m.explicit_code = true;
    m.code_text = {};
    PathPoints::set_centre(m, points->plane, points->e.a, centre);
  }

  [[nodiscard]] bool straight_for_the_source_alone() const {
    const auto goes_on = [](const machine::Profile& m) {
      return m.policies.arc_tangent_straight == machine::ArcTangentStraight::line;
    };
    return goes_on(context_.source_machine) && !goes_on(context_.target_machine);
  }

  /// The end lies straight ahead, and the source goes there on a line where the target stops.
  bool goes_straight(const std::optional<Path>& points, const std::optional<Path>& before) const {
    if (!straight_for_the_source_alone()) return false;
    if (!before || !points || before->plane != points->plane) return false;
    Vec centre;
    bool ccw = false;
    const Vec direction = before->e.end_direction(), way = points->e.b - points->e.a;
    return !centre_by_tangent(points->e.a, direction, points->e.b, centre, ccw) && dot(way, direction) > 0;
  }

  /// Whether it does is not known here.
  void tell_unknown(const Statement& s) const {
    if (!straight_for_the_source_alone()) return;
    context_.diagnostics.warning("TRN-657", s.line.span,
                                 "the direction before this tangent arc, or its ends, are not known here: where its "
                                 "end lies straight ahead, the source goes there on a line and the target stops",
                                 "write a straight line there");
  }

  /// Takes the entry or exit out of the block; false: it has none, or the target writes it itself.
  bool take_tangential(Block& b) {
    if (context_.target.tangential_ends) return false;
    for (std::size_t i = 0; i < b.actions.size(); ++i) {
      const auto* t = std::get_if<TangentialEnd>(&b.actions[i].data);
      if (t == nullptr) continue;
      tangential_ = *t;
      tangential_pos_ = b.actions[i].pos;
      b.actions.erase(b.actions.begin() + static_cast<std::ptrdiff_t>(i));
      return true;
    }
    return false;
  }

  /// The block that the entry or exit of `body[at]` adds behind it; the words around it are set to fit.
  std::optional<Statement> expand(Statement& s, Body& body, std::size_t at) {
    const auto fail = [&](std::string text, std::string hint) -> std::optional<Statement> {
      refuse(s, program_, context_, "TRN-335", std::move(text), std::move(hint), tangential_pos_);
      return std::nullopt;
    };
    Statement* next = nullptr;
    for (std::size_t j = at + 1; j < body.size() && next == nullptr; ++j) {
      const auto* b = std::get_if<Block>(&body[j].node);
      if (entered(body[j]) || (b == nullptr && !passes_by(body[j])) || (b != nullptr && moves_frames(*b))) break;
      if (b != nullptr && b->has_motion && b->motion.moves()) next = &body[j];
    }
    const auto here = points_.path_of(s);
    const auto after = next != nullptr ? points_.path_of(*next) : std::nullopt;
    if (!here || !after || here->plane != after->plane || !tangential_.radius.literal() || s.line.skip_mask != 0)
      return fail(
          "a tangential entry or exit, which the target lacks; the points around it are not known here as numbers",
          "program the arc itself");
    const bool entry = tangential_.end == TangentEnd::entry;
    const auto stands = [](const Element& e) { return !e.arc && length(e.b - e.a) < tiny; };  // an arc: a full circle
    if (stands(here->e) || stands(after->e))
      return fail("a tangential entry or exit beside a move that goes nowhere", {});
    Fillet lead;
    std::string why;
    if (!(entry ? tangential_entry : tangential_exit)(here->e, after->e, tangential_.radius.number, lead, why))
      return fail(std::move(why), "check the radius, or program the arc itself");
    if (lead.none) return std::nullopt;
    const Path arc{here->plane, {true, lead.from, lead.to, lead.centre, lead.ccw}};
    Block block;
    block.has_motion = true;
    block.motion.kind = lead.ccw ? MotionKind::arc_ccw : MotionKind::arc_cw;
    block.motion.explicit_code = true;
    block.motion.keeps_modal = false;
    points_.set_end(block.motion, arc.plane, lead.to);
    PathPoints::set_centre(block.motion, arc.plane, lead.from, lead.centre);
    if (entry)
      points_.set_end(std::get<Block>(s.node).motion, arc.plane, lead.from);
    else
      begin_next(*next, *after, lead.to);
    context_.diagnostics.note("TRN-336", word_span(s.line.span, tangential_pos_),
                              "the tangential entry or exit is written as an arc of its own");
    block.actions = take_after(std::get<Block>(s.node));
    last_ = arc;
    return made(s.line, std::move(block));
  }

  /// The element behind an exit begins where its arc ends.
  void begin_next(Statement& next, const Path& as_written, Vec from) {
    auto& m = std::get<Block>(next.node).motion;
    points_.set_end(m, as_written.plane, as_written.e.b);
    if (as_written.e.arc && !m.radius_given) PathPoints::set_centre(m, as_written.plane, from, as_written.e.c);
    points_.begins_at(next, from);
  }

  Program& program_;
  const LegaliseContext& context_;
  const FactsOf& facts_;
  PathPoints points_;
  std::set<std::uint32_t> wanted_;  ///< blocks (by id) before, with and behind tangential ends that the target lacks
  LabelUses uses_;
  TangentialEnd tangential_;
  WordPos tangential_pos_;
  std::optional<Path> last_;
};

}  // namespace

void write_out_tangents(Program& program, const LegaliseContext& context) {
  const FactsOf facts(program, context);
  TangentPass pass(program, context, facts);
  const auto wanted =
      context.target.tangential_ends ? std::set<std::uint32_t>{} : beside_lacking(program, context.target);
  if (!wanted.empty()) pass.begin_where_values_say(wanted);
  for (auto& r : program.routines) pass.routine(r);
}

}  // namespace cnctrans::ir::passes
