#include <algorithm>
#include <cmath>

#include "legaliser/cycles/parts/cycle_parts.h"

namespace cnctrans::ir::passes {

std::optional<AxisId> cycle_axis(const HoleCycle& c, const Block& b, const Facts& facts) {
  if (c.axis != axis::none) return c.axis;
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  if (!plane) return std::nullopt;
  return plane_axes(*plane).w;
}

namespace {

Level absolute(Value v) {
  v.text = {};
  Level l;
  l.value = std::move(v);
  l.given = true;
  return l;
}

struct Bases {
  std::optional<Value> initial, surface, reference;
  std::optional<Distance> distance;
};

/// Absolute, or as it was when its base is not known.
Level resolved(const Level& l, const Bases& bases) {
  if (!l.given || l.base == LevelBase::absolute) return l;
  LevelBase base = l.base;
  if (base == LevelBase::distance_mode) {
    if (!bases.distance) return l;
    if (*bases.distance == Distance::absolute) {
      Level out = l;
      out.base = LevelBase::absolute;
      return out;
    }
    base = l.otherwise;
  }
  const std::optional<Value>* from = base == LevelBase::from_initial     ? &bases.initial
                                     : base == LevelBase::from_reference ? &bases.reference
                                     : base == LevelBase::from_surface   ? &bases.surface
                                                                         : nullptr;
  if (from == nullptr || !from->has_value()) return l;
  return absolute(add(**from, l.value));
}

void note_base(const Level& l, std::optional<Value>& base) {
  if (l.given && l.base == LevelBase::absolute) base = l.value;
}

/// Dwells in another unit: `scale` seconds.
HoleCycle rescaled(HoleCycle c, double scale_to) {
  const double factor = c.dwell_scale / scale_to;
  for (Value* v : {&c.dwell_bottom, &c.dwell_top, &c.pecks.dwell}) {
    if (!v->is(0)) *v = v->literal() ? Value(std::round(v->number * factor * 1e9) / 1e9) : scale(*v, factor);
  }
  c.dwell_scale = scale_to;
  return c;
}

/// So many pecks of a given size that end at the bottom, as pecks of that size.
std::optional<HoleCycle> pecks_of_one_size(const HoleCycle& c) {
  const Pecks& p = c.pecks;
  const bool absolute = c.bottom.given && c.bottom.base == LevelBase::absolute && c.reference.given &&
                        c.reference.base == LevelBase::absolute && !c.surface.given;
  const bool numbers =
      c.bottom.value.literal() && c.reference.value.literal() && p.first.literal() && p.count.literal();
  if (p.law != PeckLaw::count || !absolute || !numbers || p.count.number < 0.5) return std::nullopt;
  const double depth = std::fabs(c.reference.value.number - c.bottom.value.number);
  if (std::fabs(depth - std::round(p.count.number) * std::fabs(p.first.number)) > 1e-9) return std::nullopt;
  HoleCycle out = c;
  out.pecks.law = PeckLaw::constant;
  out.pecks.first = Value(std::fabs(p.first.number));
  out.pecks.count = Value{};
  return out;
}

/// The cycle and its other names: reaming and boring with a dwell move alike, and a computed dwell may have to be
/// counted in seconds or in hundredths.
std::vector<HoleCycle> same_moves(const HoleCycle& c) {
  std::vector<HoleCycle> all{c};
  if (auto steps = pecks_of_one_size(c)) all.push_back(*std::move(steps));
  if (c.kind == HoleKind::ream || c.kind == HoleKind::bore) {
    all.push_back(c);
    all.back().kind = c.kind == HoleKind::ream ? HoleKind::bore : HoleKind::ream;
  }
  if (c.dwell_bottom.literal() && c.dwell_top.literal() && c.pecks.dwell.literal()) return all;
  for (std::size_t i = 0, n = all.size(); i < n; ++i) {
    for (const double unit : {1.0, 0.01}) {
      if (unit != c.dwell_scale) all.push_back(rescaled(all[i], unit));
    }
  }
  return all;
}

}  // namespace

HoleCycle with_absolute_levels(const HoleCycle& c, const Block& b, const Facts& facts, std::optional<double> initial) {
  HoleCycle out = c;
  Bases bases;
  bases.distance = setting_in<Distance>(b, facts, Setting::distance);
  const auto w = cycle_axis(c, b, facts);
  if (initial)
    bases.initial = Value{*initial};
  else if (w && facts.position[*w])
    bases.initial = Value{*facts.position[*w]};
  out.surface = resolved(c.surface, bases);
  note_base(out.surface, bases.surface);
  out.reference = resolved(c.reference, bases);
  note_base(out.reference, bases.reference);
  out.surface = resolved(out.surface, bases);  // it may lie below the reference plane by a distance
  note_base(out.surface, bases.surface);
  out.bottom = resolved(c.bottom, bases);
  out.retract = resolved(c.retract, bases);
  if (!out.retract.given) {
    const auto plane = setting_in<RetractPlane>(b, facts, Setting::retract_plane);
    if (plane == RetractPlane::reference && bases.reference) out.retract = absolute(*bases.reference);
    if (plane == RetractPlane::initial && bases.initial) out.retract = absolute(*bases.initial);
  }
  return out;
}

/// Where a way straight down over the retract plane comes to next: the reference plane, or the bottom.
static double lowest(const HoleCycle& h) {
  const bool known = h.reference.given && h.reference.base == LevelBase::absolute && h.reference.value.literal();
  return std::max(h.bottom.value.number, known ? h.reference.value.number : h.bottom.value.number);
}

std::optional<CyclePtr> native_form(const CyclePtr& cycle, const Block& b, const Facts& facts,
                                    const LegaliseContext& context, std::optional<double> initial,
                                    std::optional<SpindleState> sense, TapNeeds* needs) {
  const auto& native = context.target.native_cycle;
  if (!native || context.options.cycles == CycleWriting::explode) return std::nullopt;
  const auto* hole = std::get_if<HoleCycle>(&cycle->node);
  if (hole == nullptr) return native(*cycle) ? std::optional(cycle) : std::nullopt;
  const auto accepted = [&](const HoleCycle& h) -> std::optional<CyclePtr> {
    for (const HoleCycle& same : same_moves(h)) {
      auto made = std::make_shared<Cycle>();
      made->node = same;
      if (native(*made)) return CyclePtr(std::move(made));
    }
    return std::nullopt;
  };
  const FeedScale scale = needs != nullptr ? needs->scale : FeedScale{};
  for (auto& form : tap_forms(*hole, b, facts, needs != nullptr ? sense : std::nullopt, scale)) {
    auto said = std::make_shared<Cycle>();
    said->node = std::move(form.cycle);
    auto found = native_form(said, b, facts, context, initial);
    if (!found) continue;
    form.needs.pecks_from_elsewhere = needs->pecks_from_elsewhere;
    *needs = form.needs;
    needs->scale = scale;
    return found;
  }
  HoleCycle h = with_absolute_levels(*hole, b, facts, initial);
  if (h.retract.given && h.retract.base == h.reference.base && equal(h.retract.value, h.reference.value)) {
    h.approach_by_retract = false;  // both are one plane
  }
  const auto w = cycle_axis(h, b, facts);
  // Cycles that each point calls know no plane: they go along Z.
  if (context.target.cycle_each_call && w != axis::z) return std::nullopt;
  // An approach over the retract level is no detour when the tool stands there, or higher levels follow one line.
  const bool literal = h.retract.given && h.retract.base == LevelBase::absolute && h.retract.value.literal();
  const auto height = initial ? initial : w ? facts.position[*w] : std::nullopt;
  const bool straight = literal && height && std::fabs(*height - h.retract.value.number) < 1e-9;
  const bool downward = literal && height && h.bottom.value.literal() && h.bottom.base == LevelBase::absolute &&
                        *height >= h.retract.value.number && h.retract.value.number >= lowest(h);
  // Over the retract level is the same way then; said so first.
  const auto either_way = [&](HoleCycle c) -> std::optional<CyclePtr> {
    const bool own = c.approach_by_retract;
    c.approach_by_retract = own || straight || downward;
    auto form = accepted(c);
    if (form || !(straight || downward)) return form;
    c.approach_by_retract = false;
    return accepted(c);
  };
  if (auto form = either_way(h)) return form;
  if (h.axis != axis::none && w) {  // the normal of the plane in force: needs no name
    const auto plane = setting_in<Plane>(b, facts, Setting::plane);
    if (plane && plane_axes(*plane).w == h.axis) {
      h.axis = axis::none;
      if (auto form = either_way(h)) return form;
    }
  }
  // Surface and distance given apart: the reference plane alone says the same.
  if (h.surface.given && h.reference.given && h.reference.base == LevelBase::absolute && h.pecks.law == PeckLaw::none) {
    h.surface = Level{};
    if (auto form = either_way(h)) return form;
  }
  if (auto form = without_dwell(*hole, b, facts, context, initial, sense, needs)) return form;
  return with_pecks_from_elsewhere(*hole, b, facts, context, initial, sense, needs);
}

bool disturbs_call(const Block& b) {
  if (b.has_motion && (b.motion.moves() || b.motion.explicit_code)) return true;
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    return std::holds_alternative<SetFeed>(a.data) || std::holds_alternative<SetSpindle>(a.data);
  });
}

