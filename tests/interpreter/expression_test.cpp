// Values of expressions, variables and what --vars reports.
#include "tests/interpreter/run_ir.h"

namespace cnctrans::interpreter {
namespace {

/// JSON of R1 after `set R[1] = e`.
std::string value(const std::string& e, const std::string& before = {}) {
  const auto r = run_lines(before + "\nset R[1] = " + e);
  if (!r.lines.empty()) return r.lines.back();
  return r.variables.at("R1");
}

TEST(Expression, Arithmetic) {
  EXPECT_EQ(value("2 + 3 * 5"), "17");
  EXPECT_EQ(value("7 / 2"), "3.5");
  EXPECT_EQ(value("7 div -2"), "-3");
  EXPECT_EQ(value("-7 mod 3"), "-1") << "sign of the dividend";
  EXPECT_EQ(value("7.5 mod 2"), "1.5");
  EXPECT_EQ(value("2 pow 10"), "1024");
  EXPECT_EQ(value("(-2) pow 2"), "4");
  EXPECT_EQ(value("0.1 + 0.2"), "0.30000000000000004");
}

TEST(Expression, ComparisonsAndLogicGiveOneOrZero) {
  EXPECT_EQ(value("2 > 1"), "1");
  EXPECT_EQ(value("2 != 2"), "0");
  EXPECT_EQ(value("(2 > 1) and (1 > 2)"), "0");
  EXPECT_EQ(value("(2 > 1) xor (1 > 2)"), "1");
  EXPECT_EQ(value("not 5"), "0");
  EXPECT_EQ(value("12 bitand 10"), "8");
  EXPECT_EQ(value("12 bitxor 10"), "6");
  EXPECT_EQ(value("bitnot 0"), "-1");
}

TEST(Expression, RelativeComparison) {
  // 61.02 - 61.01 is 0.010000000000005116: more than 0.01 exactly, equal within 1e-12 of the size.
  const std::string set = "set R[2] = 61.02, R[3] = 61.01, R[4] = 0.01";
  EXPECT_EQ(value("abs(R[2] - R[3]) > R[4]", set), "1");
  EXPECT_EQ(value("abs(R[2] - R[3]) >~ R[4]", set), "0");
  EXPECT_EQ(value("abs(R[2] - R[3]) ==~ R[4]", set), "1");
  EXPECT_EQ(value("abs(R[2] - R[3]) <=~ R[4]", set), "1");
}

TEST(Expression, FunctionsInDegrees) {
  EXPECT_EQ(value("sin(30)"), "0.5");
  EXPECT_EQ(value("cos(90)"), "0");
  EXPECT_EQ(value("sin(180)"), "0");
  EXPECT_EQ(value("cos(-60)"), "0.5");
  EXPECT_EQ(value("tan(45)"), "1");
  EXPECT_EQ(value("tan(135)"), "-1");
  EXPECT_EQ(value("asin(0.5)"), "30");
  EXPECT_EQ(value("acos(0.5)"), "60");
  EXPECT_EQ(value("atan(1)"), "45");
  EXPECT_EQ(value("atan2(1, 0)"), "90");
  EXPECT_EQ(value("atan2(0, -1)"), "180");
  EXPECT_EQ(value("atan2(-1, -1)"), "-135");
  EXPECT_EQ(value("arg(0, -1)"), "270") << "arg(x, y) in [0, 360)";
  EXPECT_EQ(value("arg(1, 1)"), "45");
}

TEST(Expression, RoundingFunctions) {
  EXPECT_EQ(value("trunc(-2.7)"), "-2");
  EXPECT_EQ(value("ceil(-2.7)"), "-2");
  EXPECT_EQ(value("floor(-2.2)"), "-3");
  EXPECT_EQ(value("round(2.5)"), "3");
  EXPECT_EQ(value("round(-2.5)"), "-3");
  EXPECT_EQ(value("round.up(-2.5)"), "-2");
  EXPECT_EQ(value("round.even(2.5)"), "2");
  EXPECT_EQ(value("min(3, 2)"), "2");
  EXPECT_EQ(value("bound(0, 10, 12)"), "10");
  EXPECT_EQ(value("sign(-3)"), "-1");
  EXPECT_EQ(value("to_bcd(123)"), "291");
  EXPECT_EQ(value("from_bcd(291)"), "123");
}

TEST(Expression, FaultsAreCoded) {
  EXPECT_EQ(value("1 / 0"), "end error RUN-001");
  EXPECT_EQ(value("1 mod 0"), "end error RUN-001");
  EXPECT_EQ(value("(1 > 2) and (1 / 0 > 1)"), "end error RUN-001") << "no short circuit";
  EXPECT_EQ(value("sqrt(-1)"), "end error RUN-002");
  EXPECT_EQ(value("ln(0)"), "end error RUN-002");
  EXPECT_EQ(value("asin(1.1)"), "end error RUN-002");
  EXPECT_EQ(value("tan(90)"), "end error RUN-002");
  EXPECT_EQ(value("(-2) pow 0.5"), "end error RUN-002");
  EXPECT_EQ(value("10 pow 400"), "end error RUN-003");
  EXPECT_EQ(value("R[300]"), "end error RUN-004");
  EXPECT_EQ(value("R[R[2] - 1]"), "end error RUN-004");
  EXPECT_EQ(value("P[50]"), "end error RUN-004") << "between the segments of the space";
  EXPECT_EQ(value("V.UNKNOWN"), "end error RUN-004");
  EXPECT_EQ(value("sys(other, none, \"PLC7\")"), "end error RUN-007");
  EXPECT_EQ(value("\"text\""), "end error RUN-006");
}

TEST(Expression, ErrorInAWordStopsBeforeTheMove) {
  EXPECT_THAT(lines_of("block rapid X 1\nblock rapid X 5 Y (1 / R[1])"), ElementsAre("rapid X1", "end error RUN-001"));
}

TEST(Expression, WordsAndIndirection) {
  EXPECT_THAT(lines_of("set R[1] = 5, R[5] = 7\nblock feed (R[1] * 10), linear X (R[R[1]]) Y (-R[1])"),
              ElementsAre("linear X7 Y-5 F50"));
}

TEST(Expression, Texts) {
  const std::string declare = "declare string in V \"S\" = (\"ab\"), \"T\"\n";
  EXPECT_EQ(value("V.S == \"ab\"", declare), "1");
  EXPECT_EQ(value("string_length(V.S << \"cd\")", declare), "4");
  EXPECT_EQ(value("index_of(\"hello\", \"l\")"), "2");
  EXPECT_EQ(value("to_number(\" 2.5 \")"), "2.5");
  EXPECT_EQ(value("is_number(\"2,5\")"), "0");
  EXPECT_EQ(value("to_number(\"x\")"), "end error RUN-006");
  const auto r = run_lines(declare + "set V.T = upper_case(V.S) << substring(\"0123\", 1, 2) << 2.5");
  EXPECT_EQ(r.variables.at("T"), "\"AB122.5\"");
  EXPECT_THAT(lines_of(declare + "set R[1] = V.S"), ElementsAre("end error RUN-006"));
}

// --- variables -----------------------------------------------------------------------------------------------------

TEST(Variables, OnlyThoseThatWereSetAreReported) {
  const auto r = run_lines("set R[12] = 3.5, P[100] = 5, P[0] = 1\nblock rapid X (R[13])");
  EXPECT_THAT(r.variables,
              ElementsAre(::testing::Pair("P0", "1"), ::testing::Pair("P100", "5"), ::testing::Pair("R12", "3.5")));
}

TEST(Variables, TypesOfDeclaredOnes) {
  const auto r = run_lines(
      "declare integer in V \"I\" = (2.5), \"J\"\ndeclare boolean in V \"B\" = (7)\ndeclare real in V \"A\"[2,3] = (1, "
      "2, 3, 4)\n"
      "set V.J = -2.5\nset V.A[1,2] = 9");
  EXPECT_THAT(r.variables, ElementsAre(::testing::Pair("A[0,0]", "1"), ::testing::Pair("A[0,1]", "2"),
                                       ::testing::Pair("A[0,2]", "3"), ::testing::Pair("A[1,0]", "4"),
                                       ::testing::Pair("A[1,2]", "9"), ::testing::Pair("B", "1"),
                                       ::testing::Pair("I", "3"), ::testing::Pair("J", "-3")));
}

TEST(Variables, ArrayFaults) {
  EXPECT_THAT(lines_of("declare real in V \"A\"[3]\nset V.A[3] = 1"), ElementsAre("end error RUN-005"));
  EXPECT_THAT(lines_of("declare real in V \"A\"[3]\nset V.A = 1"), ElementsAre("end error RUN-005"));
  EXPECT_THAT(lines_of("declare real in V \"A\"[R[1]]"), ElementsAre("end error RUN-005"));
}

TEST(Variables, GlobalNamesAreSharedLocalNamesAreNot) {
  const auto r = run_text(
      "routine main 1 {\ndeclare real in V \"A\" = (1)\nset G.B = 2\ncall 20\nset R[1] = V.A, R[2] = G.B\n}\n"
      "routine sub 20 {\ndeclare real in V \"A\" = (5)\nset V.A = V.A + 1\nset G.B = G.B + 1\n}");
  EXPECT_EQ(r.variables.at("R1"), "1");
  EXPECT_EQ(r.variables.at("R2"), "3");
  EXPECT_EQ(r.variables.at("A"), "1");
  EXPECT_EQ(r.variables.at("A@1"), "6");
}

TEST(Variables, DeeperLevelsKeepTheLastValueSet) {
  const auto r = run_text(
      "routine main 1 {\ncall 20 (\"A\" = 1, \"B\" = 2) new_level\ncall 20 (\"A\" = 5) new_level\n}\nroutine sub 20 "
      "{\n}");
  EXPECT_EQ(r.variables.at("P0@1"), "5");
  EXPECT_EQ(r.variables.at("P1@1"), "2");
}

TEST(Set, NumberedNamedArraysAndData) {
  Options o;
  o.set = {{"R12", "3.5"},   {"P0", "-2"},    {"COUNT", "4"}, {"A[1]", "8"},
           {"FLAG", "TRUE"}, {"NAME", "xyz"}, {"PLC7", "1"},  {"[SYM]", "6"}};
  const auto r = run_lines(
      "declare real in V \"COUNT\" = (1), \"A\"[2] = (0, 0)\ndeclare boolean in V \"FLAG\"\ndeclare string in V "
      "\"NAME\"\n"
      "block rapid X (R[12]) Y (P[0]) Z (V.COUNT)\nblock rapid X (V.A[1]) Y (V.FLAG) Z (sys(other, none, \"PLC7\"))\n"
      "block rapid X (G.SYM)\nmessage show (V.NAME)",
      mill(), o);
  EXPECT_THAT(r.lines, ElementsAre("rapid X3.5 Y-2 Z4", "rapid X8 Y1 Z1", "rapid X6", "message xyz"));
}

TEST(Set, FaultsAreRefused) {
  Options o;
  o.set = {{"R999", "1"}};
  EXPECT_THAT(run_lines("block rapid X 1", mill(), o).lines, ElementsAre("end error RUN-106"));
  o.set = {{"R1", "abc"}};
  const auto r = run_lines("block rapid X 1", mill(), o);
  EXPECT_THAT(r.lines, ElementsAre("end error RUN-106"));
  EXPECT_EQ(r.diagnostics.error_count(), 1U);
}

TEST(Data, PositionsToolsAndOffsets) {
  auto p = lathe();
  p.work_offsets[1][ir::axis::z] = 100;
  machine::Tool t;
  t.number = 3;
  t.radius = 0.8;
  p.tools.push_back(t);
  const auto r = run_lines(
      "block work_offset 1, tool 3 changes, tool_offset 5, feed 120\nblock rapid X 40 Z 5\n"
      "set R[1] = sys(programmed_position, X, \"PX\"), R[2] = sys(machine_position, Z, \"MZ\"), R[3] = "
      "sys(work_offset, Z, \"O\", 1)\n"
      "set R[4] = sys(tool_number, none, \"T\"), R[5] = sys(tool_radius, none, \"TR\"), R[6] = sys(offset_number, "
      "none, \"D\"), "
      "R[7] = sys(feed, none, \"F\"), R[8] = sys(active_offset, none, \"E\")",
      p);
  EXPECT_EQ(r.variables.at("R1"), "40") << "in the diameter mode in force";
  EXPECT_EQ(r.variables.at("R2"), "105");
  EXPECT_EQ(r.variables.at("R3"), "100");
  EXPECT_EQ(r.variables.at("R4"), "3");
  EXPECT_EQ(r.variables.at("R5"), "0.8");
  EXPECT_EQ(r.variables.at("R6"), "5");
  EXPECT_EQ(r.variables.at("R7"), "120");
  EXPECT_EQ(r.variables.at("R8"), "1");
}

TEST(Data, OffsetTableWrittenByTheProgram) {
  const std::string text =
      "block work_offset 1\nset sys(work_offset, X, \"ORGX\", 1) = 50\nblock rapid X 1\nblock work_offset 1\nblock "
      "rapid X 1";
  EXPECT_THAT(lines_of(text), ElementsAre("rapid X1", "rapid X51"));
  auto p = mill();
  p.policies.work_offset_write = machine::WorkOffsetWrite::at_once;
  EXPECT_THAT(lines_of(text, p), ElementsAre("rapid X51"));
}

TEST(Data, WrittenDataAreReadBack) {
  EXPECT_EQ(value("sys(other, none, \"PLCM\", 3)", "set sys(other, none, \"PLCM\", 3) = 7"), "7");
  EXPECT_THAT(lines_of("set sys(programmed_shift, X, \"SHIFT\") = 7"), ElementsAre("end error RUN-007"));
}

}  // namespace
}  // namespace cnctrans::interpreter
