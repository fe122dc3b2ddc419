// Splines and polynomials as plain geometry: curves through points in any number of coordinates, cut into straight
// steps within a tolerance. What runs programs and what writes them out share it. It knows no units: lengths in the
// unit of the points.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ir/modal.h"

namespace cnctrans::ir::curves {

using Point = std::vector<double>;
/// Point of a curve at a parameter.
using Curve = std::function<Point(double)>;

/// The points of a run of spline blocks. Every point has the same number of coordinates.
struct SplinePoints {
  MotionKind kind = MotionKind::spline_cubic;
  std::vector<Point> points;  ///< where the run begins, then the end of each block (B-spline: control points)
  std::vector<Point> beside;  ///< coordinates that go along straight, one entry for each point; or empty
  SplineEnd start = SplineEnd::natural;  ///< Akima and cubic splines only
  SplineEnd end = SplineEnd::natural;
  Point start_direction, end_direction;  ///< of the neighbouring blocks, any length; empty or zero: the end is natural
  std::vector<double> weights;           ///< B-spline: of each point, above 0; empty: all 1
  std::vector<double> intervals;         ///< B-spline: knot span of each block; below 0: not given; empty: none given
  int degree = 3;                        ///< B-spline: 1..3; lower with fewer points
  PathReference beside_by = PathReference::arc_length;
};

/// One block of a curve: where its parameter begins and ends, and where pieces meet in between.
struct BlockSpan {
  std::vector<double> breaks;  ///< rising, two at least
};

/// A curve with its blocks.
struct SplineCurve {
  Curve at;
  std::vector<BlockSpan> blocks;  ///< one for each point behind the first
};

/// The curve. Akima and cubic splines run by the length of the chords; blocks of no length stay where they are. A
/// B-spline begins and ends in its outermost points with knots of full multiplicity; the spans between are equal, or
/// the intervals of the blocks from the first on; the part of a block ends where its control point pulls most (the mean
/// of the knots of the point). Answers false with `error` when points, weights or intervals give no curve.
bool make_spline(const SplinePoints& in, SplineCurve& out, std::string& error);

/// Knots and value of a B-spline of degree `k` with `weights` (empty: all 1) at `u`.
Point b_spline_point(const std::vector<Point>& control, const std::vector<double>& weights,
                     const std::vector<double>& knots, int k, double u);

/// A block that runs by polynomials in p from 0 to `interval`.
struct PolynomialBlock {
  struct Axis {
    double from = 0, to = 0;
    std::vector<double> higher;  ///< a2, a3..; may be empty
    bool divided = false;        ///< by the denominator
    bool beside = false;         ///< follows the path of the others when that is asked for
  };
  std::vector<Axis> axes;
  double interval = 1;  ///< above 0
  bool has_denominator = false;
  double denominator_end = 1;
  std::vector<double> denominator;  ///< its coefficients of p^2, p^3..
  PathReference beside_by = PathReference::arc_length;
};
/// The end of every straight step, in the order of the axes; the last one is the end of the block exactly. The
/// direction in which the block ends, of any length. False when the denominator has a zero in the interval.
bool polynomial_steps(const PolynomialBlock& block, double tolerance, std::vector<Point>& out, Point& end_direction,
                      std::string& error);

/// The ends of the straight steps of one block of a spline: its coordinates, then those beside. The last one is the end
/// of the block exactly.
void spline_steps(const SplinePoints& in, const SplineCurve& curve, std::size_t block, double tolerance,
                  std::vector<Point>& out);

/// Direction in which `at` ends (its slope there, from three points before the end); zero when it has no length.
Point end_slope(const Curve& at, double from, double to);

/// Appends the ends of steps along `at` from `from` to `to` that leave it by `tolerance` at most; the start is no step.
void flatten(const Curve& at, double from, double to, double tolerance, std::vector<Point>& out);

}  // namespace cnctrans::ir::curves
