// Word blocks: arcs, modes, order of actions, dwells, frames, cycles, safe start.
#include <gtest/gtest.h>

#include "support.h"

namespace cnctrans::test {
namespace {

std::string main_program(const std::string& body) {
  return "space L \"L\" starts_at_zero segment 0 19 forgotten\nroutine main 1 {\n" + body + "  end_program\n}\n";
}

TEST(Arcs, OffsetCentreBecomesAbsolute) {
  const std::string text =
      main_program("  block feed 100, rapid X 10 Y 0\n  block arc_ccw X 0 Y 10 centre X -10 centre Y 0\n");
  const auto p = run_pass("convert_arcs", text, chain_target());
  EXPECT_NE(p.text.find("centre X follows_distance"), std::string::npos) << p.text;
  EXPECT_EQ(difference(text, chain_target(), "fagor-mill", "num-mill"), "");
}

TEST(Arcs, UnknownStartFromVariablesBecomesAnExpression) {
  const std::string text = main_program(
      "  set L[1] = 10\n  block feed 100, rapid X (L[1]) Y 0\n  block arc_ccw X 0 Y (L[1]) centre X (-L[1])\n");
  EXPECT_EQ(difference(text, chain_target(), "fagor-mill", "num-mill"), "");
}

TEST(Arcs, LargeArcByRadiusTakesItsCentre) {
  // 270 degrees about (10, 10) from (10, 0): centre left of the chord's other side.
  const std::string text = main_program("  block feed 100, rapid X 10 Y 0\n  block arc_ccw X 0 Y 10 radius -10\n");
  const auto p = run_pass("convert_arcs", text, chain_target());
  EXPECT_EQ(p.text.find("radius"), std::string::npos) << p.text;
  EXPECT_EQ(difference(text, chain_target(), "fagor-mill", "num-mill"), "");
}

TEST(Arcs, FullCircleNamesItsEnd) {
  const std::string text = main_program("  block feed 100, rapid X 30 Y 5\n  block arc_cw centre X -12\n");
  EXPECT_EQ(difference(text, letters_target(), "sinumerik-mill", "fagor-mill"), "");
  EXPECT_EQ(difference(text, chain_target(), "sinumerik-mill", "num-mill"), "");
}

TEST(Arcs, AbsoluteCentreNeedsNoStart) {
  const std::string text = main_program(
      "  block feed 100, rapid X (L[1]) Y 0\n  block arc_ccw X 0 Y 0 centre X follows_distance modal 0 centre Y "
      "follows_distance modal 0\n");
  const auto p = run_pass("convert_arcs", text, structured_target(), "num-mill", "sinumerik-mill");
  EXPECT_TRUE(p.good) << all(p.diagnostics);
  EXPECT_NE(p.text.find("centre X absolute"), std::string::npos) << p.text;
}

TEST(Arcs, ArcThatRoundingClosesIsNoFullCircle) {
  // 0.0002 mm long: three places make start and end one point.
  const auto p = run_pass("convert_arcs",
                          main_program("  block feed 100, rapid X 10 Y 0\n  block arc_ccw X 10 Y 0.0002 radius 5\n"),
                          chain_target());
  EXPECT_NE(p.text.find("linear"), std::string::npos) << p.text;
  EXPECT_TRUE(has_code(p.diagnostics, "TRN-315"));
}

TEST(Arcs, ArcByItsCentreThatRoundingClosesIsNoFullCircle) {
  // Four places there, three here; 0.00002 mm long resp. 0.0002 mm.
  const auto p = run_pass(
      "convert_arcs", main_program("  block feed 100, rapid X 10 Y 0\n  block arc_ccw X 10 Y -0.00002 centre X 5\n"),
      letters_target(), "sinumerik-mill");
  EXPECT_NE(p.text.find("linear"), std::string::npos) << p.text;
  EXPECT_TRUE(has_code(p.diagnostics, "TRN-315"));
  EXPECT_EQ(difference(main_program("  block feed 100, rapid X 10 Y 0\n  block arc_ccw X 10 Y -0.0002 centre X 5\n"),
                       letters_target(), "sinumerik-mill"),
            "");
}

TEST(Arcs, IncrementThatRoundsToNothing) {
  // From 10.0003 to 10.0007: the places differ, the increment 0.0004 is nothing in three places.
  const auto p = run_pass("convert_arcs",
                          main_program("  block feed 100, rapid X 10.0003 Y 0\n  block distance incremental, arc_ccw X "
                                       "0.0004 Y 0 radius 3\n"),
                          chain_target());
  EXPECT_NE(p.text.find("linear"), std::string::npos) << p.text;
}

TEST(Arcs, NearlyAFullCircleByItsRadiusTakesItsCentre) {
  // The chord is shorter than the last place: by the radius nothing would say where the circle lies.
  const auto p =
      run_pass("convert_arcs",
               main_program("  block feed 100, rapid X 20 Y 0\n  block arc_ccw X 20.00002 Y -0.00001 radius -3\n"),
               letters_target(), "sinumerik-mill");
  EXPECT_EQ(p.text.find("radius"), std::string::npos) << p.text;
  EXPECT_EQ(p.text.find("linear"), std::string::npos) << p.text;
  const auto kept = run_pass(
      "convert_arcs", main_program("  block feed 100, rapid X 20 Y 0\n  block arc_ccw X 20.5 Y -0.3 radius -3\n"),
      letters_target(), "sinumerik-mill");
  EXPECT_NE(kept.text.find("radius -3"), std::string::npos) << kept.text;
}

TEST(Arcs, PitchBecomesTurns) {
  // 10 mm down at 4 mm a turn: 2.5 turns, half of one is the partial arc.
  const std::string text = main_program(
      "  block feed 100, rapid X 10 Y 0 Z 0\n  block arc_ccw X -10 Y 0 Z -10 centre X -10 centre Y 0 extra pitch 4\n");
  const auto p = run_pass("convert_arcs", text, structured_target());
  EXPECT_NE(p.text.find("turns #2"), std::string::npos) << p.text;
  EXPECT_EQ(difference(text, structured_target(), "fagor-mill", "sinumerik-mill"), "");
}

TEST(Distance, IncrementalWordTakesTheKnownPosition) {
  const std::string text = main_program("  block rapid X 10 Y 4\n  block rapid X incremental 5 Y absolute 3\n");
  const auto p = run_pass("convert_distance", text, letters_target());
  EXPECT_NE(p.text.find("X #15 Y 3"), std::string::npos) << p.text;
}

TEST(Distance, IncrementIsAddedToWhatTheControlKnows) {
  auto target = letters_target();
  target.system_data = [](const ir::SystemRef& s) { return s.datum == ir::Datum::programmed_position; };
  const std::string text =
      main_program("  N10 set L[1] = L[1] + 1\n  block rapid X incremental 5 Y (L[1])\n  jump N10 if L[1] < 3\n");
  EXPECT_EQ(difference(text, target), "");
}

TEST(Distance, UnknownPositionSwitchesTheBlock) {
  const std::string text = main_program("  block rapid X (L[1])\n  block rapid X incremental 5\n  block rapid X 1\n");
  const auto p = run_pass("convert_distance", text, letters_target());
  EXPECT_NE(p.text.find("block distance incremental, rapid X 5"), std::string::npos) << p.text;
  EXPECT_NE(p.text.find("block distance absolute\n"), std::string::npos) << p.text;
}

TEST(Diameters, RadiusProgrammingOnAFixedDiameterLathe) {
  const std::string text =
      main_program("  block diameter radius, rapid X 10 Z 2\n  block diameter diameter, rapid X 30\n");
  const auto p = run_pass("convert_diameters", text, chain_target(), "fagor-lathe", "num-lathe");
  EXPECT_NE(p.text.find("X #20 Z 2"), std::string::npos) << p.text;
  EXPECT_NE(p.text.find("X 30"), std::string::npos) << p.text;
  EXPECT_EQ(p.text.find("diameter"), std::string::npos) << p.text;
}

TEST(Order, StopBeforeTheMotionGetsABlock) {
  // M9 acts before the motion on the source, after it on the target.
  const std::string text = main_program(
      "  block feed 100, rapid X 1\n  N10 block linear X 5, coolant off as \"M9\" ; \"cut\"\n  jump N10 if L[1] > 0\n");
  const auto p = run_pass("split_blocks", text, chain_target(), "fagor-mill", "num-mill");
  EXPECT_NE(p.text.find("N10 block coolant off"), std::string::npos) << p.text;
  EXPECT_NE(p.text.find("block linear X 5 ; \"cut\""), std::string::npos) << p.text;
  EXPECT_EQ(difference(text, chain_target(), "fagor-mill", "num-mill"), "");
}

TEST(Order, StopAfterTheMotionGetsABlockBehind) {
  const std::string text = main_program(
      "  block spindle 500, spindle_run cw\n  block feed 100, linear X 5, spindle_run off after as \"M5\"\n");
  EXPECT_EQ(difference(text, structured_target(), "fagor-mill", "sinumerik-mill"), "");
}

TEST(Dwell, UnitsOfTheTarget) {
  const auto p = run_pass("convert_dwells", main_program("  block dwell 2.5\n"), letters_target());
  EXPECT_NE(p.text.find("dwell #250 scale 0.01"), std::string::npos) << p.text;
  const auto q = run_pass("convert_dwells", main_program("  block dwell 30 scale 0.01\n"), chain_target());
  EXPECT_NE(q.text.find("dwell #0.3"), std::string::npos) << q.text;  // never 30 s
}

TEST(Frames, ShiftOfAllAxesInTheChain) {
  // A named shift keeps the other axes; the chain's statement deletes them, so it names all.
  const std::string text = main_program(
      "  block frame shift translate replace_named X 100 Y 20\n  block rapid X 0 Y 0\n"
      "  block frame shift translate replace_named Y 60\n  block rapid X 0 Y 0\n"
      "  block frame shift translate clear\n  block rapid X 1 Y 1\n");
  EXPECT_EQ(difference(text, structured_target(), "fagor-mill", "sinumerik-mill"), "");
  const auto p = run_pass("convert_frames", text, structured_target(), "fagor-mill", "sinumerik-mill");
  EXPECT_NE(p.text.find("frame chain translate replace X 100 Y 60"), std::string::npos) << p.text;
}

TEST(Frames, ChainInSlots) {
  const std::string text = main_program(
      "  block frame chain translate replace X 100 Y 60\n  block frame chain rotate compose angle 30\n"
      "  block rapid X 10 Y 0\n  block frame chain translate clear\n  block rapid X 10 Y 0\n");
  EXPECT_EQ(difference(text, letters_target(), "sinumerik-mill", "fagor-mill"), "");
  EXPECT_EQ(difference(text, chain_target(), "sinumerik-mill", "num-mill"), "");
}

TEST(Frames, PresetBecomesAShift) {
  // At X 30 the coordinate is named 10: the origin moves by 20.
  const std::string text = main_program(
      "  block rapid X 30 Y 5\n  block frame preset translate preset X 10\n  block rapid X 0 Y 0\n"
      "  block frame shift translate replace_named X 1\n  block rapid X 0 Y 0\n");
  EXPECT_EQ(difference(text, structured_target(), "fagor-mill", "sinumerik-mill"), "");
  const auto p = run_pass("convert_frames", text, structured_target(), "fagor-mill", "sinumerik-mill");
  EXPECT_NE(p.text.find("frame chain translate replace X #20"), std::string::npos) << p.text;
}

TEST(Frames, ShiftThatWouldOutliveTheProgramIsTakenBack) {
  auto target = letters_target();
  target.shift_survives_end = true;
  const auto p =
      run_pass("convert_frames", main_program("  block frame chain translate replace X 100\n  block rapid X 0\n"),
               target, "sinumerik-mill", "fagor-mill");
  EXPECT_LT(p.text.find("frame shift translate clear"), p.text.find("end_program")) << p.text;
}

TEST(Frames, UnknownRestIsRefused) {
  const std::string text = main_program(
      "  jump N10 if L[1] > 0\n  block frame shift translate replace_named X 100\n"
      "  N10 block frame shift translate replace_named Y 60\n  block rapid X 0 Y 0\n");
  const auto p = run_pass("convert_frames", text, structured_target(), "fagor-mill", "sinumerik-mill");
  EXPECT_TRUE(has_code(p.diagnostics, "TRN-325")) << p.text;
}

const char* const drilling =
    "  block feed 100, rapid X 0 Y 0 Z 20\n"
    "  block modal X 10 Y 10, cycle hole drill reference 2 bottom -15\n"
    "  block modal X 30\n  block modal Y 25\n  block cycle_cancel\n  block rapid Z 50\n";

TEST(Cycles, WrittenOutMoveByMove) {
  auto target = chain_target();
  const auto text = main_program(drilling);
  EXPECT_EQ(difference(text, target, "fagor-mill", "fagor-mill"), "");
}

TEST(Cycles, ModalDefinitionBecomesAModalCall) {
  const auto p = run_pass("lower_cycles", main_program(drilling), structured_target(), "fagor-mill", "sinumerik-mill");
  ASSERT_TRUE(p.good) << all(p.diagnostics);
  const auto call = p.text.find("modal_call cycle"), first = p.text.find("X 10 Y 10"),
             off = p.text.find("modal_call off");
  EXPECT_LT(call, first) << p.text;
  EXPECT_LT(first, off) << p.text;
  EXPECT_EQ(difference(main_program(drilling), structured_target(), "fagor-mill", "sinumerik-mill"), "");
}

TEST(Cycles, ModalCallBecomesADefinitionAtTheFirstPoint) {
  auto target = letters_target();
  target.native_cycle = [](const ir::Cycle&) { return true; };
  const std::string text = main_program(
      "  block feed 100, rapid X 0 Y 0 Z 20\n"
      "  modal_call cycle hole drill reference 2 bottom -15 retract 20\n"
      "  block rapid X 10 Y 10\n  block modal X 30\n  modal_call off\n  block rapid Z 50\n");
  EXPECT_EQ(difference(text, target, "sinumerik-mill", "fagor-mill"), "");
}

TEST(Cycles, RetractPlaneChangesWhileTheCycleIsActive) {
  const std::string text = main_program(
      "  block feed 100, rapid X 0 Y 0 Z 20\n  block retract_plane initial, cycle hole drill reference 2 bottom -15, "
      "modal X 5\n"
      "  block modal X 10\n  block retract_plane reference, modal X 15\n  block modal X 20\n  block cycle_cancel\n  "
      "block rapid Z 30\n");
  EXPECT_EQ(difference(text, structured_target(), "fagor-mill", "sinumerik-mill"), "");
  EXPECT_EQ(difference(text, chain_target(), "fagor-mill", "fagor-mill"), "");
  auto target = chain_target();
  target.native_cycle = [](const ir::Cycle&) { return true; };
  EXPECT_EQ(difference(text, target, "fagor-mill", "fagor-mill"), "");
}

TEST(Cycles, SecondCycleStartsWhereTheFirstLeftTheTool) {
  const std::string text = main_program(
      "  block feed 100, rapid X 0 Y 0 Z 20\n  block cycle hole drill reference 2 bottom -15 retract 10, modal X 5 Y "
      "5\n"
      "  block cycle_cancel\n  block cycle hole peck_full reference 2 bottom -15 retract 10 pecks constant first 6 "
      "reapproach 1, "
      "modal X 9\n  block cycle_cancel\n");
  EXPECT_EQ(difference(text, chain_target(), "fagor-mill", "fagor-mill"), "");
}

TEST(SafeStart, SaysThePowerOnStateOfTheSource) {
  const auto p = run_pass("safe_start", main_program("  block plane zx\n  block rapid X 0\n"), structured_target(),
                          "fagor-mill", "sinumerik-mill");
  EXPECT_NE(p.text.find("comp off, path_mode continuous, units metric, distance absolute, feed_mode per_minute"),
            std::string::npos)
      << p.text;
  EXPECT_EQ(p.text.find("plane xy"), std::string::npos) << p.text;  // the program says its plane itself
}

TEST(SafeStart, PowerOnFeedIsWritten) {
  const auto p =
      run_pass("safe_start", main_program("  block linear X 10\n"), structured_target(), "num-mill", "sinumerik-mill");
  EXPECT_NE(p.text.find("feed #1000"), std::string::npos) << p.text;
}

TEST(SafeStart, MotionOfPowerOnIsSaidAtTheHeadWhenABranchComesFirst) {  // feed at power-on there, rapid here
  const std::string behind = "  jump N10 if L[1] == 5\n  block modal X 10\n  N10 block rapid X 0\n";
  const auto p = run_pass("safe_start", main_program(behind), structured_target(), "num-mill", "fagor-mill");
  EXPECT_NE(p.text.find(", linear coded"), std::string::npos) << p.text;
  const std::string coded = "  jump N10 if L[1] == 5\n  block linear X 10\n  N10 block rapid X 0\n";
  const auto q = run_pass("safe_start", main_program(coded), structured_target(), "num-mill", "fagor-mill");
  EXPECT_EQ(q.text.find(", linear coded"), std::string::npos) << q.text;
}

}  // namespace
}  // namespace cnctrans::test
