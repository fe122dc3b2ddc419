// Splines and polynomials: points are collected, or a block's polynomials computed, and go out as straight steps.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/diagnostics.h"
#include "base/text.h"
#include "interpreter/machine/block_machine.h"
#include "interpreter/machine/plane_points.h"
#include "interpreter/trace/run_codes.h"

namespace cnctrans::interpreter {

namespace {

constexpr std::size_t most_points = 2'000'000;

ir::curves::Point chosen(const Axes& p, const std::vector<ir::AxisId>& axes) {
  ir::curves::Point out;
  for (const auto a : axes) out.push_back(p[a]);
  return out;
}

bool apart(const ir::curves::Point& a, const ir::curves::Point& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i] - b[i]) > no_move) return true;
  }
  return false;
}

}  // namespace

void BlockMachine::tell_path(Diagnostics& diagnostics) const {
  for (const Span& s : chosen_contours()) {
    diagnostics.warning(code::contour_chosen, s,
                        "several contours fit the data of these elements; the one nearest to its start was run",
                        "say which point is meant (E+ or E-)");
  }
  tell_radii(diagnostics);
  for (const auto& [where, why] : corners_left_out_)
    diagnostics.warning(code::corner_left_out, where, why + ": the corner is left out, as the control does");
  if (!pocket_orders_.empty())
    diagnostics.warning(
        code::pocket_order, pocket_orders_.front(),
        "the maker states what a pocket with islands clears, not the way of the tool in it: the control's own path "
        "inside the pocket may differ; the same volume is cleared (told once)",
        "compare with the control where the way matters");
  if (curve_.assumed.empty()) return;
  diagnostics.warning(
      code::curve_assumed, curve_.assumed.front(),
      "the way of a spline between its points is computed by the usual formulas and run in straight steps within " +
          shortest(curve_.tolerance) +
          " mm; the maker describes only its properties, and the control's own curve may differ between the points "
          "(told once)",
      "compare with the control before a part depends on it");
}

/// What has no meaning beside the points of a curve.
bool BlockMachine::curve_allowed(const ir::Motion& m, bool spline) {
  const auto no = [&](const std::string& what) {
    return failure_.fail(code::curve_place, what + " cannot stand beside a spline or a polynomial");
  };
  if (m.frame != ir::FrameUse::normal) return no("machine coordinates");
  if (pending_ || now_.corner || modal_corner_.size > 0) return no("a corner function");
  if (!contour_.elements.empty() || now_.marks.any()) return no("an open contour");
  if (modal_.feed_mode == ir::FeedMode::inverse_time) return no("a feed by inverse time");
  if (!m.centers.empty() || m.radius_given) return no("the centre or the radius of an arc");
  if (for_contour_) return no("the contour of a cycle");
  const bool alone = std::any_of(m.coords.begin(), m.coords.end(),
                                 [](const auto& w) { return w.positioning != ir::Positioning::with_path; });
  if (alone) return no("a positioning axis");
  if (!spline) return true;
  if (cycle_.hole) return no("an active cycle");
  if (single_points) return no("a modal call of a subprogram");
  return true;
}

/// Spline axes: those the program has chosen, else the first three linear axes of the machine.
void BlockMachine::begin_curve(ir::MotionKind kind) {
  curve_.open = std::make_unique<OpenCurve>();
  auto& c = *curve_.open;
  c.kind = c.points.kind = kind;
  c.axes = curve_.axes;
  for (const auto a : axes_) {
    if (curve_.axes.empty() && !axis_[a].rotary && c.axes.size() < 3) c.axes.push_back(a);
  }
  for (const auto a : axes_) {
    if (std::find(c.axes.begin(), c.axes.end(), a) == c.axes.end()) c.beside.push_back(a);
  }
  const Axes here = frame_.apply(p_);
  c.points.points.push_back(chosen(here, c.axes));
  c.points.beside.push_back(chosen(here, c.beside));
  c.points.weights.push_back(1);
  c.points.start = modal_.spline_start;
  if (last_.known) {
    Axes back = p_;
    if (last_.arc) {
      const auto plane = ir::plane_axes(modal_.plane);
      const Vec d = last_direction(plane);
      back[plane.u] -= d.u;
      back[plane.v] -= d.v;
    } else {
      for (std::size_t i = 0; i < 3; ++i) back[i] = last_.before[i];
    }
    const Axes before = frame_.apply(back);
    Axes way{};
    for (std::size_t i = 0; i < 3; ++i) way[i] = here[i] - before[i];
    c.points.start_direction = chosen(way, c.axes);
  }
  curve_.assumed.push_back(failure_.where);
  emitter_.hold();
}

