// Splines and polynomials as straight steps, for targets without them: every point must be a number here. The steps are
// those that a run of the source takes (ir/geometry/curve).
#include <algorithm>
#include <set>

#include "ir/edit/labels.h"
#include "ir/edit/rewrite.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"
#include "legaliser/motion/curve_steps.h"

namespace cnctrans::ir::passes {

namespace {

using curves::Point;

class CurvePass {
 public:
  CurvePass(Program& program, const LegaliseContext& context, const FactsOf& facts)
      : program_(program), context_(context), facts_(facts), steps_(program, context) {}

  void routine(Routine& r) {
    uses_ = label_uses(program_, r);
    routine_ = &r;
    original_ = r;
    find_points(r);
    walk(r.body);
  }

 private:
  /// The blocks that curves with a number name.
  void find_points(const Routine& r) {
    points_.clear();
    const LabelTable labels(r);
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* repeat = std::get_if<Repeat>(&s.node);
      if (repeat == nullptr || repeat->curve_use == CurveUse::none || repeat->first.text.empty()) return;
      const auto range = labels.range(*repeat, labels.order(s.id));
      if (!range) return;
      bool inside = false;
      for_each_statement(r.body, [&](const Statement& x) {
        inside = inside || x.id == range->first.statement;
        if (inside) points_.insert(x.id);
        if (x.id == range->second.statement) inside = false;
      });
    });
  }

  [[nodiscard]] bool native(MotionKind k) const { return context_.target.motions.count(k) != 0; }

  void walk(Body& body) {
    Body out;
    out.reserve(body.size());
    bool begun = false;  // the code of a spline stands before, without a point
    for (std::size_t i = 0; i < body.size();) {
      Statement& s = body[i];
      bool nested = false;
      each_body(s, [&](Body& inner) {
        nested = true;
        walk(inner);
      });
      if (nested) begun = false;
      if (auto* r = std::get_if<Repeat>(&s.node); r != nullptr && r->curve_use != CurveUse::none) {
        begun = false;
        numbered(std::move(s), out);
        ++i;
        continue;
      }
      auto* b = std::get_if<Block>(&s.node);
      if (points_.count(s.id) != 0) {  // a point of a curve with a number: what runs it has its own copy
        out.push_back(std::move(s));
        ++i;
        continue;
      }
      const auto* next = i + 1 < body.size() ? std::get_if<Repeat>(&body[i + 1].node) : nullptr;
      if (b != nullptr && next != nullptr && next->curve_use == CurveUse::run && body[i + 1].line.joined) {
        b->motion.clear();  // G06
        b->has_motion = false;
        settle(s);
        out.push_back(std::move(s));
        ++i;
        continue;
      }
      const auto kind = b != nullptr ? motion_in(*b, facts_.before(s)) : std::nullopt;
      if (b == nullptr || !kind || (is_curve(*kind) && native(*kind))) {
        out.push_back(std::move(s));
        ++i;
        continue;
      }
      if (is_spline(*kind) && b->has_motion && b->motion.moves() && !b->motion.coords.empty()) {
        const std::size_t end = run_end(body, i, *kind);
        spline(body, i, end, *kind, begun || b->motion.explicit_code, out);
        begun = false;
        degree_.reset();
        i = end;
        continue;
      }
      if (*kind == MotionKind::polynomial && b->has_motion && b->motion.moves()) {
        polynomial(std::move(s), out);
        ++i;
        continue;
      }
      if (is_curve(*kind) && b->has_motion && b->motion.kind == *kind) {  // the code alone
        begun = is_spline(*kind);
        degree_ =
            b->motion.extra && b->motion.extra->has_degree ? std::optional(b->motion.extra->degree) : std::nullopt;
        b->motion.clear();
        b->has_motion = false;
      }
      plain(s);
      out.push_back(std::move(s));
      ++i;
    }
    body = std::move(out);
  }
  /// Words that mean nothing without their curve go.
  void plain(Statement& s) {
    auto& b = std::get<Block>(s.node);
    const bool empties = std::erase_if(b.actions, curve_setting) != 0;
    if (b.motion.extra && !b.motion.extra->polynomials.empty()) {
      auto x = *b.motion.extra;
      x.polynomials.clear();
      x.has_interval = false;
      b.motion.extra = x.has_turns || x.has_pitch || x.has_angle || x.has_polar_radius || x.has_polar_angle ||
                               x.has_line_angle || x.has_lead || x.has_probe_edge || !x.computed.empty()
                           ? std::make_shared<const MotionExtra>(std::move(x))
                           : nullptr;
    }
    if (empties) settle(s);
  }

  /// Behind the last statement that belongs to the run of points from `first` on.
  std::size_t run_end(const Body& body, std::size_t first, MotionKind kind) const {
    std::size_t end = first + 1;
    for (std::size_t i = first + 1; i < body.size(); ++i) {
      const auto* b = std::get_if<Block>(&body[i].node);
      if (b == nullptr && !std::holds_alternative<Message>(body[i].node)) break;
      if (b == nullptr || !b->has_motion) continue;
      if (b->motion.kind != MotionKind::modal && b->motion.kind != kind) break;
      end = i + 1;
    }
    return end;
  }

  void spline_error(Statement& s, const std::string& why) {
    refuse(s, program_, context_, "TRN-361",
           "a spline, which the target lacks; it can't be written as straight steps: " + why,
           "write the points as straight moves, or from a program that gives them as numbers");
  }

