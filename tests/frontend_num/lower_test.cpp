// NUM blocks -> IR. What the machine does is said by the IR text; sections are the reference's.
#include <gtest/gtest.h>

#include "tests/frontend_num/read.h"

namespace {

using namespace cnctrans;
using frontends::Reader;
using frontends::num::testing::body;
using frontends::num::testing::Outcome;
using frontends::num::testing::profile;
using frontends::num::testing::read;

/// The IR text of one line; a codes line when there are diagnostics.
std::string line(std::string_view text, const std::string& machine = "num-mill") {
  const Outcome o = read("%1\n" + std::string(text) + "\nM2\n", machine);
  std::string s = body(o);
  const auto end = s.rfind("end_program");
  if (end != std::string::npos) s.erase(s.rfind('\n', end) == std::string::npos ? 0 : s.rfind('\n', end));
  while (!s.empty() && s.back() == '\n') s.pop_back();
  std::string flat;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s[i] == '\n' && i + 1 < s.size() && s[i + 1] == '\n') continue;
    flat += s[i];
  }
  return o.codes.empty() ? flat : flat + " !" + o.codes;
}

TEST(NumLower, MotionWords) {  // 6.1, 6.2, 2.2
  EXPECT_EQ(line("N10 G0 X5 Y-3.50"), "N10 block rapid as \"G0\" X 5 Y -3.50");
  EXPECT_EQ(line("G X5"), "block rapid as \"G\" X 5");
  EXPECT_EQ(line("GO X5"), "block rapid as \"GO\" X 5 !NUM-010");
  EXPECT_EQ(line("X1 0"), "block modal X #10 !NUM-009");
  EXPECT_EQ(line("G1"), "block linear as \"G1\"");
  EXPECT_EQ(line("U5"), "opaque \"U5\" feature \"text.unread\" !NUM-006");
  EXPECT_EQ(line("X5 X6"), "opaque \"X5 X6\" feature \"text.unread\" !NUM-007");
  EXPECT_EQ(line("X100000"), "opaque \"X100000\" feature \"text.unread\" !NUM-008");
  EXPECT_EQ(line("G0 G1 X5"), "opaque \"G0 G1 X5\" feature \"text.unread\" !NUM-011");
  EXPECT_EQ(line("X5 I3"), "opaque \"X5 I3\" feature \"block.word\" !NUM-005");
}

TEST(NumLower, RotarySignIsADirection) {  // 6.12, 6.13
  EXPECT_EQ(line("G0 B-233"), "block rapid as \"G0\" B by_sign -233");
  EXPECT_EQ(line("G0 B-L10"), "block rapid as \"G0\" B by_sign (-L[10])");
  EXPECT_EQ(line("G0 A-9.3"), "block rapid as \"G0\" A -9.3");
  auto p = profile("num-mill");
  p.policies.rotary_signed_axes = "-";
  EXPECT_NE(body(read("%1\nG0 B-233\nM2\n", p)).find("B -233"), std::string::npos);
}

TEST(NumLower, MachineCoordinates) {  // 8.7
  EXPECT_EQ(line("G0 G52 Z"), "block rapid as \"G0\" in_frame machine Z #0");
  EXPECT_EQ(line("G52 G17 G90 G0 X540 Z650"),
            "block plane xy as \"G17\", distance absolute as \"G90\", rapid as \"G0\" in_frame machine X 540 Z 650");
  EXPECT_EQ(line("Z5 G52"), "opaque \"Z5 G52\" feature \"text.unread\" !NUM-012");
  EXPECT_NE(line("G91 G0 G52 Z5").find("!NUM-012"), std::string::npos);
  EXPECT_EQ(line("G91\nG0 G90 G52 Z5 G91").find("NUM-012"), std::string::npos);
}

TEST(NumLower, DistanceByPlaceInTheBlock) {  // 2.4, 6.10
  EXPECT_EQ(line("G91 X5"), "block distance incremental as \"G91\", modal X 5");
  EXPECT_EQ(line("G90 X5 G91 Y3"),
            "block distance absolute as \"G90\", distance incremental as \"G91\", modal X absolute 5 Y 3");
  EXPECT_EQ(line("G1 X7 G91 Y3"), "block linear as \"G1\" X 7 Y incremental 3, distance incremental after as \"G91\"");
  EXPECT_EQ(line("G59 X5 G91 Y3").find("!"), std::string::npos);
}

