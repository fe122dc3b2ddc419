#include "ir/geometry/curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>

namespace cnctrans::ir::curves {

namespace {

constexpr double same = 1e-9;  ///< points closer than this are one
constexpr int deepest = 24;    ///< halvings of one piece

Point minus(const Point& a, const Point& b) {
  Point c(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) c[i] = a[i] - b[i];
  return c;
}
double dot(const Point& a, const Point& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}
double length(const Point& a) {
  return std::sqrt(dot(a, a));
}
/// k1 a + k2 b
Point mix(double k1, const Point& a, double k2, const Point& b) {
  Point c(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) c[i] = k1 * a[i] + k2 * b[i];
  return c;
}
Point along(const Point& a, const Point& b, double f) {
  return mix(1 - f, a, f, b);
}

/// Distance of `p` from the line between `a` and `b`, ends included.
double away(const Point& p, const Point& a, const Point& b) {
  const Point chord = minus(b, a), to = minus(p, a);
  const double square = dot(chord, chord);
  if (square <= 0) return length(to);
  const double f = std::clamp(dot(to, chord) / square, 0.0, 1.0);
  return length(mix(1, to, -f, chord));
}

void halve(const Curve& at, double u0, const Point& p0, double u1, const Point& p1, double tolerance, int depth,
           std::vector<Point>& out) {
  bool fits = true;
  for (int i = 1; i < 8 && fits; ++i) fits = away(at(u0 + (u1 - u0) * i / 8), p0, p1) <= tolerance;
  if (fits || depth == 0) {
    out.push_back(p1);
    return;
  }
  const double middle = (u0 + u1) / 2;
  const Point p = at(middle);
  halve(at, u0, p0, middle, p, tolerance, depth - 1, out);
  halve(at, middle, p, u1, p1, tolerance, depth - 1, out);
}

/// Which part of its length a curve has run at a parameter.
class LengthRun {
 public:
  LengthRun(Curve at, const std::vector<double>& breaks) : at_(std::move(at)) {
    constexpr int parts = 512;
    Point last = at_(breaks.front());
    double sum = 0;
    add(breaks.front(), last, 0);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      for (int k = 1; k <= parts; ++k) {
        const double u = breaks[i] + (breaks[i + 1] - breaks[i]) * k / parts;
        Point p = at_(u);
        sum += length(minus(p, last));
        last = p;
        add(u, std::move(p), sum);
      }
    }
  }
  [[nodiscard]] double whole() const { return lengths_.back(); }
  [[nodiscard]] double at(double u) const {
    if (u <= parameters_.front()) return 0;
    if (u >= parameters_.back()) return 1;
    const auto i =
        static_cast<std::size_t>(std::upper_bound(parameters_.begin(), parameters_.end(), u) - parameters_.begin()) - 1;
    return (lengths_[i] + length(minus(at_(u), points_[i]))) / whole();
  }

 private:
  void add(double u, Point p, double s) {
    parameters_.push_back(u);
    points_.push_back(std::move(p));
    lengths_.push_back(s);
  }
  Curve at_;
  std::vector<double> parameters_, lengths_;
  std::vector<Point> points_;
};

// --- splines through their points ---------------------------------------------------------------------------------

/// Points with the slopes there, by parameter.
struct Hermite {
  std::vector<double> u;
  std::vector<Point> p, slope;

