// Poles of polar coordinates (equivalences 9.2, 10), followed: a plane function that resets the pole on one control
// only, a pole relative to another point and an arc by its pole mean the same there.
#include <cmath>
#include <numbers>

#include "ir/analysis/flow_states.h"
#include "ir/motion_kinds.h"
#include "legaliser/analysis/path_points.h"
#include "legaliser/analysis/words.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"
#include "legaliser/motion/path_values.h"
#include "legaliser/motion/polar_counters.h"
#include "legaliser/motion/polar_radius.h"
#include "legaliser/motion/polar_words.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

class PolePass {
 public:
  std::set<std::uint32_t> points_wanted;  ///< blocks (by id) that another pass needs as coordinates
  PolePass(Program& program, const LegaliseContext& context, const FactsOf& facts, const FrameSteps& frames,
           const PathValues& path)
      : program_(program), context_(context), facts_(facts), frames_(frames), path_(path) {
    points_wanted = beside_lacking(program, context.target);
    lines_only_ = has_lines_only(program);
  }

  // A domain of FlowStates: the pole before each statement.
  struct State {
    std::optional<Point2> at;
    bool set = false;    ///< by the program, on some way: some controls leave it in its place when the zero point moves
    bool stale = false;  ///< the zero point has moved since, on some way
    bool operator==(const State&) const = default;
  };
  [[nodiscard]] static State start(const Routine& r, bool called) {
    return r.kind == RoutineKind::main && !called ? State{Point2{}} : State{};
  }
  void transfer(const Statement& s, State& state) const {
    const auto* b = std::get_if<Block>(&s.node);
    if (!changes(s)) return;
    if (b == nullptr) return unknown(state);
    PolePass dry = *this;
    dry.quiet_ = true;
    dry.before(state);
    Statement copy = s;
    dry.block(copy, std::get<Block>(copy.node));
    state = {dry.pole_, dry.set_, dry.stale_};
  }
  [[nodiscard]] bool touches(const Routine& r) const {
    bool found = false;
    for_each_statement(r.body, [&](const Statement& s) { found = found || changes(s); });
    return found;
  }
  static void unknown(State& state) { state.at.reset(); }
  static bool join(State& a, const State& b) {
    const State before = a;
    a = {a.at == b.at ? a.at : std::nullopt, a.set || b.set, a.stale || b.stale};
    return !(a == before);
  }

  void routine(Routine& r, const FlowStates<PolePass>& states, const FlowStates<RadiusDomain>& radii,
               const FlowStates<PathValues>& values) {
    radii_ = &radii, values_ = &values, states_ = &states;
    uses_ = label_uses(program_, r);
    forget_way();
    walk(r.body);
  }

 private:
  bool changes(const Statement& s) const {
    const auto* b = std::get_if<Block>(&s.node);
    if (const auto* o = std::get_if<Opaque>(&s.node)) return !o->harmless;
    if (b == nullptr) return false;
    if (zero_counts() && b->has_motion && b->motion.extra) return true;
    return (source_.polar_pole_follows_arc && b->has_motion && !b->motion.centers.empty()) ||
           std::any_of(b->actions.begin(), b->actions.end(), [this](const Action& a) {
             const auto* m = std::get_if<ModalSet>(&a.data);
             return std::holds_alternative<PoleSet>(a.data) || (zero_counts() && moves_zero(a)) ||
                    (m != nullptr && (m->setting == Setting::plane || m->setting == Setting::units));
           });
  }
  void before(const State& state) { pole_ = state.at, set_ = state.set, stale_ = state.stale; }
  bool zero_counts() const { return source_.polar_pole_stays != target_.polar_pole_stays; }
  void forget_point() { led_ = {}, radius_.reset(), angle_.reset(); }
  /// The pole is another one: where the source takes the radius programmed last, that is no distance from it.
  void forget_radius() {
    if (!radius_stays_) radius_.reset();
    other_pole_ = true;
    angle_.reset();
  }
  void forget_way() { forget_point(), way_.reset(); }
  void walk(Body& body) {
    for (auto& s : body) {
      for (const auto& l : labels_on(s.line)) {
        if (uses_.is_target(l) || uses_.computed) forget_way();
      }
      const State* before = states_->before(s);
      this->before(before != nullptr ? *before : State{});
      if (before != nullptr && !pole_) pole_ = way_;
      if (auto* b = std::get_if<Block>(&s.node)) {
        block(s, *b);
        way_ = pole_;  // but where a subprogram goes on from there, or the block may be skipped
        if (s.line.skip_mask != 0 || facts_.before(s).modal_call_runs()) forget_way();
        continue;
      }
      const auto* kept = std::get_if<Opaque>(&s.node);
      bool elsewhere = std::holds_alternative<CallRoutine>(s.node) || std::holds_alternative<ModalCall>(s.node) ||
                       std::holds_alternative<Repeat>(s.node) || (kept != nullptr && !kept->harmless);
      each_body(s, [&](Body& inner) {
        elsewhere = true;
        forget_way();
        walk(inner);
      });
      if (elsewhere) forget_way();
      each_target(s, [this](const VarRef& v) {
        for (auto* value : {&radius_, &angle_}) {
          if (*value && (*value)->expr && reads((*value)->expr, v)) value->reset();
        }
      });
    }
  }