TEST(NumLower, Arcs) {  // 6.3
  EXPECT_EQ(line("G2 X10 Y0 I5 J0"),
            "block arc_cw as \"G2\" X 10 Y 0 centre X follows_distance modal 5 centre Y follows_distance modal 0");
  EXPECT_EQ(line("G3 X0 Y10 R10"), "block arc_ccw as \"G3\" X 0 Y 10 radius 10");
  EXPECT_EQ(line("G18 G2 X1 Z2 I3 K4"),
            "block plane zx as \"G18\", arc_cw as \"G2\" X 1 Z 2 centre Z follows_distance modal 4 centre X "
            "follows_distance modal 3");
  EXPECT_EQ(line("G3 X30 Y0 Z-12 I0 J0 K4"),
            "block arc_ccw as \"G3\" X 30 Y 0 Z -12 centre X follows_distance modal 0 centre Y follows_distance modal "
            "0 extra pitch 4");
  for (const char* bad : {"G2 X5 Y5", "G2 X5 Y5 I3", "G2 X5 Y5 R-3", "G2 X5 Y5 I1 J1 R3", "G3 X1 Y1 I0 J0 K-4"}) {
    EXPECT_NE(line(bad).find("!NUM-011"), std::string::npos) << bad;
  }
  auto p = profile("num-mill");
  p.options["num.g02_center"] = "incremental";
  EXPECT_NE(body(read("%1\nG2 X10 Y0 I5 J0\nM2\n", p)).find("centre X modal 5"), std::string::npos)
      << body(read("%1\nG2 X10 Y0 I5 J0\nM2\n", p));
}

TEST(NumLower, CentreWordsOfModalArcs) {
  EXPECT_EQ(line("G2 X5 Y0 R5\nX10 Y0 I7 J0"),
            "block arc_cw as \"G2\" X 5 Y 0 radius 5\n"
            "block modal X 10 Y 0 centre X follows_distance modal 7 centre Y follows_distance modal 0");
}

TEST(NumLower, OrderOfActionInABlock) {  // 4.1, 16
  EXPECT_EQ(line("T1 D1 M6"), "block tool 1 as \"T1\", tool_offset 1 as \"D1\", tool_change after as \"M6\"");
  EXPECT_EQ(line("X5 M5 M8 F200 S1000 M3 G95 G97 M0"),
            "block feed_mode per_rev as \"G95\", spindle_mode rpm as \"G97\", feed 200 as \"F200\", spindle 1000 as "
            "\"S1000\", "
            "coolant flood as \"M8\", spindle_run cw as \"M3\", modal X 5, spindle_run off after as \"M5\", stop after "
            "as \"M0\"");
  EXPECT_EQ(line("L1=5 G1 X L1 L2=L1+1"), "set L[1] = 5, L[2] = L[1] + 1\n& block linear as \"G1\" X L[1]");
}

TEST(NumLower, DwellAndFeed) {  // 6.5, 7
  EXPECT_EQ(line("G4 F1.5"), "block dwell 1.5 as \"G4\"");
  EXPECT_EQ(line("G4"), "opaque \"G4\" feature \"text.unread\" !NUM-008");
  EXPECT_EQ(line("G4 F2 X5").substr(0, 6), "opaque");
  EXPECT_EQ(line("G4 F200"), "opaque \"G4 F200\" feature \"text.unread\" !NUM-008");
  EXPECT_EQ(line("G92 S3000"), "block spindle_limit 3000 as \"S3000\"");
  EXPECT_EQ(line("G96 S80 X25", "num-lathe"), "block spindle_mode css as \"G96\", spindle 80 as \"S80\" !NUM-031");
  EXPECT_EQ(line("EC45 M19"), "block spindle_orient 45 as \"M19\"");
  EXPECT_EQ(line("G9 G1 X5"), "block exact_stop_block as \"G9\", linear as \"G1\" X 5");
}

