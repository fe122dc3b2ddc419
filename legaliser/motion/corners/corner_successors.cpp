#include "legaliser/motion/corners/corner_successors.h"

#include <algorithm>
#include <set>

#include "ir/analysis/flow_states.h"
#include "ir/edit/search.h"
#include "ir/geometry/geometry.h"
#include "ir/motion_kinds.h"
#include "legaliser/analysis/words.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

using namespace geometry;

namespace {

/// Whether the word moves its axis; nullopt: not known here.
std::optional<bool> moves_axis(const CoordWord& c, const Block& b, const Facts& facts, const LegaliseContext& context) {
  const auto d = distance_of(c, b, facts);
  if (!c.value.literal() || !d) return std::nullopt;
  if (*d == Distance::incremental) return !c.value.is(0);
  const auto& at = facts.position[c.axis];
  const auto f = to_radius(c.axis, c.scale, d, b, facts, context.source_machine);
  if (!at || !f) return std::nullopt;
  return std::abs(*at - c.value.number * *f) > same_point;
}

}  // namespace

Going going_of(const Statement& s, const LegaliseContext& context, const FactsOf& facts, const PathPoints& points) {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || !b->has_motion || !b->motion.moves()) return Going::stands;
  const Motion& m = b->motion;
  const Facts& known = facts.before(s);
  const auto plane = setting_in<Plane>(*b, known, Setting::plane);
  if (!plane || m.extra || !m.centers.empty() || m.radius_given) return Going::along;
  const auto axes = plane_axes(*plane);
  if (const auto path = points.path_of(s); path && (path->e.arc || length(path->e.b - path->e.a) > same_point))
    return Going::along;
  Going step = Going::stands;
  for (const auto& c : m.coords) {
    const auto moved = moves_axis(c, *b, known, context);
    const bool inside = c.axis == axes.u || c.axis == axes.v;
    if (inside && moved == true) return Going::along;
    if (inside && !moved) step = Going::perhaps;
    if (!inside && moved != false && step == Going::stands) step = Going::apart;
  }
  return step;
}

namespace {

/// A domain of FlowStates: the corners (ids of their blocks) that wait for the element behind them, on some way.
class WaitingCorners {
 public:
  using State = std::set<std::uint32_t>;
  WaitingCorners(const Program& program, const LegaliseContext& context, const FactsOf& facts)
      : context_(context), facts_(facts), points_(context, facts), lasting_(any_action(program, [](const Action& a) {
          const auto* c = std::get_if<Corner>(&a.data);
          return c != nullptr && c->modal;
        })) {}

  [[nodiscard]] static State start(const Routine& /*unused*/, bool /*unused*/) { return {}; }
  void transfer(const Statement& s, State& state) const {
    const Going step = step_of(s);
    if (step == Going::along || step == Going::apart) state.clear();
    if (has_corner(s)) state.insert(s.id);
  }
  [[nodiscard]] bool touches(const Routine& r) const {
    bool found = false;
    for_each_statement(r.body, [&](const Statement& s) { found = found || step_of(s) != Going::stands; });
    return found;
  }
  static void unknown(State& /*state*/) {}
  static bool join(State& a, const State& b) {
    const std::size_t before = a.size();
    a.insert(b.begin(), b.end());
    return a.size() != before;
  }

  [[nodiscard]] Going step_of(const Statement& s) const { return going_of(s, context_, facts_, points_); }

 private:
  [[nodiscard]] bool has_corner(const Statement& s) const {
    const auto* b = std::get_if<Block>(&s.node);
    if (lasting_ && b != nullptr && b->has_motion) return true;
    return b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
             const auto* c = std::get_if<Corner>(&a.data);
             return c != nullptr && !c->modal && !c->value.is(0);
           });
  }
  const LegaliseContext& context_;
  const FactsOf& facts_;
  PathPoints points_;
  bool lasting_;  ///< a corner function stays in force somewhere: every move may have one
};

}  // namespace

std::map<std::uint32_t, CornerEnds> corner_ends(const Program& program, const LegaliseContext& context,
                                                const FactsOf& facts) {
  const WaitingCorners domain(program, context, facts);
  const FlowStates<WaitingCorners> states(program, domain);
  std::map<std::uint32_t, CornerEnds> all;
  const auto alone = [&all](const WaitingCorners::State& waiting, const Span& where) {
    for (const auto id : waiting) all[id].alone.push_back(where);
  };
  for (std::size_t i = 0; i < program.routines.size(); ++i) {
    const Routine& r = program.routines[i];
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* waiting = states.before(s);
      if (waiting == nullptr || waiting->empty()) return;
      const auto* end = std::get_if<End>(&s.node);
      const Going step = domain.step_of(s);
      const bool ends = end != nullptr && (!end->returns_from_sub || r.kind == RoutineKind::main);
      if (step == Going::apart || ends) alone(*waiting, s.line.span);
      if (step != Going::along && step != Going::perhaps && !std::holds_alternative<Opaque>(s.node)) return;
      const auto* b = std::get_if<Block>(&s.node);
      const auto kind = b != nullptr ? motion_in(*b, facts.before(s)) : std::nullopt;
      for (const auto id : *waiting) {
        all[id].at_arc = all[id].at_arc || !kind || is_any_arc(*kind);
        all[id].followed = true;
        all[id].behind.push_back(s.line.span);
      }
    });
    const auto* left = states.behind(i);
    if (left == nullptr || r.body.empty()) continue;
    if (r.kind == RoutineKind::main)
      alone(*left, r.body.back().line.span);
    else if (!states.called(i))
      for (const auto id : *left) all[id].followed = true;  // by whoever calls it
  }
  return all;
}

}  // namespace cnctrans::ir::passes
