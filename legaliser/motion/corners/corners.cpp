// Corner functions that the target lacks (equivalences 9.9): one that stays in force becomes one in every block it acts
// on, a chamfer by its chord one by its legs, and a corner with a feed of its own is written out as an element. A
// corner that the source's control leaves out is left out.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ir/geometry/geometry.h"
#include "legaliser/analysis/path_points.h"
#include "legaliser/analysis/words.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"
#include "legaliser/motion/corners/corner_successors.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

using namespace geometry;

namespace {

class CornerPass {
 public:
  CornerPass(Program& program, const LegaliseContext& context, const FactsOf& facts)
      : program_(program),
        context_(context),
        facts_(facts),
        points_(context, facts),
        ends_(corner_ends(program, context, facts)) {}

  void routine(Routine& r) {
    uses_ = label_uses(program_, r);
    lasting_.reset();
    walk(r.body);
    if (lasting_ && !r.body.empty() && r.kind == RoutineKind::sub) leaves(r.body.back());
  }

 private:
  [[nodiscard]] const Capabilities& target() const { return context_.target; }

  void walk(Body& body) {
    Body out;
    out.reserve(body.size());
    for (std::size_t i = 0; i < body.size(); ++i) {
      Statement& s = body[i];
      if (lasting_ && (entered(s) || (!std::holds_alternative<Block>(s.node) && !passes_by(s)))) leaves(s);
      each_body(s, [&](Body& inner) { walk(inner); });
      if (lasting_ && !std::holds_alternative<Block>(s.node)) {
        bool nested = false;
        each_body(s, [&](Body&) { nested = true; });
        if (nested) leaves(s);  // it was set inside
      }
      std::optional<Statement> element;
      if (std::holds_alternative<Block>(s.node)) element = take(body, i);
      out.push_back(std::move(s));
      if (element) out.push_back(std::move(*element));
    }
    body = std::move(out);
  }

  [[nodiscard]] bool entered(const Statement& s) const {
    const auto labels = labels_on(s.line);
    return std::any_of(labels.begin(), labels.end(),
                       [this](const LabelRef& l) { return uses_.is_target(l) || uses_.is_end(l); });
  }
  static bool passes_by(const Statement& s) {
    return std::holds_alternative<Assign>(s.node) || std::holds_alternative<Message>(s.node) ||
           std::holds_alternative<Declare>(s.node) || std::holds_alternative<Label>(s.node) ||
           std::holds_alternative<End>(s.node);
  }
  /// The flow of the program comes or goes while a corner function is in force.
  void leaves(Statement& s) {
    refuse(s, program_, context_, "TRN-350",
           "a corner function is in force here, which the target has for single blocks only; the program comes here or "
           "goes on from here on another way",
           "end it before, or write the corner in every block", {});
    lasting_.reset();
  }

  /// Brings the corner of the block into a form of the target; the element that stands for it where it has none.
  std::optional<Statement> take(Body& body, std::size_t at) {
    Statement& s = body[at];
    auto& b = std::get<Block>(s.node);
    for (std::size_t i = 0; i < b.actions.size(); ++i) {
      const auto* c = std::get_if<Corner>(&b.actions[i].data);
      if (c == nullptr || !c->modal || target().corner_modal) continue;
      if (s.line.skip_mask != 0) {
        leaves(s);
        return std::nullopt;
      }
      lasting_ = *c;
      if (lasting_->value.literal() && lasting_->value.number <= 0) lasting_.reset();
      b.actions.erase(b.actions.begin() + static_cast<std::ptrdiff_t>(i));
      settle(s);
      break;
    }
    auto* block = std::get_if<Block>(&s.node);
    if (block == nullptr) return std::nullopt;
    const auto own = std::find_if(block->actions.begin(), block->actions.end(), [](const Action& a) {
      const auto* c = std::get_if<Corner>(&a.data);
      return c != nullptr && !c->modal;
    });
    if (own != block->actions.end()) {
      const auto action = static_cast<std::size_t>(own - block->actions.begin());
      if (std::get<Corner>(own->data).value.is(0)) return take_out(s, action);  // sharp, whatever stays in force
      return single(body, at, action);
    }
    if (!lasting_ || !contour(s)) return std::nullopt;
    if (!lasting_->value.literal()) {
      leaves(s);
      return std::nullopt;
    }
    if (skipped_behind(body, at)) {
      leaves(s);
      return std::nullopt;
    }
    const Statement* next = following(body, at);
    if (next == nullptr || !contour(*next) || plane_at(s) != plane_at(*next)) return std::nullopt;
    if (cycle_before(body, at, *next)) return std::nullopt;
    if (along_one_axis(s, *next)) return std::nullopt;
    if (stays(s, false)) return std::nullopt;
    const auto angle = angle_at(body, at);
    const auto line = [this](const Statement& x) {
      return motion_in(std::get<Block>(x.node), facts_.before(x)) == MotionKind::linear;
    };
    const bool back = angle && *angle < no_turn && line(s) && line(*next);  // from an arc a corner may fit
    if (back || (angle && straight_on(*angle))) return std::nullopt;
    Action a;
    Corner c = *lasting_;
    c.modal = false;
    a.data = c;
    a.order = Order::before;
    block->actions.push_back(std::move(a));
    return single(body, at, block->actions.size() - 1);
  }