TEST(NumLower, Frames) {  // 8
  EXPECT_EQ(line("G59 X10 Y L1"), "block frame shift translate replace_named by_distance_mode X 10 Y L[1] as \"G59\"");
  EXPECT_EQ(line("G53"), "block work_offset off as \"G53\"");
  EXPECT_EQ(line("G54"), "block work_offset #1 as \"G54\"");
  EXPECT_NE(line("ED30").find("frame rotation rotate replace angle 30"), std::string::npos) << line("ED30");
  EXPECT_NE(line("G59 X1 I5 J6 ED30").find("frame rotation rotate replace X 5 Y 6 angle 30"), std::string::npos)
      << line("G59 X1 I5 J6 ED30");
  EXPECT_NE(line("G51 X- Y+").find("frame mirror mirror replace_named X #1 Y #0"), std::string::npos)
      << line("G51 X- Y+");
  EXPECT_NE(line("G92 X5").find("frame preset translate preset X 5"), std::string::npos) << line("G92 X5");
  EXPECT_NE(line("G74").find("E[69000]:integer / #1000"), std::string::npos) << line("G74");
}

TEST(NumLower, Parameters) {  // 14.3
  EXPECT_EQ(line("E80000=L1/3"), "set E[80000] = trunc(L[1] / 3)");
  EXPECT_EQ(line("E60001=600"), "set sys(work_offset, X, \"E60001\", 1) = 600 / #1000");
  EXPECT_EQ(line("L1=E50001/1000"), "set L[1] = (sys(tool_length, none, \"E50001\", 1) * #1000) / 1000");
  EXPECT_EQ(line("G0 X E80000"), "block rapid as \"G0\" X (E[80000]:integer / #1000)");
  EXPECT_NE(line("E20001=1").find("!NUM-020"), std::string::npos);
  EXPECT_NE(line("L1=E12345").find("!NUM-018"), std::string::npos);
  EXPECT_EQ(line("L1=E30001"), "set L[1] = sys(other, none, \"E30001\")");
  EXPECT_NE(line("E30001=1").find("!NUM-044"), std::string::npos);
  EXPECT_NE(line("L25=1").find("!NUM-017"), std::string::npos);
  EXPECT_EQ(line("E32000=5"), "opaque \"E32000=5\" feature \"language.system_variable\" harmless !NUM-034");
}

TEST(NumLower, PrefAndDecAddUp) {  // 8.2
  EXPECT_EQ(line("E60000=200260 E60001=-5"),
            "set E[60000] = 200260, sys(work_offset, X, \"\", 1) = ((E[60000]:integer + E[60001]:integer) + "
            "E[60004]:integer) / #1000, E[60001] = -5, sys(work_offset, X, \"\", 1) = ((E[60000]:integer + "
            "E[60001]:integer) + E[60004]:integer) / #1000");
}

TEST(NumLower, Expressions) {  // 15, 19.6
  EXPECT_EQ(line("L1=2+3*5"), "set L[1] = (2 + 3) * 5");
  EXPECT_EQ(line("L1=L11+L14*C L10"), "set L[1] = (L[11] + L[14]) * cos(L[10])");
  EXPECT_EQ(line("X10+5*L1"), "block modal X ((10 + 5) * L[1]) !NUM-021");
}

TEST(NumLower, JumpsAndCalls) {  // 13.1, 13.2
  EXPECT_EQ(line("G79 N100"), "jump N100");
  EXPECT_EQ(line("N5 G79 L1<5 N010"), "N5 jump N10 if L[1] < 5");
  EXPECT_EQ(line("G79 L4=L3*2>8 N20"), "set L[4] = L[3] * 2\n& jump N20 if L[4] > 8");
  EXPECT_EQ(line("G79 N L1"), "jump N computed L[1]");
  EXPECT_EQ(line("G77 N30 N10 S3"), "repeat N10 N30 count 3");
  EXPECT_EQ(line("G77 N5"), "repeat N5 N5");
  EXPECT_EQ(line("G77 H12 S L2"), "call 12 count L[2]");
  EXPECT_EQ(line("G77 H9003 N1 N9999"), "call 9003 range N1 N9999");
  EXPECT_EQ(line("D3 G77 H5 M5"), "block tool_offset 3 as \"D3\"\n& call 5\n& block spindle_run off after as \"M5\"");
  for (const char* bad : {"G77", "G77 N1 N2 N3", "G77 N1 N2 S101", "G77 H5 S0"}) {
    EXPECT_NE(line(bad).find("!NUM-014"), std::string::npos) << bad << line(bad);
  }
  EXPECT_NE(line("G79 L1>5").find("!NUM-015"), std::string::npos);
  EXPECT_NE(line("G79 X5 N10").find("!NUM-013"), std::string::npos);
  EXPECT_NE(line("N32768 X5").find("!NUM-016"), std::string::npos);
}

