// Splines and polynomials on the machine: lines and feeds of the steps, what stands between the points, frames, modes,
// what is refused. Shapes: tests/ir/curve_test.cpp.
#include <cmath>

#include "tests/interpreter/run_ir.h"

namespace cnctrans::interpreter {
namespace {

/// Steps within 1 mm: few enough to write down. x = 20 u, y = 20 u (1 - u).
machine::Profile coarse(machine::Profile p = mill()) {
  p.policies.path_curve_tolerance = 1;
  return p;
}

TEST(Curve, StepsHaveTheLineAndTheFeedOfTheirBlock) {
  const auto r = run_lines(
      "block feed 100, spline_b coded X 10 Y 10\n"
      "block feed 50, modal X 20 Y 0\n"
      "block linear coded X 30",
      coarse());
  ASSERT_EQ(r.events.size(), 6U);
  EXPECT_EQ(r.events[1].to.value[ir::axis::x], 10);
  EXPECT_EQ(r.events[1].to.value[ir::axis::y], 5);
  EXPECT_EQ(r.events[1].feed, 100);
  EXPECT_EQ(r.events[2].feed, 50);
  EXPECT_EQ(r.events[2].line, r.events[1].line + 1);
  EXPECT_EQ(r.events[3].line, r.events[2].line);
  EXPECT_EQ(r.events[4].line, r.events[3].line + 1);
}

TEST(Curve, OtherEventsStayAtTheirPlace) {
  EXPECT_THAT(lines_of("block spline_b coded X 10 Y 10\n"
                       "block coolant flood\n"
                       "block modal X 20 Y 0, stop after\n"
                       "block linear coded X 30",
                       coarse()),
              ElementsAre("linear X5 Y3.75", "linear X10 Y5", "coolant flood", "linear X15 Y3.75", "linear X20 Y0",
                          "stop", "linear X30"));
}

TEST(Curve, TheSplineEndsWithTheProgramOrWithAnotherCode) {
  EXPECT_THAT(lines_of("block spline_b coded\nblock modal X 10 Y 10\nblock modal X 20 Y 0", coarse()),
              ElementsAre("linear X5 Y3.75", "linear X10 Y5", "linear X15 Y3.75", "linear X20 Y0"));
  // The same spline again behind a straight line: a curve of its own.
  EXPECT_THAT(lines_of("block spline_b coded X 10 Y 10\nblock modal X 20 Y 0\nblock linear coded X 30\n"
                       "block spline_b coded X 40 Y 10\nblock modal X 50 Y 0",
                       coarse()),
              ElementsAre("linear X5 Y3.75", "linear X10 Y5", "linear X15 Y3.75", "linear X20 Y0", "linear X30",
                          "linear X35 Y3.75", "linear X40 Y5", "linear X45 Y3.75", "linear X50 Y0"));
}

TEST(Curve, ItsCodeAloneBeginsAnotherCurve) {
  EXPECT_THAT(
      lines_of("block spline_b coded X 10\nblock linear once X 12\nblock spline_b coded\nblock modal X 20", coarse()),
      ElementsAre("linear X10", "linear X12", "linear X20"));
}

TEST(Curve, ASplineOfAnotherKindFollowsAtOnce) {
  EXPECT_THAT(lines_of("block spline_b coded X 10 Y 10\nblock modal X 20 Y 0\nblock spline_akima coded X 30\n"
                       "block modal X 40\nblock linear coded X 50",
                       coarse()),
              ElementsAre("linear X5 Y3.75", "linear X10 Y5", "linear X15 Y3.75", "linear X20 Y0", "linear X30",
                          "linear X40", "linear X50"));
}

TEST(Curve, CurvesWithANumber) {
  const std::string points =
      "jump N90\nN10 block modal X 0 Y 0\nblock modal X 10 Y 10\nN20 block modal X 20 Y 0\nN90 label\n";
  const std::string define = "repeat N10 N20 curve_use define curve 1\n";
  const std::string run = "block spline_b coded\n& repeat N10 N20 curve_use run curve 1\n";
  const auto steps = lines_of(define + run + "block rapid coded X 0\n" + run + points, coarse());
  EXPECT_THAT(steps, ElementsAre("linear X5 Y3.75", "linear X10 Y5", "linear X15 Y3.75", "linear X20 Y0", "rapid X0",
                                 "linear X5 Y3.75", "linear X10 Y5", "linear X15 Y3.75", "linear X20 Y0"));
  EXPECT_THAT(lines_of(run + points, coarse()), ElementsAre("end error RUN-047"));
  EXPECT_THAT(lines_of(define + "repeat N10 N20 curve_use remove curve 1\n" + run + points, coarse()),
              ElementsAre("end error RUN-047"));
  // Not where it begins; and its motion function does not go on behind it.
  EXPECT_THAT(lines_of(define + "block rapid coded X 5\n" + run + points, coarse()),
              ElementsAre("rapid X5", "end error RUN-046"));
  EXPECT_EQ(lines_of(define + run + "block modal X 30\n" + points, coarse()).back(), "end error RUN-046");
}

TEST(Curve, IncrementsInchesAndFramesActOnThePoints) {
  EXPECT_THAT(lines_of("block distance incremental, spline_b coded X 10 Y 10\nblock modal X 10 Y -10", coarse()),
              ElementsAre("linear X5 Y3.75", "linear X10 Y5", "linear X15 Y3.75", "linear X20 Y0"));
  EXPECT_THAT(lines_of("block units inch, spline_b coded X 1 Y 0\nblock modal X 2 Y 0", coarse()),
              ElementsAre("linear X25.4", "linear X50.8"));
  // Turned by 90 degrees: (x, y) becomes (-y, x).
  EXPECT_THAT(lines_of("block frame rotation rotate replace angle 90\n"
                       "block spline_b coded X 10 Y 10\nblock modal X 20 Y 0",
                       coarse()),
              ElementsAre("linear X-3.75 Y5", "linear X-5 Y10", "linear X-3.75 Y15", "linear X0 Y20"));
}

TEST(Curve, DiametersOfALathe) {
  // X as diameter: the radii are 0, 10, 0.
  EXPECT_THAT(lines_of("block spline_b coded X 20 Z 10\nblock modal X 0 Z 20", coarse(lathe())),
              ElementsAre("linear X3.75 Z5", "linear X5 Z10", "linear X3.75 Z15", "linear X0 Z20"));
  // Coefficients too: x = 20 p - 20 p^2 in diameters.
  EXPECT_THAT(lines_of("block polynomial coded X 0 Z 20 extra polynomial of X a2 -40 degree 2", coarse(lathe())),
              ElementsAre("linear X3.75 Z5", "linear X5 Z10", "linear X3.75 Z15", "linear X0 Z20"));
}

TEST(Curve, PointsFromALoop) {
  EXPECT_THAT(lines_of("block spline_cubic coded\n"
                       "N1 repeat N10 N20 count 2\n"
                       "jump N30\n"
                       "N10 block modal X incremental 10\n"
                       "N20 block modal X incremental 5\n"
                       "N30 block linear coded Y 1",
                       coarse()),
              ElementsAre("linear X10", "linear X15", "linear X25", "linear X30", "linear Y1"));
}

TEST(Curve, AStopOfThePreparationSplitsTheSpline) {
  // Two straight lines instead of one curve.
  EXPECT_THAT(lines_of("block spline_b coded X 10 Y 10\nblock preparation_stop\nblock modal X 20 Y 0", coarse()),
              ElementsAre("linear X10 Y10", "linear X20 Y0"));
}

TEST(Curve, ATangentArcBehindACurveTouchesIt) {
  // The curve ends in direction (1, -1); an arc from (20, 0) to (40, 0) that begins there: centre (30, 10).
  EXPECT_THAT(lines_of("block polynomial coded X 20 Y 0 extra polynomial of Y a2 -20 degree 2\n"
                       "block arc_tangent coded X 40 Y 0",
                       coarse())
                  .back(),
              "ccw X40 c(30,10)");
}

TEST(Curve, WhatIsRefused) {
  const auto end = [](const std::string& text) { return lines_of(text, coarse()).back(); };
  EXPECT_EQ(end("block corner round 2, spline_b coded X 10"), "end error RUN-046");
  EXPECT_EQ(end("block corner round 2, linear X 10\nblock spline_b coded X 20 Y 5"), "end error RUN-046");
  EXPECT_EQ(end("block feed_mode inverse_time, feed 2, spline_b coded X 10"), "end error RUN-046");
  EXPECT_EQ(end("block spline_b coded X 10\nblock linear once X 12\nblock modal X 20"), "end error RUN-046");
  EXPECT_EQ(end("block spline_end tangent, spline_cubic coded X 10\nblock arc_tangent coded X 20 Y 5"),
            "end error RUN-046");
  EXPECT_EQ(end("block spline_b coded X 10 extra weight 0"), "end error RUN-047");
  EXPECT_EQ(end("block spline_b coded X 10 extra weight 4"), "end error RUN-047");
  EXPECT_EQ(end("block spline_b coded X 10 extra spline_degree 4"), "end error RUN-047");
  EXPECT_EQ(end("block spline_cubic coded X 10 extra weight 2"), "end error RUN-046");
  EXPECT_EQ(end("block polynomial coded X 10 extra polynomial of X a2 1 degree 2 interval 0"), "end error RUN-047");
  EXPECT_EQ(end("block polynomial coded X 10 extra polynomial of X a2 1 degree 2 polynomial end -1"),
            "end error RUN-047");
}

TEST(Curve, TheToleranceIsThatOfTheProfile) {
  machine::Profile p = mill();
  p.policies.path_curve_tolerance = 0.01;
  const auto r = run_lines(
      "block modal X 10\nblock polynomial coded X 0 Y 10 extra polynomial of X a2 -10 degree 2 polynomial end 2 a2 1 "
      "degree "
      "2",
      p);
  double worst = 0;
  for (std::size_t i = 1; i + 1 < r.events.size(); ++i) {
    const auto& a = r.events[i - 1].to.value;
    const auto& b = r.events[i].to.value;
    EXPECT_NEAR(std::hypot(b[0], b[1]), 10, 1e-9);
    worst = std::max(worst, 10 - std::hypot((a[0] + b[0]) / 2, (a[1] + b[1]) / 2));
  }
  EXPECT_LE(worst, 0.0101);
  EXPECT_GT(worst, 0.002);
}

}  // namespace
}  // namespace cnctrans::interpreter
