// Rigid taps that the source writes as their two strokes, in and straight back out at the same speed, as a tap: the
// strokes alone no other control has. A left-hand thread stays: as strokes it is told by the sign of its lead, as a tap
// by the spindle.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

const Block* stroke(const Statement& s, MotionKind kind) {
  const auto* b = std::get_if<Block>(&s.node);
  return b != nullptr && b->has_motion && b->motion.kind == kind ? b : nullptr;
}

template <class T>
const T* alone(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  return b != nullptr && !b->has_motion && b->actions.size() == 1 ? std::get_if<T>(&b->actions[0].data) : nullptr;
}

class StrokeTaps {
 public:
  StrokeTaps(Program& program, Routine& routine, const FactsOf& facts)
      : facts_(facts), uses_(label_uses(program, routine)) {}

  void walk(Body& body) {
    for (std::size_t i = 0; i < body.size(); ++i) {
      each_body(body[i], [this](Body& inner) { walk(inner); });
      if (stroke(body[i], MotionKind::tap_rigid) != nullptr) pair(body, i);
    }
    std::erase_if(body, [this](const Statement& s) {
      return emptied_.count(s.id) != 0 && s.line.comments.empty() && s.line.labels.empty();
    });
  }

 private:
  /// Nothing leads to the statement, and no switch leaves it out.
  [[nodiscard]] bool joined_to_the_line(const Statement& s) const {
    const auto labels = labels_on(s.line);
    return s.line.skip_mask == 0 &&
           std::none_of(labels.begin(), labels.end(), [this](const LabelRef& l) { return uses_.is_target(l); });
  }
  /// The move that follows says its own function: it does not go on as a stroke.
  static bool ends_here(const Body& body, std::size_t from) {
    for (std::size_t i = from; i < body.size(); ++i) {
      if (std::holds_alternative<End>(body[i].node)) return true;
      const auto* b = std::get_if<Block>(&body[i].node);
      if (b == nullptr) return false;
      if (b->has_motion) return b->motion.explicit_code && b->motion.kind != MotionKind::modal;
    }
    return false;
  }
  /// Where the one word of the stroke ends, from `start`; nullopt: along another axis, or not a number.
  static std::optional<Value> end_of(const Block& b, const Facts& facts, AxisId w, double start) {
    const Motion& m = b.motion;
    const bool one = m.coords.size() == 1 && m.coords[0].axis == w && m.frame == FrameUse::normal;
    const auto distance = setting_in<Distance>(b, facts, Setting::distance);
    if (!one || (m.coords[0].mode == WordMode::modal && !distance)) return std::nullopt;
    const CoordWord& c = m.coords[0];
    const bool absolute = c.mode == WordMode::modal ? distance == Distance::absolute : c.mode == WordMode::absolute;
    if (absolute) return c.value;
    return c.value.literal() ? std::optional(Value(start + c.value.number)) : std::nullopt;
  }
  /// The speed that the block gives the spindle; false: it says something else.
  static bool speed_of(const Block& b, const Facts& facts, Value& speed, bool& given) {
    for (const auto& a : b.actions) {
      const auto* s = std::get_if<SetSpindle>(&a.data);
      if (s == nullptr || s->number != facts.master || given) return false;
      speed = s->value;
      given = true;
    }
    return true;
  }

  void pair(Body& body, std::size_t i) {
    const Facts& facts = facts_.before(body[i]);
    const Block& in = *stroke(body[i], MotionKind::tap_rigid);
    const std::size_t back = i + 1;
    const Block* out = back < body.size() ? stroke(body[back], MotionKind::tap_rigid_out) : nullptr;
    if (out == nullptr || !out->actions.empty() || !in.motion.extra || !out->motion.extra ||
        body[i].line.skip_mask != 0)
      return;
    const AxisId w = in.motion.extra->lead_axis;
    const Value& lead = in.motion.extra->lead;
    const auto plane = setting<Plane>(facts, Setting::plane);
    const double start = w < facts.position.size() ? facts.position[w].value_or(std::nan("")) : std::nan("");
    const bool radius = w != axis::x || setting<DiameterMode>(facts, Setting::diameter) == DiameterMode::radius;
    const bool quiet = facts.cycle_active_known && !facts.cycle_active && !facts.modal_call_runs();
    const bool one_thread =
        lead.literal() && lead.number > 0 && equal(lead, out->motion.extra->lead) && out->motion.extra->lead_axis == w;
    if (!plane || std::isnan(start) || !radius || !quiet || !one_thread || !joined_to_the_line(body[back]) ||
        !ends_here(body, back + 1))
      return;
    const auto bottom = end_of(in, facts, w, start);
    const auto top = bottom ? end_of(*out, facts, w, bottom->literal() ? bottom->number : std::nan("")) : std::nullopt;
    if (!top || !top->literal() || !(std::fabs(top->number - start) <= 1e-9)) return;
    HoleCycle hole;
    hole.kind = HoleKind::tap;
    hole.rigid = true;
    hole.pitch = lead;
    hole.spindle_after = SpindleStep::off;
    if (plane_axes(*plane).w != w) hole.axis = w;
    hole.bottom.value = *bottom;
    hole.reference.value = hole.retract.value = Value(start);
    hole.bottom.given = hole.reference.given = hole.retract.given = true;
    if (!speed_of(in, facts, hole.speed, hole.has_speed)) return;
    if (const auto angle = oriented_before(body, i, facts)) {
      hole.orient_first = true;
      hole.orient_angle = *angle;
    }
    CycleDefine define;
    define.modal = false;
    define.cycle = std::make_shared<const Cycle>(Cycle{std::move(hole)});
    Block tap;
    tap.actions.emplace_back().data = std::move(define);
    body[i].node = std::move(tap);
    empty(body[back]);
  }
  void empty(Statement& s) {
    s.node = Block{};
    emptied_.insert(s.id);
  }
  /// The spindle is stopped at an angle, and from there on only rapid moves lead to the tap: that is the tap's own now.
  std::optional<Value> oriented_before(Body& body, std::size_t i, const Facts& facts) {
    for (std::size_t k = i; k > 0 && joined_to_the_line(body[k]) && body[k - 1].line.skip_mask == 0; --k) {
      Statement& s = body[k - 1];
      if (const auto* orient = alone<SpindleOrient>(s)) {
        if (orient->number != facts.master || orient->incremental || !joined_to_the_line(s)) return std::nullopt;
        const Value angle = orient->angle;
        empty(s);
        return angle;
      }
      const Block* way = stroke(s, MotionKind::rapid);
      if (way == nullptr || !way->actions.empty()) return std::nullopt;
    }
    return std::nullopt;
  }

  std::set<std::uint32_t> emptied_;
  const FactsOf& facts_;
  LabelUses uses_;
};

}  // namespace

void say_stroke_taps(Program& program, const LegaliseContext& context) {
  if (context.options.cycles == CycleWriting::explode || context.target.motions.count(MotionKind::tap_rigid) != 0)
    return;
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(
        r.body, [&found](const Statement& s) { found = found || stroke(s, MotionKind::tap_rigid_out) != nullptr; });
  }
  if (!found) return;
  const FactsOf facts(program, context);
  for (auto& r : program.routines) StrokeTaps(program, r, facts).walk(r.body);
}

}  // namespace cnctrans::ir::passes