/// The words of a B-spline point.
bool BlockMachine::spline_words(const ir::Motion& m, double& weight, double& interval) {
  auto& c = *curve_.open;
  weight = 1;
  interval = -1;
  if (!m.extra) return true;
  const auto& x = *m.extra;
  if (!x.polynomials.empty())
    return failure_.fail(code::curve_place, "polynomials cannot stand in a block of a spline");
  if (c.kind != ir::MotionKind::spline_b && (x.has_weight || x.has_degree || x.has_interval))
    return failure_.fail(code::curve_place, "weights, degrees and knot intervals belong to B-splines only");
  if (x.has_weight) weight = value(x.weight);
  if (x.has_interval) interval = value(x.interval);
  const double degree = x.has_degree ? value(x.degree) : c.points.degree;
  if (failure_.set) return false;
  if (!(weight > 0 && weight <= 3))
    return failure_.fail(code::curve_data, "the weight of a control point must be above 0, and 3 at most");
  if (x.has_interval && !(interval >= 0)) return failure_.fail(code::curve_data, "a knot interval cannot be negative");
  if (!(degree == 1 || degree == 2 || degree == 3))
    return failure_.fail(code::curve_data, "the degree of a B-spline must be 1, 2 or 3");
  const bool late = c.blocks.size() > 0 && x.has_degree && degree != c.points.degree;
  if (late) return failure_.fail(code::curve_data, "the degree of a B-spline changes between its points");
  c.points.degree = static_cast<int>(degree);
  return true;
}

/// One more point of a spline.
bool BlockMachine::spline_point(const ir::Motion& m, ir::MotionKind kind) {
  if (curve_.broken) {
    return failure_.fail(code::curve_place,
                         "a move of another kind stands between the points of a spline: where the curve goes on is "
                         "not certain");
  }
  if (!curve_allowed(m, true)) return false;
  if (!curve_.open) begin_curve(kind);
  auto& c = *curve_.open;
  double weight = 1, interval = -1;
  Move move = move_from_here();
  if (!end_point(m, move) || !spline_words(m, weight, interval)) return false;
  if (modal_.path_reference == ir::PathReference::arc_length &&
      std::any_of(c.axes.begin(), c.axes.end(), [](auto a) { return a > ir::axis::z; })) {
    return failure_.fail(code::curve_place,
                         "a spline of axes beside X, Y and Z that follow the length of the path is not carried out");
  }
  const Axes to = frame_.apply(move.to);
  auto point = chosen(to, c.axes);
  auto beside = chosen(to, c.beside);
  bool linear = false;
  for (const auto a : axes_) linear = linear || (!axis_[a].rotary && std::abs(move.to[a] - move.from[a]) > no_move);
  for (const auto a : axes_) increments_.pending &= move.to[a] != move.from[a] ? ~(1U << a) : ~0U;
  p_ = move.to;
  c.points.end = modal_.spline_end;
  c.points.beside_by = modal_.path_reference;
  const bool stays = !apart(point, c.points.points.back()) && !apart(beside, c.points.beside.back());
  if (c.blocks.empty() && stays && !c.first_point_said) {  // the first block says where the curve begins
    c.first_point_said = true;
    c.points.weights.front() = weight;
    return true;
  }
  if (c.blocks.empty() && curve_.from_first_point && !c.first_point_said) {
    return failure_.fail(code::curve_place, "the tool does not stand at the first point of the curve");
  }
  if (c.blocks.size() >= most_points)
    return failure_.fail(code::curve_data, "a spline with more points than can be computed at once");
  c.points.points.push_back(std::move(point));
  c.points.beside.push_back(std::move(beside));
  c.points.weights.push_back(weight);
  c.points.intervals.push_back(interval);
  c.blocks.push_back(
      {move.file, move.line, linear ? feed_now() : feed_degrees(), modal_.feed_mode, modal_.comp, emitter_.held()});
  return true;
}