Statement off_statement(const LineInfo& like, bool by_call) {
  if (!by_call) return make_block(like, action(CycleCancel{}));
  ModalCall m;
  m.off = true;
  return made(like, std::move(m));
}
Statement on_statement(const LineInfo& like, const CyclePtr& cycle) {
  ModalCall m;
  m.cycle = cycle;
  return made(like, std::move(m));
}
Statement single_run(const LineInfo& like, const CyclePtr& cycle) {
  return make_block(like, action(CycleDefine{cycle, false, true, CycleTrigger::plane_axis_word}));
}

std::optional<CycleDefine> take_definition(Block& b, WordPos& pos) {
  for (auto it = b.actions.begin(); it != b.actions.end(); ++it) {
    if (auto* d = std::get_if<CycleDefine>(&it->data)) {
      CycleDefine out = *d;
      pos = it->pos;
      b.actions.erase(it);
      return out;
    }
  }
  return std::nullopt;
}
bool take_cancel(Block& b) {
  return std::erase_if(b.actions, [](const Action& a) { return std::holds_alternative<CycleCancel>(a.data); }) != 0;
}

bool ToolHeight::keeps(const Statement& s) {
  const auto* m = std::get_if<ModalCall>(&s.node);
  const auto* kept = std::get_if<Opaque>(&s.node);
  return (kept != nullptr && kept->harmless) || std::holds_alternative<Assign>(s.node) ||
         std::holds_alternative<Message>(s.node) || std::holds_alternative<Label>(s.node) ||
         std::holds_alternative<Declare>(s.node) || (m != nullptr && (m->cycle != nullptr || m->off));
}

