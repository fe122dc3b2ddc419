#include "ir/edit/rewrite.h"

namespace cnctrans::ir::passes {

namespace {

struct BlockValues {
  const ValueVisitor& visit;
  bool changed = false;

  void one(Value& v, Role role, AxisId axis = axis::none, WordPos pos = {}) {
    if (visit(v, Place{role, axis, pos})) changed = true;
  }

  void level(Level& l) {
    if (l.given) one(l.value, Role::cycle_level);
  }
  void pecks(Pecks& p) {
    if (p.law == PeckLaw::none) return;
    one(p.first, Role::cycle_length);
    level(p.first_to);
    one(p.count, Role::cycle_other);
    one(p.degression, p.law == PeckLaw::geometric ? Role::cycle_other : Role::cycle_length);
    one(p.minimum, Role::cycle_length);
    one(p.lift, Role::cycle_length);
    one(p.reapproach, Role::cycle_length);
    one(p.dwell, Role::cycle_other);
    if (p.has_first_feed_factor) one(p.first_feed_factor, Role::cycle_other);
  }
  void hole(HoleCycle& h) {
    level(h.surface);
    level(h.reference);
    level(h.bottom);
    level(h.retract);
    one(h.dwell_bottom, Role::cycle_other);
    one(h.dwell_top, Role::cycle_other);
    if (h.has_feed) one(h.feed, Role::cycle_feed);
    if (h.has_feed_out) one(h.feed_out, Role::cycle_feed);
    pecks(h.pecks);
    one(h.pitch, Role::cycle_length);
    one(h.orient_angle, Role::cycle_other);
    one(h.shift_u, Role::cycle_length);
    one(h.shift_v, Role::cycle_length);
    one(h.shift_w, Role::cycle_length);
    if (h.has_speed) one(h.speed, Role::cycle_other);
    if (h.has_speed_out) one(h.speed_out, Role::cycle_other);
    for (auto& [word, value] : h.mill.words) one(value, Role::cycle_other);
  }
  void cycle(Cycle& c) {
    if (auto* h = std::get_if<HoleCycle>(&c.node)) {
      hole(*h);
    } else if (auto* n = std::get_if<NamedCycle>(&c.node)) {
      for (auto& [word, value] : n->words) one(value, Role::cycle_other);
    }
  }

  /// Visits a copy and keeps it when something changed.
  template <class T, class Walk>
  void shared(std::shared_ptr<const T>& p, const Walk& walk) {
    if (!p) return;
    auto copy = std::make_shared<T>(*p);
    const bool before = changed;
    changed = false;
    walk(*copy);
    if (changed) p = std::move(copy);
    changed = changed || before;
  }

  void frame(FrameChange& f) {
    for (auto& w : f.words) {
      const bool factor = f.kind == FrameKind::scale || f.kind == FrameKind::mirror;
      const bool angle = f.kind == FrameKind::rotate && !f.has_angle;
      one(w.value, factor ? Role::frame_factor : angle ? Role::frame_angle : Role::frame_length, w.axis, w.pos);
    }
    if (f.has_angle) one(f.angle, Role::frame_angle);
  }

  void extra(MotionExtra& e) {
    if (e.has_turns) one(e.turns, Role::turns);
    if (e.has_pitch) one(e.pitch, Role::pitch);
    if (e.has_angle) one(e.opening_angle, Role::angle);
    for (auto& c : e.through) one(c.value, Role::center, c.axis, c.pos);
    if (e.has_polar_radius) one(e.polar_radius, Role::polar_radius);
    if (e.has_polar_angle) one(e.polar_angle, Role::angle);
    if (e.has_line_angle) one(e.line_angle, Role::angle);
    if (e.has_lead) one(e.lead, Role::lead, e.lead_axis);
    one(e.lead_change, Role::lead);
    if (e.has_start_angle) one(e.start_angle, Role::angle);
    one(e.probe_tolerance, Role::polar_radius);
    if (e.has_probe_edge) one(e.probe_edge, Role::turns);
    if (e.has_fixed_point) one(e.fixed_point, Role::turns);
    for (auto& c : e.computed) one(c.value, Role::turns, axis::none, c.pos);
    for (auto& p : e.polynomials) {
      const auto role = p.axis == axis::none ? Role::turns : Role::coordinate;
      if (p.axis == axis::none) one(p.end, role, axis::none, p.pos);
      for (auto* a : {&p.a2, &p.a3, &p.a4, &p.a5}) one(*a, role, p.axis, p.pos);
    }
    if (e.has_interval) one(e.interval, Role::turns);
    if (e.has_weight) one(e.weight, Role::turns);
    if (e.has_degree) one(e.degree, Role::turns);
  }