  void block(Statement& s, Block& b) {
    const Facts& facts = facts_.before(s);
    as_point_ = points_wanted.count(s.id) != 0;
    const auto* values = quiet_ ? nullptr : values_->before(s);
    led_.stands(values != nullptr ? path_.numbers(s, *values) : FrameSteps::Place{});
    end_ = values != nullptr ? path_.polar_end(s, *values) : std::nullopt;
    plane_ = setting<Plane>(facts, Setting::plane);
    std::vector<Action> actions;
    std::string_view problem;
    WordPos place;
    for (auto& a : b.actions) {
      if (const auto* m = std::get_if<ModalSet>(&a.data); m != nullptr && m->setting == Setting::plane) {
        if (source_.polar_plane_resets_pole ||
            plane_ != static_cast<Plane>(m->value)) {  // radius and angle are about another pole now
          forget_radius();
        }
        plane_ = static_cast<Plane>(m->value);
        actions.push_back(std::move(a));
        if (!plane_code(actions)) problem = "where the pole of the polar words behind this plane function lies";
        continue;
      }
      if (const auto* m = std::get_if<ModalSet>(&a.data); m != nullptr && m->setting == Setting::units)
        in_other_units(setting<Units>(facts, Setting::units), static_cast<Units>(m->value));
      if (zero_counts() && moves_zero(a) && set_ && frames_.moves_zero(s)) stale_ = true;
      if (const auto* p = std::get_if<PoleSet>(&a.data)) {
        place = a.pos;
        forget_radius();
        if (!pole_set(*p, a, b, facts)) problem = "the point that this pole is given from";
        if (!context_.target.polar) {  // the words that count from it become coordinates
          problem = {};
          continue;
        }
      }
      actions.push_back(std::move(a));
    }
    b.actions = std::move(actions);
    polar_arc_done_ = is_polar_arc(b, facts);
    const bool centred = source_.polar_pole_follows_arc && b.has_motion && !b.motion.centers.empty();
    const auto from = centred ? here(facts) : std::nullopt;
    const auto mode = setting_in<Distance>(b, facts, Setting::distance);
    const auto middle = from ? centre_of(b, facts, *from, *plane_, mode, context_.source_machine) : std::nullopt;
    const bool about = polar_line(b, facts, lines_only_) || (polar_arc_done_ && b.motion.centers.empty());
    const auto whole = factors(b, facts, Distance::absolute);
    if (about && pole_ && stale_ && !source_.polar_pole_stays && whole) {  // the target's stayed behind
      if (context_.target.polar) b.actions.push_back(action(PoleSet{pole_words(*plane_, *pole_, whole->u, whole->v)}));
      stale_ = false;
    } else if (about && stale_)
      problem = "the pole, which stays in its place when the zero point moves,";
    if (problem.empty() && polar_arc_done_ && !polar_arc(b, facts))
      problem = "the start or the centre of this arc by polar words";
    const auto* step = quiet_ || radius_stays_ || !target_radius_stays_ ? nullptr : radii_->before(s);
    if (polar_line(b, facts, lines_only_)) {
      say_radius_ = (step != nullptr && !step->same) || (radius_stays_ && other_pole_);
      const bool takes_over = radius_stays_ && !b.motion.extra->has_polar_radius && !radius_;
      if (takes_over && problem.empty()) problem = "the radius that these polar words take over";
      const bool done = polar_words(b, facts);
      if (problem.empty() && !done && say_radius_ && !says_radius(b, facts))
        problem = "the distance from the pole that these polar words keep";
      if (problem.empty() && !done && !stays_polar(b) && !by_values(b, facts))
        problem = "the pole of these polar words, or the point before them,";
    } else if (!polar_arc_done_) {
      if (step != nullptr && !step->same && angle_alone(b)) problem = "the distance from the pole of this arc's end";
      if (radius_stays_ && !target_radius_stays_ && angle_alone(b)) problem = "what these polar words lead along";
      follow_point(b, facts);
    }
    settle(s);
    if (!problem.empty() && !quiet_) {
      refuse(s, program_, context_, "TRN-316", std::string(problem) + " is not known here, and the target needs it",
             "give the pole and the point before it as numbers", place.column == 0 ? b.motion.code_pos : place);
      return;
    }
    if (centred) pole_ = middle;
  }

