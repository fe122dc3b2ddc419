#include "legaliser/motion/polar_counters.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "ir/edit/search.h"
#include "ir/known_number.h"
#include "ir/motion_kinds.h"
#include "legaliser/analysis/words.h"
#include "legaliser/edit/editor.h"
#include "legaliser/motion/path_values.h"
#include "legaliser/motion/polar_words.h"

namespace cnctrans::ir::passes {

namespace {

/// A straight move by polar words that count from the point before.
bool is_step(const Statement& s, const Facts& facts) {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || !is_polar_line(*b, facts) || s.line.skip_mask != 0 || b->repeat_given != 0 || loses_point(*b))
    return false;
  const auto distance = setting_in<Distance>(*b, facts, Setting::distance);
  const auto modes = polar_modes(*b->motion.extra, distance);
  if (!distance && (modes.radius_modal || modes.angle_modal)) return false;
  return modes.adds_radius || modes.adds_angle;
}

/// A part of a circle about the pole, by an angle that counts from the point before.
bool is_arc_step(const Statement& s, const Facts& facts) {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || !is_polar_arc(*b, facts) || s.line.skip_mask != 0 || b->repeat_given != 0 || loses_point(*b))
    return false;
  const MotionExtra& x = *b->motion.extra;
  const auto modes = polar_modes(x, setting_in<Distance>(*b, facts, Setting::distance));
  constexpr double turn = 360 - 1e-9;
  return modes.adds_angle && !modes.angle_modal && !x.has_polar_radius && x.polar_angle.literal() &&
         std::fabs(x.polar_angle.number) < turn && !(x.has_turns && !x.turns.is(0));
}

/// The place in the plane may be another one behind it, or what it is counted from.
bool leaves_place(const Statement& s, const Facts& facts) {
  if (const auto* o = std::get_if<Opaque>(&s.node)) return !o->harmless;
  if (std::holds_alternative<ModalCall>(s.node)) return true;
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr) return false;
  const bool other_words = std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
    const auto* m = std::get_if<ModalSet>(&a.data);
    return std::holds_alternative<PoleSet>(a.data) ||
           (m != nullptr && (m->setting == Setting::plane || m->setting == Setting::units));
  });
  if (other_words || loses_point(*b)) return true;
  if (!b->has_motion || !b->motion.moves()) return false;
  const auto plane = setting_in<Plane>(*b, facts, Setting::plane);
  return !plane || b->motion.extra || ends_at_the_machine(b->motion.kind) || touches_plane(*b, plane_axes(*plane));
}

bool is_loop(const Statement& s) {
  return std::holds_alternative<While>(s.node) || std::holds_alternative<For>(s.node) ||
         std::holds_alternative<Until>(s.node) || std::holds_alternative<Loop>(s.node);
}

/// Stands where the variables may begin until that is decided.
bool is_mark(const Statement& s) {
  const auto* a = std::get_if<Assign>(&s.node);
  return a != nullptr && a->items.empty();
}

