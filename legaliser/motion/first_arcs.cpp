// The first move behind a change of mirror or rotation is an arc with its centre from the start: some controls ask for
// the absolute centre there (equivalences 17.4).
#include "base/text.h"
#include "ir/analysis/flow_states.h"
#include "legaliser/analysis/path_points.h"
#include "legaliser/motion/arc_pass.h"

namespace cnctrans::ir::passes {

namespace {

/// A domain of FlowStates: whether, on some way, the coordinates were turned and nothing has moved since.
class TurnDomain {
 public:
  struct State {
    bool turned = false, fresh = false;
  };
  [[nodiscard]] static State start(const Routine& /*r*/, bool /*called*/) { return {}; }
  static void follow(const FrameChange& f, State& state) {
    const bool turns = f.combine != FrameCombine::clear && (f.kind == FrameKind::mirror || f.kind == FrameKind::rotate);
    const bool ends = state.turned &&
                      (f.slot == FrameSlot::chain || f.slot == FrameSlot::rotation || f.slot == FrameSlot::mirror) &&
                      (f.combine == FrameCombine::clear || f.combine == FrameCombine::replace);
    if (!turns && !ends) return;
    state.fresh = true;
    state.turned = turns;
  }
  static void actions(const Block& b, State& state) {
    for (const auto& a : b.actions) {
      if (const auto* f = std::get_if<FrameOp>(&a.data); f != nullptr && f->change != nullptr)
        follow(*f->change, state);
    }
  }
  static void transfer(const Statement& s, State& state) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    actions(*b, state);
    if (b->has_motion && b->motion.moves()) state.fresh = false;
  }
  static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      found = found || (b != nullptr && (b->has_motion || !b->actions.empty()));
    });
    return found;
  }
  static void unknown(State& /*state*/) {}
  static bool join(State& a, const State& b) {
    const bool changed = (b.turned && !a.turned) || (b.fresh && !a.fresh);
    a.turned = a.turned || b.turned;
    a.fresh = a.fresh || b.fresh;
    return changed;
  }
};

}  // namespace

void check_first_arcs(const Program& program, const LegaliseContext& context, const FactsOf& facts) {
  if (context.target_machine.policies.frame_first_arc != machine::FrameFirstArc::absolute_centre) return;
  bool any = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&any](const Statement& s) {
      TurnDomain::State state;
      if (const auto* b = std::get_if<Block>(&s.node)) TurnDomain::actions(*b, state);
      any = any || state.turned;
    });
  }
  if (!any) return;
  const TurnDomain domain;
  const FlowStates<TurnDomain> states(program, domain);
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      const auto* before = b == nullptr ? nullptr : states.before(s);
      if (before == nullptr || !b->has_motion || b->motion.centers.empty()) return;
      TurnDomain::State state = *before;
      TurnDomain::actions(*b, state);
      const auto kind = motion_in(*b, facts.before(s));
      const bool arc = !kind || *kind == MotionKind::arc_cw || *kind == MotionKind::arc_ccw;
      const bool from_start = std::any_of(b->motion.centers.begin(), b->motion.centers.end(),
                                          [](const CenterWord& c) { return c.mode != CenterMode::absolute; });
      if (!state.fresh || !arc || !from_start) return;
      context.diagnostics.warning(
          "TRN-475", s.line.span,
          "an arc is the first move behind a change of mirror or rotation, and its centre counts from its start: this "
          "control asks for an absolute centre there",
          "give the centre absolute in the source, or move to the start of the arc again before it");
    });
  }
}

void check_radii(const Program& program, const LegaliseContext& context, const FactsOf& facts) {
  const double most = context.target_machine.arc_tolerance;
  if (most >= context.source_machine.arc_tolerance) return;
  const PathPoints points(context, facts);
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !b->has_motion || (b->motion.centers.empty() && !b->motion.radius_given)) return;
      const auto path = points.path_of(s);
      if (!path || !path->e.arc) return;
      const auto& e = path->e;
      const double unit = setting_in<Units>(*b, facts.before(s), Setting::units) == Units::inch ? 25.4 : 1;
      const bool by_radius = b->motion.radius_given && b->motion.radius.literal();
      const double off = by_radius ? geometry::length(e.b - e.a) * unit - 2 * std::abs(b->motion.radius.number) * unit
                                   : std::abs(geometry::length(e.a - e.c) - geometry::length(e.b - e.c)) * unit;
      if (off <= most || off > context.source_machine.arc_tolerance) return;
      context.diagnostics.error(
          "TRN-317", s.line.span,
          (by_radius ? "the end of this arc lies " + rounded(off, 4) + " mm beyond its diameter"
                     : "the radius of this arc differs by " + rounded(off, 4) + " mm between its start and its end") +
              "; the source's control takes that, the target " + rounded(most, 4) + " mm at most",
          by_radius ? "correct its end or its radius"
                    : "correct its end or its centre, or write the arc by its radius");
    });
  }
}

}  // namespace cnctrans::ir::passes