  /// The spline of the blocks from `first` to before `end`.
  void spline(Body& body, std::size_t first, std::size_t end, MotionKind kind, bool begins, Body& out) {
    Facts now = facts_.before(body[first]);
    std::vector<Statement*> list;
    for (std::size_t i = first; i < end; ++i) list.push_back(&body[i]);
    std::string why;
    if (!begins) why = "it begins elsewhere in the program";
    for (std::size_t i = first; i < end && why.empty(); ++i) {
      if (i > first && entered(body[i])) why = "a jump or a repeated part enters it";
    }
    // What follows without a block that ends it may hold further points.
    if (why.empty() && end < body.size()) {
      std::size_t next = end;
      while (next < body.size() && std::holds_alternative<Block>(body[next].node) &&
             !std::get<Block>(body[next].node).has_motion)
        ++next;
      const bool ends = next == body.size() || std::holds_alternative<Block>(body[next].node) ||
                        std::holds_alternative<End>(body[next].node) ||
                        std::holds_alternative<Message>(body[next].node);
      if (!ends) why = "it may go on behind a statement of another kind";
    }
    if (why.empty() && &body != &routine_->body && end == body.size())
      why = "it may go on behind the structure it stands in";
    if (why.empty() && end == body.size() && routine_->kind != RoutineKind::main)
      why = "it may go on in the calling program";
    if (why.empty()) {
      Point following;
      if (end < body.size()) following = steps_.direction_of(body[end], facts_.before(body[end]));
      if (steps_.spline(list, kind, now, following, degree_, out, why)) return;
    }
    spline_error(*list.front(), why);
    for (auto* s : list) out.push_back(std::move(*s));
  }

  [[nodiscard]] bool entered(const Statement& s) const {
    const auto labels = labels_on(s.line);
    return std::any_of(labels.begin(), labels.end(), [this](const LabelRef& l) {
      return uses_.is_target(l) || uses_.computed || uses_.computed_name;
    });
  }

  void polynomial(Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    const Facts& before = facts_.before(s);
    const auto on = setting_in<OnOff>(b, before, Setting::polynomial_axes);
    const bool has = b.motion.extra && !b.motion.extra->polynomials.empty();
    if (!has || on == OnOff::off) {
      plain(s);
      b.motion.kind = MotionKind::linear;
      b.motion.explicit_code = true;
      b.motion.code_text = {};
      if (b.motion.extra) b.motion.extra.reset();
      out.push_back(std::move(s));
      return;
    }
    std::string why;
    if (!steps_.polynomial(s, b, before, on, out, why)) {
      refuse(s, program_, context_, "TRN-362",
             "polynomials, which the target lacks; they can't be written as straight steps: " + why,
             "write the path as straight moves, or from a program that gives it as numbers");
      out.push_back(std::move(s));
    }
  }

  /// A curve with a number: its definition goes, its run is written out.
  void numbered(Statement&& s, Body& out) {
    const Repeat r = std::get<Repeat>(s.node);
    if (r.curve_use != CurveUse::run) {
      s.node = Block{};
      settle(s);
      out.push_back(std::move(s));
      return;
    }
    std::vector<Statement> copies;
    const LabelTable labels(original_);
    const auto range = labels.range(r, labels.order(s.id));
    std::string why = range ? "" : "its points are not in this program";
    if (range) {
      bool inside = false;
      for_each_statement(original_.body, [&](const Statement& x) {
        inside = inside || x.id == range->first.statement;
        if (inside && why.empty()) {
          if (!std::holds_alternative<Block>(x.node)) why = "its points are not plain blocks";
          copies.push_back(x);
        }
        if (x.id == range->second.statement) inside = false;
      });
    }
    Facts now = facts_.before(s);
    std::vector<Statement*> list;
    for (auto& c : copies) {
      c.line.number = {};
      c.line.labels.clear();
      c.line.comments.clear();
      c.line.joined = false;
      c.id = 0;
      list.push_back(&c);
    }
    if (why.empty()) {
      Body made_out;
      steps_.begins_at_first_point(true);
      const bool done = steps_.spline(list, MotionKind::spline_cubic, now, {}, {}, made_out, why);
      steps_.begins_at_first_point(false);
      if (done) {
        s.node = Block{};
        settle(s);
        out.push_back(std::move(s));
        for (auto& m : made_out) out.push_back(std::move(m));
        return;
      }
    }
    spline_error(s, why);
    out.push_back(std::move(s));
  }

  Program& program_;
  const LegaliseContext& context_;
  const FactsOf& facts_;
  LabelUses uses_;
  Routine* routine_ = nullptr;
  std::set<std::uint32_t> points_;  ///< ids of blocks in the range of a numbered curve
  Routine original_;                ///< before its statements are taken apart
  CurveSteps steps_;
  std::optional<Value> degree_;  ///< said with the code of a spline
};

bool has_curves(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      if (const auto* rep = std::get_if<Repeat>(&s.node)) found = found || rep->curve_use != CurveUse::none;
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || found) return;
      found = (b->has_motion && is_curve(b->motion.kind)) ||
              (b->motion.extra && !b->motion.extra->polynomials.empty()) ||
              std::any_of(b->actions.begin(), b->actions.end(), curve_setting);
    });
  }
  return found;
}

}  // namespace

void write_out_curves(Program& program, const LegaliseContext& context) {
  if (!has_curves(program)) return;
  const FactsOf facts(program, context);
  CurvePass pass(program, context, facts);
  for (auto& r : program.routines) pass.routine(r);
}

}  // namespace cnctrans::ir::passes