TEST(NumLower, RangeOrderByPosition) {  // errata 13.2
  auto p = profile("num-mill");
  p.options["num.range_order"] = "position";
  EXPECT_NE(body(read("%1\nG77 N30 N10\nM2\n", p)).find("repeat N30 N10 order_free"), std::string::npos)
      << body(read("%1\nG77 N30 N10\nM2\n", p));
}

TEST(NumLower, DrillingCycles) {  // 11
  EXPECT_EQ(line("G81 X10 Y10 Z-5 ER2 EH1"),
            "block cycle hole drill reference 1 bottom -5 retract 2 approach_by_retract as \"G81\", modal X 10 Y 10");
  EXPECT_EQ(line("G81 Z-5"),
            "block cycle hole drill reference from_initial #0 bottom -5 retract from_initial #0 approach_by_retract as "
            "\"G81\"");
  EXPECT_NE(line("G82 Z-5 ER2 EF0.5").find("dwell_bottom 0.5"), std::string::npos) << line("G82 Z-5 ER2 EF0.5");
  EXPECT_NE(line("G83 Z-23 P10 Q6 ER1").find("pecks linear first 10 minimum 6 reapproach #1"), std::string::npos);
  EXPECT_NE(line("G83 Z-23 P10 ER1").find("pecks constant first 10"), std::string::npos);
  EXPECT_NE(line("G83 Z-23 ER1").find("hole drill"), std::string::npos);
  EXPECT_NE(line("G81 X1").find("!NUM-026"), std::string::npos);
  EXPECT_NE(line("G81 Z-1 P3").find("!NUM-027"), std::string::npos);
  EXPECT_NE(line("G86 Z-1 EC90").find("hole bore_shift"), std::string::npos);
  EXPECT_EQ(line("G83 Z-12 P10 ER1 \nX50\nG80 G97 S1000").substr(0, 5), "block");
}

TEST(NumLower, DepthOfACycleBesideIncrements) {  // 2.4, 11.1
  EXPECT_NE(line("G91 G81 X5 Z-3").find("!NUM-026"), std::string::npos);
  EXPECT_NE(line("G91 G81 X5 G90 Z-3 G91 ER2").find("!NUM-026"), std::string::npos);
  const std::string s = line("G91\nG81 X5 G90 Z-3 ER2 G91");
  EXPECT_EQ(s.find("!"), std::string::npos) << s;
  EXPECT_NE(s.find("bottom -3"), std::string::npos) << s;
}

TEST(NumLower, WordsOfAnActiveCycle) {  // 11.1, 26.6
  const std::string to_plane = line("G81 X1 Y1 Z-5 ER2\nER10\nX5 ER20");
  EXPECT_NE(to_plane.find("rapid once Z absolute 10"), std::string::npos) << to_plane;
  EXPECT_NE(to_plane.find("cycle hole drill reference 20 bottom -5 retract 20 approach_by_retract, modal X 5"),
            std::string::npos)
      << to_plane;
  EXPECT_NE(line("G81 X1 Z-5\nZ-8 ER3").find("!NUM-026"), std::string::npos);
  EXPECT_NE(line("G81 X1 Z-5\nG1 X5").find("!NUM-026"), std::string::npos);
  EXPECT_NE(line("ER3").find("!NUM-005"), std::string::npos);
}

