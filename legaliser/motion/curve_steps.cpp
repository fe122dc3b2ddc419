#include "legaliser/motion/curve_steps.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/tiny.h"
#include "ir/edit/rewrite.h"
#include "legaliser/analysis/words.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

namespace {

/// What neither stands between the points of a curve nor beside them in a translation.
bool disturbs(const Block& b) {
  if (b.repeat_given != 0 || b.motion.frame != FrameUse::normal) return true;
  for (const auto& w : b.motion.coords) {
    if (w.positioning != Positioning::with_path || w.direction != RotaryDirection::as_value) return true;
  }
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    return std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data) ||
           std::holds_alternative<PreparationStop>(a.data) || std::holds_alternative<Corner>(a.data) ||
           std::holds_alternative<CycleDefine>(a.data) || std::holds_alternative<TangentialEnd>(a.data);
  });
}

std::optional<double> number_of(const Value& v) {
  return v.expr ? constant_value(v.expr) : std::optional(v.number);
}

}  // namespace

bool curve_setting(const Action& a) {
  if (std::holds_alternative<SplineAxes>(a.data)) return true;
  const auto* m = std::get_if<ModalSet>(&a.data);
  return m != nullptr && (m->setting == Setting::spline_start || m->setting == Setting::spline_end ||
                          m->setting == Setting::path_reference || m->setting == Setting::polynomial_axes);
}

CurveSteps::CurveSteps(const Program& program, const LegaliseContext& context) : context_(context) {
  tolerance_ = std::clamp(context.source_machine.policies.path_curve_tolerance, 1e-6, 1.0);
  for (const auto& a : context.source_machine.axes) {
    if (!a.rotary && group_.size() < 3) group_.push_back(a.id);
  }
  bool chosen = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) { find_axes(s, chosen); });
  }
}

void CurveSteps::find_axes(const Statement& s, bool& chosen) {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr) return;
  for (const auto& a : b->actions) {
    if (const auto* f = std::get_if<FrameOp>(&a.data); f != nullptr && f->change != nullptr)
      unequal_ = unequal_ || (f->change->kind == FrameKind::scale && !f->change->uniform_scale);
    const auto* g = std::get_if<SplineAxes>(&a.data);
    if (g == nullptr) continue;
    std::vector<AxisId> named;
    for (const auto& x : g->axes) named.push_back(x.axis);
    several_groups_ = several_groups_ || (chosen && named != group_);
    group_ = named;
    chosen = true;
  }
}

double CurveSteps::length_unit(AxisId axis, double unit) const {
  const auto* spec = context_.source_machine.axis(axis);
  return spec != nullptr && spec->rotary ? 1 : unit;
}

/// Of a straight move in the axes of the curve; empty: not known.
curves::Point CurveSteps::direction_of(const Statement& s, const Facts& before) const {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || !b->has_motion) return {};
  const auto kind = motion_in(*b, before);
  if (!kind || (*kind != MotionKind::linear && *kind != MotionKind::rapid)) return {};
  Facts after = before;
  apply(s, after);
  Point d;
  for (const auto a : group_) {
    const auto from = before.position[a], to = after.position[a];
    const bool named =
        std::any_of(b->motion.coords.begin(), b->motion.coords.end(), [a](const auto& w) { return w.axis == a; });
    if (named && (!from || !to)) return {};
    d.push_back(named ? *to - *from : 0);
  }
  return d;
}

