#include "legaliser/motion/polar_words.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/noise.h"
#include "ir/geometry/geometry.h"
#include "ir/nesting.h"

namespace cnctrans::ir::passes {

double clean(double x) {
  return without_noise(x);
}

Point2 around(Point2 pole, double r, double q) {
  const double angle = q * std::numbers::pi / 180;
  return {clean(pole.u + r * std::cos(angle)), clean(pole.v + r * std::sin(angle))};
}

Value around(const Value& r, const Value& q, Function wave, double from, double factor) {
  const ExprPtr turn = q.literal() ? as_expr(q) : q.expr;
  const Value leg{binary(BinaryOp::multiply, as_expr(r), call(wave, std::vector<ExprPtr>{turn}))};
  return add(scale(leg, 1 / factor), Value{from / factor});
}

PolarModes polar_modes(const MotionExtra& x, std::optional<Distance> distance) {
  PolarModes m;
  m.radius_modal = x.has_polar_radius && x.polar_mode == WordMode::modal;
  m.angle_modal = x.has_polar_angle && x.polar_angle_mode == WordMode::modal;
  m.adds_radius = x.has_polar_radius && !polar_absolute(x.polar_mode, distance);
  m.adds_angle = x.has_polar_angle && !polar_absolute(x.polar_angle_mode, distance);
  return m;
}

void drop_modes_in_force(Block& b, const Facts& facts) {
  if (!b.has_motion || !b.motion.extra) return;
  const auto& now = *b.motion.extra;
  if (!modes_of_words(now)) return;
  const auto mode = setting_in<Distance>(b, facts, Setting::distance);
  if (!mode) return;
  const WordMode in_force = *mode == Distance::absolute ? WordMode::absolute : WordMode::incremental;
  MotionExtra extra = now;
  for (WordMode* word : {&extra.polar_mode, &extra.polar_angle_mode}) {
    if (*word == in_force) *word = WordMode::modal;
  }
  b.motion.extra = std::make_shared<const MotionExtra>(std::move(extra));
}

void say_polar_radius(Motion& m, const Value& radius) {
  MotionExtra x = *m.extra;
  x.has_polar_radius = true;
  x.polar_radius = radius;
  m.extra = std::make_shared<const MotionExtra>(std::move(x));
}

bool says_radius(const Block& b, const Facts& facts) {
  const MotionExtra& x = *b.motion.extra;
  return x.has_polar_radius && polar_absolute(x.polar_mode, setting_in<Distance>(b, facts, Setting::distance));
}

std::optional<Point2> place_of(const PoleSet& p, Plane plane, std::optional<Point2> base, std::optional<Point2> pole,
                               const Block& b, const Facts& facts, const machine::Profile& machine) {
  if (!p.at) return base;
  const bool relative = p.at->combine == FrameCombine::add || p.at->combine == FrameCombine::compose;
  if (!relative && p.at->words.empty()) base = Point2{};
  if (!relative && !p.at->words.empty()) base = pole;
  const PlaneAxes axes = plane_axes(plane);
  std::optional<double> u, v;
  if (base) u = base->u, v = base->v;
  for (const auto& w : p.at->words) {
    auto* slot = w.axis == axes.u ? &u : w.axis == axes.v ? &v : nullptr;
    if (slot == nullptr) continue;
    const auto f = to_radius(w.axis, w.scale, relative ? Distance::incremental : Distance::absolute, b, facts, machine);
    if (!w.value.literal() || !f || (relative && !*slot)) {
      slot->reset();
      continue;
    }
    *slot = w.value.number * *f + (relative ? **slot : 0);
  }
  if (!u || !v) return std::nullopt;
  return Point2{*u, *v};
}

bool is_polar_arc(const Block& b, const Facts& facts) {
  if (!b.has_motion || !b.motion.extra) return false;
  const auto kind = motion_in(b, facts);
  if (kind != MotionKind::arc_cw && kind != MotionKind::arc_ccw) return false;
  return b.motion.extra->has_polar_angle || b.motion.extra->has_polar_radius;
}

bool is_polar_line(const Block& b, const Facts& facts) {
  if (!b.has_motion || !b.motion.extra) return false;
  const auto kind = motion_in(b, facts);
  return (kind == MotionKind::linear || kind == MotionKind::rapid || kind == MotionKind::arc_tangent) &&
         (b.motion.extra->has_polar_angle || b.motion.extra->has_polar_radius);
}

bool has_lines_only(const Program& program) {
  bool found = true;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !b->has_motion) return;
      const auto kind = b->motion.kind;
      found = found && (kind == MotionKind::modal || kind == MotionKind::rapid || kind == MotionKind::linear);
    });
  }
  return found;
}