TEST(NumLower, LatheWords) {  // 12, 27.1
  const std::string arc = line("G2 X40 Z-5 I30 K-5", "num-lathe");
  EXPECT_NE(arc.find("centre X follows_distance modal 30"), std::string::npos) << arc;
  EXPECT_EQ(line("G83 Z-20 P5 ER2", "num-lathe").find("axis Z") == std::string::npos, false)
      << line("G83 Z-20 P5 ER2", "num-lathe");
  EXPECT_EQ(line("G33 X10 Z-5 K1 P1 S4", "num-lathe"),
            "block cycle once named \"thread.chased\" (\"x_end\" 10, \"z_end\" -5, \"pitch\" 1, \"depth\" 1, "
            "\"passes\" 4) as \"G33\"");
  EXPECT_NE(line("G33 X10 Z-5 K1", "num-lathe").find("!NUM-004"), std::string::npos);
  EXPECT_NE(line("G91 G33 X10 Z-5 K1 P1", "num-lathe").find("!NUM-026"), std::string::npos);
  EXPECT_NE(line("G33 X10 Z-5 K1").find("!NUM-002"), std::string::npos);
}

TEST(NumLower, ContourOfARoughingCycleIsNoMove) {  // 12.3
  const Outcome o = read("%1\nG64 N10 N20 I1 K0.5 P3\nX80 Z0\nX80 Z50\nG80 G97 S1000\nG0 X5\nM2\n", "num-lathe");
  EXPECT_EQ(o.codes, "NUM-040 NUM-040");
  const std::string s = body(o);
  EXPECT_NE(s.find("opaque \"X80 Z50\" feature \"cycle.turning\""), std::string::npos) << s;
  EXPECT_NE(s.find("rapid as \"G0\" X 5"), std::string::npos);
}

TEST(NumLower, LinesByAngle) {  // 10.2, 10.3
  EXPECT_EQ(line("G1 EA45 X20"), "block linear as \"G1\" X 20 extra line_angle 45");
  EXPECT_EQ(
      line("G1 EA30 EX40"),
      "block linear as \"G1\" extra polar_radius 40 polar_angle 30 polar_mode absolute polar_angle_mode absolute");
  EXPECT_EQ(line("G1 EA30 ES"), "block opaque_word \"ES\" as \"ES\", linear as \"G1\" extra line_angle 30");
  for (const char* refused :
       {"G91 G1 EA30 EX L1", "G1 EA30", "G1 EA30 X5 Y6", "G1 EA30 ES ET", "G1 X5 Y5 E+", "G91 G1 X5 ET"})
    EXPECT_NE(line(refused).find("!NUM-043"), std::string::npos) << refused;
  EXPECT_NE(line("G2 EA30 X5 R9").find("!NUM-004"), std::string::npos);
}

TEST(NumLower, ThreadSegments) {  // 12.2
  EXPECT_EQ(line("G38 Z-20 K1.5", "num-lathe"), "block thread as \"G38\" once Z -20 extra lead 1.5 lead_axis Z");
  for (const char* refused : {"G38 Z-20", "G38 K2", "G38 Z-20 K0", "G38 G1 Z-20 K1"})
    EXPECT_NE(line(refused, "num-lathe").find("!NUM-011"), std::string::npos) << refused;
  EXPECT_NE(line("G38 Z-20 K1.5").find("!NUM-002"), std::string::npos);
}

TEST(NumLower, EqualPecks) {  // 11: ES pecks over the depth from ER to Z, (2 - -8) / 4
  EXPECT_NE(line("G83 X10 Z-8 ER2 ES4").find("pecks constant first #2.5"), std::string::npos)
      << line("G83 X10 Z-8 ER2 ES4");
  for (const char* refused : {"G83 X1 Z-8 ES4", "G83 X1 Z-8 ER2 ES2.5", "G83 X1 Z-8 ER2 ES2 P1", "G81 X1 Z-8 ER2 ES2"})
    EXPECT_NE(line(refused).find("!NUM-027"), std::string::npos) << refused;
}

TEST(NumLower, ShiftByParameter) {  // 14.3: E6x005 in micrometres
  EXPECT_NE(line("E61005=2500").find("Y radius #2.5"), std::string::npos) << line("E61005=2500");
  EXPECT_NE(line("L1=5 E61005=L1").find("!NUM-019"), std::string::npos);
}

TEST(NumLower, ToolDataWithoutEffectIsANumber) {  // 14.3
  EXPECT_EQ(line("E55004=3"), "set E[55004] = 3 !NUM-041");
  EXPECT_NE(line("L1=E52000/1000").find("set L[1]"), std::string::npos);
}

