// Work offsets and programmable frames: pm = offset . slots in the machine's order . p.
#include "tests/interpreter/run_ir.h"

namespace cnctrans::interpreter {
namespace {

TEST(Frame, WorkOffsetIsAddedAndMovesNothingByItself) {
  auto p = mill();
  p.work_offsets[1] = {{ir::axis::x, 100}, {ir::axis::z, -20}};
  p.work_offsets[2] = {{ir::axis::x, 200}};
  EXPECT_THAT(lines_of("block work_offset 1\nblock rapid X 1 Y 1\nblock work_offset 2, rapid X 1\nblock work_offset "
                       "off\nblock rapid X 1 Z 0",
                       p),
              ElementsAre("rapid X101 Y1", "rapid X201", "rapid X1"));
}

TEST(Frame, AxesThatAreNotNamedStayWhereTheyAre) {
  auto p = mill();
  p.work_offsets[1] = {{ir::axis::x, 100}, {ir::axis::y, 50}};
  EXPECT_THAT(lines_of("block rapid X 1 Y 1\nblock work_offset 1\nblock rapid X 1", p),
              ElementsAre("rapid X1 Y1", "rapid X101"));
}

TEST(Frame, ShiftReplacesAddsOrKeepsTheOthers) {
  const std::string first = "block frame shift translate replace X 10 Y 20\nblock rapid X 0 Y 0\n";
  const std::string then = "\nblock rapid X 0 Y 0";
  EXPECT_THAT(lines_of(first + "block frame shift translate replace X 1" + then),
              ElementsAre("rapid X10 Y20", "rapid X1 Y0"));
  EXPECT_THAT(lines_of(first + "block frame shift translate replace_named X 1" + then),
              ElementsAre("rapid X10 Y20", "rapid X1"));
  EXPECT_THAT(lines_of(first + "block frame shift translate add X 1" + then),
              ElementsAre("rapid X10 Y20", "rapid X11"));
  EXPECT_THAT(
      lines_of(
          first +
          "block distance incremental, frame shift translate replace by_distance_mode X 1\nblock distance absolute" +
          then),
      ElementsAre("rapid X10 Y20", "rapid X11"));
  EXPECT_THAT(lines_of(first + "block frame shift translate clear" + then),
              ElementsAre("rapid X10 Y20", "rapid X0 Y0"));
}

TEST(Frame, PresetGivesThePresentPointItsCoordinates) {
  EXPECT_THAT(
      lines_of("block rapid X 50 Y 30\nblock frame preset translate preset X 10\nblock rapid X 0\nblock rapid Y 0"),
      ElementsAre("rapid X50 Y30", "rapid X40", "rapid Y0"));
}

TEST(Frame, RotationInThePlaneAboutACentre) {
  EXPECT_THAT(lines_of("block frame rotation rotate replace angle 90\nblock rapid X 10 Y 0"), ElementsAre("rapid Y10"));
  // About (10, 0) by 90 degrees: (20, 0) -> (10, 10).
  EXPECT_THAT(lines_of("block frame rotation rotate replace X 10 Y 0 angle 90\nblock rapid X 20 Y 0"),
              ElementsAre("rapid X10 Y10"));
  // Successive rotations add up: 30 + 60.
  EXPECT_THAT(
      lines_of("block frame rotation rotate add angle 30\nblock frame rotation rotate add angle 60\nblock rapid X 10"),
      ElementsAre("rapid Y10"));
  // In ZX the angle turns from Z toward X.
  EXPECT_THAT(lines_of("block plane zx, frame rotation rotate replace angle 90\nblock rapid Z 10"),
              ElementsAre("rapid X10"));
}

TEST(Frame, OneWordInARotatedFrameMovesBothAxes) {
  // At machine (0, 10) the work point is (10, 0); X 20 leads to (0, 20).
  EXPECT_THAT(
      lines_of("block rapid Y 10\nblock frame rotation rotate replace angle 90\nblock rapid X 20\nblock rapid Y 5"),
      ElementsAre("rapid Y10", "rapid Y20", "rapid X-5"));
}

TEST(Frame, ChainAppliesInside) {
  // T(10, 0) . R(90) . T(5, 0): the point (1, 0) -> (6, 0) -> (0, 6) -> (10, 6).
  EXPECT_THAT(lines_of("block frame chain translate replace X 10\nblock frame chain rotate compose angle 90\n"
                       "block frame chain translate compose X 5\nblock rapid X 1 Y 0"),
              ElementsAre("rapid X10 Y6"));
  // A replacing statement deletes all of the chain.
  EXPECT_THAT(
      lines_of(
          "block frame chain translate replace X 10\nblock frame chain rotate replace angle 90\nblock rapid X 1 Y 0"),
      ElementsAre("rapid Y1"));
  // Scale, then a shift whose values are scaled; mirror, then a shift that is mirrored.
  EXPECT_THAT(
      lines_of("block frame chain scale replace X 2 Y 2\nblock frame chain translate compose X 5\nblock rapid X 1 Y 1"),
      ElementsAre("rapid X12 Y2"));
  EXPECT_THAT(
      lines_of("block frame chain mirror replace X 1\nblock frame chain translate compose X 5\nblock rapid X 1 Y 1"),
      ElementsAre("rapid X-6 Y1"));
  EXPECT_THAT(
      lines_of("block frame chain rotate replace angle 90\nblock frame chain translate clear\nblock rapid X 1 Y 0"),
      ElementsAre("rapid X1"));
}

TEST(Frame, OrderOfTheSlotsIsTheMachines) {
  const std::string text =
      "block frame shift translate replace X 10\nblock frame mirror mirror replace X 1\nblock frame rotation rotate "
      "replace angle 90\n"
      "block rapid X 1 Y 2";
  using S = ir::FrameSlot;
  auto p = mill();
  // shift . rotation . mirror: (1,2) -> mirror (-1,2) -> rotate (-2,-1) -> shift (8,-1).
  EXPECT_THAT(lines_of(text, p), ElementsAre("rapid X8 Y-1"));
  // mirror . shift . rotation: (1,2) -> rotate (-2,1) -> shift (8,1) -> mirror (-8,1).
  p.frame_order = {S::preset, S::mirror, S::shift, S::rotation, S::scale, S::chain};
  EXPECT_THAT(lines_of(text, p), ElementsAre("rapid X-8 Y1"));
}

TEST(Frame, MirrorFlipsArcs) {
  EXPECT_THAT(lines_of("block rapid X 10\nblock frame mirror mirror add Y 1\nblock arc_ccw X 0 Y 10 centre X -10"),
              ElementsAre("rapid X10", "cw X0 Y-10 c(0,0)"));
  // Both plane axes: no flip.
  EXPECT_THAT(
      lines_of(
          "block frame mirror mirror add X 1\nblock frame mirror mirror add Y 1\nblock arc_ccw X 10 Y 0 centre X 5"),
      ElementsAre("ccw X-10 c(-5,0)"));
}

TEST(Frame, RotatedAndScaledArc) {
  EXPECT_THAT(lines_of("block frame rotation rotate replace angle 90\nblock frame scale scale replace uniform X "
                       "2\nblock arc_cw X 10 Y 0 centre X 5"),
              ElementsAre("cw Y20 c(0,10)"));
}

TEST(Frame, ArcsUnderUnequalScalesAreRefused) {
  EXPECT_THAT(lines_of("block frame scale scale replace X 2\nblock linear X 10\nblock arc_cw X 0 Y 0 centre X -5"),
              ElementsAre("linear X20", "end error RUN-015"));
  EXPECT_THAT(lines_of("block frame chain rotate replace angle 30 about X\nblock arc_cw X 10 Y 0 centre X 5"),
              ElementsAre("end error RUN-015"));
  EXPECT_THAT(lines_of("block frame scale scale replace X 0"), ElementsAre("end error RUN-027"));
}

TEST(Frame, RotationCentreThroughScaleAndMirror) {
  auto p = mill();
  const std::string text =
      "block frame mirror mirror replace X 1\nblock frame rotation rotate replace X 10 Y 0 angle 90\nblock rapid X 10 "
      "Y 0";
  // As written: (10,0) -> mirrored (-10,0) -> turned about (10,0): (10,-20).
  EXPECT_THAT(lines_of(text, p), ElementsAre("rapid X10 Y-20"));
  // Through the mirror the centre is (-10, 0): the point stays on it.
  p.policies.frame_rotation_centre = machine::FrameRotationCentre::scaled_and_mirrored;
  EXPECT_THAT(lines_of(text, p), ElementsAre("rapid X-10"));
}

TEST(Frame, IncrementalMoveAfterAFrameChange) {
  const std::string text =
      "block rapid X 10\nblock frame chain translate replace X 100\nblock distance incremental, rapid X 5\nblock rapid "
      "X 1";
  auto p = mill();
  EXPECT_THAT(lines_of(text, p), ElementsAre("rapid X10", "rapid X15", "rapid X16"));
  p.policies.frame_change_keeps =
      machine::FrameChangeKeeps::programmed;  // the difference of the frames is travelled: 100 + 10 + 5
  EXPECT_THAT(lines_of(text, p), ElementsAre("rapid X10", "rapid X115", "rapid X116"));
}

TEST(Frame, DiameterShift) {
  EXPECT_THAT(lines_of("block frame shift translate replace X 20 Z 5\nblock rapid X 40 Z 0", lathe()),
              ElementsAre("rapid X30 Z5"));
}

TEST(Frame, RotaryAxesTakeShiftsOnly) {
  EXPECT_THAT(lines_of("block frame shift translate replace C 10\nblock frame rotation rotate replace angle 90\nblock "
                       "rapid C 5 X 1"),
              ElementsAre("rapid Y1 C15"));
}

}  // namespace
}  // namespace cnctrans::interpreter