  /// What is kept is counted in the unit of the program.
  void in_other_units(std::optional<Units> before, Units now) {
    if (before == now) return;
    if (!before) pole_.reset();
    const double factor = now == Units::inch ? 1 / 25.4 : 25.4;
    if (pole_) pole_->u = clean(pole_->u * factor), pole_->v = clean(pole_->v * factor);
    if (!before || (radius_ && !radius_->literal())) return forget_point();
    led_.scale(factor);
    if (radius_) radius_ = Value{clean(radius_->number * factor)};
  }

  /// The point of the polar words over a block without such words.
  void follow_point(const Block& b, const Facts& facts) {
    const bool plain =
        plane_ && b.motion.frame == FrameUse::normal && !b.motion.extra && !ends_at_the_machine(b.motion.kind);
    const bool moves = b.has_motion && b.motion.moves();
    if (loses_point(b) || (moves && !plain)) return forget_point();
    if (!moves) return;
    if (touches_plane(b, plane_axes(*plane_))) radius_.reset(), angle_.reset();
    led_.follow(b, facts, context_.source_machine);
  }

  /// After a plane function: the pole of the source, said again. False: not known.
  bool plane_code(std::vector<Action>& actions) {
    const bool at_zero = pole_ && pole_->u == 0 && pole_->v == 0;
    if (source_.polar_plane_resets_pole) before(State{Point2{}});
    if (!context_.target.polar || source_.polar_plane_resets_pole == target_.polar_plane_resets_pole || at_zero)
      return true;
    if (!pole_) return false;
    actions.push_back(action(PoleSet{pole_words(*plane_, *pole_, 1, 1)}));
    return true;
  }

  /// False: not known.
  bool pole_set(const PoleSet& p, Action& a, const Block& b, const Facts& facts) {
    const bool relative = p.at && (p.at->combine == FrameCombine::add || p.at->combine == FrameCombine::compose);
    const bool from_last = relative && p.at->combine == FrameCombine::add;
    const auto base = from_last ? pole_ : here(facts);
    const auto at = plane_ ? place_of(p, *plane_, base, pole_, b, facts, context_.source_machine) : std::nullopt;
    before(State{at, true});
    // Along an axis without a word the pole stays where it is; not every target says it so.
    if (!relative && !(at && p.at && p.at->words.size() == 1)) return true;
    bool zero = relative;
    for (const auto& w : p.at->words) zero = zero && w.value.is(0);
    const auto f = factors(b, facts, Distance::absolute);
    if (!from_last && zero) {
      a.data = PoleSet{};
    } else if (pole_ && f) {
      a.data = PoleSet{pole_words(*plane_, *pole_, f->u, f->v)};
    } else {
      return false;
    }
    a.text = {};
    return true;
  }

  std::optional<Point2> here(const Facts& facts) const {
    return plane_ ? led_.at(plane_axes(*plane_), facts) : std::nullopt;
  }
  void led_to(Point2 to) { led_.set(plane_axes(*plane_), to); }
  /// The value of a word of each axis of the plane times this is its radius.
  std::optional<Point2> factors(const Block& b, const Facts& facts, std::optional<Distance> d) const {
    if (!plane_) return std::nullopt;
    const PlaneAxes axes = plane_axes(*plane_);
    const auto u = to_radius(axes.u, WordScale::modal, d, b, facts, context_.source_machine);
    const auto v = to_radius(axes.v, WordScale::modal, d, b, facts, context_.source_machine);
    if (!u || !v) return std::nullopt;
    return Point2{*u, *v};
  }