void ToolHeight::follow(const Statement& s, const Facts& facts, const CyclePtr& ran, bool harmless,
                        std::optional<double> initial) {
  const auto before = value_;
  follow_block(s, facts, ran, harmless, initial);
  if (s.line.skip_mask != 0 && value_ != before) value_.reset();  // perhaps the block was left out
}

bool ToolHeight::enter(const Statement& s) {
  bool named = false;
  for (const auto& l : labels_on(s.line)) {
    named = named || uses_.is_target(l);
    if (named || uses_.computed) value_.reset();
  }
  return named;
}

void ToolHeight::follow_block(const Statement& s, const Facts& facts, const CyclePtr& ran, bool harmless,
                              std::optional<double> initial) {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr) {
    if (!harmless) value_.reset();
    return;
  }
  for (const auto& a : b->actions) {
    if (std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data)) value_.reset();
  }
  const auto* hole = ran ? std::get_if<HoleCycle>(&ran->node) : nullptr;
  if (hole == nullptr) {
    for (const auto& a : b->actions) {
      if (std::holds_alternative<CycleDefine>(a.data)) value_.reset();
    }
    for (const auto& c : b->motion.coords) {
      if (b->has_motion && c.axis == axis_) value_.reset();  // the dataflow knows it then
    }
    return;
  }
  const auto w = cycle_axis(*hole, *b, facts);
  const auto units = setting_in<Units>(*b, facts, Setting::units);
  value_.reset();
  if (!w || !units) return;
  axis_ = *w;
  const HoleCycle h = with_absolute_levels(*hole, *b, facts, initial);
  if (h.retract.given && h.retract.base == LevelBase::absolute && h.retract.value.literal()) {
    value_ = h.retract.value.number * (*units == Units::inch ? 25.4 : 1);
  }
}

