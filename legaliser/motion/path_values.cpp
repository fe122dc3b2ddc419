#include "legaliser/motion/path_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ir/known_number.h"
#include "ir/motion_kinds.h"
#include "legaliser/analysis/words.h"

namespace cnctrans::ir::passes {

namespace {

constexpr int largest = 48;  ///< nodes of a formula that a person still reads

/// A sum as the part that is computed and the number added to it.
struct Sum {
  ExprPtr rest;
  double number = 0;
};
Sum sum_of(const Value& v) {
  if (v.literal()) return {nullptr, v.number};
  const auto* b = std::get_if<Binary>(&v.expr->node);
  if (b == nullptr || (b->op != BinaryOp::add && b->op != BinaryOp::subtract)) return {v.expr, 0};
  const auto left = constant_value(b->left), right = constant_value(b->right);
  if (right) {
    Sum s = sum_of(Value{b->left});
    s.number += b->op == BinaryOp::add ? *right : -*right;
    return s;
  }
  if (!left) return {v.expr, 0};
  Sum s = sum_of(Value{b->right});
  if (b->op == BinaryOp::subtract) {
    if (s.rest) s.rest = unary(UnaryOp::negate, s.rest);
    s.number = -s.number;
  }
  s.number += *left;
  return s;
}
const ExprPtr* negated_in(const ExprPtr& e) {
  const auto* u = std::get_if<Unary>(&e->node);
  return u != nullptr && u->op == UnaryOp::negate ? &u->operand : nullptr;
}
Value plus(const ExprPtr& rest, double n) {
  return rest ? add(Value{rest}, Value{n}) : Value{n};
}
Value difference(const Value& a, const Value& b);
Value total(const Value& a, const Value& b) {
  const Sum x = sum_of(a), y = sum_of(b);
  const double n = x.number + y.number;
  if (!x.rest || !y.rest) {
    const ExprPtr& rest = x.rest ? x.rest : y.rest;
    const ExprPtr* turned = rest ? negated_in(rest) : nullptr;
    if (turned != nullptr && n != 0) return Value{binary(BinaryOp::subtract, number(n), *turned)};
    return plus(rest, n);
  }
  if (const auto* turned = negated_in(y.rest)) return difference(Value{x.rest}, plus(*turned, -n));
  return plus(binary(BinaryOp::add, x.rest, y.rest), n);
}
Value difference(const Value& a, const Value& b) {
  const Sum x = sum_of(a), y = sum_of(b);
  const double n = x.number - y.number;
  if (!y.rest) return plus(x.rest, n);
  if (x.rest && equal(x.rest, y.rest)) return Value{n};
  if (const auto* turned = negated_in(y.rest)) return total(plus(x.rest, n), Value{*turned});
  if (x.rest) return plus(binary(BinaryOp::subtract, x.rest, y.rest), n);
  return n == 0 ? Value{unary(UnaryOp::negate, y.rest)} : Value{binary(BinaryOp::subtract, number(n), y.rest)};
}
Value magnitude(const Value& v) {
  if (v.literal()) return Value{std::fabs(v.number)};
  if (const auto* turned = negated_in(v.expr)) return magnitude(Value{*turned});
  const auto* c = std::get_if<Call>(&v.expr->node);
  if (c != nullptr && (c->function == Function::abs || c->function == Function::sqrt)) return v;
  return Value{call(Function::abs, {v.expr})};
}
Value distance(const Value& du, const Value& dv) {
  if (dv.is(0)) return magnitude(du);
  if (du.is(0)) return magnitude(dv);
  const auto square = [](const Value& v) {
    if (v.literal()) return number(v.number * v.number);
    const auto* c = std::get_if<Call>(&v.expr->node);
    const ExprPtr& e = c != nullptr && c->function == Function::abs ? c->args.front() : v.expr;
    return binary(BinaryOp::multiply, e, e);
  };
  if (du.literal() && dv.literal()) return Value{std::hypot(du.number, dv.number)};
  return Value{call(Function::sqrt, {binary(BinaryOp::add, square(du), square(dv))})};
}

/// Short enough, and the same whenever it is computed while the variables are.
bool sayable(const Value& v) {
  if (v.literal()) return true;
  int nodes = 0;
  bool lasting = true;
  walk(v.expr, [&](const ExprPtr& e) {
    ++nodes;
    lasting = lasting && !std::holds_alternative<SystemRef>(e->node);
  });
  return lasting && nodes <= largest;
}
std::optional<Value> kept(std::optional<Value> v) {
  if (!v || !sayable(*v)) return std::nullopt;
  v->text = {};
  return v;
}
std::optional<Value> shared(const std::optional<Value>& a, const std::optional<Value>& b) {
  return a && b && equal(*a, *b) ? a : std::nullopt;
}
bool differ(const std::optional<Value>& a, const std::optional<Value>& b) {
  return a.has_value() != b.has_value() || (a && !equal(*a, *b));
}
void forget(std::optional<Value>& v, const VarRef& variable) {
  if (v && v->expr && reads(v->expr, variable)) v.reset();
}
FrameSteps::Place numbers_of(const std::array<std::optional<Value>, axis::count_max>& values) {
  FrameSteps::Place place{};
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (values[i] && values[i]->literal()) place[i] = values[i]->number;
  }
  return place;
}
bool moves_coordinates(const Action& a) {
  const auto* m = std::get_if<ModalSet>(&a.data);
  return std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data) ||
         (m != nullptr && m->setting == Setting::units);
}

}  // namespace

