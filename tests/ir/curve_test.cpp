// Points of splines and polynomials by own arithmetic: closed forms, blossoms, systems of two equations by hand.
#include "ir/geometry/curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cnctrans::ir::curves {
namespace {

void expect_point(const Point& p, const Point& wanted, double within = 1e-9) {
  ASSERT_EQ(p.size(), wanted.size());
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_NEAR(p[i], wanted[i], within) << "coordinate " << i;
}

SplineCurve curve_of(const SplinePoints& in) {
  SplineCurve c;
  std::string error;
  EXPECT_TRUE(make_spline(in, c, error)) << error;
  return c;
}
Point middle(const SplineCurve& c, std::size_t block) {
  const auto& b = c.blocks.at(block).breaks;
  return c.at((b.front() + b.back()) / 2);
}

SplinePoints points(MotionKind kind, std::vector<Point> p) {
  SplinePoints in;
  in.kind = kind;
  in.points = std::move(p);
  return in;
}

// Chords of the same length h = sqrt 2. y'' of the natural spline: 4 M1 + M2 = -6, M1 + 4 M2 = 6: M1 = -2, M2 = 2. The
// middle of a piece lies h^2/16 (M + M') below the middle of its chord.
TEST(CubicSpline, NaturalThroughFourPoints) {
  const auto c = curve_of(points(MotionKind::spline_cubic, {{0, 0}, {1, 1}, {2, 0}, {3, 1}}));
  expect_point(middle(c, 0), {0.5, 0.75});
  expect_point(middle(c, 1), {1.5, 0.5});
  expect_point(middle(c, 2), {2.5, 0.25});
  expect_point(c.at(c.blocks[1].breaks.back()), {2, 0});
}

// Free ends through four points: one cubic, Lagrange's; at a sixth of the parameter y = 15/16 + 1/16.
TEST(CubicSpline, FreeEndsAreOnePolynomial) {
  auto in = points(MotionKind::spline_cubic, {{0, 0}, {1, 1}, {2, 0}, {3, 1}});
  in.start = in.end = SplineEnd::free;
  expect_point(middle(curve_of(in), 0), {0.5, 1.0});
  in.points = {{0, 0}, {1, 1}, {2, 0}};  // the parabola 1 - (t - 1)^2
  expect_point(middle(curve_of(in), 0), {0.5, 0.75});
  expect_point(middle(curve_of(in), 1), {1.5, 0.75});
}

// One free and one natural end through three points: y = a + b t + c t^2 + d t^3 on both pieces, y''(2) = 0: 2c + 12d =
// 0, b + c + d = 1, 2b + 4c + 8d = 0: d = 1/3, c = -2, b = 8/3; y(1/2) = 4/3 - 1/2 + 1/24.
TEST(CubicSpline, OneFreeEnd) {
  auto in = points(MotionKind::spline_cubic, {{0, 0}, {1, 1}, {2, 0}});
  in.start = SplineEnd::free;
  expect_point(middle(curve_of(in), 0), {0.5, 4.0 / 3 - 0.5 + 1.0 / 24});
}

// m0 = (0, 1); m0 + 2 m1 = 3 (1, 0); the middle is that of the chord + h/8 (m0 - m1).
TEST(CubicSpline, TangentStart) {
  auto in = points(MotionKind::spline_cubic, {{0, 0}, {1, 0}});
  in.start = SplineEnd::tangent;
  in.start_direction = {0, 5};
  expect_point(middle(curve_of(in), 0), {0.3125, 0.1875});
  in.start_direction = {0, 0};  // nothing before it
  expect_point(middle(curve_of(in), 0), {0.5, 0});
  in.start_direction = {};
  in.start = SplineEnd::natural;
  in.end = SplineEnd::tangent;
  in.end_direction = {0, 2};
  expect_point(middle(curve_of(in), 0), {0.6875, -0.1875});
}

// Straight chords stay straight up to the corner; the slope at the end is 1.5 d2 - 0.5 d1.
TEST(AkimaSpline, SlopesLeaveStraightPartsAlone) {
  auto in = points(MotionKind::spline_akima, {{0, 0}, {1, 0}, {2, 0}, {3, 1}});
  in.start = in.end = SplineEnd::free;
  const auto c = curve_of(in);
  expect_point(middle(c, 0), {0.5, 0});
  expect_point(middle(c, 1), {1.5, 0});
  expect_point(middle(c, 2), {2.5 + std::sqrt(2.0) * 1.5 / 8 - 1.5 / 8, 0.5 - 1.5 / 8});
}

// Chords d = (1,1), (1,-1), (1,-1), (1,1), all over sqrt 2. At the second point the chord behind goes on straight
// (weight 0 for the one before), so the slope is that behind... at the third both sides turn alike: their mean.
TEST(AkimaSpline, WeightsByTheTurnOfTheChords) {
  auto in = points(MotionKind::spline_akima, {{0, 0}, {1, 1}, {2, 0}, {3, -1}, {4, 0}});
  in.start = in.end = SplineEnd::free;
  const auto c = curve_of(in);
  // t1: |d2 - d1| = 0, |d0 - d(-1)| = |d1 - d0| > 0: t1 = d1. t2: |d3 - d2| = |d1 - d0|: the mean of d1 and d2 = d1.
  expect_point(middle(c, 1), {1.5, 0.5});
  // Block 1: slopes t0 = (d(-1) + d0) / 2 = 1.5 d0 - 0.5 d1 = (1, 2) / sqrt 2, t1 = d1 = (1, -1) / sqrt 2.
  expect_point(middle(c, 0), {0.5, 0.5 + 3.0 / 8});
}

TEST(AkimaSpline, TurnsWithItsPoints) {
  auto in = points(MotionKind::spline_akima, {{0, 0}, {4, 1}, {5, 6}, {9, 7}, {9, 12}});
  const Point a = middle(curve_of(in), 2);
  const double s = std::sin(0.7), k = std::cos(0.7);
  for (auto& p : in.points) p = {k * p[0] - s * p[1], s * p[0] + k * p[1]};
  expect_point(middle(curve_of(in), 2), {k * a[0] - s * a[1], s * a[0] + k * a[1]});
}

TEST(Spline, PointsThatRepeatDoNotCount) {
  const auto c = curve_of(points(MotionKind::spline_cubic, {{0, 0}, {0, 0}, {1, 1}, {1, 1}, {2, 0}, {3, 1}}));
  ASSERT_EQ(c.blocks.size(), 5U);
  EXPECT_EQ(c.blocks[0].breaks.front(), c.blocks[0].breaks.back());
  expect_point(middle(c, 1), {0.5, 0.75});
}

TEST(BSpline, OfDegreeOneIsThePolygon) {
  auto in = points(MotionKind::spline_b, {{0, 0}, {10, 0}, {10, 20}});
  in.degree = 1;
  const auto c = curve_of(in);
  expect_point(middle(c, 0), {5, 0});
  expect_point(middle(c, 1), {10, 10});
  expect_point(c.at(c.blocks[1].breaks.back()), {10, 20});
}

TEST(BSpline, OfAsManyPointsAsItsDegreeIsBeziers) {
  auto in = points(MotionKind::spline_b, {{0, 0}, {4, 8}, {8, 0}});
  in.degree = 2;
  const auto quadratic = curve_of(in);
  expect_point(quadratic.at(0), {0, 0});
  expect_point(quadratic.at(0.5), {4, 4});  // (P0 + 2 P1 + P2) / 4
  in.points.push_back({16, 16});
  in.degree = 3;
  const auto cubic = curve_of(in);
  expect_point(cubic.at(0.5), {(0 + 12 + 24 + 16) / 8.0, (0 + 24 + 0 + 16) / 8.0});
  expect_point(cubic.at(1), {16, 16});
}

// Degree 3, five points: the knot between lies at (P1 + 2 P2 + P3) / 4; with spans 1 and 3 at (9 P1 + 6 P2 + P3) / 16.
TEST(BSpline, EqualAndGivenSpans) {
  auto in = points(MotionKind::spline_b, {{0, 0}, {4, 8}, {8, 0}, {12, 8}, {16, 0}});
  expect_point(curve_of(in).at(1), {8, 4});
  in.intervals = {1, 3, 7, 7};  // two spans; the others have no place
  expect_point(curve_of(in).at(1), {(36 + 48 + 12) / 16.0, (72 + 0 + 8) / 16.0});
}

TEST(BSpline, FewerPointsLowerTheDegree) {
  const auto line = curve_of(points(MotionKind::spline_b, {{0, 0}, {10, 4}}));
  expect_point(middle(line, 0), {5, 2});
  expect_point(curve_of(points(MotionKind::spline_b, {{0, 0}, {4, 8}, {8, 0}})).at(0.5), {4, 4});
}

// The quarter circle: the middle weight is cos 45.
TEST(BSpline, WeightsMakeCircles) {
  auto in = points(MotionKind::spline_b, {{10, 0}, {10, 10}, {0, 10}});
  in.degree = 2;
  in.weights = {1, std::sqrt(0.5), 1};
  const auto c = curve_of(in);
  for (double u = 0; u <= 1; u += 0.125) EXPECT_NEAR(std::hypot(c.at(u)[0], c.at(u)[1]), 10, 1e-12);
  std::vector<Point> steps;
  spline_steps(in, c, 0, 0.001, steps);
  spline_steps(in, c, 1, 0.001, steps);
  Point last{10, 0};
  for (const auto& p : steps) {
    EXPECT_GT(std::hypot((p[0] + last[0]) / 2, (p[1] + last[1]) / 2), 10 - 0.001);
    last = p;
  }
  EXPECT_EQ(last, (Point{0, 10}));
}

TEST(BSpline, ImpossibleData) {
  auto in = points(MotionKind::spline_b, {{0, 0}, {4, 8}, {8, 0}, {12, 8}, {16, 0}});
  SplineCurve c;
  std::string error;
  in.intervals = {0, 1};
  EXPECT_FALSE(make_spline(in, c, error));
  in.intervals.clear();
  in.weights = {1, 1, 0, 1, 1};
  EXPECT_FALSE(make_spline(in, c, error));
  in.points = {{0, 0}};
  EXPECT_FALSE(make_spline(in, c, error));
}

// The blocks of a B-spline end where their points pull most: for five points of degree 3 with knots 0 0 0 0 1 2 2 2 2
// at 1/3, 1, 5/3 and 2.
TEST(BSpline, BlocksEndAtTheMeanOfTheirKnots) {
  const auto c = curve_of(points(MotionKind::spline_b, {{0, 0}, {4, 8}, {8, 0}, {12, 8}, {16, 0}}));
  ASSERT_EQ(c.blocks.size(), 4U);
  EXPECT_NEAR(c.blocks[0].breaks.back(), 1.0 / 3, 1e-12);
  EXPECT_NEAR(c.blocks[1].breaks.back(), 1, 1e-12);
  EXPECT_NEAR(c.blocks[2].breaks.back(), 5.0 / 3, 1e-12);
  EXPECT_EQ(c.blocks[3].breaks.back(), 2);
  EXPECT_EQ(c.blocks[2].breaks.size(), 2U);  // the knot 1 is where the block begins
}

// --- polynomials --------------------------------------------------------------------------------------------------

std::vector<Point> steps_of(const PolynomialBlock& b, double tolerance = 0.001) {
  std::vector<Point> out;
  Point direction;
  std::string error;
  EXPECT_TRUE(polynomial_steps(b, tolerance, out, direction, error)) << error;
  return out;
}
bool has(const std::vector<Point>& list, const Point& wanted) {
  return std::any_of(list.begin(), list.end(), [&](const Point& p) {
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (std::abs(p[i] - wanted[i]) > 1e-9) return false;
    }
    return true;
  });
}