  void act(Action& a) {
    if (auto* f = std::get_if<SetFeed>(&a.data))
      one(f->value, Role::feed, axis::none, a.pos);
    else if (auto* s = std::get_if<SetSpindle>(&a.data))
      one(s->value, Role::spindle, axis::none, a.pos);
    else if (auto* so = std::get_if<SpindleOrient>(&a.data))
      one(so->angle, Role::angle, axis::none, a.pos);
    else if (auto* sl = std::get_if<SpindleLimit>(&a.data))
      one(sl->value, Role::spindle, axis::none, a.pos);
    else if (auto* t = std::get_if<ToolSelect>(&a.data))
      one(t->number, Role::tool, axis::none, a.pos);
    else if (auto* o = std::get_if<ToolOffset>(&a.data))
      one(o->number, Role::offset, axis::none, a.pos);
    else if (auto* w = std::get_if<WorkOffset>(&a.data)) {
      if (!w->off) one(w->index, Role::work_offset, axis::none, a.pos);
    } else if (auto* d = std::get_if<Dwell>(&a.data)) {
      one(d->value, Role::dwell, axis::none, a.pos);
    } else if (auto* m = std::get_if<MachineFunction>(&a.data)) {
      if (m->auxiliary || m->computed) one(m->value, Role::machine, axis::none, a.pos);
    } else {
      act_rest(a);
    }
  }
  void act_rest(Action& a) {
    if (auto* fo = std::get_if<FrameOp>(&a.data)) {
      shared(fo->change, [this](FrameChange& f) { frame(f); });
    } else if (auto* p = std::get_if<PoleSet>(&a.data)) {
      shared(p->at, [this](FrameChange& f) { frame(f); });
    } else if (auto* c = std::get_if<CycleDefine>(&a.data)) {
      shared(c->cycle, [this](Cycle& y) { cycle(y); });
    } else if (auto* k = std::get_if<Corner>(&a.data)) {
      one(k->value, Role::corner, axis::none, a.pos);
      shared(k->feed, [this](Value& v) { one(v, Role::feed); });
    } else if (auto* s = std::get_if<SurfaceSet>(&a.data)) {
      one(s->diameter, Role::radius, axis::none, a.pos);
    } else if (auto* e = std::get_if<TangentialEnd>(&a.data)) {
      one(e->radius, Role::corner, axis::none, a.pos);
    }
  }

  void block(Block& b) {
    for (auto& a : b.actions) act(a);
    if (b.has_motion) {
      for (auto& c : b.motion.coords) one(c.value, Role::coordinate, c.axis, c.pos);
      for (auto& c : b.motion.centers) one(c.value, Role::center, c.axis, c.pos);
      if (b.motion.radius_given) one(b.motion.radius, Role::radius, axis::none, b.motion.radius_pos);
      shared(b.motion.extra, [this](MotionExtra& e) { extra(e); });
    }
    if (b.repeat_given != 0) one(b.repeat, Role::count);
  }
};

bool plain_action(const Action& a) {
  if (const auto* f = std::get_if<SetFeed>(&a.data)) return f->value.literal();
  if (const auto* s = std::get_if<SetSpindle>(&a.data)) return s->value.literal();
  if (const auto* t = std::get_if<ToolSelect>(&a.data)) return t->number.literal();
  if (const auto* o = std::get_if<ToolOffset>(&a.data)) return o->number.literal();
  if (const auto* d = std::get_if<Dwell>(&a.data)) return d->value.literal();
  if (const auto* m = std::get_if<MachineFunction>(&a.data)) return m->value.literal();
  if (const auto* w = std::get_if<WorkOffset>(&a.data)) return w->index.literal();
  return std::holds_alternative<ModalSet>(a.data) || std::holds_alternative<SpindleRun>(a.data) ||
         std::holds_alternative<SpindleGear>(a.data) || std::holds_alternative<ToolChange>(a.data) ||
         std::holds_alternative<Coolant>(a.data) || std::holds_alternative<Stop>(a.data) ||
         std::holds_alternative<ExactStopBlock>(a.data) || std::holds_alternative<CycleCancel>(a.data) ||
         std::holds_alternative<PreparationStop>(a.data) || std::holds_alternative<OpaqueWord>(a.data);
}

}  // namespace

void visit_values(Block& block, const ValueVisitor& visit) {
  BlockValues{visit}.block(block);
}

void visit_values(Cycle& cycle, const ValueVisitor& visit, bool& changed) {
  BlockValues walk{visit};
  walk.cycle(cycle);
  changed = walk.changed;
}

bool has_expression(const Block& block) {
  for (const auto& a : block.actions) {
    if (!plain_action(a)) return true;  // deep ones: look closer
  }
  if (block.repeat_given != 0 && block.repeat.expr) return true;
  if (!block.has_motion) return false;
  if (block.motion.extra || block.motion.radius.expr) return true;
  for (const auto& c : block.motion.coords) {
    if (c.value.expr) return true;
  }
  for (const auto& c : block.motion.centers) {
    if (c.value.expr) return true;
  }
  return false;
}

}  // namespace cnctrans::ir::passes
