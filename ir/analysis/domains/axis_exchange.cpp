#include "ir/analysis/domains/axis_exchange.h"

#include <algorithm>
#include <array>

#include "ir/analysis/flow_states.h"
#include "ir/axis_mask.h"
#include "ir/edit/rewrite.h"
#include "ir/motion_kinds.h"

namespace cnctrans::ir::passes {

namespace {

/// Which axes the words of each axis may move.
struct Exchanged {
  std::array<AxisMask, axis::count_max> moves{};

  Exchanged() {
    for (std::size_t a = 0; a < moves.size(); ++a) moves[a] = axis_bit(static_cast<AxisId>(a));
  }
  [[nodiscard]] bool own(AxisId a) const { return moves[a] == axis_bit(a); }
  [[nodiscard]] bool sure(AxisId a) const { return (moves[a] & (moves[a] - 1)) == 0; }
  [[nodiscard]] AxisId partner(AxisId a) const {
    AxisId p = 0;
    while ((moves[a] & axis_bit(p)) == 0) ++p;
    return p;
  }
  [[nodiscard]] bool any() const {
    for (std::size_t a = 0; a < moves.size(); ++a) {
      if (!own(static_cast<AxisId>(a))) return true;
    }
    return false;
  }
  [[nodiscard]] bool any_of_space() const { return !own(axis::x) || !own(axis::y) || !own(axis::z); }
};

/// What may be in force besides.
struct Shape {
  bool arc = false, comp = false, cycle = false;
};

/// The pairs in force. A routine that exchanges nothing itself leaves those of each of its callers as they are.
struct PairDomain {
  using State = Exchanged;
  const ReadExchange* read;

  static State start(const Routine& /*r*/, bool /*called*/) { return {}; }
  [[nodiscard]] bool touches(const Routine& r) const {
    bool found = false;
    for_each_statement(r.body, [&](const Statement& s) { found = found || (*read)(s).has_value(); });
    return found;
  }
  static void unknown(State& /*s*/) {}  // told at the call
  void transfer(const Statement& s, State& state) const {
    const auto exchange = (*read)(s);
    if (!exchange) return;
    for (const AxisId a : exchange->ends) end(state, a);
    for (const auto& [a, b] : exchange->pairs) {
      state.moves[a] = axis_bit(b);
      state.moves[b] = axis_bit(a);
    }
  }
  static bool join(State& state, const State& other) {
    bool changed = false;
    for (std::size_t a = 0; a < state.moves.size(); ++a) {
      const AxisMask both = state.moves[a] | other.moves[a];
      changed = changed || both != state.moves[a];
      state.moves[a] = both;
    }
    return changed;
  }

 private:
  static void end(State& state, AxisId a) {
    const AxisMask partners = state.moves[a] & ~axis_bit(a);
    state.moves[a] = axis_bit(a);
    for (AxisId p = 0; p < axis::count_max; ++p) {
      if ((partners & axis_bit(p)) == 0) continue;
      state.moves[p] &= ~axis_bit(a);
      if (state.moves[p] == 0) state.moves[p] = axis_bit(p);
    }
  }
};

struct ShapeDomain {
  using State = Shape;

  static State start(const Routine& /*r*/, bool /*called*/) { return {}; }
  static bool touches(const Routine& /*r*/) { return true; }
  static void unknown(State& /*s*/) {}
  static void transfer(const Statement& s, State& state) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    if (b->has_motion && b->motion.kind != MotionKind::modal && b->motion.keeps_modal)
      state.arc = is_any_arc(b->motion.kind);
    for (const auto& a : b->actions) {
      if (const auto* set = std::get_if<ModalSet>(&a.data); set != nullptr && set->setting == Setting::comp)
        state.comp = set->value != static_cast<std::uint8_t>(CompSide::off);
      if (const auto* d = std::get_if<CycleDefine>(&a.data)) state.cycle = d->modal;
      if (std::holds_alternative<CycleCancel>(a.data)) state.cycle = false;
    }
  }
  static bool join(State& state, const State& other) {
    bool changed = false;
    const auto also = [&changed](bool& mine, bool theirs) {
      changed = changed || (theirs && !mine);
      mine = mine || theirs;
    };
    also(state.arc, other.arc);
    also(state.comp, other.comp);
    also(state.cycle, other.cycle);
    return changed;
  }
};

class Rewriter {
 public:
  Rewriter(const Exchanged& state, const Shape& shape, Statement& s) : state_(state), shape_(shape), statement_(s) {}