TEST(NumLower, MacrosThatTheFileBringsAlong) {  // 13.7: X is 'X = L923, EA is 'EA = L926
  const Outcome o = read("%1\nG123 X5 EA2\nM2\n%10123\nZ L923\n");
  EXPECT_EQ(o.codes, "") << o.messages;
  EXPECT_NE(body(o).find("set L[923] = 5, L[926] = 2"), std::string::npos) << body(o);
  EXPECT_NE(body(o).find("call 10123"), std::string::npos) << body(o);
  EXPECT_NE(read("%1\nG124 X5\nM2\n%10123\nZ L923\n").codes.find("NUM-003"), std::string::npos);
  EXPECT_NE(read("%1\nG123 M3\nM2\n%10123\nZ L923\n").codes.find("NUM-005"), std::string::npos);
}

TEST(NumLower, Corners) {  // 10.1
  EXPECT_EQ(line("G1 X40 EB2"), "block corner round 2 as \"EB2\", linear as \"G1\" X 40");
  EXPECT_EQ(line("G1 X40 EB-1.50"), "block corner chamfer_leg 1.50 as \"EB-1.50\", linear as \"G1\" X 40");
  EXPECT_EQ(line("X40 EA30").find("!"), std::string::npos);
}

TEST(NumLower, MessagesAndSymbols) {  // 14.4, 18
  EXPECT_EQ(line("N9 $ TOOL SHORT !!"), "N9 message show (\"TOOL SHORT !!\")");
  EXPECT_EQ(line("$"), "message clear");
  EXPECT_EQ(line("M0 $0 LOAD"),
            "message show (\"LOAD\")\n& block spindle_run off after as \"M0\", stop after as \"M0\"");
  EXPECT_EQ(line("$1 TO PLC"), "opaque \"$1 TO PLC\" feature \"language.statement\" harmless !NUM-035");
  EXPECT_EQ(line("VAR\n[A]=5 [B]\nENDV\nL1=[A]*2"),
            "declare real in v \"[A]\" = (#5\"5\")\n& declare real in v \"[B]\"\nset L[1] = v.\"[A]\" * 2");
  EXPECT_NE(line("L1=[A]").find("!NUM-025"), std::string::npos);
  EXPECT_NE(line("L1=[.IRX(1)]").find("!NUM-024"), std::string::npos);
}

TEST(NumLower, StructuredStatements) {  // 13.9
  const std::string s = line(
      "IF L1=5 THEN\nX1\nELSE\nX2\nENDI\nFOR L1=1 TO 3 DO\nX L1\nENDF\nREPEAT\nL1=L1-1\nUNTIL L1<=0\nWHILE L1<2 "
      "DO\nEXIT\nENDW");
  EXPECT_NE(s.find("if L[1] == 5 {"), std::string::npos) << s;
  EXPECT_NE(s.find("} else {"), std::string::npos);
  EXPECT_NE(s.find("for "), std::string::npos);
  EXPECT_NE(s.find("until"), std::string::npos);
  EXPECT_NE(s.find("while L[1] < 2"), std::string::npos);
  EXPECT_NE(s.find("exit"), std::string::npos);
  EXPECT_NE(line("ENDI").find("!NUM-022"), std::string::npos);
  EXPECT_NE(line("EXIT").find("!NUM-022"), std::string::npos);
  EXPECT_NE(read("%1\nIF L1=5 THEN\nX1\nM2\n").codes.find("NUM-022"), std::string::npos);
  auto p = profile("num-mill");
  p.options["num.family"] = "7xx";
  EXPECT_EQ(read("%1\nG2 X1 Y0 I F J0\nM2\n", p).codes, "");
}