PathValues::PathValues(const FactsOf& facts, const machine::Profile& machine, const FrameSteps& frames)
    : facts_(facts),
      machine_(machine),
      frames_(frames),
      plane_resets_(machine.policies.polar_plane_resets_pole),
      follows_arc_(machine.policies.polar_pole_follows_arc),
      radius_stays_(machine.policies.polar_radius == machine::PolarRadius::programmed),
      pole_stays_(machine.policies.polar_pole_stays) {}

PathValues::State PathValues::start(const Routine& r, bool called) {
  State state;
  if (r.kind == RoutineKind::main && !called) state.pole = ValuePoint{Value{0.0}, Value{0.0}};
  return state;
}

bool PathValues::join(State& a, const State& b) {
  bool changed = false;
  for (std::size_t i = 0; i < a.at.size(); ++i) {
    const auto both = shared(a.at[i], b.at[i]);
    changed = changed || differ(a.at[i], both);
    a.at[i] = both;
  }
  if (a.pole && !(b.pole && equal(a.pole->u, b.pole->u) && equal(a.pole->v, b.pole->v))) {
    a.pole.reset();
    changed = true;
  }
  return changed;
}

void PathValues::crosses(const Statement& /*s*/, std::optional<std::size_t> /*callee*/, State& state) {
  for (auto& v : state.at) {
    if (v && !v->literal()) v.reset();
  }
  if (state.pole && !(state.pole->u.literal() && state.pole->v.literal())) state.pole.reset();
}

PathValues::Place PathValues::places(const Facts& facts, const State& state) const {
  Place at = state.at;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (facts.position[i]) at[i] = Value{*facts.position[i]};
  }
  return at;
}

FrameSteps::Place PathValues::numbers(const Statement& s, const State& before) const {
  return numbers_of(places(facts_.before(s), before));
}

std::optional<Value> PathValues::place(const Statement& s, const State& before, AxisId axis) const {
  return axis < before.at.size() ? places(facts_.before(s), before)[axis] : std::nullopt;
}

