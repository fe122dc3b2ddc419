// Contours given by angles, tangency and intersection, for targets that want their points: written out where the start
// and all data are numbers.
#include <algorithm>

#include "ir/geometry/contour.h"
#include "legaliser/analysis/words.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

bool open_end(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  return b != nullptr && b->has_motion && contour::marks_of(*b).end != contour::ElementEnd::given;
}

/// The axes that nothing has moved or shifted since the start of the main program, down its text: they stand at 0.
class Untouched {
 public:
  Untouched(const Routine& main, const LabelUses& uses, const machine::Profile& machine) {
    std::uint32_t axes = machine.work_offsets.empty() ? ~0U : 0;
    for (const auto& a : machine.axes) {
      if (a.start != 0) axes = 0;
    }
    for (const auto& s : main.body) {
      const auto labels = labels_on(s.line);
      if (std::any_of(labels.begin(), labels.end(), [&uses](const LabelRef& l) { return uses.is_target(l); })) axes = 0;
      if (s.id >= before_.size()) before_.resize(s.id + 1, 0);
      before_[s.id] = axes;
      axes &= ~touched(s);
    }
  }
  [[nodiscard]] std::uint32_t before(std::uint32_t id) const { return id < before_.size() ? before_[id] : 0; }

 private:
  static std::uint32_t touched(const Statement& s) {
    if (const auto* a = std::get_if<Assign>(&s.node)) {
      for (const auto& item : a->items) {
        if (item.to_system) return ~0U;
      }
      return 0;
    }
    if (std::holds_alternative<Label>(s.node) || std::holds_alternative<Message>(s.node) ||
        std::holds_alternative<Declare>(s.node))
      return 0;
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return ~0U;
    for (const auto& a : b->actions) {
      const bool plain = std::holds_alternative<ModalSet>(a.data) || std::holds_alternative<SetFeed>(a.data) ||
                         std::holds_alternative<SetSpindle>(a.data) || std::holds_alternative<SpindleRun>(a.data) ||
                         std::holds_alternative<SpindleGear>(a.data) || std::holds_alternative<Coolant>(a.data) ||
                         std::holds_alternative<MachineFunction>(a.data) ||
                         std::holds_alternative<ToolSelect>(a.data) || std::holds_alternative<ToolChange>(a.data) ||
                         std::holds_alternative<ToolOffset>(a.data) || std::holds_alternative<CycleCancel>(a.data) ||
                         std::holds_alternative<WorkOffset>(a.data);
      if (!plain) return ~0U;
    }
    if (!b->has_motion) return 0;
    if (!b->motion.centers.empty() || b->motion.radius_given || b->motion.extra) return ~0U;
    std::uint32_t axes = 0;
    for (const auto& w : b->motion.coords) axes |= w.axis < 32 ? 1U << w.axis : 0U;
    return axes;
  }

  std::vector<std::uint32_t> before_;  ///< by id of the statement
};

class ContourPass {
 public:
  ContourPass(Program& program, const LegaliseContext& context)
      : program_(program), context_(context), facts_(program, context) {}

  void routine(Routine& r) {
    uses_ = label_uses(program_, r);
    const Untouched start(r, uses_, context_.source_machine);
    untouched_ = r.kind == RoutineKind::main ? &start : nullptr;
    body(r.body);
    untouched_ = nullptr;
  }

 private:
  struct Group {
    std::vector<Block*> blocks;
    std::vector<const Facts*> facts;
    std::vector<contour::Element> elements;
    std::uint32_t untouched = 0;  ///< axes that stand where they stood at the start of the program
    std::string fault;
  };

