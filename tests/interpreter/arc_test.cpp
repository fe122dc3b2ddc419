// Arcs: every way to give the centre, sense, helix, tolerance. Positions by own arithmetic.
#include "tests/interpreter/run_ir.h"

namespace cnctrans::interpreter {
namespace {

TEST(Arc, CentreFromTheStartInBothDistanceModes) {
  // From (10, 0) about (0, 0), a quarter counter-clockwise.
  EXPECT_THAT(lines_of("block feed 100, rapid X 10\nblock arc_ccw X 0 Y 10 centre X -10 centre Y 0"),
              ElementsAre("rapid X10", "ccw X0 Y10 c(0,0) F100"));
  EXPECT_THAT(lines_of("block rapid X 10\nblock distance incremental, arc_ccw X -10 Y 10 centre X -10"),
              ElementsAre("rapid X10", "ccw X0 Y10 c(0,0)"));
}

TEST(Arc, CentreAbsoluteAndFollowingTheDistanceMode) {
  EXPECT_THAT(lines_of("block rapid X 10\nblock arc_cw X 0 Y -10 centre X absolute 0 centre Y absolute 0"),
              ElementsAre("rapid X10", "cw X0 Y-10 c(0,0)"));
  const std::string follows = "centre X follows_distance 20 centre Y follows_distance 0";
  // Absolute: centre (20, 0) seen from (10, 0): half circle to (30, 0). Incremental: the centre is (30, 0).
  EXPECT_THAT(lines_of("block rapid X 10\nblock arc_cw X 30 Y 0 " + follows),
              ElementsAre("rapid X10", "cw X30 c(20,0)"));
  EXPECT_THAT(lines_of("block rapid X 10\nblock distance incremental, arc_cw X 40 Y 0 " + follows),
              ElementsAre("rapid X10", "cw X50 c(30,0)"));
}

TEST(Arc, RadiusMinorAndMajor) {
  // Chord (0,0)-(10,0), R 10: h = sqrt(100 - 25) = 8.66025. ccw minor: centre left of the chord (above); major: below.
  EXPECT_THAT(lines_of("block arc_ccw X 10 Y 0 radius 10"), ElementsAre("ccw X10 c(5,8.66025)"));
  EXPECT_THAT(lines_of("block arc_ccw X 10 Y 0 radius -10"), ElementsAre("ccw X10 c(5,-8.66025)"));
  EXPECT_THAT(lines_of("block arc_cw X 10 Y 0 radius 10"), ElementsAre("cw X10 c(5,-8.66025)"));
  EXPECT_THAT(lines_of("block arc_cw X 10 Y 0 radius -10"), ElementsAre("cw X10 c(5,8.66025)"));
}

TEST(Arc, RadiusNearAHalfCircleIsClampedWithinTheTolerance) {
  EXPECT_THAT(lines_of("block arc_ccw X 10 Y 0 radius 4.995"), ElementsAre("ccw X10 c(5,0)"));
  EXPECT_THAT(lines_of("block arc_ccw X 10 Y 0 radius 4.98"), ElementsAre("end error RUN-012"));
}

TEST(Arc, RadiusWithEndAtStartIsAnError) {
  EXPECT_THAT(lines_of("block arc_ccw X 0 Y 0 radius 10"), ElementsAre("end error RUN-012"));
  EXPECT_THAT(lines_of("block arc_ccw X 1 Y 0 radius 0"), ElementsAre("end error RUN-012"));
}

TEST(Arc, FullCircle) {
  EXPECT_THAT(lines_of("block arc_cw X 0 Y 0 centre X 5"), ElementsAre("cw c(5,0)"));
  EXPECT_THAT(lines_of("block arc_cw centre X 5\nblock arc_ccw centre Y -3"), ElementsAre("cw c(5,0)", "ccw c(0,-3)"));
}

TEST(Arc, PlanesTurnFromAbscissaToOrdinate) {
  // ZX: from Z 10 towards X is counter-clockwise; centre (u, v) = (Z, X).
  EXPECT_THAT(lines_of("block plane zx, rapid Z 10\nblock arc_ccw Z 0 X 10 centre Z -10"),
              ElementsAre("rapid Z10", "ccw X10 Z0 c(0,0) ZX"));
  EXPECT_THAT(lines_of("block plane yz, rapid Y 10\nblock arc_ccw Y 0 Z 10 centre Y -10"),
              ElementsAre("rapid Y10", "ccw Y0 Z10 c(0,0) YZ"));
}

TEST(Arc, LatheEndInDiameterCentreInRadius) {
  // From X40 (radius 20) Z0 to X60 (radius 30) Z-10, R 10 about X radius 20, Z -10: centre offset X 0, Z -10. From +Z
  // toward +X is counter-clockwise.
  EXPECT_THAT(lines_of("block rapid X 40 Z 0\nblock arc_ccw X 60 Z -10 centre Z -10 centre X 0", lathe()),
              ElementsAre("rapid X20", "ccw X30 Z-10 c(-10,20) ZX"));
  // An absolute centre that is a diameter word.
  EXPECT_THAT(
      lines_of("block rapid X 40 Z 0\nblock arc_ccw X 60 Z -10 centre Z absolute -10 centre X absolute modal 40",
               lathe()),
      ElementsAre("rapid X20", "ccw X30 Z-10 c(-10,20) ZX"));
}

TEST(Arc, Inches) {
  EXPECT_THAT(lines_of("block units inch, arc_ccw X 2 Y 0 centre X 1"), ElementsAre("ccw X50.8 c(25.4,0)"));
  EXPECT_THAT(lines_of("block units inch, arc_ccw X 2 Y 0 radius 1"), ElementsAre("ccw X50.8 c(25.4,0)"));
}

TEST(Arc, RadiiMustAgree) {
  EXPECT_THAT(lines_of("block arc_ccw X 10.01 Y 0 centre X 5"), ElementsAre("ccw X10.01 c(5,0)"));
  const auto r = run_lines("block arc_ccw X 10.1 Y 0 centre X 5");
  EXPECT_THAT(r.lines, ElementsAre("end error RUN-011"));
  EXPECT_THAT(r.result.error_text, ::testing::HasSubstr("5.1"));
  EXPECT_THAT(lines_of("block arc_ccw X 10 Y 0"), ElementsAre("end error RUN-013"));
  EXPECT_THAT(lines_of("block arc_ccw X 10 Y 0 centre X 0"), ElementsAre("end error RUN-012"));
}

TEST(Arc, HelixByTurns) {
  EXPECT_THAT(lines_of("block arc_ccw X 10 Y 0 Z -30 centre X 5 extra turns 2"),
              ElementsAre("ccw X10 Z-30 c(5,0) turns2"));
  EXPECT_THAT(lines_of("block arc_ccw Z -5 centre X 5"), ElementsAre("ccw Z-5 c(5,0)"));
}

TEST(Arc, HelixByPitch) {
  // Half a turn and n full ones: travel 10 at pitch 4 = 2.5 turns.
  EXPECT_THAT(lines_of("block arc_ccw X 10 Y 0 Z -10 centre X 5 extra pitch 4"),
              ElementsAre("ccw X10 Z-10 c(5,0) turns2"));
  // Full circles: travel 12 at pitch 4 = 3 turns = one circle and two added.
  EXPECT_THAT(lines_of("block arc_cw X 0 Y 0 Z 12 centre X 5 extra pitch 4"), ElementsAre("cw Z12 c(5,0) turns2"));
  EXPECT_THAT(lines_of("block arc_cw X 0 Y 0 Z 11 centre X 5 extra pitch 4"), ElementsAre("end error RUN-014"));
  auto nearest = mill();
  nearest.policies.helix_pitch_mismatch = machine::HelixPitchMismatch::nearest;
  EXPECT_THAT(lines_of("block arc_cw X 0 Y 0 Z 11 centre X 5 extra pitch 4", nearest),
              ElementsAre("cw Z11 c(5,0) turns2"));
}

TEST(Arc, OpeningAngle) {
  // Quarter about (0, 0) from (10, 0).
  EXPECT_THAT(lines_of("block rapid X 10\nblock arc_ccw centre X -10 extra angle 90"),
              ElementsAre("rapid X10", "ccw X0 Y10 c(0,0)"));
  // By end point: chord 10 at 90 degrees: r = 10/(2 sin 45) = 7.07107, centre at (5, 5).
  EXPECT_THAT(lines_of("block arc_ccw X 10 Y 0 extra angle 90"), ElementsAre("ccw X10 c(5,5)"));
  EXPECT_THAT(lines_of("block arc_ccw X 10 Y 0 extra angle 270"), ElementsAre("ccw X10 c(5,-5)"));
}

TEST(Arc, PolarEndAboutCentreOrPole) {
  EXPECT_THAT(lines_of("block rapid X 10\nblock arc_ccw centre X -10 extra polar_angle 180"),
              ElementsAre("rapid X10", "ccw X-10 c(0,0)"));
  EXPECT_THAT(lines_of("block rapid X 10\nblock distance incremental, arc_cw extra polar_angle -90"),
              ElementsAre("rapid X10", "cw X0 Y-10 c(0,0)"));
}

TEST(Arc, ThroughAPointAndTangent) {
  // (0,0) over (5,5) to (10,0): the half circle about (5,0), clockwise.
  EXPECT_THAT(lines_of("block arc_through_point once X 10 Y 0 extra through X absolute 5 through Y absolute 5"),
              ElementsAre("cw X10 c(5,0)"));
  EXPECT_THAT(lines_of("block arc_through_point X 10 Y 0 extra through X absolute 5"),
              ElementsAre("end error RUN-013"));
  // Along +X to (10,0), then tangent to (20,10): the quarter about (10,10).
  EXPECT_THAT(lines_of("block linear X 10\nblock arc_tangent once X 20 Y 10\nblock arc_tangent once X 10 Y 20"),
              ElementsAre("linear X10", "ccw X20 Y10 c(10,10)", "ccw X10 Y20 c(10,10)"));
  EXPECT_THAT(lines_of("block linear X 10\nblock arc_tangent X 20 Y 0"),
              ElementsAre("linear X10", "end error RUN-013"));
  EXPECT_THAT(lines_of("block arc_tangent X 20 Y 10"), ElementsAre("end error RUN-013"));
}

}  // namespace
}  // namespace cnctrans::interpreter