std::optional<Point2> centre_of(const Block& b, const Facts& facts, Point2 start, Plane plane,
                                std::optional<Distance> distance, const machine::Profile& machine) {
  const PlaneAxes axes = plane_axes(plane);
  Point2 c = start;
  for (const auto& w : b.motion.centers) {
    const bool abs =
        w.mode == CenterMode::absolute || (w.mode == CenterMode::follows_distance && distance == Distance::absolute);
    const auto f = to_radius(w.axis, w.scale, abs ? Distance::absolute : Distance::incremental, b, facts, machine);
    if (!f || !w.value.literal() || (w.axis != axes.u && w.axis != axes.v)) return std::nullopt;
    double& slot = w.axis == axes.u ? c.u : c.v;
    slot = (abs ? 0 : slot) + w.value.number * *f;
  }
  return c;
}

bool is_part_about(Point2 pole, const Block& b, const Facts& facts, const machine::Profile& machine) {
  constexpr double last_places = 0.001;  // degrees: a full turn, or none
  const Value& step = b.motion.extra->polar_angle;
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  const bool absolute = std::all_of(b.motion.centers.begin(), b.motion.centers.end(),
                                    [](const CenterWord& c) { return c.mode == CenterMode::absolute; });
  return plane && absolute && step.literal() && std::fabs(std::remainder(step.number, 360)) > last_places &&
         centre_of(b, facts, pole, *plane, Distance::absolute, machine) == pole;
}

void turns_to_pitch(MotionExtra& x, const Block& b, const Facts& facts, AxisId normal, const ArcPoints& arc,
                    const machine::Profile& machine) {
  const auto word = std::find_if(b.motion.coords.begin(), b.motion.coords.end(),
                                 [normal](const CoordWord& c) { return c.axis == normal; });
  const auto kind = motion_in(b, facts);
  if (word == b.motion.coords.end() || !word->value.literal() || !x.turns.literal() || !kind) return;
  if (*kind != MotionKind::arc_cw && *kind != MotionKind::arc_ccw) return;
  const auto d = distance_of(*word, b, facts);
  const auto f = to_radius(normal, word->scale, d, b, facts, machine);
  const auto from = facts.position[normal];
  if (!d || !f || (*d == Distance::absolute && !from)) return;
  const double travel = word->value.number * *f - (*d == Distance::absolute ? *from : 0);
  const double angle = geometry::swept_angle({arc.start.u, arc.start.v}, {arc.end.u, arc.end.v},
                                             {arc.centre.u, arc.centre.v}, *kind == MotionKind::arc_ccw);
  if (travel == 0) return;
  x.has_pitch = true;
  x.pitch = Value{clean(std::fabs(travel) / (x.turns.number + angle / 360))};
  x.has_turns = false;
  x.turns = Value{};
}

void LedPoint::set(const PlaneAxes& axes, Point2 to) {
  at_[axes.u] = to.u;
  at_[axes.v] = to.v;
}

std::optional<Point2> LedPoint::at(const PlaneAxes& axes, const Facts& facts) const {
  const auto one = [&](AxisId axis) {
    if (at_[axis]) return at_[axis];
    return facts.position[axis] ? facts.position[axis] : stands_[axis];
  };
  const auto u = one(axes.u), v = one(axes.v);
  return u && v ? std::optional(Point2{*u, *v}) : std::nullopt;
}