  /// A cycle runs before the next element: the contour ends there.
  static bool cycle_before(const Body& body, std::size_t at, const Statement& next) {
    for (std::size_t j = at + 1; j < body.size(); ++j) {
      const auto* b = std::get_if<Block>(&body[j].node);
      for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
        if (std::holds_alternative<CycleDefine>(b->actions[i].data)) return true;
      }
      if (&body[j] == &next) return false;
    }
    return false;
  }

  /// Two lines along the same axis: straight on or back, and nothing to insert in either case.
  static bool along_one_axis(const Statement& s, const Statement& next) {
    const auto only_axis = [](const Statement& x) -> std::optional<AxisId> {
      const Motion& m = std::get<Block>(x.node).motion;
      if (m.coords.size() != 1 || !m.centers.empty() || m.extra != nullptr || m.radius_given) return std::nullopt;
      return m.coords.front().axis;
    };
    const auto axis = only_axis(s);
    return axis && axis == only_axis(next);
  }

  /// The corner of one block.
  std::optional<Statement> single(Body& body, std::size_t at, std::size_t action) {
    Statement& s = body[at];
    auto& b = std::get<Block>(s.node);
    auto& c = std::get<Corner>(b.actions[action].data);
    const WordPos pos = b.actions[action].pos;
    const auto& source = context_.source_machine.policies;
    const bool left_out = source.corner_without_successor == machine::CornerWithoutSuccessor::left_out;
    if (left_out && stands_alone(s)) {
      context_.diagnostics.warning(
          "TRN-462", word_span(s.line.span, pos),
          std::string(stays(s, false) ? "this block does not move in the plane and has no corner"
                                      : "no move in the plane follows this corner") +
              ": the source's control leaves it out, and so does the translation",
          "take the word out of the source");
      return take_out(s, action);
    }
    if (left_out) tell_alone(s, pos);
    const auto angle = angle_at(body, at);
    const bool by_leg = c.kind == CornerKind::chamfer_chord && target().corners.count(c.kind) == 0;
    const bool cut = c.kind != CornerKind::round && at_arc(body, at) && source.corner_chamfer_at_arc &&
                     !context_.target_machine.policies.corner_chamfer_at_arc;
    const bool own = cut || (c.feed && !target().corner_feed);
    if (source.corner_straight_on != machine::CornerStraightOn::refused) {
      if (angle && straight_on(*angle)) {
        if (pos.column != 0)  // else of a corner function that stays in force
          context_.diagnostics.note("TRN-650", word_span(s.line.span, pos),
                                    "the path goes on tangentially here: the source's control inserts no corner, and "
                                    "none is written");
        return take_out(s, action);
      }
      if (!angle && !by_leg && !own) tell_unknown(s, pos, following(body, at));  // else it is refused below
      const Statement* next = following(body, at);
      const bool sure = angle && next != nullptr && going_of(*next, context_, facts_, points_) == Going::along;
      if (const auto ends = ends_.find(s.id); !sure && ends != ends_.end()) {
        for (const auto& where : ends->second.behind)  // the next one may stand still, or others go on
          if (next == nullptr || !(where == next->line.span)) tell_unknown_at(where);
      }
    }
    if (!c.value.literal()) tell_zero(s, pos);
    if (by_leg) {
      if (!angle || !c.value.literal()) {
        refuse(s, program_, context_, "TRN-351",
               "a chamfer by its chord, which the target wants by its legs; the directions before and behind it are "
               "not known here",
               "write the chamfer by its leg", pos);
        return std::nullopt;
      }
      const double half = std::sin(*angle / 2 * std::numbers::pi / 180);
      if (half > 0) c.value = Value{std::round(c.value.number / (2 * half) * 1e6) / 1e6};
      c.kind = CornerKind::chamfer_leg;
    }
    return own ? own_element(body, at, action) : std::nullopt;
  }