/// What a motion of another kind, or a code of another spline, means to the curve.
bool BlockMachine::leave_curve(ir::MotionKind kind) {
  if (kind == curve_.open->kind) return true;
  const bool by_next = curve_.open->points.end == ir::SplineEnd::tangent;
  const bool to_machine = kind == ir::MotionKind::reference_point || kind == ir::MotionKind::fixed_point;
  if (!by_next) return close_curve(nullptr);
  if (ir::is_curve(kind) || kind == ir::MotionKind::arc_tangent || to_machine) {
    return failure_.fail(code::curve_place,
                         "the spline ends along the block behind it, whose direction does not stand in its words");
  }
  return true;  // the move itself closes it, with its direction (see send)
}

/// The direction in which a move begins, in the machine.
Axes BlockMachine::start_direction(const Move& move) const {
  Axes ahead = move.to;
  if (move.kind == Move::Kind::arc) {
    const auto plane = ir::plane_axes(move.plane);
    const Vec from{move.from[plane.u], move.from[plane.v]};
    const Vec n = left_of(normalised(from - move.centre));
    ahead = move.from;
    ahead[plane.u] += move.ccw ? n.u : -n.u;
    ahead[plane.v] += move.ccw ? n.v : -n.v;
  }
  const Axes a = frame_.apply(move.from), b = frame_.apply(ahead);
  Axes way{};
  for (std::size_t i = 0; i < 3; ++i) way[i] = b[i] - a[i];
  return way;
}

/// The curve is known now: its steps go out, and the other events between them.
bool BlockMachine::close_curve(const Move* next) {
  const auto open = std::move(curve_.open);
  curve_.open.reset();
  auto& c = *open;
  curve_.broken = ir::is_spline(modal_.motion);
  if (c.blocks.empty()) {
    emitter_.release();
    return true;
  }
  if (next != nullptr) c.points.end_direction = chosen(start_direction(*next), c.axes);
  ir::curves::SplineCurve curve;
  std::string error;
  if (!ir::curves::make_spline(c.points, curve, error)) {
    emitter_.release();
    return failure_.fail(code::curve_data, error);
  }
  auto& e = path_event_;
  std::vector<ir::curves::Point> steps;
  e.kind = EventKind::linear;
  e.in_machine = false;
  e.number = spindles_.master_number();
  e.stop = path_stop();
  for (std::size_t i = 0; i < c.blocks.size(); ++i) {
    const auto& b = c.blocks[i];
    emitter_.pass_held(b.held);
    steps.clear();
    ir::curves::spline_steps(c.points, curve, i, curve_.tolerance, steps);
    e.file = b.file;
    e.line = b.line;
    e.feed = b.feed;
    e.feed_mode = b.feed_mode;
    put_centre_side(e, b.comp, modal_.plane);
    for (const auto& p : steps) {
      const Axes from = e.to.value;
      std::uint32_t moved = 0;
      for (std::size_t k = 0; k < p.size(); ++k) {
        const auto a = k < c.axes.size() ? c.axes[k] : c.beside[k - c.axes.size()];
        if (std::abs(p[k] - e.to.value[a]) <= no_move) continue;
        e.to.value[a] = p[k];
        moved |= 1U << a;
      }
      if (moved == 0) continue;
      tool_.put_offset(e, moved, modal_);
      add_travel(from, e);
      emitter_.pass(e);
    }
  }
  emitter_.release();
  e.file = failure_.where.file;
  e.line = failure_.where.line;
  // The end of the curve as a path element, for tangents.
  const auto& piece = curve.blocks.back().breaks;
  const auto slope = ir::curves::end_slope(curve.at, piece[piece.size() - 2], piece.back());
  const double way = std::sqrt(std::inner_product(slope.begin(), slope.end(), slope.begin(), 0.0));
  if (way > 0) {
    Axes back = e.to.value;
    for (std::size_t k = 0; k < c.axes.size(); ++k) back[c.axes[k]] -= slope[k] / way;
    const Axes work = inverse_.apply(back);
    for (std::size_t i = 0; i < 3; ++i) last_.before[i] = work[i];
    last_.arc = false;
    last_.known = true;
  }
  return true;
}