/// The points of the blocks, and what holds behind them in `now`.
bool CurveSteps::collect(const std::vector<Statement*>& list, Facts& now, const std::vector<AxisId>& order,
                         const std::vector<AxisId>& moved, double unit, curves::SplinePoints& in, std::string& why) {
  const auto no = [&why](const char* text) {
    why = text;
    return false;
  };
  const auto point = [&](const Facts& f, Point& curve, Point& beside) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      const AxisId a = order[i];
      const bool moves = std::find(moved.begin(), moved.end(), a) != moved.end();
      if (moves && !f.position[a]) return false;
      const auto* spec = context_.source_machine.axis(a);
      const double scale = spec != nullptr && spec->rotary ? 1 : unit;
      (i < group_.size() ? curve : beside).push_back(moves ? *f.position[a] * scale : 0);
    }
    return true;
  };
  in.points.emplace_back();
  in.beside.emplace_back();
  in.weights.push_back(1);
  if (!point(now, in.points[0], in.beside[0])) return no("the point where it begins is not a number here");
  taken_.clear();
  last_end_.reset();
  bool first_said = false;
  const auto units = setting<Units>(now, Setting::units);
  const auto feed_mode = setting<FeedMode>(now, Setting::feed_mode);
  for (auto* s : list) {
    auto* b = std::get_if<Block>(&s->node);
    if (b == nullptr) continue;
    if (s->line.skip_mask != 0) return no("a block of it can be skipped");
    if (disturbs(*b)) return no("a block of it holds words that can't stand beside straight steps");
    const Facts before = now;
    apply(*s, now);
    if (setting<Units>(now, Setting::units) != units || setting<FeedMode>(now, Setting::feed_mode) != feed_mode)
      return no("the units or the kind of the feed change in it");
    if (!b->has_motion || !b->motion.moves()) continue;
    double weight = 1, interval = -1;
    if (b->motion.extra) {
      const auto& x = *b->motion.extra;
      const auto w = x.has_weight ? number_of(x.weight) : std::optional(1.0);
      const auto l = x.has_interval ? number_of(x.interval) : std::optional(-1.0);
      const auto d = x.has_degree ? number_of(x.degree) : std::optional(static_cast<double>(in.degree));
      if (!w || !l || !d) return no("a weight, an interval or a degree is not a number here");
      weight = *w;
      interval = *l;
      in.degree = static_cast<int>(*d);
    }
    if (in.degree < 1 || in.degree > 3) return no("its degree is not 1 to 3");
    last_end_ = setting<SplineEnd>(now, Setting::spline_end);
    if (b->motion.coords.empty()) continue;
    Taken t{s, before, {}};
    Point beside;
    if (!point(now, t.at, beside)) return no("a point of it is not a number here");
    const bool stays = taken_.empty() && !first_said && t.at == in.points[0] && beside == in.beside[0];
    if (stays) {
      first_said = true;
      in.weights[0] = weight;
      continue;
    }
    if (taken_.empty() && at_first_point_ && !first_said) return no("the tool does not stand at its first point");
    in.points.push_back(t.at);
    in.beside.push_back(beside);
    in.weights.push_back(weight);
    in.intervals.push_back(interval);
    taken_.push_back(std::move(t));
  }
  return true;
}

/// Replaces the blocks by their steps; false with a sentence, and nothing is touched.
bool CurveSteps::spline(const std::vector<Statement*>& list, MotionKind kind, Facts now, const Point& following,
                        const std::optional<Value>& degree, Body& out, std::string& why) {
  const auto no = [&why](const char* text) {
    why = text;
    return false;
  };
  if (several_groups_) return no("the axes of splines change in the program");
  if (unequal_ && kind != MotionKind::spline_b) return no("the program has scales of single axes");
  const auto units = setting<Units>(now, Setting::units);
  const auto feed_mode = setting<FeedMode>(now, Setting::feed_mode);
  const auto start = setting<SplineEnd>(now, Setting::spline_start);
  if (!units || !feed_mode) return no("the units or the kind of the feed are not known here");
  if (*feed_mode == FeedMode::inverse_time) return no("the feed is an inverse time");
  const double unit = *units == Units::inch ? 25.4 : 1;
  std::vector<AxisId> moved;
  for (const auto* s : list) {
    const auto* b = std::get_if<Block>(&s->node);
    if (b == nullptr) continue;
    for (const auto& w : b->motion.coords) {
      if (std::find(moved.begin(), moved.end(), w.axis) == moved.end()) moved.push_back(w.axis);
    }
  }
  std::vector<AxisId> order = group_;
  for (const auto a : moved) {
    if (std::find(order.begin(), order.end(), a) == order.end()) order.push_back(a);
  }
  curves::SplinePoints in;
  in.kind = kind;
  if (degree) in.degree = static_cast<int>(number_of(*degree).value_or(0));
  if (!collect(list, now, order, moved, unit, in, why)) return false;
  const auto reference = setting<PathReference>(now, Setting::path_reference);
  if (!start || !last_end_ || !reference) return no("how it begins and ends is not known here");
  if (in.points.size() < 2) return no("it has no point");
  in.start = *start;
  in.end = *last_end_;
  in.beside_by = *reference;
  const bool ends_count = kind != MotionKind::spline_b;
  if (ends_count && in.start == SplineEnd::tangent) return no("it begins along the block before it");
  if (ends_count && in.end == SplineEnd::tangent) {
    if (following.empty()) return no("it ends along a block whose direction is not known here");
    in.end_direction = following;
  }
  const bool far = *reference == PathReference::arc_length &&
                   std::any_of(group_.begin(), group_.end(), [](AxisId a) { return a > axis::z; });
  if (far) return no("its axes beside X, Y and Z follow the length of the path");
  curves::SplineCurve curve;
  if (!curves::make_spline(in, curve, why)) return false;
  std::size_t count = 0, k = 0;
  const Span first_span = list.front()->line.span;
  for (auto* s : list) {
    auto* b = std::get_if<Block>(&s->node);
    if (k >= taken_.size() || taken_[k].s != s) {
      const bool empties = b != nullptr && std::erase_if(b->actions, curve_setting) != 0;
      if (b != nullptr && b->has_motion) {
        b->motion.kind = MotionKind::linear;
        b->motion.explicit_code = true;
        b->motion.code_text = {};
        b->motion.extra.reset();
        if (b->motion.coords.empty()) b->has_motion = false;
      }
      if (empties) settle(*s);
      out.push_back(std::move(*s));
      continue;
    }
    std::vector<Point> steps;
    curves::spline_steps(in, curve, k, tolerance_, steps);
    Point from = in.points[k];
    from.insert(from.end(), in.beside[k].begin(), in.beside[k].end());
    if (k > 0) from = last_;
    count += steps.size();
    if (!put_steps(std::move(*s), taken_[k].before, order, from, steps, unit, out)) {
      why = "the diameter mode is not known here";
      return false;
    }
    ++k;
  }
  told(first_span, count);
  return true;
}