  [[nodiscard]] Point at(double x) const {
    const std::size_t last = u.size() - 1;
    auto i = static_cast<std::size_t>(std::upper_bound(u.begin(), u.end(), x) - u.begin());
    i = std::clamp<std::size_t>(i, 1, last) - 1;
    const double h = u[i + 1] - u[i], t = (x - u[i]) / h;
    const double t2 = t * t, t3 = t2 * t;
    const Point ends = mix(2 * t3 - 3 * t2 + 1, p[i], -2 * t3 + 3 * t2, p[i + 1]);
    const Point bend = mix((t3 - 2 * t2 + t) * h, slope[i], (t3 - t2) * h, slope[i + 1]);
    return mix(1, ends, 1, bend);
  }
};

/// A condition of an end once it is known whether the direction is: along `direction`, else by `kind`.
struct EndRule {
  SplineEnd kind = SplineEnd::natural;
  Point direction;
};
EndRule end_rule(SplineEnd kind, const Point& direction) {
  EndRule rule{kind, {}};
  if (kind != SplineEnd::tangent) return rule;
  const double l = direction.empty() ? 0 : length(direction);
  if (l <= same) return EndRule{SplineEnd::natural, {}};
  rule.direction = mix(1 / l, direction, 0, direction);
  return rule;
}

/// Slopes between the points, and what a spline of one or two of them is in closed form.
struct Chords {
  std::vector<double> h;
  std::vector<Point> d;
};
Chords chords(const Hermite& c) {
  Chords out;
  for (std::size_t i = 0; i + 1 < c.p.size(); ++i) {
    out.h.push_back(c.u[i + 1] - c.u[i]);
    out.d.push_back(mix(1 / out.h.back(), c.p[i + 1], -1 / out.h.back(), c.p[i]));
  }
  return out;
}

void akima_slopes(Hermite& c, const EndRule& start, const EndRule& end) {
  const auto [h, d] = chords(c);
  const auto n = static_cast<std::ptrdiff_t>(d.size());
  const auto chord = [&, &list = d](std::ptrdiff_t i) -> Point {
    if (n == 1) return list[0];
    const auto at = [&](std::ptrdiff_t k) -> const Point& { return list[static_cast<std::size_t>(k)]; };
    if (i < 0) return mix(1 - static_cast<double>(i), at(0), static_cast<double>(i), at(1));
    const auto past = static_cast<double>(i - (n - 1));
    if (i >= n) return mix(1 + past, at(n - 1), -past, at(n - 2));
    return at(i);
  };
  c.slope.clear();
  for (std::ptrdiff_t i = 0; i <= n; ++i) {
    const Point before = chord(i - 1), after = chord(i);
    const double w1 = length(minus(chord(i + 1), after)), w2 = length(minus(before, chord(i - 2)));
    const double sum = w1 + w2;
    c.slope.push_back(sum <= same ? mix(0.5, before, 0.5, after) : mix(w1 / sum, before, w2 / sum, after));
  }
  auto& first = c.slope.front();
  auto& last = c.slope.back();
  if (start.kind == SplineEnd::tangent) first = start.direction;
  if (end.kind == SplineEnd::tangent) last = end.direction;
  if (start.kind == SplineEnd::natural) first = mix(1.5, d.front(), -0.5, c.slope[1]);
  if (end.kind == SplineEnd::natural) last = mix(1.5, d.back(), -0.5, c.slope[c.slope.size() - 2]);
}

/// The slopes of the cubic spline with continuous curvature: a tridiagonal system, solved for all coordinates at once.
void cubic_slopes(Hermite& c, EndRule start, EndRule end) {
  const auto [h, d] = chords(c);
  const std::size_t n = d.size();
  if (n == 1 && start.kind == SplineEnd::free && end.kind == SplineEnd::free) {
    c.slope = {d[0], d[0]};
    return;
  }
  if (n == 1 && (start.kind == SplineEnd::free || end.kind == SplineEnd::free)) {
    // One piece and one condition: the parabola, which has the other slope opposite to the first about the chord.
    if (start.kind == SplineEnd::natural || end.kind == SplineEnd::natural) {
      c.slope = {d[0], d[0]};
    } else if (start.kind == SplineEnd::tangent) {
      c.slope = {start.direction, mix(2, d[0], -1, start.direction)};
    } else {
      c.slope = {mix(2, d[0], -1, end.direction), end.direction};
    }
    return;
  }
  if (n == 2 && start.kind == SplineEnd::free && end.kind == SplineEnd::free) {
    const Point bend = mix(1 / (h[0] + h[1]), d[1], -1 / (h[0] + h[1]), d[0]);
    c.slope = {mix(1, d[0], -h[0], bend), mix(1, d[0], h[0], bend), mix(1, d[1], h[1], bend)};
    return;
  }
  std::vector<double> low(n + 1), mid(n + 1), high(n + 1);
  std::vector<Point> right(n + 1);
  const auto outer = [&](std::size_t row, const EndRule& rule, double h0, double h1, const Point& d0, const Point& d1,
                         double& beside) {
    switch (rule.kind) {
      case SplineEnd::tangent:
        mid[row] = 1;
        right[row] = rule.direction;
        return;
      case SplineEnd::natural:
        mid[row] = 2;
        beside = 1;
        right[row] = mix(3, d0, 0, d0);
        return;
      case SplineEnd::free: {
        const double both = h0 + h1;
        mid[row] = h1;
        beside = both;
        right[row] = mix((h0 + 2 * both) * h1 / both, d0, h0 * h0 / both, d1);
        return;
      }
    }
  };
  outer(0, start, h[0], n > 1 ? h[1] : h[0], d[0], n > 1 ? d[1] : d[0], high[0]);
  outer(n, end, h[n - 1], n > 1 ? h[n - 2] : h[0], d[n - 1], n > 1 ? d[n - 2] : d[0], low[n]);
  for (std::size_t i = 1; i < n; ++i) {
    low[i] = h[i];
    mid[i] = 2 * (h[i - 1] + h[i]);
    high[i] = h[i - 1];
    right[i] = mix(3 * h[i], d[i - 1], 3 * h[i - 1], d[i]);
  }
  for (std::size_t i = 1; i <= n; ++i) {
    const double k = low[i] / mid[i - 1];
    mid[i] -= k * high[i - 1];
    right[i] = mix(1, right[i], -k, right[i - 1]);
  }
  c.slope.assign(n + 1, {});
  c.slope[n] = mix(1 / mid[n], right[n], 0, right[n]);
  for (std::size_t i = n; i-- > 0;) c.slope[i] = mix(1 / mid[i], right[i], -high[i] / mid[i], c.slope[i + 1]);
}

bool through_points(const SplinePoints& in, SplineCurve& out) {
  const auto c = std::make_shared<Hermite>();
  double u = 0;
  c->u.push_back(0);
  c->p.push_back(in.points.front());
  for (std::size_t i = 1; i < in.points.size(); ++i) {
    const double step = length(minus(in.points[i], c->p.back()));
    const double from = u;
    if (step > same) {
      u += step;
      c->u.push_back(u);
      c->p.push_back(in.points[i]);
    }
    out.blocks.push_back(BlockSpan{{from, u}});
  }
  if (c->p.size() == 1) {
    out.at = [p = c->p.front()](double) { return p; };
    return true;
  }
  const EndRule start = end_rule(in.start, in.start_direction), end = end_rule(in.end, in.end_direction);
  if (in.kind == MotionKind::spline_akima) {
    akima_slopes(*c, start, end);
  } else {
    cubic_slopes(*c, start, end);
  }
  out.at = [c](double x) { return c->at(x); };
  return true;
}

// --- B-splines ----------------------------------------------------------------------------------------------------

bool b_spline(const SplinePoints& in, SplineCurve& out, std::string& error) {
  const std::size_t n = in.points.size() - 1;
  const auto k = static_cast<std::size_t>(std::clamp(in.degree, 1, std::max(1, static_cast<int>(n))));
  std::vector<double> knots(k + 1, 0.0);
  double u = 0;
  std::size_t times = k + 1;
  for (std::size_t j = 1; j <= n - k + 1; ++j) {
    const bool given = j <= in.intervals.size() && in.intervals[j - 1] >= 0;
    const double step = given ? in.intervals[j - 1] : 1;
    times = step > 0 ? 1 : times + 1;
    const bool outermost = j == 1 || j == n - k + 1;
    if ((outermost && step <= 0) || times > k) {
      if (k > 1 || step <= 0) {
        error = "the knot intervals leave the spline without a beginning, an end or a connection";
        return false;
      }
    }
    u += step;
    knots.push_back(u);
  }
  knots.insert(knots.end(), k, u);
  out.at = [control = in.points, weights = in.weights, knots, k](double x) {
    return b_spline_point(control, weights, knots, static_cast<int>(k), x);
  };
  double from = 0;
  for (std::size_t i = 1; i <= n; ++i) {
    double to = std::accumulate(knots.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                knots.begin() + static_cast<std::ptrdiff_t>(i + k) + 1, 0.0) /
                static_cast<double>(k);
    if (i == n) to = u;
    BlockSpan span{{from}};
    for (auto x = std::upper_bound(knots.begin(), knots.end(), from); x != knots.end() && *x < to; ++x) {
      if (*x > span.breaks.back()) span.breaks.push_back(*x);
    }
    span.breaks.push_back(to);
    out.blocks.push_back(std::move(span));
    from = to;
  }
  return true;
}

}  // namespace