/// A stop of the preparation ends the curve; the next point begins another.
bool BlockMachine::split_curve() {
  if (!curve_.open) return true;
  if (curve_.open->points.end == ir::SplineEnd::tangent) {
    return failure_.fail(code::curve_place,
                         "a stop of the preparation inside of a spline that ends along the block behind it");
  }
  if (!close_curve(nullptr)) return false;
  curve_.broken = false;
  return true;
}

bool BlockMachine::end_defined_curve() {
  curve_.from_first_point = false;
  if (!curve_.open) {
    curve_.broken = ir::is_spline(modal_.motion);
    return true;
  }
  return close_curve(nullptr);
}

/// A block whose axes run by polynomials.
bool BlockMachine::polynomial(const ir::Motion& m) {
  const bool given = m.extra && !m.extra->polynomials.empty() && modal_.polynomial_axes == ir::OnOff::on;
  if (m.extra && (m.extra->has_weight || m.extra->has_degree))
    return failure_.fail(code::curve_place, "weights and degrees of points belong to B-splines only");
  if (!given) return general_motion(m, ir::MotionKind::linear);
  if (!curve_allowed(m, false)) return false;
  Move move = move_from_here();
  if (!end_point(m, move)) return false;
  ir::curves::PolynomialBlock block;
  block.beside_by = modal_.path_reference;
  if (m.extra->has_interval) block.interval = value(m.extra->interval);
  const auto& named = m.extra->polynomials;
  for (const auto a : axes_) {  // an axis that the block does not name stands, whatever the denominator is
    const bool runs = move.from[a] != move.to[a] ||
                      std::any_of(named.begin(), named.end(), [a](const auto& w) { return w.axis == a; });
    block.axes.push_back({move.from[a], move.to[a], {}, runs && a <= ir::axis::z, a > ir::axis::z});
  }
  for (const auto& w : m.extra->polynomials) {
    std::vector<double> higher;
    const auto word = std::find_if(m.coords.begin(), m.coords.end(), [&](const auto& k) { return k.axis == w.axis; });
    const auto mode = word != m.coords.end() ? word->mode : ir::WordMode::modal;
    const auto scale = word != m.coords.end() ? word->scale : ir::WordScale::modal;
    const bool absolute =
        mode == ir::WordMode::absolute || (mode == ir::WordMode::modal && modal_.distance == ir::Distance::absolute);
    for (const auto* k : {&w.a2, &w.a3, &w.a4, &w.a5}) {
      if (higher.size() + 1 >= w.degree) break;
      higher.push_back(w.axis == ir::axis::none ? value(*k) : coordinate(w.axis, *k, scale, absolute));
    }
    if (w.axis == ir::axis::none) {
      block.has_denominator = true;
      block.denominator_end = value(w.end);
      block.denominator = std::move(higher);
      continue;
    }
    const auto at = std::find(axes_.begin(), axes_.end(), w.axis);
    if (at == axes_.end()) return check_axis(w.axis);
    block.axes[static_cast<std::size_t>(at - axes_.begin())].higher = std::move(higher);
  }
  if (failure_.set) return false;
  if (!(block.interval >= 0.0001 && block.interval <= 99999.9999))
    return failure_.fail(code::curve_data, "the interval of a polynomial must lie between 0.0001 and 99999.9999");
  std::vector<ir::curves::Point> steps;
  ir::curves::Point direction;
  std::string error;
  if (!ir::curves::polynomial_steps(block, curve_.tolerance, steps, direction, error))
    return failure_.fail(code::curve_data, error);
  Move step = move;
  step.kind = Move::Kind::linear;
  for (const auto& p : steps) {
    for (std::size_t i = 0; i < axes_.size(); ++i) step.to[axes_[i]] = p[i];
    if (!emit_move(step, false)) return false;
    step.from = step.to;
  }
  arrived(move);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (axes_[i] <= ir::axis::z) last_.before[axes_[i]] = p_[axes_[i]] - direction[i];
  }
  last_.arc = false;
  last_.known = true;
  return true;
}

}  // namespace cnctrans::interpreter