void CurveSteps::told(const Span& where, std::size_t count) const {
  context_.diagnostics.warning("TRN-360", where,
                               "the curve is written as " + std::to_string(count) +
                                   " straight steps that leave it by at most " + shortest(tolerance_) + " mm",
                               "path.curve_tolerance in the machine profile of the source says how much; compare the "
                               "way of a spline between its points with the control");
}

/// The block as its first step, the others behind it.
bool CurveSteps::put_steps(Statement&& s, const Facts& before, const std::vector<AxisId>& axes, Point from,
                           const std::vector<Point>& steps, double unit, Body& out) {
  span_ = s.line.span;
  auto& b = std::get<Block>(s.node);
  std::vector<std::vector<CoordWord>> words;
  for (const auto& p : steps) {
    std::vector<CoordWord> list;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (std::abs(p[i] - from[i]) <= tiny) continue;
      const auto* spec = context_.source_machine.axis(axes[i]);
      const double scale = spec != nullptr && spec->rotary ? 1 : unit;
      const auto radius = to_radius(axes[i], WordScale::modal, Distance::absolute, b, before, context_.source_machine);
      if (!radius) return false;
      CoordWord w;
      w.axis = axes[i];
      w.mode = WordMode::absolute;
      w.value = Value(p[i] / scale / *radius);
      list.push_back(std::move(w));
    }
    if (list.empty()) continue;
    from = p;
    words.push_back(std::move(list));
  }
  last_ = from;
  std::vector<Action> later = take_after(b);
  for (auto it = b.actions.begin(); it != b.actions.end() && words.size() > 1;) {
    if (std::holds_alternative<ExactStopBlock>(it->data)) {
      later.push_back(std::move(*it));
      it = b.actions.erase(it);
    } else {
      ++it;
    }
  }
  std::erase_if(b.actions, curve_setting);
  // Many increments would add up what each is rounded by.
  const bool increments = setting_in<Distance>(b, before, Setting::distance) == Distance::incremental;
  const auto distance = [](Distance d) {
    return action(ModalSet{Setting::distance, static_cast<std::uint8_t>(d), true, FeedMemory::shared});
  };
  if (increments && words.size() > 1 && !context_.target.distance_per_word) {
    std::erase_if(b.actions, [](const Action& a) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      return m != nullptr && m->setting == Setting::distance;
    });
    b.actions.insert(b.actions.begin(), distance(Distance::absolute));
  }
  Motion line;
  line.kind = MotionKind::linear;
  line.explicit_code = true;
  b.motion = line;
  b.has_motion = !words.empty();
  if (!words.empty()) b.motion.coords = std::move(words.front());
  const LineInfo like = s.line;
  out.push_back(std::move(s));
  for (std::size_t i = 1; i < words.size(); ++i) {
    Block next;
    next.motion = line;
    next.motion.explicit_code = false;  // the code stands in the first step
    next.motion.coords = std::move(words[i]);
    next.has_motion = true;
    out.push_back(made(like, std::move(next)));
  }
  auto& end = std::get<Block>(out.back().node);
  for (auto& a : later) end.actions.push_back(std::move(a));
  if (increments && words.size() > 1 && !context_.target.distance_per_word)
    out.push_back(make_block(like, distance(Distance::incremental)));
  return true;
}

