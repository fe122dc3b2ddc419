// Positions by own arithmetic: straight moves, units, diameters, modes, machine coordinates, threads, order of events.
#include "tests/interpreter/run_ir.h"

namespace cnctrans::interpreter {
namespace {

TEST(Motion, AbsoluteAndIncrementalPerBlockAndPerWord) {
  EXPECT_THAT(lines_of("block feed 200, rapid X 10 Y 20\n"
                       "block linear Z -5\n"
                       "block distance incremental, linear X 1.5 Y absolute 7\n"
                       "block linear X -2\n"
                       "block distance absolute, linear X incremental 4 Y 0"),
              ElementsAre("rapid X10 Y20", "linear Z-5 F200", "linear X11.5 Y7 F200", "linear X9.5 F200",
                          "linear X13.5 Y0 F200"));
}

TEST(Motion, AllAxesMoveInOneEventAndEveryKnownAxisIsReported) {
  const auto r = run_lines("block rapid X 1 Y 2 Z 3 C 90");
  ASSERT_EQ(r.events.size(), 2U);
  EXPECT_EQ(r.events[0].to.known, 0b111000111U);
  EXPECT_EQ(r.events[0].to.value[ir::axis::c], 90);
}

TEST(Motion, NoEventWhereNothingMoves) {
  EXPECT_THAT(
      lines_of("block rapid X 0 Y 0\nblock linear X 5\nblock linear X 5\nblock distance incremental, linear X 0"),
      ElementsAre("linear X5"));
}

TEST(Motion, InchesForWordsAndFeedOrForWordsOnly) {
  EXPECT_THAT(lines_of("block units inch, feed 10, linear X 1 C 90\nblock units metric, feed 100, linear X 0\n"
                       "block units inch not_feed, feed 100, linear X 2"),
              ElementsAre("linear X25.4 C90 F254", "linear X0 F100", "linear X50.8 F100"));
}

TEST(Motion, DiameterModes) {
  // diameter: both kinds of words; absolute_only: increments are radius; a word may say its own scale.
  EXPECT_THAT(
      lines_of("block linear X 40 Z 2\n"
               "block distance incremental, linear X -10\n"
               "block diameter absolute_only, linear X -2\n"
               "block distance absolute, linear X 20\n"
               "block diameter radius, linear X 20\n"
               "block linear X diameter 30\n"
               "block diameter diameter, linear X incremental radius 1",
               lathe()),
      ElementsAre("linear X20 Z2", "linear X15", "linear X13", "linear X10", "linear X20", "linear X15", "linear X16"));
}

TEST(Motion, DiameterInInches) {
  EXPECT_THAT(lines_of("block units inch, linear X 2\nblock linear X incremental -1", lathe()),
              ElementsAre("linear X25.4", "linear X12.7"));
}

TEST(Motion, ModalCodeAndOneShots) {
  EXPECT_THAT(
      lines_of(
          "block rapid X 1\nblock modal X 2\nblock linear once X 3\nblock modal X 4\nblock linear\nblock modal X 5"),
      ElementsAre("rapid X1", "rapid X2", "linear X3", "rapid X4", "linear X5"));
}

TEST(Motion, FeedModesAndWhatBecomesOfF) {
  EXPECT_THAT(lines_of("block feed 200, linear X 1\nblock feed_mode per_rev feed_memory cleared, linear X 2\n"
                       "block feed 0.2, linear X 3\nblock feed_mode per_minute feed_memory cleared, linear X 4"),
              ElementsAre("linear X1 F200", "linear X2/rev", "linear X3 F0.2/rev", "linear X4"));
  EXPECT_THAT(
      lines_of("block feed 200, linear X 1\nblock feed_mode per_rev feed_memory per_mode, feed 0.3, linear X 2\n"
               "block feed_mode per_minute feed_memory per_mode, linear X 3"),
      ElementsAre("linear X1 F200", "linear X2 F0.3/rev", "linear X3 F200"));
  EXPECT_THAT(lines_of("block feed 2, feed_mode inverse_time, linear X 1"), ElementsAre("linear X1 F2/inv"));
}

TEST(Motion, MachineCoordinatesIgnoreEveryFrame) {
  const std::string shift = "block frame shift translate replace X 100 Z 50\nblock rapid X 1 Z 2\n";
  EXPECT_THAT(lines_of(shift + "block rapid in_frame machine Z 0\nblock rapid Z 5\nblock rapid X incremental 1"),
              ElementsAre("rapid X101 Z52", "rapid Z0", "rapid Z55", "rapid X102"));
}

TEST(Motion, ProgrammableFrameCanBeLeftOutForOneBlock) {
  auto p = mill();
  p.work_offsets[1][ir::axis::x] = 10;
  EXPECT_THAT(lines_of("block work_offset 1\nblock frame chain translate replace X 5\n"
                       "block rapid X 1\nblock rapid in_frame no_programmable X 1\nblock rapid X 1",
                       p),
              ElementsAre("rapid X16", "rapid X11", "rapid X16"));
}

TEST(Motion, RotaryDirectionsUnwrap) {
  EXPECT_THAT(lines_of("block rapid C positive 90\nblock rapid C positive 30\nblock rapid C negative 350\n"
                       "block rapid C shortest 10\nblock rapid C by_sign -20\nblock rapid C incremental -30"),
              ElementsAre("rapid C90", "rapid C390", "rapid C350", "rapid C370", "rapid C20", "rapid C-10"));
  // A negative zero turns negative to 0.
  EXPECT_THAT(lines_of("block rapid C 90\nblock rapid C by_sign (-R[1])"), ElementsAre("rapid C90", "rapid C0"));
}

TEST(Motion, Threads) {
  EXPECT_THAT(
      lines_of("block thread Z -30 extra lead 1.5 start_angle 180\nblock rapid X 30\nblock thread Z 0\n"
               "block thread_variable Z -10 extra lead 2 lead_change 0.1",
               lathe()),
      ElementsAre("thread Z-30 pitch1.5 at180", "rapid X15", "thread Z0 pitch1.5", "thread Z-10 pitch2 change0.1"));
}

TEST(Motion, PolarAndLineByAngle) {
  // Pole (10, 0): radius 20 at 90 degrees is (10, 20).
  EXPECT_THAT(lines_of("block rapid X 30\nblock pole shift translate replace X 10 Y 0\n"
                       "block linear extra polar_radius 20 polar_angle 90\n"
                       "block distance incremental, linear extra polar_angle 90"),
              ElementsAre("rapid X30", "linear X10 Y20", "linear X-10 Y0"));
  // 8055 checks (radius): from X0 Z160: Q90 to X30; Q149 to Z110 is X60 (rounded in the manual).
  EXPECT_THAT(lines_of("block diameter radius, rapid Z 160\nblock linear X 30 extra line_angle 90", lathe()),
              ElementsAre("rapid Z160", "linear X30"));
  EXPECT_THAT(lines_of("block linear X 10 extra line_angle 45"), ElementsAre("linear X10 Y10"));
  EXPECT_THAT(lines_of("block linear X 10 extra line_angle 90"), ElementsAre("end error RUN-019"));
}

TEST(Motion, AnAxisTheMachineDoesNotHaveIsAnError) {
  EXPECT_THAT(lines_of("block rapid X 1\nblock rapid Y 1", lathe()), ElementsAre("rapid X0.5", "end error RUN-010"));
}

TEST(Motion, StartAndReferencePointOfTheProfile) {
  auto p = mill();
  p.axes[2].start = 300;
  p.axes[2].reference_point = 500;
  EXPECT_THAT(lines_of("block linear Z incremental -100\nblock reference_point once Z 0", p),
              ElementsAre("linear Z200", "rapid Z500"));
}

// --- events beside motion ----------------------------------------------------------------------------------------

TEST(Events, OrderInsideABlock) {
  EXPECT_THAT(lines_of("block tool_change after, spindle 800, spindle_run cw, coolant flood, coolant off after, linear "
                       "X 5, stop after"),
              ElementsAre("spindle 1 cw 800", "coolant flood", "linear X5", "tool 0 change", "coolant off", "stop"));
}

TEST(Events, SpindlePolicy) {
  // S while stopped: nothing; S and M3 in one block, in either order: one event; S while running: one, only when it
  // changes.
  EXPECT_THAT(lines_of("block spindle 500\nblock spindle_run cw, spindle 900\nblock spindle 900\nblock spindle 1000\n"
                       "block spindle_run cw\nblock spindle_run off\nblock spindle 100\nblock spindle_orient 90"),
              ElementsAre("spindle 1 cw 900", "spindle 1 cw 1000", "spindle 1 cw 1000", "spindle 1 off 1000",
                          "spindle 1 oriented 100 at90"));
}

TEST(Events, SpindleModesAndLimit) {
  // Leaving constant cutting speed at X radius 20 with 100 m/min: 1000*100/(pi*40) = 795.77472 rpm.
  EXPECT_THAT(lines_of("block spindle_limit 3000, spindle_mode css, spindle 100, spindle_run ccw\nblock rapid X 40\n"
                       "block spindle_mode rpm\nblock spindle_mode rpm, spindle 500\nblock spindle_limit 400",
                       lathe()),
              ElementsAre("spindle 1 ccw 100m/min limit3000", "rapid X20", "spindle 1 ccw 795.77472 limit3000",
                          "spindle 1 ccw 500 limit3000", "spindle 1 ccw 500 limit400"));
}

TEST(Events, SecondSpindleKeepsItsNumber) {
  EXPECT_THAT(lines_of("block spindle 100 of 2, spindle_run cw of 2"), ElementsAre("spindle 2 cw 100"));
}

TEST(Events, Tools) {
  EXPECT_THAT(
      lines_of("block tool 3\nblock tool_change\nblock tool_change after, tool 4, tool_offset 7\nblock tool 5 changes\n"
               "block tool 0 name \"MILL_10\""),
      ElementsAre("tool 3", "tool 3 change", "offset 7", "tool 4 change", "tool 5 change", "tool MILL_10"));
}

TEST(Events, CompOnlyWhenTheSideChanges) {
  EXPECT_THAT(
      lines_of("block comp off\nblock comp left, linear X 1\nblock comp left\nblock comp right\nblock comp off"),
      ElementsAre("comp left", "linear X1", "comp right", "comp off"));
}

TEST(Events, DwellStopMessageExactStop) {
  EXPECT_THAT(
      lines_of("block dwell 250 scale 0.01\nblock dwell 0\nblock dwell 3 revolutions\nblock stop optional\n"
               "block exact_stop_block, linear X 1\nmessage show (\"  part \", (R[1] + 2.5), \" \")\nmessage show "
               "(\" \")\nmessage clear"),
      ElementsAre("dwell 2.5s", "dwell 3rev", "stop optional", "linear X1", "feed_stop", "message part 2.5"));
}

TEST(Events, MachineFunctionsByTheProfile) {
  auto p = mill();
  p.m_codes.push_back({107, machine::MMeaning::coolant_flood, ir::Order::before, 0, {}});
  p.m_codes.push_back({41, machine::MMeaning::gear, ir::Order::before, 1, {}});
  EXPECT_THAT(lines_of("block machine_function 107, machine_function 41, machine_function 88\nset R[1] = 99\nblock "
                       "machine_function 0 computed value (R[1])",
                       p),
              ElementsAre("coolant flood", "m 88", "m 99"));
}

TEST(Events, EachCarriesItsLine) {
  const auto r = run_lines("block rapid X 1\nblock rapid X 2");
  ASSERT_EQ(r.events.size(), 3U);
  EXPECT_EQ(r.events[0].file, 1U);
  EXPECT_EQ(r.events[1].line, r.events[0].line + 1);
}

}  // namespace
}  // namespace cnctrans::interpreter