class PolarCounters {
 public:
  PolarCounters(Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  void run() {
    if (!find_starts()) return;
    for (auto& r : program_.routines) mark(r.body);
    const FactsOf facts(program_, context_);
    const PathStates places(program_, facts, context_.source_machine, context_);
    facts_ = &facts;
    places_ = &places;
    const FlowStates<PolarCounters> states(program_, *this);
    bool counts = false;
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) { counts = counts || counted(s, states); });
    }
    for (auto& r : program_.routines) write(r, states, counts);
  }

  // A domain of FlowStates: the variables hold the place before each statement.
  struct State {
    bool holds = false;
  };
  static State start(const Routine& /*r*/, bool /*called*/) { return {}; }
  static bool touches(const Routine& r) { return !r.body.empty(); }
  static void unknown(State& state) { state.holds = false; }
  static bool join(State& a, const State& b) {
    const bool changed = a.holds && !b.holds;
    a.holds = a.holds && b.holds;
    return changed;
  }
  void transfer(const Statement& s, State& state) const {
    if (is_mark(s))
      state.holds = place(s).has_value();
    else if (!counts_on(s, facts_->before(s)) && leaves_place(s, facts_->before(s)))
      state.holds = false;
  }

 private:
  struct Polar {
    double radius = 0, angle = 0;
  };

  /// A step that the target can't say, whose point before is no number.
  [[nodiscard]] bool counts_on(const Statement& s, const Facts& facts) const {
    const auto plane = setting<Plane>(facts, Setting::plane);
    if (!plane || (facts.position[plane_axes(*plane).u] && facts.position[plane_axes(*plane).v])) return false;
    if (is_arc_step(s, facts)) return about_pole(s, plane_axes(*plane)) && by_radius(s, facts, plane_axes(*plane));
    const Capabilities& target = context_.target;
    return is_step(s, facts) &&
           (!target.polar || (!target.distance_per_word && modes_of_words(*std::get<Block>(s.node).motion.extra)));
  }
  /// No axis of the plane counts diameters.
  [[nodiscard]] bool by_radius(const Statement& s, const Facts& facts, const PlaneAxes& plane) const {
    const auto& b = std::get<Block>(s.node);
    const auto whole = [&](AxisId a) {
      return to_radius(a, WordScale::modal, Distance::absolute, b, facts, context_.source_machine) == 1.0;
    };
    return whole(plane.u) && whole(plane.v);
  }
  /// The centre of the arc is the pole.
  [[nodiscard]] bool about_pole(const Statement& s, const PlaneAxes& plane) const {
    const auto pole = places_ == nullptr ? std::nullopt : places_->pole(s);
    const auto& centers = std::get<Block>(s.node).motion.centers;
    return std::all_of(centers.begin(), centers.end(), [&](const CenterWord& c) {
      if (c.mode != CenterMode::absolute || !c.value.literal()) return false;
      if (places_ == nullptr) return true;
      const Value* at = !pole ? nullptr : c.axis == plane.u ? &pole->u : c.axis == plane.v ? &pole->v : nullptr;
      return at != nullptr && at->literal() && at->number == c.value.number;
    });
  }

  /// The statements behind which the variables may begin: the last one that leaves its place before a loop with such a
  /// step.
  bool find_starts() {
    const FactsOf facts(program_, context_);
    for (auto& r : program_.routines) {
      const LabelUses uses = label_uses(program_, r);
      std::uint32_t last = 0;
      bool loop = false, said = true;
      for_each_statement(r.body, [&](const Statement& s) {
        const auto labels = labels_on(s.line);
        loop = loop || uses.computed || is_loop(s) ||
               std::any_of(labels.begin(), labels.end(), [&](const LabelRef& l) { return uses.is_target(l); });
        if (counts_on(s, facts.before(s))) {
          if (loop && (said || !takes_radius_over(s, facts.before(s)))) starts_.insert(last);
        } else if (leaves_place(s, facts.before(s))) {
          last = s.id;
          const auto* b = std::get_if<Block>(&s.node);
          said = b != nullptr && b->motion.extra && b->motion.extra->has_polar_radius;
          loop = false;
        }
      });
    }
    starts_.erase(0);
    return !starts_.empty();
  }

  /// The radius of the step is the one that was said last, which is not the distance of a point said otherwise.
  [[nodiscard]] bool takes_radius_over(const Statement& s, const Facts& facts) const {
    const auto& b = std::get<Block>(s.node);
    const auto modes = polar_modes(*b.motion.extra, setting_in<Distance>(b, facts, Setting::distance));
    return context_.source_machine.policies.polar_radius == machine::PolarRadius::programmed && is_step(s, facts) &&
           (!b.motion.extra->has_polar_radius || modes.adds_radius);
  }

  void mark(Body& body) {
    bool due = false;
    LineInfo place;
    Body out;
    for (auto& s : body) {
      if (due && !s.line.joined) out.push_back(made(place, Assign{})), due = false;
      each_body(s, [this](Body& inner) { mark(inner); });
      if (starts_.count(s.id) != 0) place = s.line, due = s.line.skip_mask == 0;
      out.push_back(std::move(s));
    }
    if (due) out.push_back(made(place, Assign{}));
    body = std::move(out);
  }

  [[nodiscard]] std::optional<Polar> place(const Statement& s) const {
    const auto plane = setting<Plane>(facts_->before(s), Setting::plane);
    const auto pole = places_->pole(s);
    if (!plane || !pole || !pole->u.literal() || !pole->v.literal()) return std::nullopt;
    const auto u = places_->number(s, plane_axes(*plane).u), v = places_->number(s, plane_axes(*plane).v);
    if (!u || !v) return std::nullopt;
    const double du = *u - pole->u.number, dv = *v - pole->v.number;
    return Polar{clean(std::hypot(du, dv)), clean(std::atan2(dv, du) * 180 / std::numbers::pi)};
  }

  [[nodiscard]] bool counted(const Statement& s, const FlowStates<PolarCounters>& states) const {
    const State* state = states.before(s);
    return state != nullptr && state->holds && counts_on(s, facts_->before(s));
  }

  void write(Routine& r, const FlowStates<PolarCounters>& states, bool counts) {
    Editor editor(program_, r, context_);
    if (counts && !angle_) {  // both stay taken
      radius_ = editor.take(r.body.front().line);
      angle_ = editor.take(r.body.front().line);
    }
    rewrite_body(r.body, [&](Statement&& s, Body& out) {
      if (is_mark(s)) {
        const auto from = angle_ && states.before(s) != nullptr ? place(s) : std::nullopt;
        if (!from) return;
        out.push_back(make_assign(s.line, *radius_, number(from->radius)));
        out.push_back(make_assign(s.line, *angle_, number(from->angle)));
      } else if (angle_ && counted(s, states)) {
        step(std::move(s), editor, out);
      } else {
        out.push_back(std::move(s));
      }
    });
  }

  /// r = r + step; q = q + step; polar words R r Q q
  void step(Statement&& s, Editor& editor, Body& out) {
    auto& b = std::get<Block>(s.node);
    MotionExtra x = *b.motion.extra;
    const auto modes = polar_modes(x, setting_in<Distance>(b, facts_->before(s), Setting::distance));
    Body pieces;
    const auto count = [&](const VarRef& v, bool said, bool adds, Value& word) {
      const ExprPtr to = adds ? binary(BinaryOp::add, variable(v), as_expr(word)) : as_expr(word);
      if (said) pieces.push_back(make_assign(s.line, v, to));
      word = Value{variable(v)};
    };
    count(*radius_, x.has_polar_radius, modes.adds_radius, x.polar_radius);
    count(*angle_, x.has_polar_angle, modes.adds_angle, x.polar_angle);
    if (is_polar_arc(b, facts_->before(s))) {  // its own angle stays the step
      end_as_words(s, b);
      return editor.put(out, std::move(pieces), std::move(s));
    }
    x.has_polar_radius = x.has_polar_angle = true;
    x.polar_mode = x.polar_angle_mode = WordMode::absolute;
    b.motion.extra = std::make_shared<const MotionExtra>(std::move(x));
    editor.put(out, std::move(pieces), std::move(s));
  }

  /// X = pole + r * cos q, Y = pole + r * sin q; beside increments, where the target has one mode for all words, the
  /// way from the place before.
  void end_as_words(const Statement& s, Block& b) const {
    const auto plane = plane_axes(*setting<Plane>(facts_->before(s), Setting::plane));
    const auto pole = places_->pole(s);
    MotionExtra x = *b.motion.extra;
    const Value now{variable(*angle_)}, before = subtract(now, x.polar_angle);
    const bool steps = !context_.target.distance_per_word &&
                       std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                                   [](const CoordWord& c) { return c.mode == WordMode::incremental; });
    x.has_polar_angle = false;
    x.polar_angle = Value{};
    x.polar_angle_mode = WordMode::modal;
    b.motion.extra = x.has_turns || x.has_pitch ? std::make_shared<const MotionExtra>(std::move(x)) : nullptr;
    b.motion.centers.clear();
    const Value radius{variable(*radius_)};
    for (const bool first : {true, false}) {
      const Function wave = first ? Function::cos : Function::sin;
      const Value to = polar_leg(radius, now, wave), from = polar_leg(radius, before, wave);
      const Value& middle = first ? pole->u : pole->v;
      CoordWord end;
      end.axis = first ? plane.u : plane.v;
      end.mode = steps ? WordMode::incremental : WordMode::absolute;
      end.value = steps ? subtract(to, from) : add(middle, to);
      b.motion.coords.push_back(std::move(end));
      CenterWord centre;
      centre.axis = first ? plane.u : plane.v;
      centre.mode = steps ? CenterMode::from_start : CenterMode::absolute;
      centre.value = steps ? negate(from) : middle;
      b.motion.centers.push_back(std::move(centre));
    }
  }

  Program& program_;
  const LegaliseContext& context_;
  std::set<std::uint32_t> starts_;
  const FactsOf* facts_ = nullptr;
  const PathStates* places_ = nullptr;
  std::optional<VarRef> radius_, angle_;
};