bool has_plane_word(const Block& b, AxisId tool_axis) {
  const auto in_plane = [=](const CoordWord& c) { return c.axis != tool_axis && !is_rotary_letter(c.axis); };
  if (b.has_motion && std::any_of(b.motion.coords.begin(), b.motion.coords.end(), in_plane)) return true;
  const auto* x = b.has_motion ? b.motion.extra.get() : nullptr;  // the lead of a thread leads nowhere
  return x != nullptr && (!x->has_lead || x->has_polar_radius || x->has_polar_angle || x->has_line_angle);
}

bool turns_to_point(const Block& b, const machine::Profile& machine) {
  return b.has_motion && machine.policies.cycle_rotary_triggers &&
         std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                     [](const CoordWord& c) { return is_rotary_letter(c.axis); });
}

namespace {

Motion along(MotionKind kind, AxisId axis, double value) {
  Motion m;
  m.kind = kind;
  m.explicit_code = true;
  m.keeps_modal = false;
  CoordWord c;
  c.axis = axis;
  c.mode = WordMode::absolute;
  c.value = Value{value};
  m.coords.push_back(c);
  return m;
}

/// Steps of a hole as blocks.
class HoleWriter {
 public:
  HoleWriter(const LineInfo& like, AxisId axis, Plane plane, double unit, const FeedBefore& feed,
             std::optional<SpindleState> sense)
      : like_(like), axis_(axis), plane_(plane), unit_(unit), feed_(feed.word()), no_feed_(feed.none), sense_(sense) {}

  /// The feed in force goes on behind the hole.
  bool finish(std::string* error) {
    if (!changed_ || no_feed_) return true;
    if (!feed_) {
      *error = "the feed after the cycle's own one is not known here";
      return false;
    }
    blocks.push_back(make_block(like_, action(SetFeed{*feed_, false})));
    return true;
  }

  bool add(const cycles::CycleMove& m, std::string* error) {
    switch (m.step) {
      case cycles::CycleStep::rapid:
      case cycles::CycleStep::feed: return move(m, error);
      case cycles::CycleStep::dwell:
        blocks.push_back(make_block(like_, action(Dwell{Value{m.amount}, 1, m.revolutions})));
        return true;
      case cycles::CycleStep::spindle_stop: return spindle(SpindleState::off);
      case cycles::CycleStep::spindle_cw: return spindle(SpindleState::cw);
      case cycles::CycleStep::spindle_ccw: return spindle(SpindleState::ccw);
      case cycles::CycleStep::spindle_restore:
      case cycles::CycleStep::spindle_reverse:
        if (!sense_) {
          *error = "the sense of the spindle before the cycle is not known here";
          return false;
        }
        if (*sense_ == SpindleState::off)  // a standing spindle goes on standing
          return m.step == cycles::CycleStep::spindle_reverse || oriented_ ? spindle(SpindleState::off) : true;
        return spindle((*sense_ == SpindleState::cw) == (m.step == cycles::CycleStep::spindle_restore)
                           ? SpindleState::cw
                           : SpindleState::ccw);
      case cycles::CycleStep::spindle_orient:
        oriented_ = true;
        blocks.push_back(make_block(like_, action(SpindleOrient{1, Value{m.amount}})));
        return true;
      case cycles::CycleStep::operator_stop:
        blocks.push_back(make_block(like_, action(Stop{}, Order::after)));
        return true;
      default: *error = "the strokes of a tap can't be written out"; return false;
    }
  }

  Body blocks;
  double last = 0;

 private:
  bool move(const cycles::CycleMove& m, std::string* error) {
    Block b;
    b.has_motion = true;
    b.motion = along(m.step == cycles::CycleStep::rapid ? MotionKind::rapid : MotionKind::linear, axis_, m.w / unit_);
    sideways(b.motion, m);
    const bool own_feed = m.has_feed || m.feed_factor != 1;
    if (own_feed && !m.has_feed && !feed_) {
      *error = "the feed of the first peck depends on a feed that is not known here";
      return false;
    }
    if (own_feed) {
      const Value f = m.has_feed ? Value{m.feed / unit_} : scale(*feed_, m.feed_factor);
      b.actions.push_back(action(SetFeed{f, false}));
      changed_ = true;
    } else if (changed_ && m.step == cycles::CycleStep::feed) {
      if (!feed_) {
        *error = "the feed after the cycle's own one is not known here";
        return false;
      }
      b.actions.push_back(action(SetFeed{*feed_, false}));
      changed_ = false;
    }
    last = m.w;
    blocks.push_back(made(like_, std::move(b)));
    return true;
  }