bool CurveSteps::polynomial(Statement& s, const Block& b, const Facts& before, std::optional<OnOff> on, Body& out,
                            std::string& why) {
  const auto no = [&why](const char* text) {
    why = text;
    return false;
  };
  const auto units = setting_in<Units>(b, before, Setting::units);
  const auto mode = setting_in<FeedMode>(b, before, Setting::feed_mode);
  const auto reference = setting_in<PathReference>(b, before, Setting::path_reference);
  if (!units || !mode || !reference || !on) return no("the modes in force are not known here");
  if (*mode == FeedMode::inverse_time) return no("the feed is an inverse time");
  if (disturbs(b)) return no("the block holds words that can't stand beside straight steps");
  const double unit = *units == Units::inch ? 25.4 : 1;
  Facts after = before;
  apply(s, after);
  const auto& x = *b.motion.extra;
  curves::PolynomialBlock block;
  block.beside_by = *reference;
  const auto interval = x.has_interval ? number_of(x.interval) : std::optional(1.0);
  if (!interval || *interval < 0.0001 || *interval > 99999.9999)
    return no("its interval is no number here, or none it may have");
  block.interval = *interval;
  std::vector<AxisId> order;
  Point from;
  for (const auto& w : b.motion.coords) {
    const auto* spec = context_.source_machine.axis(w.axis);
    const double scale = spec != nullptr && spec->rotary ? 1 : unit;
    const auto at = before.position[w.axis], to = after.position[w.axis];
    if (spec == nullptr || !at || !to) return no("its beginning or its end is not a number here");
    order.push_back(w.axis);
    from.push_back(*at * scale);
    block.axes.push_back({*at * scale, *to * scale, {}, w.axis <= axis::z, w.axis > axis::z});
  }
  for (const auto& p : x.polynomials) {
    std::vector<double> higher;
    const auto at = std::find(order.begin(), order.end(), p.axis);
    double scale = 1;
    if (p.axis != axis::none) {
      if (at == order.end()) return no("an axis of it has no end");
      const auto& w = b.motion.coords[static_cast<std::size_t>(at - order.begin())];
      const auto radius = to_radius(p.axis, w.scale, distance_of(w, b, before), b, before, context_.source_machine);
      if (!radius) return no("the diameter mode is not known here");
      const auto* spec = context_.source_machine.axis(p.axis);
      scale = *radius * (spec->rotary ? 1 : unit);
    }
    for (const auto* k : {&p.a2, &p.a3, &p.a4, &p.a5}) {
      if (higher.size() + 1 >= p.degree) break;
      const auto n = number_of(*k);
      if (!n) return no("a coefficient is not a number here");
      higher.push_back(*n * scale);
    }
    if (p.axis == axis::none) {
      const auto end = number_of(p.end);
      if (!end) return no("a coefficient is not a number here");
      block.has_denominator = true;
      block.denominator_end = *end;
      block.denominator = std::move(higher);
    } else {
      block.axes[static_cast<std::size_t>(at - order.begin())].higher = std::move(higher);
    }
  }
  std::vector<Point> steps;
  Point direction;
  if (!curves::polynomial_steps(block, tolerance_, steps, direction, why)) return false;
  const std::size_t count = steps.size();
  const Facts then = before;
  if (!put_steps(std::move(s), then, order, from, steps, unit, out)) return no("the diameter mode is not known here");
  told(span_, count);
  return true;
}

}  // namespace cnctrans::ir::passes
