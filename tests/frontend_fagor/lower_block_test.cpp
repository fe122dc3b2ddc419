// ISO blocks to IR: what each word and function means (sections of the programming manual in brackets).
#include <gtest/gtest.h>

#include "tests/frontend_fagor/support.h"

namespace cnctrans::fagor {
namespace {

using test::line;
using test::read;

TEST(FagorBlock, MotionAndTechnology) {
  EXPECT_EQ(line("N10 G1 X10.500 Z-3 F150"),
            "N10 block feed 150 zero_is_maximum as \"F150\", linear as \"G1\" X 10.500 Z -3");
  EXPECT_EQ(line("X5"), "block modal X 5");
  EXPECT_EQ(line("G00 Y"), "block rapid as \"G00\" Y #0");  // a bare word is 0 (ch. 2)
  EXPECT_EQ(line("T1 D18 M6"), "block tool 1 as \"T1\", tool_change as \"M6\", tool_offset 18 as \"D18\"");
  EXPECT_EQ(line("T1 D1", "fagor-lathe"), "block tool 1 changes as \"T1\", tool_offset 1 as \"D1\"");
  EXPECT_EQ(line("S1200 M3"), "block spindle 1200 as \"S1200\", spindle_run cw as \"M3\"");
  EXPECT_EQ(line("M19 S30"), "block spindle_orient 30 as \"M19\"");
}

TEST(FagorBlock, OrderInTheBlock) {  // 5.7: M5, M0, M1, M30 after the motion, M3 before it
  EXPECT_EQ(line("X1 M5 M8"), "block coolant flood as \"M8\", modal X 1, spindle_run off after as \"M5\"");
  EXPECT_EQ(line("X1 M30"), "block modal X 1\n& end_program returns_from_sub as \"M30\"");
  EXPECT_EQ(line("M30"), "end_program returns_from_sub as \"M30\"");
  EXPECT_EQ(line("M155"), "block machine_function 155 as \"M155\"");
}

TEST(FagorBlock, Arcs) {
  EXPECT_EQ(line("G2 X20 Y0 I5"), "block arc_cw as \"G2\" X 20 Y 0 centre X 5");  // 6.3: from the start
  EXPECT_EQ(line("G6 G3 X0 Y0 I10 J0"),
            "block arc_ccw as \"G3\" X 0 Y 0 centre X absolute modal 10 centre Y absolute modal 0");
  EXPECT_EQ(line("G2 X10 Y10 R-12.5"), "block arc_cw as \"G2\" X 10 Y 10 radius -12.5");
  EXPECT_EQ(line("X10 Y10 R5"), "block modal X 10 Y 10 radius 5");
  EXPECT_EQ(line("G18 G2 Z1 X2 K3 I4"), "block plane zx as \"G18\", arc_cw as \"G2\" Z 1 X 2 centre X 4 centre Z 3");
  EXPECT_EQ(line("G17 G2 X10 Y0 I5 J0 Z-5 K2.5"),
            "block plane xy as \"G17\", arc_cw as \"G2\" X 10 Y 0 Z -5 centre X 5 centre Y 0 extra pitch 2.5");
  EXPECT_EQ(line("G8 X5 Y5"), "block arc_tangent as \"G8\" once X 5 Y 5");
  EXPECT_EQ(line("G3 G36 R5 X20 Y40 R15"),
            "block corner round 5 with as \"G36\", arc_ccw as \"G3\" X 20 Y 40 radius 15");
  EXPECT_EQ(line("G36 R5 G3 X20 Y40 R12"),
            "block corner round 5 with as \"G36\", arc_ccw as \"G3\" X 20 Y 40 radius 12");
}

TEST(FagorBlock, LatheArcIsRadiusAndEndFollowsTheMode) {  // 6.3 and the table of radius and diameter
  EXPECT_EQ(line("G3 X90 Z110 I50 K0", "fagor-lathe"), "block arc_ccw as \"G3\" X 90 Z 110 centre X 50 centre Z 0");
  EXPECT_EQ(line("G6 G3 X90 Z110 I180 K60", "fagor-lathe"),
            "block arc_ccw as \"G3\" X 90 Z 110 centre X absolute modal 180 centre Z absolute modal 60");
}

TEST(FagorBlock, DiameterModeCountsFromTheNextBlock) {  // 3.5
  EXPECT_EQ(line("G152 X10", "fagor-lathe"), "block modal X 10, diameter radius after as \"G152\"");
  EXPECT_EQ(line("G151"), "opaque \"G151\" feature \"text.unread\" | FAG-003");  // lathe only
}

TEST(FagorBlock, TheSameCodeMeansDifferentThingsOnTheTwoModels) {
  EXPECT_EQ(line("G96", "fagor-lathe"), "block spindle_mode css as \"G96\"");
  EXPECT_EQ(line("G96"), "block feed_point contact as \"G96\"");
  EXPECT_EQ(test::read("G81 X1 Z2 Q3 R4 C1", "fagor-lathe").codes(), "");
  EXPECT_NE(test::read("G81 X1 Z2 Q3 R4 C1").codes(), "");  // a drilling cycle there
  EXPECT_EQ(test::read("G43 Z1", "fagor-lathe").codes(), "FAG-003");
}

TEST(FagorBlock, Dwell) {  // 7.1, 7.2: hundredths of a second; without a time a stop of the look-ahead
  EXPECT_EQ(line("G04 K250"), "block dwell 250 scale 0.01 as \"G04\"");
  EXPECT_EQ(line("G4 KP100"), "block dwell P[100] scale 0.01 as \"G4\"");
  EXPECT_EQ(line("G4"), "block preparation_stop as \"G4\"");
  EXPECT_EQ(line("G4 K0"), "block preparation_stop as \"G4\"");
}

TEST(FagorBlock, Offsets) {
  EXPECT_EQ(line("G55"), "block work_offset #2 as \"G55\"");
  EXPECT_EQ(line("G159 N7"), "block work_offset 7");
  EXPECT_EQ(line("G53 G0 Z0"), "block rapid as \"G0\" in_frame machine Z 0");
  EXPECT_EQ(line("G92 S2000"), "block spindle_limit 2000 as \"S2000\"");
  EXPECT_EQ(line("G158 X10"), "block frame shift translate replace_named X 10 as \"G158\"");
  EXPECT_EQ(line("G158"), "block frame shift translate clear as \"G158\"");
  // G92 ends with the next G54
  EXPECT_EQ(line("G92 X0 Y5\nG54"),
            "block frame preset translate preset X 0 Y 5 as \"G92\"\nblock work_offset #1 as \"G54\", frame preset "
            "translate clear");
}

TEST(FagorBlock, MirrorScaleRotation) {
  EXPECT_EQ(
      line("G11 G12"),
      "block frame mirror mirror replace_named X #1 as \"G11\", frame mirror mirror replace_named Y #1 as \"G12\"");
  EXPECT_EQ(line("G10"), "block frame mirror mirror clear as \"G10\"");
  EXPECT_EQ(test::read("G72 S2").codes(), "");
  EXPECT_EQ(test::read("G72 X2 S2").codes(), "FAG-006");
  EXPECT_EQ(test::read("G73 Q30 I5").codes(), "FAG-014");
}

TEST(FagorBlock, DrillingCycles) {  // 25.2, 25.3: Z reference plane, I bottom, G83: J pecks of I
  EXPECT_EQ(
      line("G81 G99 X10 Y5 Z2 I-5"),
      "block cycle hole drill reference distance_mode 2 bottom distance_mode otherwise from_reference -5 as \"G81\", "
      "retract_plane reference as \"G99\", rapid once X 10 Y 5");
  EXPECT_NE(line("G0 X1\nG81 X10 Z2 I-5").find(", modal X 10"), std::string::npos) << line("G0 X1\nG81 X10 Z2 I-5");
  EXPECT_EQ(line("G83 Z2 I-4 J3"),
            "block cycle hole peck_full reference distance_mode 2 bottom from_reference #-12 pecks count first #4 "
            "count 3 reapproach #1 as \"G83\"");
  EXPECT_NE(line("G82 Z2 I-5 K50").find("dwell_bottom 50 dwell_scale 0.01"), std::string::npos)
      << line("G82 Z2 I-5 K50");
  EXPECT_EQ(test::read("G82 Z2 I-5").codes(), "FAG-014");
  EXPECT_EQ(test::read("G81 X1 Y1 Z2").codes(), "FAG-014");
  EXPECT_EQ(test::read("G83 Z2 I-5 J1.5").codes(), "FAG-014");
  // in ZX the longitudinal axis is Y
  EXPECT_NE(line("G18\nG81 Z1 X2 Y3 I-5").find("cycle hole drill reference distance_mode 3"), std::string::npos)
      << line("G18\nG81 Z1 X2 Y3 I-5");
}

TEST(FagorBlock, RepeatCount) {  // 2.7
  EXPECT_EQ(line("G91 X10 N3"), "block distance incremental as \"G91\", modal X 10, times 3");
  EXPECT_EQ(line("X10 NP110"), "block modal X 10, times P[110]");
  EXPECT_EQ(test::read("M3 N3").codes(), "FAG-016");
  EXPECT_EQ(test::read("G41 N20 X5").codes(), "FAG-008");  // collision detection, not a count
}

TEST(FagorBlock, Computed) {
  EXPECT_EQ(line("XP100 Y-P101 FP115"), "block feed P[115] zero_is_maximum as \"FP115\", modal X P[100] Y (-P[101])");
  EXPECT_EQ(test::read("GP1 X5").codes(), "FAG-012");
  EXPECT_EQ(test::read("XP26").codes(), "FAG-018");  // 26..99 do not exist
}

TEST(FagorBlock, RotaryWords) {  // 3.7
  EXPECT_EQ(line("G1 A-90"), "block linear as \"G1\" A -90 | FAG-035");
  EXPECT_EQ(test::read("A10\nA20\nB5").codes(), "FAG-035");
}

TEST(FagorBlock, Refusals) {
  EXPECT_EQ(test::read("G777").codes(), "FAG-003");
  EXPECT_EQ(test::read("G0 G1 X5").codes(), "FAG-006");
  EXPECT_EQ(test::read("X1 X2").codes(), "FAG-005");
  EXPECT_EQ(test::read("U5").codes(), "FAG-009");
  EXPECT_EQ(test::read("G1 X5 I3").codes(), "FAG-004");
  EXPECT_EQ(test::read("G1 X5 L3").codes(), "FAG-004");
  EXPECT_EQ(test::read("O0001").codes(), "FAG-004");
  EXPECT_EQ(test::read("X100000").codes(), "FAG-013");
  EXPECT_EQ(test::read("G28 YA").codes(), "FAG-008");
  EXPECT_EQ(test::read("G28 Y").codes(), "FAG-014");
  EXPECT_EQ(test::read("G28 Y1 A").codes(), "FAG-004 FAG-008");
  EXPECT_EQ(test::read("G36 X5").codes(), "FAG-014");
  EXPECT_EQ(test::read("G6 G2 X5").codes(), "FAG-014");
  EXPECT_EQ(test::read("G33 Z-5").codes(), "FAG-014");
  EXPECT_EQ(test::read("X1 #").codes(), "FAG-002");
  const auto r = test::read("X1 #");
  ASSERT_EQ(r.diagnostics.all().size(), 1U);
  EXPECT_EQ(r.diagnostics.all()[0].span.column, 4U);
}

TEST(FagorBlock, Order) {
  EXPECT_EQ(test::read("X5 G1").codes(), "FAG-010");
  EXPECT_EQ(test::read("F100 X5").codes(), "FAG-010");
  EXPECT_EQ(test::read("g1 x5").codes(), "FAG-011");
  EXPECT_EQ(test::read("G54 G0 X5").codes(), "FAG-006");
  EXPECT_FALSE(test::read("G54 G0 X5").diagnostics.has_errors());
}

TEST(FagorBlock, HoleCyclesOfTheMill) {  // 25.3, 28.6
  EXPECT_EQ(
      line("G69 Z2 I-20 B5"),
      "block cycle hole peck_full reference distance_mode 2 bottom distance_mode otherwise from_reference -20 pecks "
      "constant first 5 reapproach #1 as \"G69\"");
  EXPECT_EQ(
      line("G69 Z2 I-20 B5 C0.5 D2 K30 L1 R.8"),
      "block cycle hole peck_full surface from_reference #-2 reference distance_mode 2 bottom distance_mode otherwise "
      "from_reference -20 dwell_bottom 30 dwell_scale 0.01 pecks geometric first 5 degression .8 minimum 1 reapproach "
      "0.5 first_from_surface dwell 30 as \"G69\"");
  EXPECT_EQ(line("G69 Z2 I-20"), "opaque \"G69 Z2 I-20\" feature \"text.unread\" | FAG-014");
  EXPECT_EQ(line("G69 Z2 I-20 B5 J3"), line("G69 Z2 I-20 B5"));     // without H: to the reference plane
  EXPECT_EQ(line("G69 Z2 I-20 B5 H4 J1"), line("G69 Z2 I-20 B5"));  // every peck is a J-th one
  EXPECT_EQ(line("G69 Z2 I-20 B5 H4 J2"), "opaque \"G69 Z2 I-20 B5 H4 J2\" feature \"cycle.hole\" | FAG-007");
  EXPECT_EQ(line("G69 Z2 I-20 B5 H4"), "opaque \"G69 Z2 I-20 B5 H4\" feature \"cycle.hole\" | FAG-007");
  EXPECT_EQ(line("G69 Z2 I-20 B0"), "opaque \"G69 Z2 I-20 B0\" feature \"text.unread\" | FAG-013");
  EXPECT_EQ(line("G84 X10 Z2 I-15 K20 F500 S500"),
            "block cycle hole tap_floating reference distance_mode 2 bottom distance_mode otherwise from_reference -15 "
            "dwell_bottom 20 dwell_scale 0.01 as \"G84\", feed 500 zero_is_maximum as \"F500\", spindle 500 as "
            "\"S500\", rapid "
            "once X 10");
  EXPECT_EQ(line("G84 Z2 I-15 R1").substr(0, 20), "block cycle hole tap");
  EXPECT_EQ(line("G84 Z2 I-15 R2"), "opaque \"G84 Z2 I-15 R2\" feature \"cycle.hole\" | FAG-007");
  EXPECT_EQ(line("G85 Z2 I-15").substr(0, 21), "block cycle hole ream");
  EXPECT_EQ(line("G86 Z2 I-15 K5").substr(0, 26), "block cycle hole bore_stop");
  EXPECT_EQ(line("G89 Z2 I-15 K5").substr(0, 22), "block cycle hole bore ");
}

TEST(FagorBlock, KeptAsText) {  // understood, not carried out: no error, and the text is whole
  EXPECT_EQ(line("G29 X ; back"), "opaque \"G29 X\" feature \"language.synchronised\" harmless ; \" back\" | FAG-008");
  EXPECT_EQ(line("M45 SP1"), "opaque \"M45 SP1\" feature \"block.word\" | FAG-007");
  EXPECT_EQ(line("GP101 X5"), "opaque \"GP101 X5\" feature \"block.word\" | FAG-012");
  EXPECT_EQ(line("( WKEY ) ; waits"), "opaque \"( WKEY )\" feature \"beside.data\" ; \" waits\" | FAG-022");
  EXPECT_EQ(line("(PROBE 3,X50,Z0,B5,F100)"), "opaque \"(PROBE 3,X50,Z0,B5,F100)\" feature \"motion.probe\" | FAG-022");
  EXPECT_EQ(line("(ESBLK)"), "opaque \"(ESBLK)\" feature \"language.statement\" harmless | FAG-023");
  EXPECT_EQ(line("G1 X5 P3=2"), "opaque \"G1 X5 P3=2\" feature \"text.unread\" | FAG-004");
  EXPECT_EQ(read("M30\n(SUB 183)\nX1\n(RET)\n(SUB 1)\nG183 P1=12.3 P2=6\n(RET)\n").codes(), "");
}

}  // namespace
}  // namespace cnctrans::fagor