  /// The target has polar words, and all that the block says beside them: the pitch of a helix by its turns is found
  /// from the points.
  [[nodiscard]] bool stays_polar(const Block& b) const {
    const auto& x = b.motion.extra;
    const bool turns = x && x->has_turns && !x->turns.is(0);
    const bool written_out = b.motion.kind == MotionKind::arc_tangent && !context_.target.arc_tangent;
    return context_.target.polar && !as_point_ && !written_out && (!turns || context_.target.helix_turns);
  }

  /// An angle about the centre: with its radius every target has it, else axis words. False: not known.
  bool polar_arc(Block& b, const Facts& facts) {
    const MotionExtra& x = *b.motion.extra;
    const auto distance = setting_in<Distance>(b, facts, Setting::distance);
    auto programmed = x.has_polar_radius ? std::optional(x.polar_radius) : radius_;
    if (x.has_polar_radius && !polar_absolute(x.polar_mode, distance)) programmed.reset();
    const bool sayable = stays_polar(b) && (context_.target.distance_per_word || !modes_of_words(x));
    if (b.motion.centers.empty() && x.has_polar_radius && x.has_polar_angle && sayable) {
      forget_point();
      if (polar_absolute(x, distance) && pole_ && x.polar_angle.literal() && x.polar_radius.literal())
        led_to(around(*pole_, x.polar_radius.number, x.polar_angle.number));
      radius_ = programmed;
      return true;
    }
    const bool done = about_pole(b, facts) || to_cartesian(b, facts, *b.motion.extra) || by_values(b, facts);
    if (radius_stays_) radius_ = programmed;
    return done;
  }

  /// An arc about the pole to an absolute angle, or by a step from that of computed polar words: its radius is the
  /// distance of the point before, which may be a variable's. False: not of that form, or not known.
  bool about_pole(Block& b, const Facts& facts) {
    Motion& m = b.motion;
    MotionExtra x = *m.extra;
    const auto distance = setting_in<Distance>(b, facts, Setting::distance);
    const bool absolute = polar_absolute(x.polar_angle_mode, distance);
    const auto f = factors(b, facts, Distance::absolute);
    if (x.has_polar_radius || distance != Distance::absolute || !pole_ || !f) return false;
    if (absolute ? !m.centers.empty() : !angle_ || !is_part_about(*pole_, b, facts, context_.source_machine))
      return false;
    std::optional<Value> r = radius_stays_ && other_pole_ ? std::nullopt : radius_;
    if (const auto start = here(facts); !r && start)
      r = Value{clean(std::hypot(start->u - pole_->u, start->v - pole_->v))};
    if (!r) return false;
    const Value q = absolute ? x.polar_angle : add(*angle_, x.polar_angle);
    const bool stays = absolute && stays_polar(b);
    if (r->literal() && q.literal() && !stays) return false;  // numbers: by to_cartesian
    r->text = {};
    forget_point();
    if (r->literal() && q.literal()) led_to(around(*pole_, r->number, q.number));
    radius_ = r;
    angle_ = q;
    angle_->text = {};
    if (stays) {
      say_polar_radius(m, *r);
      return true;
    }
    const Value u = around(*r, *angle_, Function::cos, pole_->u, 1),
                v = around(*r, *angle_, Function::sin, pole_->v, 1);
    write_end(b, {{u, v}, {Value{pole_->u}, Value{pole_->v}}, *r}, true, *plane_, f->u, f->v);
    return true;
  }

  /// Where polar words lead as formulas in the program's variables. False: not known.
  bool by_values(Block& b, const Facts& facts) {
    const auto f = factors(b, facts, Distance::absolute);
    if (!end_ || !plane_ || !f || setting_in<Distance>(b, facts, Setting::distance) != Distance::absolute) return false;
    forget_point();
    if (!stays_polar(b) || !b.motion.centers.empty()) {
      write_end(b, *end_, polar_arc_done_, *plane_, f->u, f->v);
      return true;
    }
    say_polar_radius(b.motion, end_->radius);
    return true;
  }