// Motion reference 4: PO[Y]=(2) PO[X]=(4,0.25) PL=4 from 0 0: X = p^2 / 4, Y = p / 2, so X = Y^2.
TEST(Polynomial, TheParabolaOfTheManual) {
  PolynomialBlock b;
  b.axes = {{0, 4, {0.25}, false, false}, {0, 2, {}, false, false}};
  b.interval = 4;
  const auto steps = steps_of(b);
  EXPECT_GT(steps.size(), 8U);
  Point last{0, 0};
  for (const auto& p : steps) {
    EXPECT_NEAR(p[0], p[1] * p[1], 1e-12);
    const Point middle{(p[0] + last[0]) / 2, (p[1] + last[1]) / 2};
    EXPECT_LE(std::abs(middle[0] - middle[1] * middle[1]), 0.001 * std::hypot(1, 2 * middle[1]) + 1e-9);
    last = p;
  }
  EXPECT_EQ(steps.back(), (Point{4, 2}));
}

// Y = 135 u^2 - 90 u^3 from PO[X]=(90) PO[Y]=(45,135,-90).
TEST(Polynomial, OfThirdDegree) {
  PolynomialBlock b;
  b.axes = {{0, 90, {}, false, false}, {0, 45, {135, -90}, false, false}};
  EXPECT_TRUE(has(steps_of(b), {45, 135 * 0.25 - 90 * 0.125}));
}