void LedPoint::scale(double factor) {
  for (auto& x : at_) {
    if (x) x = clean(*x * factor);
  }
}

void LedPoint::follow(const Block& b, const Facts& facts, const machine::Profile& machine) {
  const auto distance = setting_in<Distance>(b, facts, Setting::distance);
  for (const auto& w : b.motion.coords) {
    if (w.axis >= at_.size() || !at_[w.axis]) continue;
    auto& slot = at_[w.axis];
    const bool steps =
        w.mode == WordMode::incremental || (w.mode == WordMode::modal && distance == Distance::incremental);
    const auto f = to_radius(w.axis, w.scale, steps ? Distance::incremental : Distance::absolute, b, facts, machine);
    const bool known = w.value.literal() && f && (w.mode != WordMode::modal || distance) &&
                       (w.mode == WordMode::modal || w.mode == WordMode::absolute || w.mode == WordMode::incremental);
    slot = known ? std::optional((steps ? *slot : 0) + w.value.number * *f) : std::nullopt;
  }
}

bool touches_plane(const Block& b, const PlaneAxes& axes) {
  return !b.motion.centers.empty() ||
         std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                     [&axes](const CoordWord& w) { return w.axis == axes.u || w.axis == axes.v; });
}

bool moves_zero(const Action& a) {
  const auto* f = std::get_if<FrameOp>(&a.data);
  return std::holds_alternative<WorkOffset>(a.data) ||
         (f != nullptr && f->change && f->change->kind == FrameKind::translate);
}

std::shared_ptr<const FrameChange> pole_words(Plane plane, Point2 at, double fu, double fv) {
  const PlaneAxes axes = plane_axes(plane);
  auto change = std::make_shared<FrameChange>();
  change->words.push_back({axes.u, Value{at.u / fu}, WordScale::modal, {}});
  change->words.push_back({axes.v, Value{at.v / fv}, WordScale::modal, {}});
  return change;
}

bool loses_point(const Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    const auto* d = std::get_if<CycleDefine>(&a.data);
    return std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data) ||
           (d != nullptr && !leaves_point(*d));
  });
}

namespace {

void look_beside(const Body& body, const Capabilities& target, std::set<std::uint32_t>& found) {
  std::uint32_t last = 0;
  bool next = false;
  for (const auto& s : body) {
    for (const Body* inner : ir::detail::bodies_of(s)) {
      if (inner != nullptr) look_beside(*inner, target, found);
    }
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr || !b->has_motion || !b->motion.moves()) continue;
    const bool helix = b->motion.extra && b->motion.extra->has_pitch && !target.helix_pitch;
    const bool here = helix || std::any_of(b->actions.begin(), b->actions.end(), [&target](const Action& a) {
                        return std::holds_alternative<TangentialEnd>(a.data) && !target.tangential_ends;
                      });
    if (here || next) found.insert(s.id);
    if (here) found.insert(last);
    next = here;
    last = s.id;
  }
}

}  // namespace

std::set<std::uint32_t> beside_lacking(const Program& program, const Capabilities& target) {
  std::set<std::uint32_t> found;
  for (const auto& r : program.routines) look_beside(r.body, target, found);
  return found;
}

bool has_modal_calls(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* m = std::get_if<ModalCall>(&s.node);
      found = found || (m != nullptr && !m->cycle);
    });
  }
  return found;
}

bool uses_polar(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      const MotionExtra* x = b->has_motion ? b->motion.extra.get() : nullptr;
      found = found || (x != nullptr && (x->has_polar_angle || x->has_polar_radius));
      for (const auto& a : b->actions) {
        const auto* p = std::get_if<PoleSet>(&a.data);
        found = found || (p != nullptr && p->at && !p->at->words.empty());
      }
    });
  }
  return found;
}

}  // namespace cnctrans::ir::passes