Point b_spline_point(const std::vector<Point>& control, const std::vector<double>& weights,
                     const std::vector<double>& knots, int degree, double u) {
  const auto k = static_cast<std::size_t>(degree);
  const auto last = knots.begin() + static_cast<std::ptrdiff_t>(control.size());
  const auto above = std::upper_bound(knots.begin() + static_cast<std::ptrdiff_t>(k) + 1, last, u);
  const auto span = static_cast<std::size_t>(above - knots.begin()) - 1;
  // De Boor's scheme with the weight as one more coordinate.
  std::vector<Point> d;
  for (std::size_t i = span - k; i <= span; ++i) {
    const double w = weights.empty() ? 1 : weights[i];
    Point p = mix(w, control[i], 0, control[i]);
    p.push_back(w);
    d.push_back(std::move(p));
  }
  for (std::size_t r = 1; r <= k; ++r) {
    for (std::size_t j = k; j >= r; --j) {
      const std::size_t i = span - k + j;
      const double low = knots[i], high = knots[i + k - r + 1];
      const double f = high > low ? (u - low) / (high - low) : 0;
      d[j] = along(d[j - 1], d[j], f);
    }
  }
  Point p = d[k];
  const double w = p.back();
  p.pop_back();
  for (double& x : p) x /= w;
  return p;
}

