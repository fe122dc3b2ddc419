// Hole cycles: levels, pecks, retract planes, what triggers them. The sequences are those of the language references
// (Fagor 28.6, NUM 11.2 and 11.4, Sinumerik 18.1), by own arithmetic.
#include "ir/cycles/hole.h"
#include "tests/interpreter/run_ir.h"

namespace cnctrans::interpreter {
namespace {

const std::string at_20 = "block feed 100, rapid Z 20\n";

TEST(Cycle, DrillModalWithBothRetractPlanes) {
  const std::string text =
      "block cycle hole drill reference absolute 2 bottom absolute -10, rapid X 10\nblock modal X 20\n"
      "block cycle_cancel, rapid X 30";
  EXPECT_THAT(lines_of(at_20 + "block retract_plane reference\n" + text),
              ElementsAre("rapid Z20", "rapid X10", "rapid Z2", "linear Z-10 F100", "rapid Z2", "rapid X20",
                          "linear Z-10 F100", "rapid Z2", "rapid X30"));
  EXPECT_THAT(lines_of(at_20 + text),
              ElementsAre("rapid Z20", "rapid X10", "rapid Z2", "linear Z-10 F100", "rapid Z20", "rapid X20",
                          "rapid Z2", "linear Z-10 F100", "rapid Z20", "rapid X30"));
}

TEST(Cycle, RetractPlaneMayChangeDuringTheInfluence) {
  EXPECT_THAT(
      lines_of(
          at_20 +
          "block cycle hole drill reference absolute 2 bottom absolute -1\nblock retract_plane reference, rapid X 1\n"
          "block modal Y 1"),
      ElementsAre("rapid Z20", "rapid Z2", "linear Z-1 F100", "rapid Z20", "rapid X1", "rapid Z2", "linear Z-1 F100",
                  "rapid Z2", "rapid Y1", "linear Z-1 F100", "rapid Z2"));
}

TEST(Cycle, LevelsFollowTheDistanceMode) {
  // Incremental: reference 18 below the height (20 - 18 = 2), bottom 12 below the reference.
  EXPECT_THAT(
      lines_of(at_20 + "block distance incremental, cycle hole drill reference distance_mode -18 bottom distance_mode "
                       "otherwise from_reference -12"),
      ElementsAre("rapid Z20", "rapid Z2", "linear Z-10 F100", "rapid Z20"));
  EXPECT_THAT(lines_of(at_20 + "block cycle hole drill surface absolute 1 reference from_surface 2 bottom from_surface "
                               "-5 retract absolute 10"),
              ElementsAre("rapid Z20", "rapid Z3", "linear Z-4 F100", "rapid Z10"));
}

TEST(Cycle, DwellFeedAndApproachByTheRetractLevel) {
  EXPECT_THAT(
      lines_of(at_20 +
               "block cycle hole drill reference absolute 1 bottom absolute -4 retract absolute 5 dwell_bottom 50 "
               "dwell_scale 0.01 feed 30 approach_by_retract"),
      ElementsAre("rapid Z20", "rapid Z5", "rapid Z1", "linear Z-4 F30", "dwell 0.5s", "rapid Z5"));
}

TEST(Cycle, DefinitionThatWaitsAndDefinitionForOneHole) {
  EXPECT_THAT(
      lines_of(at_20 +
               "block cycle later path_motion hole drill reference absolute 2 bottom absolute -1 retract absolute 2\n"
               "block rapid X 5\nblock coolant flood\nblock cycle_cancel"),
      ElementsAre("rapid Z20", "rapid X5", "rapid Z2", "linear Z-1 F100", "rapid Z2", "coolant flood"));
  EXPECT_THAT(
      lines_of(
          at_20 +
          "block cycle once hole drill reference absolute 2 bottom absolute -1 retract absolute 2\nblock rapid X 5"),
      ElementsAre("rapid Z20", "rapid Z2", "linear Z-1 F100", "rapid Z2", "rapid X5"));
}

TEST(Cycle, TriggersOfAPlaneCycle) {
  // Tool axis alone and other blocks do not drill; a position that does not move does.
  EXPECT_THAT(
      lines_of(at_20 +
               "block cycle later hole drill reference absolute 2 bottom absolute -1 retract absolute 2, rapid\n"
               "block modal Z 15\nblock tool 2\nblock modal X 0\nblock rapid C 90"),
      ElementsAre("rapid Z20", "rapid Z15", "tool 2", "rapid Z2", "linear Z-1 F100", "rapid Z2", "rapid C90"));
}

TEST(Cycle, PathMotionCycleIsTriggeredByBareWordsToo) {
  EXPECT_THAT(lines_of(at_20 + "block cycle later path_motion hole drill reference absolute 2 bottom absolute -1 "
                               "retract absolute 2\nblock feed 50"),
              ElementsAre("rapid Z20", "rapid Z2", "linear Z-1 F50", "rapid Z2"));
}

TEST(Cycle, PositioningByRapidWhereTheMachineDoesSo) {
  auto p = mill();
  const std::string text =
      "block cycle hole drill reference absolute 2 bottom absolute -1 retract absolute 2, modal X 5\nblock modal X "
      "6\nblock linear X 7";
  EXPECT_THAT(lines_of("block feed 9, linear Z 2\n" + text, p),
              ElementsAre("linear Z2 F9", "linear X5 F9", "linear Z-1 F9", "rapid Z2", "linear X6 F9", "linear Z-1 F9",
                          "rapid Z2", "linear X7 F9", "linear Z-1 F9", "rapid Z2"));
  p.policies.cycle_positioning = machine::CyclePositioning::rapid;
  EXPECT_THAT(lines_of("block feed 9, linear Z 2\n" + text, p),
              ElementsAre("linear Z2 F9", "rapid X5", "linear Z-1 F9", "rapid Z2", "rapid X6", "linear Z-1 F9",
                          "rapid Z2", "rapid X7", "linear Z-1 F9", "rapid Z2"));
}

TEST(Cycle, BlockRepeatedAndRepeatedZeroTimes) {
  EXPECT_THAT(
      lines_of(at_20 +
               "block cycle later hole drill reference absolute 2 bottom absolute -1 retract absolute 2, rapid\n"
               "block distance incremental, modal X 5, times 2\nblock modal X 5, times 0"),
      ElementsAre("rapid Z20", "rapid X5", "rapid Z2", "linear Z-1 F100", "rapid Z2", "rapid X10", "linear Z-1 F100",
                  "rapid Z2", "rapid X15"));
}

TEST(Cycle, PecksWithFullRetract) {
  // Reference 2, bottom -10, pecks of 5: 5, 5, 2; down again to 1 above the last bottom.
  EXPECT_THAT(
      lines_of(at_20 +
               "block cycle hole peck_full reference absolute 2 bottom absolute -10 retract absolute 2 dwell_bottom 1 "
               "pecks constant first 5 reapproach 1"),
      ElementsAre("rapid Z20", "rapid Z2", "linear Z-3 F100", "rapid Z2", "rapid Z-2", "linear Z-8 F100", "rapid Z2",
                  "rapid Z-7", "linear Z-10 F100", "dwell 1s", "rapid Z2"));
}

TEST(Cycle, PecksMayWithdrawToTheRetractLevel) {
  EXPECT_THAT(
      lines_of(at_20 + "block cycle hole peck_full reference absolute 1 bottom absolute -9 retract absolute 5 "
                       "pecks constant first 5 reapproach 1 withdraws_to_retract"),
      ElementsAre("rapid Z20", "rapid Z1", "linear Z-4 F100", "rapid Z5", "rapid Z-3", "linear Z-9 F100", "rapid Z5"));
}

TEST(Cycle, PecksByCountGiveTheBottom) {
  // Peck -4, three times, below the reference 2: bottom -10.
  EXPECT_THAT(lines_of(at_20 + "block cycle hole peck_full reference absolute 2 retract absolute 2 pecks count first "
                               "-4 count 3 reapproach 1"),
              ElementsAre("rapid Z20", "rapid Z2", "linear Z-2 F100", "rapid Z2", "rapid Z-1", "linear Z-6 F100",
                          "rapid Z2", "rapid Z-5", "linear Z-10 F100", "rapid Z2"));
}

TEST(Cycle, PecksWithAShortLift) {
  EXPECT_THAT(lines_of(at_20 + "block cycle hole peck_break reference absolute 2 bottom absolute -8 retract absolute 2 "
                               "pecks constant first 5 lift 1 dwell 0.2"),
              ElementsAre("rapid Z20", "rapid Z2", "linear Z-3 F100", "dwell 0.2s", "linear Z-2 F100",
                          "linear Z-8 F100", "rapid Z2"));
  EXPECT_THAT(
      lines_of(at_20 + "block cycle hole peck_break reference absolute 2 bottom absolute -8 retract absolute 2 pecks "
                       "constant first 5 lift 3 "
                       "lift_rapid reapproach 1"),
      ElementsAre("rapid Z20", "rapid Z2", "linear Z-3 F100", "rapid Z0", "rapid Z-2", "linear Z-8 F100", "rapid Z2"));
}

TEST(Cycle, PecksFromTheSurfaceWithFirstDepthAndFeedFactor) {
  // Surface 0, reference 2, first depth -6 (6 below the surface), then 6: bottom -12. First feed covers 2 + 6 at half
  // the feed.
  EXPECT_THAT(
      lines_of(at_20 +
               "block cycle hole peck_full surface absolute 0 reference from_surface 2 bottom absolute -12 retract "
               "absolute 2 "
               "pecks balanced first_to absolute -6 reapproach_automatic first_from_surface first_feed_factor 0.5"),
      ElementsAre("rapid Z20", "rapid Z2", "linear Z-6 F50", "rapid Z2", "rapid Z-5.4", "linear Z-12 F100",
                  "rapid Z2"));
}

TEST(Cycle, TapsReverseAndRestore) {
  EXPECT_THAT(lines_of("block feed 150, spindle 100, spindle_run cw, rapid Z 20\n"
                       "block cycle hole tap reference absolute 2 bottom absolute -8 retract absolute 10"),
              ElementsAre("spindle 1 cw 100", "rapid Z20", "rapid Z2", "thread Z-8 pitch1.5", "spindle 1 ccw 100",
                          "thread Z2 pitch1.5", "spindle 1 cw 100", "rapid Z10"));
  EXPECT_THAT(lines_of(at_20 + "block cycle hole tap reference absolute 2 bottom absolute -8 pitch 2"),
              ElementsAre("rapid Z20", "spindle 1 cw 0", "rapid Z2", "thread Z-8 pitch2", "spindle 1 ccw 0",
                          "thread Z2 pitch2", "spindle 1 cw 0", "rapid Z20"));
  EXPECT_THAT(lines_of("block spindle_run cw\nblock cycle hole tap bottom absolute -8"),
              ElementsAre("spindle 1 cw 0", "end error RUN-018"));
}

TEST(Cycle, ReamAndBores) {
  EXPECT_THAT(
      lines_of(at_20 + "block cycle hole ream reference absolute 2 bottom absolute -8 retract absolute 5 feed_out 300"),
      ElementsAre("rapid Z20", "rapid Z2", "linear Z-8 F100", "linear Z2 F300", "rapid Z5"));
  const std::string on = "block feed 100, spindle 200, spindle_run ccw, rapid Z 5\n";
  EXPECT_THAT(lines_of(on + "block cycle hole bore_stop reference absolute 2 bottom absolute -8"),
              ElementsAre("spindle 1 ccw 200", "rapid Z5", "rapid Z2", "linear Z-8 F100", "spindle 1 off 200",
                          "rapid Z5", "spindle 1 ccw 200"));
  EXPECT_THAT(lines_of(on + "block cycle hole bore_manual reference absolute 2 bottom absolute -8"),
              ElementsAre("spindle 1 ccw 200", "rapid Z5", "rapid Z2", "linear Z-8 F100", "spindle 1 off 200", "stop",
                          "rapid Z5"));
  EXPECT_THAT(
      lines_of(
          on +
          "block cycle hole bore_shift reference absolute 2 bottom absolute -8 orient_angle 45 shift_u 1 shift_v -1"),
      ElementsAre("spindle 1 ccw 200", "rapid Z5", "rapid Z2", "linear Z-8 F100", "spindle 1 oriented 200 at45",
                  "rapid X1 Y-1", "rapid Z2", "rapid X0 Y0 Z5", "spindle 1 ccw 200"));
}

TEST(Cycle, AxisByThePlaneOrByItsName) {
  EXPECT_THAT(lines_of("block plane yz, feed 10\nblock cycle once hole drill reference absolute 0 bottom absolute 5"),
              ElementsAre("linear X5 F10", "rapid X0"));
  EXPECT_THAT(lines_of("block feed 10, cycle once hole drill axis Z reference absolute 0 bottom absolute -5", lathe()),
              ElementsAre("linear Z-5 F10", "rapid Z0"));
  // On the face of a lathe: X in diameters, drilled along X from 40 to 20.
  EXPECT_THAT(
      lines_of("block feed 10, rapid X 50\nblock cycle once hole drill axis X reference absolute 40 bottom absolute 20",
               lathe()),
      ElementsAre("rapid X25", "rapid X20", "linear X10 F10", "rapid X25"));
}

TEST(Cycle, Inches) {
  EXPECT_THAT(
      lines_of(
          "block units inch, feed 1, rapid Z 1\nblock cycle hole drill reference absolute 0.5 bottom absolute -0.5"),
      ElementsAre("rapid Z25.4", "rapid Z12.7", "linear Z-12.7 F25.4", "rapid Z25.4"));
}

TEST(Cycle, Faults) {
  EXPECT_THAT(lines_of("block cycle hole drill reference absolute 2"), ElementsAre("end error RUN-018"));
  EXPECT_THAT(lines_of("block cycle hole drill reference absolute 2 bottom absolute 2"),
              ElementsAre("end error RUN-018"));
  EXPECT_THAT(lines_of("block cycle hole peck_full bottom absolute -5 pecks constant first 0"),
              ElementsAre("end error RUN-018"));
  EXPECT_THAT(lines_of("block cycle hole back_bore bottom absolute -5"), ElementsAre("end error RUN-040"));
  EXPECT_THAT(lines_of("block cycle named \"POCKET3\" (\"RTP\" 5)"), ElementsAre("end error RUN-040"));
  EXPECT_THAT(lines_of("block cycle hole drill bottom absolute -5", lathe()), ElementsAre("end error RUN-010"));
}

TEST(Cycle, InAFrame) {
  EXPECT_THAT(lines_of("block frame shift translate replace X 100 Z 50\n" + at_20 +
                       "block cycle hole drill reference absolute 2 bottom absolute -10, rapid X 1"),
              ElementsAre("rapid Z70", "rapid X101", "rapid Z52", "linear Z40 F100", "rapid Z70"));
}

// --- schedules ---------------------------------------------------------------------------------------------------

std::vector<double> sizes(ir::PeckLaw law, double first, double depth, double degression = 0, double minimum = 0,
                          double count = 0) {
  ir::cycles::HoleNumbers n;
  n.law = law;
  n.first = first;
  n.degression = degression;
  n.minimum = minimum;
  n.count = count;
  return ir::cycles::peck_sizes(n, depth);
}
using ::testing::DoubleNear;

TEST(Pecks, Laws) {
  EXPECT_THAT(sizes(ir::PeckLaw::none, 0, 12), ElementsAre(12));
  EXPECT_THAT(sizes(ir::PeckLaw::constant, 5, 12), ElementsAre(5, 5, 2));
  EXPECT_THAT(sizes(ir::PeckLaw::constant, 4, 12), ElementsAre(4, 4, 4));
  EXPECT_THAT(sizes(ir::PeckLaw::count, 4, 12, 0, 0, 3), ElementsAre(4, 4, 4));
  // 5 leaves 7 < 2*5: the last two share it.
  EXPECT_THAT(sizes(ir::PeckLaw::balanced, 5, 12), ElementsAre(5, 3.5, 3.5));
  EXPECT_THAT(sizes(ir::PeckLaw::balanced, 5, 10), ElementsAre(5, 5));
  EXPECT_THAT(sizes(ir::PeckLaw::balanced, 5, 4), ElementsAre(4));
  // Each 4 smaller while more than 4 results: 10, 6, then 4s; the last 6 (< 8) in two halves.
  EXPECT_THAT(sizes(ir::PeckLaw::arithmetic, 10, 30, 4), ElementsAre(10, 6, 4, 4, 3, 3));
  EXPECT_THAT(sizes(ir::PeckLaw::geometric, 8, 13, 0.5), ElementsAre(8, 4, 1));
  EXPECT_THAT(sizes(ir::PeckLaw::geometric, 8, 20, 0.5, 3), ElementsAre(8, 4, 3, 3, 2));
  // P10 Q5 over 30: n = ceil(60/15) = 4: 10, 8.33, 6.67, 5 sum 30.
  EXPECT_THAT(sizes(ir::PeckLaw::linear, 10, 30, 0, 5), ElementsAre(DoubleNear(10, 1e-9), DoubleNear(25.0 / 3, 1e-9),
                                                                    DoubleNear(20.0 / 3, 1e-9), DoubleNear(5, 1e-9)));
}

TEST(Pecks, SumIsTheDepth) {
  for (const auto law : {ir::PeckLaw::constant, ir::PeckLaw::arithmetic, ir::PeckLaw::geometric, ir::PeckLaw::linear,
                         ir::PeckLaw::balanced}) {
    for (double depth = 0.5; depth < 40; depth += 0.7) {
      double sum = 0;
      for (const double s : sizes(law, 6, depth, law == ir::PeckLaw::geometric ? 0.8 : 1, 2)) {
        EXPECT_GT(s, 0);
        sum += s;
      }
      EXPECT_NEAR(sum, depth, 1e-9) << ir::name(law) << " " << depth;
    }
  }
}

}  // namespace
}  // namespace cnctrans::interpreter