  /// Radius and angle about the pole as coordinates; a word that is left out keeps what the point before has of it.
  /// False: not known.
  bool polar_words(Block& b, const Facts& facts) {
    MotionExtra x = *b.motion.extra;
    const auto distance = setting_in<Distance>(b, facts, Setting::distance);
    const auto [radius_modal, angle_modal, adds_r, adds_q] = polar_modes(x, distance);
    if (!pole_ || !plane_ || (!distance && (radius_modal || angle_modal))) return forget_point(), false;
    const auto start = here(facts);
    std::optional<Value> from_r = radius_, from_q = angle_;
    if (start) {
      const Point2 d{start->u - pole_->u, start->v - pole_->v};
      const double length = std::hypot(d.u, d.v);
      if (!from_r) from_r = Value{clean(length)};
      if (!from_q) from_q = Value{length < 1e-6 ? 0 : clean(std::atan2(d.v, d.u) * 180 / std::numbers::pi)};
    }
    forget_point();
    if ((adds_r || !x.has_polar_radius) && !from_r) return false;
    if ((adds_q || !x.has_polar_angle) && !from_q) return false;
    Value r = !x.has_polar_radius ? *from_r : (adds_r ? add(*from_r, x.polar_radius) : x.polar_radius);
    Value q = !x.has_polar_angle ? *from_q : (adds_q ? add(*from_q, x.polar_angle) : x.polar_angle);
    r.text = q.text = {};
    const auto f = factors(b, facts, Distance::absolute);
    if (!f || (r.literal() && r.number < 0)) return false;
    radius_ = r;
    angle_ = q;
    other_pole_ = false;
    Value u, v;
    std::optional<Point2> to;
    if (r.literal() && q.literal()) {
      to = around(*pole_, r.number, q.number);
      led_to(*to);
      u = Value{to->u / f->u};
      v = Value{to->v / f->v};
    } else {
      u = around(r, q, Function::cos, pole_->u, f->u);
      v = around(r, q, Function::sin, pole_->v, f->v);
    }
    const bool modal = radius_modal == x.has_polar_radius && angle_modal == x.has_polar_angle;
    // A target whose words are all absolute or all increments has no polar words of the other kind.
    const bool sayable = context_.target.distance_per_word || distance == Distance::absolute;
    const bool say = say_radius_ && !says_radius(b, facts);  // the target would take its last one
    if (stays_polar(b) && sayable && say) {
      x.has_polar_radius = true;
      x.polar_radius = r;
      if (adds_r || adds_q || distance != Distance::absolute) {
        x.has_polar_angle = true;
        x.polar_angle = q;
        x.polar_mode = x.polar_angle_mode = WordMode::absolute;
      }
      b.motion.extra = std::make_shared<const MotionExtra>(std::move(x));
      return true;
    }
    if (stays_polar(b) && (sayable || (modal && !say))) {  // only followed
      if (modal || context_.target.distance_per_word) return true;
      x.has_polar_radius = x.has_polar_angle = true;
      x.polar_radius = r;
      x.polar_angle = q;
      x.polar_mode = x.polar_angle_mode = WordMode::modal;
      b.motion.extra = std::make_shared<const MotionExtra>(std::move(x));
      return true;
    }
    const auto inc = factors(b, facts, Distance::incremental);
    const bool steps = distance == Distance::incremental && start && to && inc;
    if (steps) {
      u = Value{clean((to->u - start->u) / inc->u)};
      v = Value{clean((to->v - start->v) / inc->v)};
    }
    const PlaneAxes axes = plane_axes(*plane_);
    for (const auto& [axis, value] : {std::pair{axes.u, u}, std::pair{axes.v, v}}) {
      CoordWord w;
      w.axis = axis;
      w.value = value;
      w.mode = steps || distance == Distance::absolute ? WordMode::modal : WordMode::absolute;
      b.motion.coords.push_back(w);
    }
    x.has_polar_radius = x.has_polar_angle = false;
    x.polar_radius = x.polar_angle = Value{};
    b.motion.extra =
        x.has_turns || x.has_pitch || x.has_line_angle ? std::make_shared<const MotionExtra>(std::move(x)) : nullptr;
    return true;
  }