  /// nullopt: done, or nothing to do.
  std::optional<ExchangeFault> rewrite(bool& changed) {
    auto* b = std::get_if<Block>(&statement_.node);
    if (b == nullptr || !state_.any()) return std::nullopt;
    bool named = false, sure = true;
    const auto look = [&](AxisId a) {
      if (a >= axis::count_max || state_.own(a)) return;
      named = true;
      sure = sure && state_.sure(a);
    };
    bool other = false;  // something besides the end points of straight moves
    for (const auto& a : b->actions) {
      if (const auto* f = std::get_if<FrameOp>(&a.data)) {
        for (const auto& w : f->change->words) look(w.axis);
        other = other || named || (f->change->kind != FrameKind::translate && state_.any_of_space());
      }
      other = other || ((std::holds_alternative<PoleSet>(a.data) || std::holds_alternative<CycleDefine>(a.data) ||
                         std::holds_alternative<Corner>(a.data) || std::holds_alternative<TangentialEnd>(a.data)) &&
                        state_.any_of_space());
    }
    const Motion& m = b->motion;
    if (b->has_motion) {
      for (const auto& w : m.coords) look(w.axis);
      const bool arc = is_any_arc(m.kind) || (m.kind == MotionKind::modal && shape_.arc);
      const bool curved = m.moves() && (arc || shape_.comp || shape_.cycle || m.extra || !m.centers.empty());
      other = other || (state_.any_of_space() && curved) || (named && m.kind == MotionKind::reference_point);
    }
    if (other) return ExchangeFault::not_said;
    if (!named) return std::nullopt;
    if (!sure) return ExchangeFault::unsure;
    for (auto& w : b->motion.coords) {
      if (!state_.own(w.axis)) w.axis = state_.partner(w.axis);
    }
    changed = true;
    return std::nullopt;
  }

 private:
  const Exchanged& state_;
  const Shape& shape_;
  Statement& statement_;
};

/// A pair of which an axis is exchanged already, and goes on to be.
bool pairs_again(const Exchanged& before, const AxisExchange& exchange) {
  const auto ended = [&](AxisId a) {
    return std::any_of(exchange.ends.begin(), exchange.ends.end(),
                       [&](AxisId e) { return e == a || (before.moves[e] & axis_bit(a)) != 0; });
  };
  return std::any_of(exchange.pairs.begin(), exchange.pairs.end(), [&](const auto& p) {
    return (!before.own(p.first) && !ended(p.first)) || (!before.own(p.second) && !ended(p.second));
  });
}

/// A position or another datum of an axis that is exchanged is read.
bool reads_exchanged(const Exchanged& before, const Statement& s) {
  bool found = false;
  if (!before.any()) return false;
  each_expression(s, [&](const ExprPtr& e) {
    const auto* datum = std::get_if<SystemRef>(&e->node);
    const auto* name = std::get_if<AxisName>(&e->node);
    const AxisId a = datum != nullptr ? datum->axis : name != nullptr ? name->axis : axis::none;
    found = found || (a < axis::count_max && !before.own(a));
  });
  return found;
}

bool at_hand(const Program& program, const Statement& s) {
  const auto* c = std::get_if<CallRoutine>(&s.node);
  const auto* m = std::get_if<ModalCall>(&s.node);
  if (m != nullptr && !m->off && !m->cycle) c = &m->call;
  return c == nullptr || (!c->computed && program.find(c->routine) != nullptr);
}

/// Some blocks of another routine run here: what they exchange, and what they move, is not followed.
bool runs_part(const Program& program, const Statement& s, const Exchanged& before, const PairDomain& pairs) {
  const auto* c = std::get_if<CallRoutine>(&s.node);
  const auto* r = std::get_if<Repeat>(&s.node);
  const Routine* of = nullptr;
  if (c != nullptr && c->has_range && !c->computed) of = program.find(c->routine);
  if (r != nullptr && r->has_program) of = program.find(r->program);
  return of != nullptr && (before.any() || pairs.touches(*of));
}

}  // namespace

bool exchange_axes(Program& program, const ReadExchange& read, const TellExchange& fault, const TellExchanged& done) {
  bool any = false;
  for (const auto& r : program.routines)
    for_each_statement(r.body, [&](const Statement& s) { any = any || read(s).has_value(); });
  if (!any) return false;
  number_statements(program);
  const PairDomain pairs{&read};
  const FlowStates<PairDomain> states(program, pairs);
  const ShapeDomain shapes;
  const FlowStates<ShapeDomain> shape_of(program, shapes);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      const Exchanged* before = states.before(s);
      const Shape* shape = shape_of.before(s);
      if (before == nullptr || shape == nullptr) return;
      if (const auto exchange = read(s)) {
        if (pairs_again(*before, *exchange)) fault(s, ExchangeFault::twice);
        return;
      }
      if (reads_exchanged(*before, s)) return fault(s, ExchangeFault::not_said);
      if (runs_part(program, s, *before, pairs)) return fault(s, ExchangeFault::unsure);
      if (before->any() && !at_hand(program, s)) fault(s, ExchangeFault::outside);
      bool changed = false;
      const auto why = Rewriter(*before, *shape, s).rewrite(changed);
      if (why) fault(s, *why);
      if (changed) done(s);
    });
  }
  return true;
}

}  // namespace cnctrans::ir::passes