/// Polar words about a pole that is the tool's own place, wherever that is, become increments: a subprogram that mills
/// about the place of its call. Followed along straight text.
class StepsFromTool {
 public:
  StepsFromTool(Program& program, const LegaliseContext& context)
      : program_(program),
        machine_(context.source_machine),
        facts_(program, context),
        places_(program, facts_, context.target_machine, context) {}

  void run(Routine& r) {
    const LabelUses uses = label_uses(program_, r);
    seen_.reset();
    for (auto& s : r.body) {
      const auto labels = labels_on(s.line);
      if (std::any_of(labels.begin(), labels.end(), [&uses](const auto& l) { return uses.is_target(l); }))
        seen_.reset();
      if (auto* b = std::get_if<Block>(&s.node))
        block(s, *b);
      else if (!std::holds_alternative<Message>(s.node) && !std::holds_alternative<Label>(s.node))
        seen_.reset();
    }
  }

 private:
  /// Where the tool stands seen from the pole that the block sets at its place, or a step from there.
  void set_pole(const PoleSet& p, const Block& b, const PlaneAxes& plane) {
    seen_.reset();
    if (b.has_motion || (p.at && p.at->combine != FrameCombine::compose)) return;
    ValuePoint seen{Value{0.0}, Value{0.0}};
    for (std::size_t k = 0; p.at && k < p.at->words.size(); ++k) {
      const FrameWord& w = p.at->words[k];
      if (w.axis == plane.u) seen.u = negate(w.value);
      if (w.axis == plane.v) seen.v = negate(w.value);
    }
    seen_ = seen;
  }

