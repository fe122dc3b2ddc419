// Rounding, chamfer, tangential entry and exit: the inserted elements by own geometry.
#include "tests/interpreter/run_ir.h"

namespace cnctrans::interpreter {
namespace {

TEST(Corner, RoundBetweenLines) {
  // Right angle at (20, 0), r 5: cut back by 5 on both, centre (15, 5).
  EXPECT_THAT(lines_of("block feed 100, corner round 5, linear X 20\nblock linear Y 20"),
              ElementsAre("linear X15 F100", "ccw X20 Y5 c(15,5) F100", "linear Y20 F100"));
  // Interior angle 60 degrees: cut back by 5 / tan 30 = 8.66025.
  const auto lines = lines_of("block corner round 5, linear X 40\nblock linear X 30 Y 17.320508075688775");
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0], "linear X31.33975");
}

TEST(Corner, ChamferByLegAndByChord) {
  EXPECT_THAT(lines_of("block corner chamfer_leg 3, linear X 20\nblock linear Y 20"),
              ElementsAre("linear X17", "linear X20 Y3", "linear Y20"));
  // Chord 2 at a right angle: leg = 2 / (2 sin 45) = 1.41421.
  EXPECT_THAT(lines_of("block corner chamfer_chord 2, linear X 20\nblock linear Y 20"),
              ElementsAre("linear X18.58579", "linear X20 Y1.41421", "linear Y20"));
}

TEST(Corner, OwnFeedAndOwnLine) {
  const auto r = run_lines("block feed 100, corner round 5 feed 30, linear X 20\nblock feed 200, linear Y 20");
  EXPECT_THAT(r.lines, ElementsAre("linear X15 F100", "ccw X20 Y5 c(15,5) F30", "linear Y20 F200"));
  EXPECT_EQ(r.events[1].line, r.events[0].line) << "the corner belongs to the block that programs it";
  EXPECT_EQ(r.events[2].line, r.events[0].line + 1);
}

TEST(Corner, LineAndArc) {
  // Line along Y=0 to (20,0); then a clockwise quarter about (20,-10)... starts along +X: no corner is needed.
  EXPECT_THAT(lines_of("block corner round 2, linear X 20\nblock arc_cw X 30 Y -10 centre Y -10"),
              ElementsAre("linear X20", "cw X30 Y-10 c(20,-10)"));
  // Line to (10,0) into the circle about (0,0), counter-clockwise up to (0,10): the fillet circle r 1 left of both lies
  // at distance 9 from the centre and 1 above the line: centre (sqrt(80), 1) = (8.94427, 1).
  EXPECT_THAT(lines_of("block corner round 1, linear X 10\nblock arc_ccw X 0 Y 10 centre X -10"),
              ElementsAre("linear X8.94427", "ccw X9.93808 Y1.11111 c(8.94427,1)", "ccw X0 Y10 c(0,0)"));
}

TEST(Corner, ArcAndArc) {
  // Two circles of radius 10 about (0,0) and (20,0) touch at (10,0), where the path turns back. The circle of radius 2
  // that touches both from outside lies at distance 12 from their centres: (10, -sqrt(44)) = (10, -6.63325).
  EXPECT_THAT(lines_of("block rapid Y -10\nblock corner round 2, arc_ccw X 10 Y 0 centre Y 10\nblock arc_ccw X 20 Y "
                       "-10 centre X 10"),
              ElementsAre("rapid Y-10", "ccw X8.33333 Y-5.52771 c(0,0)", "cw X11.66667 c(10,-6.63325)",
                          "ccw X20 Y-10 c(20,0)"));
  // Half circle about (0,0) to (10,0), then the half circle about (15,0) upwards over the top, clockwise: directions +Y
  // both: smooth.
  EXPECT_THAT(
      lines_of(
          "block rapid X -10\nblock corner round 2, arc_ccw X 10 Y 0 centre X 10\nblock arc_cw X 20 Y 0 centre X 5"),
      ElementsAre("rapid X-10", "ccw X10 c(0,0)", "cw X20 c(15,0)"));
}