  bool to_cartesian(Block& b, const Facts& facts, MotionExtra x) {
    Motion& m = b.motion;
    const auto distance = setting_in<Distance>(b, facts, Setting::distance);
    const auto start = here(facts);
    const auto centre = m.centers.empty()   ? pole_
                        : !start || !plane_ ? std::nullopt
                                            : centre_of(b, facts, *start, *plane_, distance, context_.source_machine);
    const auto f = factors(b, facts, distance);
    const bool absolute = polar_absolute(x.polar_angle_mode, distance);
    if (!start || !centre || !f || !distance || !x.polar_angle.literal()) return false;
    const Point2 d{start->u - centre->u, start->v - centre->v};
    const double angle = (absolute ? 0 : std::atan2(d.v, d.u)) + x.polar_angle.number * std::numbers::pi / 180;
    const double r = std::hypot(d.u, d.v);
    const Point2 end{centre->u + r * std::cos(angle), centre->v + r * std::sin(angle)};
    const bool inc = distance == Distance::incremental;
    const bool about = !inc && led_.only_stands(plane_axes(*plane_), facts);
    constexpr double last_places = 0.002;  // mm: a full circle, or none
    if (about && std::hypot(end.u - start->u, end.v - start->v) < last_places) return false;
    forget_point();
    led_to({clean(end.u), clean(end.v)});
    const Point2 to = inc ? Point2{end.u - start->u, end.v - start->v} : end;
    about ? m.centers.clear() : PathPoints::set_centre(m, *plane_, {start->u, start->v}, {centre->u, centre->v});
    if (x.has_turns && !context_.target.helix_turns && context_.target.helix_pitch)
      turns_to_pitch(x, b, facts, plane_axes(*plane_).w, {*start, end, *centre}, context_.source_machine);
    m.extra = std::make_shared<const MotionExtra>(std::move(x));
    write_end(b, {{Value{clean(to.u)}, Value{clean(to.v)}}, {Value{centre->u}, Value{centre->v}}, {}}, about, *plane_,
              f->u, f->v);
    return true;
  }

  Program& program_;
  const LegaliseContext& context_;
  const FactsOf& facts_;
  LabelUses uses_;
  std::optional<Point2> pole_, way_;     ///< way_: behind the block before, where the dataflow does not know it
  LedPoint led_;                         ///< where polar words have led
  std::optional<Value> radius_, angle_;  ///< of that point about the pole
  const FlowStates<PolePass>* states_ = nullptr;
  const FlowStates<RadiusDomain>* radii_ = nullptr;
  const FrameSteps& frames_;
  const PathValues& path_;
  const FlowStates<PathValues>* values_ = nullptr;
  std::optional<PolarEnd> end_;       ///< of the block at hand
  bool as_point_ = false;             ///< the block at hand is of points_wanted
  bool set_ = false, stale_ = false;  ///< of State
  bool other_pole_ = false;           ///< since the last polar words of a line
  bool say_radius_ = false;  ///< the target's last radius may be another than the present distance from the pole
  bool polar_arc_done_ = false, quiet_ = false;  ///< quiet: only following
  std::optional<Plane> plane_;
  const machine::Policies& source_ = context_.source_machine.policies;
  const machine::Policies& target_ = context_.target_machine.policies;
  bool radius_stays_ = source_.polar_radius == machine::PolarRadius::programmed;
  bool target_radius_stays_ = context_.target.polar && target_.polar_radius == machine::PolarRadius::programmed;
  bool lines_only_ = false;
};

}  // namespace

void convert_poles(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || !uses_polar(program)) return;
  count_polar_steps(program, context);
  const FactsOf facts(program, context);
  const FrameSteps frames(program, facts, context.target_machine, context);
  const PathValues path(facts, context.source_machine, frames);
  PolePass pass(program, context, facts, frames, path);
  const FlowStates<PolePass> states(program, pass);
  const RadiusDomain radius(facts, pass.points_wanted);
  const FlowStates<RadiusDomain> radii(program, radius);
  const FlowStates<PathValues> values(program, path);
  for (auto& r : program.routines) pass.routine(r, states, radii, values);
}

}  // namespace cnctrans::ir::passes