// PO[X]=(0,-10) PO[Y]=(10) PO[]=(2,1) from 10 0: the quarter circle; p = 0.5 gives 6 8.
TEST(Polynomial, DenominatorOfTheQuarterCircle) {
  PolynomialBlock b;
  b.axes = {{10, 0, {-10}, true, false}, {0, 10, {}, true, false}};
  b.has_denominator = true;
  b.denominator_end = 2;
  b.denominator = {1};
  const auto steps = steps_of(b);
  EXPECT_TRUE(has(steps, {6, 8}));
  for (const auto& p : steps) EXPECT_NEAR(std::hypot(p[0], p[1]), 10, 1e-12);
  b.denominator_end = -1;
  std::vector<Point> out;
  Point direction;
  std::string error;
  EXPECT_FALSE(polynomial_steps(b, 0.001, out, direction, error));
  b.denominator_end = 1;  // (1 - 2 p)^2 touches zero
  b.denominator = {4};
  EXPECT_FALSE(polynomial_steps(b, 0.001, out, direction, error));
}

// X = 10 u^2 with A to 10 beside it: A = 10 u by the parameter, A = X by the length (motion reference 4.6).
TEST(Polynomial, WhatTheAxesBesideFollow) {
  PolynomialBlock b;
  b.axes = {{0, 10, {10}, false, false}, {0, 10, {}, false, true}};
  for (const auto& p : steps_of(b)) EXPECT_NEAR(p[0], p[1], 1e-6);
  b.beside_by = PathReference::parameter;
  const auto steps = steps_of(b);
  EXPECT_GT(steps.size(), 4U);
  for (const auto& p : steps) EXPECT_NEAR(p[0], p[1] * p[1] / 10, 1e-9);
}

TEST(Spline, AxesBesideGoStraightByLengthOrParameter) {
  auto in = points(MotionKind::spline_cubic, {{0, 0}, {10, 0}, {20, 0}});
  in.beside = {{0}, {90}, {90}};
  const auto c = curve_of(in);
  std::vector<Point> steps;
  spline_steps(in, c, 0, 0.001, steps);
  for (const auto& p : steps) EXPECT_NEAR(p[2], 9 * p[0], 1e-6);
  EXPECT_EQ(steps.back(), (Point{10, 0, 90}));
}

}  // namespace
}  // namespace cnctrans::ir::curves