  static std::optional<Statement> take_out(Statement& s, std::size_t action) {
    auto& b = std::get<Block>(s.node);
    b.actions.erase(b.actions.begin() + static_cast<std::ptrdiff_t>(action));
    settle(s);
    return std::nullopt;
  }
  /// Whether there is a corner follows from numbers that are not known here, and the target stops where there is none.
  /// It does so at the element behind the corner.
  void tell_unknown(const Statement& s, WordPos pos, const Statement* next) {
    if (context_.target_machine.policies.corner_straight_on != machine::CornerStraightOn::refused) return;
    Span where = word_span(s.line.span, pos);
    if (next != nullptr && next->line.span.file == where.file && next->line.span.line > where.line) {
      where.end_line = next->line.span.line;
      where.end_column = next->line.span.end_column;
    }
    tell_unknown_at(where);
  }
  void tell_unknown_at(const Span& where) {
    if (context_.target_machine.policies.corner_straight_on != machine::CornerStraightOn::refused) return;
    context_.diagnostics.warning("TRN-651", where,
                                 "the directions before and behind this corner are not known here: where the path goes "
                                 "on tangentially, the source's control leaves the corner out and the target stops",
                                 "take the word out where there is no corner");
  }
  /// A computed size: 0 is no corner for the source, and a fault for the target.
  void tell_zero(const Statement& s, WordPos pos) {
    const auto leaves_out = [](const machine::Profile& m) {
      return m.policies.corner_without_successor == machine::CornerWithoutSuccessor::left_out;
    };
    if (zero_told_ || !leaves_out(context_.source_machine) || leaves_out(context_.target_machine)) return;
    zero_told_ = true;
    context_.diagnostics.warning("TRN-654", word_span(s.line.span, pos),
                                 "the size of this corner is computed: where it is 0 the source has no corner, and the "
                                 "target stops (said once a program)",
                                 "make sure that it is never 0");
  }
  static constexpr double no_turn = 1e-4;
  static bool straight_on(double inside) { return inside > 180 - no_turn; }

  /// A straight move of known ends that goes nowhere, in the plane or (`anywhere`) at all.
  [[nodiscard]] bool stays(const Statement& s, bool anywhere) const {
    const auto path = points_.path_of(s);
    if (const auto* m = std::get_if<Block>(&s.node); !path && m != nullptr && m->has_motion && m->motion.moves()) {
      const Going going = going_of(s, context_, facts_, points_);
      return going == Going::stands || (!anywhere && going == Going::apart);
    }
    if (!path || path->e.arc || length(path->e.b - path->e.a) > same_point) return false;
    if (!anywhere) return true;
    const auto& b = std::get<Block>(s.node);
    const Facts& facts = facts_.before(s);
    const auto axes = plane_axes(path->plane);
    return std::all_of(b.motion.coords.begin(), b.motion.coords.end(), [&](const CoordWord& c) {
      if (c.axis == axes.u || c.axis == axes.v) return true;
      const auto d = distance_of(c, b, facts);
      if (!c.value.literal() || !d || is_diameter_axis(context_.source_machine, c.axis)) return false;
      return *d == Distance::incremental ? c.value.is(0) : facts.position[c.axis] == c.value.number;
    });
  }