  void body(Body& list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!open_end(list[i])) {
        nested(list[i]);
        continue;
      }
      where_ = list[i].line.span;
      Group g;
      if (untouched_ != nullptr) g.untouched = untouched_->before(list[i].id);
      i = collect(list, i, g);
      if (g.fault.empty()) write(g);
      if (g.fault.empty()) continue;
      context_.diagnostics.error(
          "TRN-183", where_, "the points of this contour follow from its elements and can't be written out: " + g.fault,
          "write the end points");
      for (Block* b : g.blocks) unmark(*b);
    }
  }

  static void unmark(Block& b) {
    std::erase_if(b.actions, [](const Action& a) {
      const auto* w = std::get_if<OpaqueWord>(&a.data);
      return w != nullptr && (w->word == contour::mark::secant || w->word == contour::mark::tangent ||
                              w->word == contour::mark::plus || w->word == contour::mark::minus);
    });
    b.motion.extra.reset();
  }

  void nested(Statement& s) {
    if (auto* i = std::get_if<If>(&s.node)) {
      body(i->then_body);
      body(i->else_body);
    } else if (auto* w = std::get_if<While>(&s.node)) {
      body(w->body);
    } else if (auto* u = std::get_if<Until>(&s.node)) {
      body(u->body);
    } else if (auto* f = std::get_if<For>(&s.node)) {
      body(f->body);
    } else if (auto* l = std::get_if<Loop>(&s.node)) {
      body(l->body);
    }
  }

  /// The elements from `i` to the one that closes; its index.
  std::size_t collect(Body& list, std::size_t i, Group& g) {
    for (; i < list.size(); ++i) {
      Statement& s = list[i];
      auto* b = std::get_if<Block>(&s.node);
      const bool first = g.blocks.empty();
      if (b == nullptr) {
        g.fault = "something else than a block stands between its elements";
        return i;
      }
      if (s.line.skip_mask != 0) g.fault = "a block of it can be skipped";
      if (!first && led_to(s)) g.fault = "the program can begin in the middle of it";
      if (!b->has_motion || !b->motion.moves()) {
        if (changes_frame(*b)) g.fault = "the plane or the zero point changes inside it";
        continue;
      }
      if (!element(s, *b, g)) return i;
      if (!open_end(s)) return i;
    }
    if (g.fault.empty()) g.fault = "the element that closes it is missing";
    return i;
  }

  [[nodiscard]] bool led_to(const Statement& s) const {
    if (s.line.number.empty()) return false;
    return uses_.computed || uses_.is_target({std::string(s.line.number), true, nullptr});
  }
  static bool changes_frame(const Block& b) {
    return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      return std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data) ||
             (m != nullptr && (m->setting == Setting::plane || m->setting == Setting::units));
    });
  }

  std::optional<double> number(const Value& v, Group& g) const {
    if (v.literal()) return v.number;
    if (const auto c = constant_value(v.expr)) return c;
    g.fault = "it holds computed values";
    return std::nullopt;
  }

  bool element(const Statement& s, Block& b, Group& g) const {
    const Facts& facts = facts_.before(s);
    const auto plane = setting_in<Plane>(b, facts, Setting::plane);
    const auto kind = motion_in(b, facts);
    g.blocks.push_back(&b);
    g.facts.push_back(&facts);
    if (!plane || !kind || b.repeat_given != 0) {
      g.fault = "the plane or the motion function is not known";
      return false;
    }
    const PlaneAxes axes = plane_axes(*plane);
    contour::Element e;
    e.arc = *kind == MotionKind::arc_cw || *kind == MotionKind::arc_ccw;
    e.ccw = *kind == MotionKind::arc_ccw;
    if (!e.arc && *kind != MotionKind::linear && *kind != MotionKind::rapid) g.fault = "it holds other motions";
    for (const auto& w : b.motion.coords) {
      if (w.axis != axes.u && w.axis != axes.v) continue;
      const auto d = distance_of(w, b, facts);
      const auto factor = to_radius(w.axis, w.scale, d, b, facts, context_.source_machine);
      const auto v = number(w.value, g);
      if (d != Distance::absolute || !factor) g.fault = "it holds increments";
      if (v && factor) (w.axis == axes.u ? e.u : e.v) = *v * *factor;
    }
    if (b.motion.radius_given) {
      e.radius = number(b.motion.radius, g);
      if (e.radius && *e.radius <= 0) g.fault = "a radius is not above 0";
    }
    centre(b, facts, axes, e, g);
    if (b.motion.extra) {
      const MotionExtra& x = *b.motion.extra;
      if (x.has_turns || x.has_pitch || x.has_polar_angle || x.has_polar_radius || x.has_angle || !x.through.empty())
        g.fault = "it holds polar words or turns";
      if (x.has_line_angle) e.angle = number(x.line_angle, g);
    }
    const contour::Marks marks = contour::marks_of(b);
    e.end = marks.end;
    e.branch = marks.branch;
    g.elements.push_back(e);
    return g.fault.empty();
  }

  void centre(const Block& b, const Facts& facts, const PlaneAxes& axes, contour::Element& e, Group& g) const {
    if (b.motion.centers.empty()) return;
    contour::Point c;
    for (const auto& w : b.motion.centers) {
      const bool absolute =
          w.mode == CenterMode::absolute || (w.mode == CenterMode::follows_distance &&
                                             setting_in<Distance>(b, facts, Setting::distance) == Distance::absolute);
      const auto factor = to_radius(w.axis, w.scale, Distance::absolute, b, facts, context_.source_machine);
      const auto v = number(w.value, g);
      if (!absolute || !factor || (w.axis != axes.u && w.axis != axes.v))
        g.fault = "the centre of an arc is no point of the plane";
      if (v && factor) (w.axis == axes.u ? c.u : c.v) = *v * *factor;
    }
    e.centre = c;
  }

  void write(Group& g) const {
    const auto plane = setting_in<Plane>(*g.blocks.front(), *g.facts.front(), Setting::plane);
    const PlaneAxes axes = plane_axes(*plane);
    const auto at = [&](AxisId axis) {
      const auto known = g.facts.front()->position[axis];
      return known || (g.untouched >> axis & 1U) == 0 ? known : std::optional(0.0);
    };
    const auto u = at(axes.u), v = at(axes.v);
    if (!u || !v) {
      g.fault = "the point where it starts is not known here";
      return;
    }
    if (!g.facts.front()->position[axes.u] || !g.facts.front()->position[axes.v]) {
      context_.diagnostics.warning("TRN-484", where_,
                                   "no move before this contour says where the tool stands: its points are those from "
                                   "the zero point of the program on",
                                   "write a move to the start of the contour before it");
    }
    const bool inch = setting_in<Units>(*g.blocks.front(), *g.facts.front(), Setting::units) != Units::metric;
    const auto solved = contour::solve({*u, *v}, g.elements, context_.source_machine.arc_tolerance / (inch ? 25.4 : 1));
    if (!solved.ok) {
      g.fault = solved.error;
      return;
    }
    for (std::size_t i = 0; i < g.blocks.size(); ++i) {
      auto& m = g.blocks[i]->motion;
      std::erase_if(m.coords, [&](const CoordWord& w) { return w.axis == axes.u || w.axis == axes.v; });
      const auto& s = solved.elements[i];
      put(m, axes.v, s.to.v, *g.blocks[i], *g.facts[i]);
      put(m, axes.u, s.to.u, *g.blocks[i], *g.facts[i]);
      unmark(*g.blocks[i]);
      if (!g.elements[i].arc) continue;
      m.radius_given = false;
      m.centers.clear();
      for (const auto& [axis, value] : {std::pair{axes.u, s.centre.u}, std::pair{axes.v, s.centre.v}}) {
        CenterWord c;
        c.axis = axis;
        c.mode = CenterMode::absolute;
        c.scale = WordScale::radius;
        c.value = Value{value};
        m.centers.push_back(std::move(c));
      }
    }
    if (solved.chosen) {
      context_.diagnostics.warning("TRN-184", where_,
                                   "several contours fit the data of these elements; the nearest one is written",
                                   "say which point is meant");
    }
  }

  void put(Motion& m, AxisId axis, double radius, const Block& b, const Facts& facts) const {
    CoordWord w;
    w.axis = axis;
    w.mode =
        setting_in<Distance>(b, facts, Setting::distance) == Distance::absolute ? WordMode::modal : WordMode::absolute;
    const auto factor = to_radius(axis, WordScale::modal, Distance::absolute, b, facts, context_.source_machine);
    if (!factor) w.scale = WordScale::radius;
    w.value = Value{radius / factor.value_or(1)};
    m.coords.insert(m.coords.begin(), std::move(w));
  }

  Program& program_;
  const LegaliseContext& context_;
  FactsOf facts_;
  LabelUses uses_;
  const Untouched* untouched_ = nullptr;
  Span where_;
};

}  // namespace

void solve_contours(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect) return;  // it has these words itself
  bool any = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&any](const Statement& s) { any = any || open_end(s); });
  }
  if (!any) return;
  ContourPass pass(program, context);
  for (auto& r : program.routines) pass.routine(r);
}

}  // namespace cnctrans::ir::passes