void PathValues::set_pole(const PoleSet& p, const Block& b, const Facts& facts, State& state) const {
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  const auto before = std::exchange(state.pole, std::nullopt);
  if (!plane) return;
  const PlaneAxes axes = plane_axes(*plane);
  const Place at = places(facts, state);
  const bool adds = p.at && p.at->combine == FrameCombine::add;
  const bool from_here = !p.at || p.at->combine == FrameCombine::compose;
  std::optional<Value> u, v;
  if (from_here) {
    u = at[axes.u], v = at[axes.v];
  } else if (!adds && p.at->words.empty()) {
    u = v = Value{0.0};
  } else if (before) {
    u = before->u, v = before->v;
  }
  if (p.at) {
    for (const auto& w : p.at->words) {
      auto* slot = w.axis == axes.u ? &u : w.axis == axes.v ? &v : nullptr;
      if (slot == nullptr) continue;
      const bool steps = adds || from_here;
      const auto f = to_radius(w.axis, w.scale, steps ? Distance::incremental : Distance::absolute, b, facts, machine_);
      if (!f || (steps && !*slot)) return;
      const Value by = scale(w.value, *f);
      *slot = kept(steps ? total(**slot, by) : by);
    }
  }
  if (u && v) state.pole = ValuePoint{*u, *v};
}

void PathValues::actions(const Statement& s, State& state) const {
  const auto& b = std::get<Block>(s.node);
  const Facts& facts = facts_.before(s);
  if (std::any_of(b.actions.begin(), b.actions.end(), moves_coordinates)) {
    const auto place = frames_.seen(s, numbers_of(places(facts, state)));
    for (std::size_t i = 0; i < place.size(); ++i)
      state.at[i] = place[i] ? std::optional(Value{*place[i]}) : std::nullopt;
    const bool frames_only = std::none_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
      return moves_coordinates(a) && !std::holds_alternative<FrameOp>(a.data);
    });
    if (!frames_only || (pole_stays_ && frames_.moves_zero(s))) state.pole.reset();
  }
  for (const auto& a : b.actions) {
    if (const auto* m = std::get_if<ModalSet>(&a.data); m != nullptr && m->setting == Setting::plane) {
      const bool other = setting<Plane>(facts, Setting::plane) != static_cast<Plane>(m->value);
      if (plane_resets_)
        state.pole = ValuePoint{Value{0.0}, Value{0.0}};
      else if (other)
        state.pole.reset();
    }
    if (const auto* p = std::get_if<PoleSet>(&a.data)) set_pole(*p, b, facts, state);
  }
}

std::optional<ValuePoint> PathValues::centre(const Block& b, const Facts& facts, const State& state) const {
  if (b.motion.centers.empty()) return state.pole;
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  const auto mode = setting_in<Distance>(b, facts, Setting::distance);
  if (!plane || !mode) return std::nullopt;
  const PlaneAxes axes = plane_axes(*plane);
  const Place at = places(facts, state);
  std::optional<Value> u = at[axes.u], v = at[axes.v];
  for (const auto& w : b.motion.centers) {
    auto* slot = w.axis == axes.u ? &u : w.axis == axes.v ? &v : nullptr;
    const bool absolute =
        w.mode == CenterMode::absolute || (w.mode == CenterMode::follows_distance && mode == Distance::absolute);
    const auto f =
        to_radius(w.axis, w.scale, absolute ? Distance::absolute : Distance::incremental, b, facts, machine_);
    if (slot == nullptr || !f || (!absolute && !*slot)) return std::nullopt;
    const Value by = scale(w.value, *f);
    *slot = kept(absolute ? by : total(**slot, by));
  }
  if (!u || !v) return std::nullopt;
  return ValuePoint{*u, *v};
}