  /// The corner has no second element: a move outside of the plane or the end of the program comes first on every way.
  bool stands_alone(const Statement& s) const {
    if (!plane_words(s) || stays(s, false)) return true;
    const auto ends = ends_.find(s.id);
    return ends != ends_.end() && !ends->second.alone.empty() && !ends->second.followed;
  }
  /// On some way it has none.
  void tell_alone(const Statement& s, WordPos pos) {
    const auto ends = ends_.find(s.id);
    if (ends == ends_.end() ||
        context_.target_machine.policies.corner_without_successor == machine::CornerWithoutSuccessor::left_out)
      return;
    const auto tell = [this](const Span& where, std::string_view what) {
      context_.diagnostics.warning(
          "TRN-656", where,
          std::string(what) + ": the source's control leaves the corner out then, and the target stops",
          "let a move in the plane follow the corner on every way");
    };
    if (!ends->second.alone.empty())
      tell(word_span(s.line.span, pos), "on some way no move in the plane follows this corner");
    for (const auto& where : ends->second.alone) tell(where, "a corner may still wait for a move in the plane here");
  }
  /// The block moves in its plane, or may.
  bool plane_words(const Statement& s) const {
    const auto& m = std::get<Block>(s.node).motion;
    const auto plane = plane_at(s);
    if (!plane || m.extra || !m.centers.empty() || m.radius_given) return true;
    const auto axes = plane_axes(*plane);
    return std::any_of(m.coords.begin(), m.coords.end(),
                       [&](const CoordWord& c) { return c.axis == axes.u || c.axis == axes.v; });
  }
  bool at_arc(Body& body, std::size_t at) {
    const Statement* next = following(body, at);
    const auto arc = [this](const Statement& s) {
      const auto kind = motion_in(std::get<Block>(s.node), facts_.before(s));
      return !kind || *kind == MotionKind::arc_cw || *kind == MotionKind::arc_ccw;
    };
    const auto ends = ends_.find(body[at].id);  // a caller, or the way behind a jump, may go on
    return arc(body[at]) || (next != nullptr ? arc(*next) : ends != ends_.end() && ends->second.at_arc);
  }

  /// Degrees inside of the corner behind the block.
  std::optional<double> angle_at(Body& body, std::size_t at) {
    const Statement* next = following(body, at);
    if (next == nullptr || !contour(*next)) return std::nullopt;
    const auto a = points_.path_of(body[at], true), b = points_.path_of(*next, true);
    if (a && b && a->plane == b->plane) return interior_angle(a->e, b->e);
    const auto first = only_axis(body[at]), second = only_axis(*next);
    return first && second && *first != *second ? std::optional<double>(90) : std::nullopt;
  }
  /// The axis of a straight move along one axis of the plane.
  std::optional<AxisId> only_axis(const Statement& s) const {
    const auto& b = std::get<Block>(s.node);
    const auto plane = plane_at(s);
    if (!plane || b.motion.extra || motion_in(b, facts_.before(s)) != MotionKind::linear) return std::nullopt;
    const auto axes = plane_axes(*plane);
    std::optional<AxisId> axis;
    for (const auto& c : b.motion.coords) {
      if (c.axis != axes.u && c.axis != axes.v) continue;
      if (axis) return std::nullopt;
      axis = c.axis;
    }
    return axis;
  }

  /// The corner as an element of its own, at its feed; the block behind it goes on at the feed before.
  std::optional<Statement> own_element(Body& body, std::size_t at, std::size_t action) {
    Statement& s = body[at];
    auto& b = std::get<Block>(s.node);
    const Corner c = std::get<Corner>(b.actions[action].data);
    const WordPos pos = b.actions[action].pos;
    const bool straight = c.kind != CornerKind::round;
    const auto fail = [&](std::string why) -> std::optional<Statement> {
      const bool feed = c.feed && !target().corner_feed;
      refuse(s, program_, context_, "TRN-352",
             (feed ? "a feed for this corner alone, which the target lacks; "
                   : "a chamfer at an arc, which the target lacks; ") +
                 std::move(why),
             "write the corner as an element of its own", pos);
      return std::nullopt;
    };
    Statement* next = following(body, at);
    const auto here = points_.path_of(s), after = next != nullptr ? points_.path_of(*next) : std::nullopt;
    if (!here || !after || here->plane != after->plane || !contour(*next) || !c.value.literal() ||
        s.line.skip_mask != 0)
      return fail("the points around it are not known here as numbers");
    auto& then = std::get<Block>(next->node);
    const auto feed = facts_.before(*next).feed;
    const bool given = sets_feed(then);
    if (c.feed && !given && !feed) return fail("the feed behind it is not known here");
    Fillet f;
    std::string why;
    const bool arcs = here->e.arc || after->e.arc;
    if (!(!straight ? fillet : arcs ? chamfer_along : chamfer)(here->e, after->e, c.value.number, f, why))
      return fail(std::move(why));
    b.actions.erase(b.actions.begin() + static_cast<std::ptrdiff_t>(action));
    if (f.none) return std::nullopt;
    Block element;
    element.has_motion = true;
    element.motion.kind = straight ? MotionKind::linear : f.ccw ? MotionKind::arc_ccw : MotionKind::arc_cw;
    element.motion.explicit_code = true;
    element.motion.keeps_modal = false;
    element.actions = take_after(b);
    points_.set_end(b.motion, here->plane, f.from);
    if (here->e.arc) PathPoints::set_centre(b.motion, here->plane, here->e.a, here->e.c);
    points_.set_end(element.motion, here->plane, f.to);
    points_.set_end(then.motion, here->plane, after->e.b);
    if (after->e.arc) PathPoints::set_centre(then.motion, here->plane, f.to, after->e.c);
    points_.begins_at(*next, f.to);
    if (!straight) PathPoints::set_centre(element.motion, here->plane, f.from, f.centre);
    if (c.feed) add_feed(element, *c.feed);
    if (c.feed && !given) add_feed(then, Value{*feed});
    context_.diagnostics.note("TRN-353", word_span(s.line.span, pos),
                              c.feed ? "the corner is written as an element of its own, for its feed"
                                     : "the chamfer at an arc is written as an element of its own");
    return made(s.line, std::move(element));
  }
  static bool sets_feed(const Block& b) {
    return std::any_of(b.actions.begin(), b.actions.end(),
                       [](const Action& a) { return std::holds_alternative<SetFeed>(a.data); });
  }
  static void add_feed(Block& b, const Value& value) {
    Action a;
    a.data = SetFeed{value};
    a.order = Order::before;
    b.actions.push_back(std::move(a));
  }