TEST(NumLower, SeveralProgramsInAFile) {  // 2.5, 3
  const Outcome o = read("%\n%12 (MAIN) (rest)\nG77 H5\nM2\n\n%5\n(sub)\nX5\n%\n");
  ASSERT_EQ(o.program.routines.size(), 2U) << o.messages;
  EXPECT_EQ(o.codes, "");
  EXPECT_EQ(o.program.routines[0].name.number, 12);
  EXPECT_EQ(o.program.routines[0].title, "MAIN");
  EXPECT_EQ(o.program.routines[0].header.comments.size(), 1U);
  EXPECT_EQ(o.program.routines[0].kind, ir::RoutineKind::main);
  EXPECT_EQ(o.program.routines[1].name.number, 5);
  EXPECT_EQ(o.program.routines[1].kind, ir::RoutineKind::sub);
  EXPECT_EQ(o.program.files[0].leader, std::vector<std::string>{"%"});
  EXPECT_EQ(o.program.files[0].trailer, "%\n");
  EXPECT_EQ(read("%1\nM2\n%1\nM2\n").codes, "NUM-036");
  const Outcome bare = read("G0 X5\n");
  EXPECT_EQ(bare.program.routines.at(0).name.number, 7);  // the file is 7.xpi
  EXPECT_EQ(bare.codes, "NUM-037");
  EXPECT_EQ(read("").program.routines.size(), 1U);
}

TEST(NumLower, WhatIsNotCarriedIsRefusedAndKept) {
  for (const auto& [text, code] : std::vector<std::pair<std::string, std::string>>{{"G151 EA0", "NUM-003"},
                                                                                   {"G501", "NUM-002"},
                                                                                   {"G6", "NUM-004"},
                                                                                   {"G45 X1 Y1 Z-5 EX3 P1", "NUM-027"},
                                                                                   {"G21", "NUM-002"},
                                                                                   {"G1 X5 R-", "NUM-005 NUM-028"},
                                                                                   {"@X=U", "NUM-023"},
                                                                                   {"PULL L1 - L5", "NUM-023"},
                                                                                   {"L1=$0 N", "NUM-023"},
                                                                                   {"G76 N10 N20", "NUM-004"},
                                                                                   {"G10 G0 X5 N10", "NUM-045"},
                                                                                   {"X5 #", "NUM-001"}}) {
    const Outcome o = read("%1\n" + text + "\nM2\n");
    EXPECT_NE(body(o).find("opaque \"" + text), std::string::npos) << text << "\n" << body(o);
    EXPECT_NE(code.find(o.codes), std::string::npos) << text << ": " << o.codes;
  }
}

TEST(NumLower, BothReadersAgree) {
  const Outcome o =
      read("%1\n/N010 G 01 X 5.50Y-.5 (a)(b)\nN2\n (c)\n\n  X5 (m) Y3\nVAR\nENDV\nIF100\nG79 N10\nN 10 M 02\n",
           profile("num-mill"));
  EXPECT_EQ(o.codes.find("CNC-READERS"), std::string::npos) << o.messages;
}

TEST(NumLower, StreamTakesPlainLines) {
  const auto p = profile("num-mill");
  const auto frontend = frontends::num::make_frontend();
  const auto stream = frontend->stream(1, {Reader::scanner, &p}, "dir/44.xpi");
  ir::Statement s;
  Diagnostics d;
  const auto next = [&](std::string_view text, std::uint32_t n) {
    SourceLine l;
    l.text = text;
    l.number = n;
    return stream->read(l, s, d);
  };
  using frontends::StreamLine;
  EXPECT_EQ(next("%12 (PART)", 1), StreamLine::no_statement);
  EXPECT_EQ(stream->frame().routines.at(0).title, "PART");
  EXPECT_EQ(next("G1 X5 F100 (go)", 2), StreamLine::statement);
  EXPECT_EQ(ir::to_text(s, stream->frame()), "block feed 100 as \"F100\", linear as \"G1\" X 5 ; \"go\"\n");
  EXPECT_EQ(next("", 3), StreamLine::statement);
  EXPECT_EQ(next("M2", 4), StreamLine::program_end);
  EXPECT_EQ(next("L1=5", 5), StreamLine::needs_program);
  EXPECT_EQ(next("G79 N5", 6), StreamLine::needs_program);
}

// Found by the fuzz target: the look for latched positions went behind the end of the text.
TEST(NumLower, TextsThatEndInsideOfAParameter) {
  for (const std::string_view end : {"E", "E7", "E70", "E6", "E700", "E7000", "E70001"}) {
    const auto o = read("%1\nG0 X1\nL1=" + std::string(end));
    EXPECT_EQ(o.program.routines.size(), 1U) << end;
    EXPECT_NE(o.codes, "") << end;
  }
}

}  // namespace