std::optional<PolarEnd> PathValues::end(const Block& b, const Facts& facts, const State& state) const {
  if (!b.has_motion || !b.motion.extra || b.motion.frame != FrameUse::normal || b.repeat_given != 0)
    return std::nullopt;
  const MotionExtra& x = *b.motion.extra;
  const auto kind = motion_in(b, facts);
  const bool arc = kind == MotionKind::arc_cw || kind == MotionKind::arc_ccw;
  const bool line = kind == MotionKind::linear || kind == MotionKind::rapid;
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  const auto mode = setting_in<Distance>(b, facts, Setting::distance);
  const auto counts = [mode](WordMode m) {
    return m == WordMode::absolute || (m == WordMode::modal && mode == Distance::absolute);
  };
  if (!(arc || line) || !plane || !x.has_polar_angle || !counts(x.polar_angle_mode) || x.has_line_angle ||
      x.has_angle || !x.through.empty() || (x.has_polar_radius && !counts(x.polar_mode)) ||
      (line && (!b.motion.centers.empty() || (!x.has_polar_radius && radius_stays_))))
    return std::nullopt;
  const PlaneAxes axes = plane_axes(*plane);
  const auto middle = centre(b, facts, state);
  if (!middle) return std::nullopt;
  PolarEnd found{{}, *middle, x.polar_radius};
  if (!x.has_polar_radius) {
    const Place at = places(facts, state);
    if (!at[axes.u] || !at[axes.v]) return std::nullopt;
    found.radius = distance(difference(*at[axes.u], middle->u), difference(*at[axes.v], middle->v));
  }
  const auto u = kept(total(middle->u, polar_leg(found.radius, x.polar_angle, Function::cos)));
  const auto v = kept(total(middle->v, polar_leg(found.radius, x.polar_angle, Function::sin)));
  if (!u || !v || !sayable(found.radius)) return std::nullopt;
  const Place at = places(facts, state);
  const auto beside = [](const std::optional<Value>& a, const Value& end) {
    constexpr double last_places = 0.002;  // mm
    return a && a->literal() && end.literal() && std::fabs(a->number - end.number) < last_places;
  };
  if (arc && beside(at[axes.u], *u) && beside(at[axes.v], *v)) return std::nullopt;  // a full circle, or none
  found.radius.text = {};
  found.to = {*u, *v};
  return found;
}

std::optional<PolarEnd> PathValues::polar_end(const Statement& s, const State& before) const {
  const auto& b = std::get<Block>(s.node);
  if (std::any_of(b.actions.begin(), b.actions.end(), moves_coordinates)) return std::nullopt;
  State state = before;
  actions(s, state);
  return end(b, facts_.before(s), state);
}

std::optional<Value> PathValues::by_word(AxisId axis, const Block& b, const Facts& facts,
                                         const std::optional<Value>& from) const {
  const auto word = std::find_if(b.motion.coords.begin(), b.motion.coords.end(),
                                 [axis](const CoordWord& c) { return c.axis == axis; });
  if (word == b.motion.coords.end() || word->direction != RotaryDirection::as_value) return std::nullopt;
  const auto mode = distance_of(*word, b, facts);
  const auto f = to_radius(axis, word->scale, mode, b, facts, machine_);
  if (!mode || !f || (*mode == Distance::incremental && !from)) return std::nullopt;
  const Value by = scale(word->value, *f);
  return kept(*mode == Distance::absolute ? by : total(*from, by));
}