  bool spindle(SpindleState state) {
    blocks.push_back(make_block(like_, action(SpindleRun{1, state})));
    return true;
  }
  /// The tool leaves the middle of the hole, or comes back to it.
  void sideways(Motion& motion, const cycles::CycleMove& m) {
    const auto axes = plane_axes(plane_);
    const bool moves = std::fabs(m.du - du_) > 1e-9 || std::fabs(m.dv - dv_) > 1e-9;
    if (moves && std::fabs(m.w - last) < 1e-9) motion.coords.clear();
    const auto add = [&](AxisId axis, double by) {
      if (std::fabs(by) < 1e-9) return;
      CoordWord c;
      c.axis = axis;
      c.mode = WordMode::incremental;
      c.value = Value{by / unit_};
      motion.coords.push_back(c);
    };
    add(axes.u, m.du - du_);
    add(axes.v, m.dv - dv_);
    du_ = m.du;
    dv_ = m.dv;
  }

  LineInfo like_;
  AxisId axis_;
  Plane plane_;
  double unit_;
  std::optional<Value> feed_;
  bool no_feed_ = false;
  std::optional<SpindleState> sense_;
  double du_ = 0, dv_ = 0;
  bool changed_ = false, oriented_ = false;
};

}  // namespace

std::optional<Explosion> explode(const HoleCycle& c, const LineInfo& like, const Block& b, const Facts& facts,
                                 const FeedBefore& feed, double height, double defined_at,
                                 std::optional<SpindleState> sense, std::string* error) {
  const auto axis_id = cycle_axis(c, b, facts);
  const auto units = setting_in<Units>(b, facts, Setting::units);
  const auto distance = setting_in<Distance>(b, facts, Setting::distance);
  const auto in_plane = setting_in<Plane>(b, facts, Setting::plane);
  if (!axis_id || !units || !distance || !in_plane) {
    *error = "plane, units or absolute and incremental are not known here";
    return std::nullopt;
  }
  const double unit = *units == Units::inch ? 25.4 : 1;
  cycles::HoleContext context;
  context.length_unit = context.level_unit = context.feed_unit = unit;
  context.distance = *distance;
  context.height = defined_at;
  const auto literal = [](const Value& v) {
    return v.literal() ? std::optional<double>(v.number) : constant_value(v.expr);
  };
  const auto numbers = cycles::resolve(c, context, literal, error);
  if (!numbers) return std::nullopt;
  const auto plane = setting_in<RetractPlane>(b, facts, Setting::retract_plane).value_or(RetractPlane::initial);
  const auto moves = cycles::expand(*numbers, height, plane, error);
  if (moves.empty()) {
    if (error->empty()) *error = "it has no moves";
    return std::nullopt;
  }
  LineInfo line;
  line.span = like.span;
  line.skip_mask = like.skip_mask;
  HoleWriter writer(line, *axis_id, *in_plane, unit, feed, sense);
  writer.last = height;
  for (const auto& m : moves) {
    if (!writer.add(m, error)) return std::nullopt;
  }
  if (!writer.finish(error)) return std::nullopt;
  return Explosion{std::move(writer.blocks), writer.last};
}

bool uses_cycles(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      if (const auto* m = std::get_if<ModalCall>(&s.node)) found = found || m->cycle != nullptr;
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        found = found || std::holds_alternative<CycleDefine>(a.data) || std::holds_alternative<CycleCancel>(a.data);
      }
    });
  }
  return found;
}

bool stands_by_itself(const HoleCycle& c) {
  const auto fixed = [](const Level& l) {
    return l.given && (l.base == LevelBase::absolute || l.base == LevelBase::from_surface);
  };
  const bool surface = !c.surface.given || c.surface.base == LevelBase::absolute;
  return surface && fixed(c.reference) && fixed(c.bottom) && c.retract.given && c.retract.base == LevelBase::absolute;
}

}  // namespace cnctrans::ir::passes