bool make_spline(const SplinePoints& in, SplineCurve& out, std::string& error) {
  out = {};
  if (in.points.size() < 2) {
    error = "a spline needs a point";
    return false;
  }
  if (in.kind != MotionKind::spline_b) return through_points(in, out);
  if (std::any_of(in.weights.begin(), in.weights.end(), [](double w) { return !(w > 0); })) {
    error = "a control point of weight zero does not count";
    return false;
  }
  return b_spline(in, out, error);
}

Point end_slope(const Curve& at, double from, double to) {
  const double h = (to - from) * 1e-4;
  if (h <= 0) return Point(at(to).size(), 0.0);
  const Point near = mix(3, at(to), -4, at(to - h));
  return mix(1 / (2 * h), near, 1 / (2 * h), at(to - 2 * h));
}

void flatten(const Curve& at, double from, double to, double tolerance, std::vector<Point>& out) {
  halve(at, from, at(from), to, at(to), tolerance, deepest, out);
}

void spline_steps(const SplinePoints& in, const SplineCurve& curve, std::size_t block, double tolerance,
                  std::vector<Point>& out) {
  const auto& breaks = curve.blocks[block].breaks;
  const double from = breaks.front(), to = breaks.back();
  const bool has_beside = !in.beside.empty() && !in.beside.front().empty();
  Curve at = [&curve](double u) { return curve.at(u); };
  std::shared_ptr<LengthRun> run;
  if (has_beside) {
    const Point& b0 = in.beside[block];
    const Point& b1 = in.beside[block + 1];
    const bool moves = length(minus(b1, b0)) > same;
    if (moves && in.beside_by == PathReference::arc_length) run = std::make_shared<LengthRun>(at, breaks);
    if (run && run->whole() <= same) run.reset();
    at = [&curve, b0, b1, from, to, run](double u) {
      Point p = curve.at(u);
      const double f = run ? run->at(u) : to > from ? (u - from) / (to - from) : 1;
      const Point b = along(b0, b1, f);
      p.insert(p.end(), b.begin(), b.end());
      return p;
    };
  }
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) flatten(at, breaks[i], breaks[i + 1], tolerance, out);
  // The ends of the blocks exactly: a B-spline has them at its own end only.
  Point& last = out.back();
  if (in.kind != MotionKind::spline_b || block + 1 == curve.blocks.size())
    std::copy(in.points[block + 1].begin(), in.points[block + 1].end(), last.begin());
  if (has_beside) {
    std::copy(in.beside[block + 1].begin(), in.beside[block + 1].end(),
              last.begin() + static_cast<std::ptrdiff_t>(in.points.front().size()));
  }
}