  void block(const Statement& s, Block& b) {
    const Facts& facts = facts_.before(s);
    const auto plane = setting_in<Plane>(b, facts, Setting::plane);
    const auto* pole = plane && s.line.skip_mask == 0 ? action_in<PoleSet>(b) : nullptr;
    if (pole != nullptr) return set_pole(*pole, b, plane_axes(*plane));
    if (!seen_) return;
    if (!plane || s.line.skip_mask != 0) return seen_.reset();
    if (!leaves_place(s, facts) || full_turn(b, plane_axes(*plane))) return;
    const auto to = end(b, facts);
    if (to) write(s, b, facts, *to, plane_axes(*plane));
    seen_ = to;
  }
  /// A circle, or turns of a helix.
  static bool full_turn(const Block& b, const PlaneAxes& plane) {
    const auto& x = b.motion.extra;
    const bool in_plane = std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                                      [&plane](const CoordWord& c) { return c.axis == plane.u || c.axis == plane.v; });
    return b.has_motion && !loses_point(b) && !b.motion.centers.empty() && !in_plane &&
           !(x && (x->has_polar_angle || x->has_polar_radius || x->has_angle));
  }
  [[nodiscard]] std::optional<ValuePoint> end(const Block& b, const Facts& facts) const {
    if (!is_polar_line(b, facts) || b.repeat_given != 0 || !b.motion.coords.empty() || loses_point(b))
      return std::nullopt;
    const MotionExtra& x = *b.motion.extra;
    const auto modes = polar_modes(x, setting_in<Distance>(b, facts, Setting::distance));
    if (!x.has_polar_radius || !x.has_polar_angle || modes.adds_radius || modes.adds_angle) return std::nullopt;
    return ValuePoint{polar_leg(x.polar_radius, x.polar_angle, Function::cos),
                      polar_leg(x.polar_radius, x.polar_angle, Function::sin)};
  }
  void write(const Statement& s, Block& b, const Facts& facts, const ValuePoint& to, const PlaneAxes& plane) const {
    if (places_.pole(s)) return;  // axis words say the place
    for (const auto& [axis, value] :
         {std::pair{plane.u, subtract(to.u, seen_->u)}, {plane.v, subtract(to.v, seen_->v)}}) {
      const auto f = to_radius(axis, WordScale::modal, Distance::incremental, b, facts, machine_);
      if (!f) return b.motion.coords.clear();
      CoordWord w;
      w.axis = axis;
      w.mode = WordMode::incremental;
      w.value = scale(value, 1 / *f);
      b.motion.coords.push_back(w);
    }
    b.motion.extra = nullptr;
  }

  Program& program_;
  const machine::Profile& machine_;
  const FactsOf facts_;
  const PathStates places_;
  std::optional<ValuePoint> seen_;
};

bool poles_at_the_tool(const Program& program) {
  return any_action(program, [](const Action& a) {
    const auto* p = std::get_if<PoleSet>(&a.data);
    return p != nullptr && (!p->at || p->at->combine == FrameCombine::compose);
  });
}

}  // namespace

void count_polar_steps(Program& program, const LegaliseContext& context) {
  if (!context.target.polar && poles_at_the_tool(program)) {
    StepsFromTool steps(program, context);
    for (auto& r : program.routines) steps.run(r);
  }
  PolarCounters(program, context).run();
}

}  // namespace cnctrans::ir::passes