TEST(Corner, OtherAxesAreInterpolatedAndEventsKeepTheirOrder) {
  EXPECT_THAT(
      lines_of(
          "block corner round 5, linear X 20 Z -10\nblock coolant flood\nmessage show (\"hi\")\nblock linear Y 20"),
      ElementsAre("linear X15 Z-7.5", "ccw X20 Y5 Z-10 c(15,5)", "coolant flood", "message hi", "linear Y20"));
}

TEST(Corner, ChainOfCorners) {
  EXPECT_THAT(lines_of("block corner round 2, linear X 10\nblock corner chamfer_leg 1, linear Y 10\nblock linear X 0"),
              ElementsAre("linear X8", "ccw X10 Y2 c(8,2)", "linear Y9", "linear X9 Y10", "linear X0"));
}

TEST(Corner, ModalRoundingUntilZeroAndOnlyBetweenContourElements) {
  EXPECT_THAT(lines_of("block corner round 2 modal, linear X 10\nblock linear Y 10\nblock rapid X 0\nblock linear Y 0\n"
                       "block corner round 0 modal\nblock linear X 5\nblock linear Y 5"),
              ElementsAre("linear X8", "ccw X10 Y2 c(8,2)", "linear Y10", "rapid X0", "linear Y2", "ccw X2 Y0 c(2,2)",
                          "linear X5", "linear Y5"))
      << "the corner at the end of a block belongs to the mode in force there";
}

TEST(Corner, Faults) {
  EXPECT_THAT(lines_of("block corner round 30, linear X 20\nblock linear Y 20"),
              ElementsAre("linear X20", "end error RUN-016"));
  EXPECT_THAT(lines_of("block corner chamfer_leg 25, linear X 20\nblock linear Y 20"),
              ElementsAre("linear X20", "end error RUN-016"));
  EXPECT_THAT(lines_of("block corner chamfer_leg 1, linear X 20\nblock arc_ccw X 30 Y 0 centre X 5"),
              ElementsAre("linear X20", "end error RUN-016"));
  EXPECT_THAT(lines_of("block corner round 3, linear X 20\nblock linear X 0"),
              ElementsAre("linear X20", "end error RUN-016"));
  EXPECT_THAT(lines_of("block corner round 3, linear X 20"), ElementsAre("linear X20", "end error RUN-017"));
  EXPECT_THAT(lines_of("block corner round 3, linear X 20\nblock linear Z 5"),
              ElementsAre("linear X20", "end error RUN-017"));
  EXPECT_THAT(lines_of("block corner round 3"), ElementsAre("end error RUN-017"));
}

TEST(Tangential, Entry) {
  // From (0,0) to P (20,10), next element along +X; r 5: the start lies right of the path (below): centre (20, 5).
  // d = |(20,5)| = 20.61553, l = sqrt(425 - 25) = 20; direction arg(20,5) + asin(5/20.61553) = 28.07249 deg:
  // T = 20 (cos, sin) = (17.64706, 9.41176).
  EXPECT_THAT(lines_of("block tangential entry 5, linear X 20 Y 10\nblock linear X 40"),
              ElementsAre("linear X17.64706 Y9.41176", "cw X20 Y10 c(20,5)", "linear X40"));
  // Straight above: start left of the element.
  EXPECT_THAT(lines_of("block rapid X 15 Y 30\nblock tangential entry 5, linear X 20 Y 10\nblock linear X 40"),
              ElementsAre("rapid X15 Y30", "linear Y15", "ccw X20 Y10 c(20,15)", "linear X40"));
  EXPECT_THAT(lines_of("block rapid X 19 Y 11\nblock tangential entry 5, linear X 20 Y 10\nblock linear X 40"),
              ElementsAre("rapid X19 Y11", "linear X20 Y10", "end error RUN-016"));
}

TEST(Tangential, ExitIsTheEntryBackwards) {
  EXPECT_THAT(lines_of("block rapid X -20 Y 10\nblock tangential exit 5, linear X 0\nblock linear X 5 Y 30"),
              ElementsAre("rapid X-20 Y10", "linear X0", "ccw X5 Y15 c(0,15)", "linear Y30"));
}

}  // namespace
}  // namespace cnctrans::interpreter