namespace {

/// a0 + a1 p + a2 p^2 ..; a1 such that the value at `interval` is `to`.
struct Polynomial {
  std::vector<double> a;

  Polynomial(double from, double to, const std::vector<double>& higher, double interval) : a{from, 0} {
    a.insert(a.end(), higher.begin(), higher.end());
    double rest = 0, power = interval;
    for (std::size_t i = 2; i < a.size(); ++i) {
      power *= interval;
      rest += a[i] * power;
    }
    a[1] = (to - from - rest) / interval;
  }
  [[nodiscard]] double at(double p) const {
    double y = 0;
    for (std::size_t i = a.size(); i-- > 0;) y = y * p + a[i];
    return y;
  }
};

/// Falls to zero somewhere from 0 to `interval`. It begins with 1.
bool has_zero(const Polynomial& d, double interval) {
  constexpr int parts = 1000;
  const double step = interval / parts;
  for (int i = 0; i <= parts; ++i) {
    const double p = step * i;
    if (d.at(p) <= 0) return true;
    if (i == 0 || i == parts || d.at(p) > d.at(p - step) || d.at(p) > d.at(p + step)) continue;
    double low = p - step, high = p + step;  // a valley: look at its bottom
    for (int k = 0; k < 60; ++k) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (d.at(a) < d.at(b) ? high : low) = d.at(a) < d.at(b) ? b : a;
    }
    if (d.at((low + high) / 2) <= 1e-9) return true;
  }
  return false;
}

}  // namespace

bool polynomial_steps(const PolynomialBlock& block, double tolerance, std::vector<Point>& out, Point& end_direction,
                      std::string& error) {
  const double interval = block.interval;
  const Polynomial denominator(1, block.has_denominator ? block.denominator_end : 1, block.denominator, interval);
  if (block.has_denominator && has_zero(denominator, interval)) {
    error = "the denominator of the polynomials becomes zero inside of the interval";
    return false;
  }
  struct Axis {
    Polynomial numerator;
    bool divided, beside;
  };
  std::vector<Axis> axes;
  bool follows = false;
  for (const auto& a : block.axes) {
    const bool divided = a.divided && block.has_denominator;
    const double to = divided ? a.to * block.denominator_end : a.to;
    axes.push_back(Axis{Polynomial(a.from, to, a.higher, interval), divided, a.beside});
    follows = follows || (a.beside && (a.to != a.from || !a.higher.empty()));
  }
  const auto value = [&](const Axis& a, double p) {
    return a.divided ? a.numerator.at(p) / denominator.at(p) : a.numerator.at(p);
  };
  std::shared_ptr<LengthRun> run;
  if (follows && block.beside_by == PathReference::arc_length) {
    const Curve path = [&](double p) {
      Point q;
      for (const auto& a : axes) {
        if (!a.beside) q.push_back(value(a, p));
      }
      return q;
    };
    run = std::make_shared<LengthRun>(path, std::vector<double>{0, interval});
    if (run->whole() <= same) run.reset();
  }
  const Curve at = [&](double p) {
    Point q;
    for (const auto& a : axes) q.push_back(value(a, a.beside && run ? run->at(p) * interval : p));
    return q;
  };
  flatten(at, 0, interval, tolerance, out);
  end_direction = end_slope(at, 0, interval);
  for (std::size_t i = 0; i < block.axes.size(); ++i) out.back()[i] = block.axes[i].to;
  return true;
}

}  // namespace cnctrans::ir::curves