void PathValues::block(const Statement& s, const Block& b, State& state) const {
  const Facts& facts = facts_.before(s);
  const bool moved_zero = std::any_of(b.actions.begin(), b.actions.end(), moves_coordinates);
  const bool cycle = facts.cycle_active || !facts.cycle_active_known ||
                     std::any_of(b.actions.begin(), b.actions.end(),
                                 [](const Action& a) { return std::holds_alternative<CycleDefine>(a.data); });
  State behind = state;
  actions(s, behind);
  const Place from = moved_zero ? behind.at : places(facts, state);
  const auto kind = motion_in(b, facts);
  const bool plain = !moved_zero && !cycle && b.has_motion && b.motion.frame == FrameUse::normal &&
                     !(kind && ends_at_the_machine(*kind)) && b.repeat_given == 0 &&
                     !(b.motion.extra && !b.motion.extra->computed.empty());
  const State middle = behind;
  const auto polar = plain ? end(b, facts, middle) : std::nullopt;
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  // The block is carried out from two places that are not in any program: where it leaves them alone, it does not move.
  // The axes are not as far apart in both, or the end of a line by its angle would be the same.
  const auto place_tried = [](std::size_t t, std::size_t i) {
    return t == 0 ? 70001.25 + static_cast<double>(i) : 90007.75 + 3.5 * static_cast<double>(i);
  };
  std::array<Facts, 2> tried{facts, facts};
  Statement moves = s;
  if (moved_zero) std::erase_if(std::get<Block>(moves.node).actions, moves_coordinates);
  const auto numbered = [&](std::size_t i) { return !moved_zero && facts.position[i]; };
  for (std::size_t t = 0; t < tried.size(); ++t) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (!numbered(i)) tried[t].position[i] = place_tried(t, i);
    }
    apply(moves, tried[t]);
  }
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto axis = static_cast<AxisId>(i);
    auto& at = behind.at[i];
    const auto &a = tried[0].position[i], &c = tried[1].position[i];
    const bool stays = !numbered(i) && a == place_tried(0, i) && c == place_tried(1, i);
    if (stays) continue;
    if (polar && plane && (axis == plane_axes(*plane).u || axis == plane_axes(*plane).v))
      at = axis == plane_axes(*plane).u ? polar->to.u : polar->to.v;
    else if (a && a == c)
      at = Value{*a};
    else
      at = plain ? by_word(axis, b, facts, from[i]) : std::nullopt;
  }
  if (follows_arc_ && b.has_motion && !b.motion.centers.empty())
    behind.pole = plain ? centre(b, facts, middle) : std::nullopt;
  state = std::move(behind);
}

void PathValues::transfer(const Statement& s, State& state) const {
  if (const auto* b = std::get_if<Block>(&s.node)) return block(s, *b, state);
  if (const auto* o = std::get_if<Opaque>(&s.node); o != nullptr && !o->harmless) return unknown(state);
  if (const auto* m = std::get_if<ModalCall>(&s.node); m != nullptr && m->here) return unknown(state);
  if (const auto* a = std::get_if<Assign>(&s.node)) {
    for (const auto& i : a->items) {
      if (i.to_system) return unknown(state);
    }
  }
  each_target(s, [&state](const VarRef& v) {
    for (auto& at : state.at) forget(at, v);
    if (!state.pole) return;
    std::optional<Value> pole_u = state.pole->u, pole_v = state.pole->v;
    forget(pole_u, v);
    forget(pole_v, v);
    if (!pole_u || !pole_v) state.pole.reset();
  });
}

void write_end(Block& b, const PolarEnd& end, bool arc, Plane plane, double fu, double fv) {
  Motion& m = b.motion;
  MotionExtra x = *m.extra;
  const PlaneAxes axes = plane_axes(plane);
  const bool about_pole = arc && m.centers.empty();
  const auto word = [&](AxisId axis, const Value& to, const Value& middle, double factor) {
    CoordWord w;
    w.axis = axis;
    w.value = scale(to, 1 / factor);
    m.coords.push_back(w);
    if (!about_pole) return;
    CenterWord c;
    c.axis = axis;
    c.mode = CenterMode::absolute;
    c.value = middle;
    m.centers.push_back(c);
  };
  word(axes.u, end.to.u, end.centre.u, fu);
  word(axes.v, end.to.v, end.centre.v, fv);
  x.has_polar_radius = x.has_polar_angle = false;
  x.polar_radius = x.polar_angle = Value{};
  x.polar_mode = x.polar_angle_mode = WordMode::modal;
  const bool more = x.has_turns || x.has_pitch || x.has_line_angle;
  m.extra = more ? std::make_shared<const MotionExtra>(std::move(x)) : nullptr;
}

}  // namespace cnctrans::ir::passes