  /// A block that may be skipped stands before the next move, or is it.
  static bool skipped_behind(const Body& body, std::size_t at) {
    for (std::size_t j = at + 1; j < body.size(); ++j) {
      if (body[j].line.skip_mask != 0) return true;
      const auto* b = std::get_if<Block>(&body[j].node);
      if (b != nullptr && b->has_motion && b->motion.moves()) return false;
    }
    return false;
  }
  /// The next statement that moves, where nothing stands between that could change the way there.
  Statement* following(Body& body, std::size_t at) {
    for (std::size_t j = at + 1; j < body.size(); ++j) {
      auto* b = std::get_if<Block>(&body[j].node);
      if (b == nullptr && !passes_by(body[j])) return nullptr;
      if (b != nullptr && (moves_frames(*b) || body[j].line.skip_mask != 0)) return nullptr;
      if (b != nullptr && b->has_motion && b->motion.moves() && !stays(body[j], true)) return &body[j];
    }
    return nullptr;
  }
  std::optional<Plane> plane_at(const Statement& s) const {
    return setting_in<Plane>(std::get<Block>(s.node), facts_.before(s), Setting::plane);
  }
  /// A move at feed in the plane.
  bool contour(const Statement& s) const {
    const auto& b = std::get<Block>(s.node);
    if (!b.has_motion || !b.motion.moves() || b.motion.frame != FrameUse::normal) return false;
    const auto kind = motion_in(b, facts_.before(s));
    const bool straight = kind == MotionKind::linear;
    if (!straight && kind != MotionKind::arc_cw && kind != MotionKind::arc_ccw) return false;
    const auto plane = plane_at(s);
    if (!straight || !plane || b.motion.extra) return true;
    const auto axes = plane_axes(*plane);
    return std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                       [&](const CoordWord& c) { return c.axis == axes.u || c.axis == axes.v; });
  }

  Program& program_;
  const LegaliseContext& context_;
  const FactsOf& facts_;
  PathPoints points_;
  std::map<std::uint32_t, CornerEnds> ends_;
  LabelUses uses_;
  std::optional<Corner> lasting_;  ///< in force
  bool zero_told_ = false;         ///< tell_zero() has spoken
};

/// Whether there is a corner that the target can't write as it stands.
bool wanted(const Program& program, const LegaliseContext& context) {
  const Capabilities& target = context.target;
  const auto &here = context.source_machine.policies, &there = context.target_machine.policies;
  const bool habits = here.corner_chamfer_at_arc != there.corner_chamfer_at_arc ||
                      here.corner_without_successor != there.corner_without_successor ||
                      here.corner_straight_on != there.corner_straight_on;
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        const auto* c = std::get_if<Corner>(&a.data);
        found = found ||
                (c != nullptr &&
                 (habits || c->value.is(0) || (c->modal && !target.corner_modal) || (c->feed && !target.corner_feed) ||
                  (c->kind == CornerKind::chamfer_chord && target.corners.count(c->kind) == 0)));
      }
    });
  }
  return found;
}

}  // namespace

void write_out_corners(Program& program, const LegaliseContext& context) {
  if (context.target.corners.empty() || !wanted(program, context)) return;
  const FactsOf facts(program, context);
  CornerPass pass(program, context, facts);
  for (auto& r : program.routines) pass.routine(r);
}

}  // namespace cnctrans::ir::passes
