// check_well_formed: each fault is found, with its code and its line; sound programs give none.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/ir/read_ir.h"
#include "tests/support/random_program.h"

namespace cnctrans::ir {
namespace {

using Codes = std::vector<std::string>;

Codes faults(const Program& p) {
  Diagnostics diagnostics;
  check_well_formed(p, diagnostics);
  Codes codes;
  for (const auto& d : diagnostics.all()) codes.push_back(d.code);
  return codes;
}
Codes faults(const std::string& lines) {
  return faults(read_main(lines));
}

TEST(WellFormed, SoundProgramsHaveNoFaults) {
  EXPECT_EQ(faults("N10 block plane xy, feed 100, linear X 1 Y (R[1] * 2), coolant off after\n"
                   "while R[1] < 3 and not R[2] {\nif R[3] {\nexit\n}\n}\n"
                   "for R[4] = 1 to 9 step 2 {\nset R[R[4]] = min(1, 2)\n}\n"
                   "block arc_cw X 1 radius 5\nblock arc_ccw X 1 centre X 5\n"
                   "jump N10 if R[1] == 2\nrepeat N10 N10 count 3\nend_program\n"),
            Codes{});
  EXPECT_EQ(faults(read_ir("space v \"\"\nroutine main 1 {\nset v.COUNT = 1\nmessage show (\"a\" << v.COUNT)\n}\n")),
            Codes{});
}

TEST(WellFormed, Variables) {
  EXPECT_EQ(faults("set s7[1] = 1\n"), Codes{"IR-010"});
  EXPECT_EQ(faults("declare real in s7 \"A\"\n"), Codes{"IR-010"});
  EXPECT_EQ(faults("set R[100] = 1\n"), Codes{"IR-011"}) << "R has 0 to 99";
  EXPECT_EQ(faults("set R = 1\n"), Codes{"IR-011"});
  EXPECT_EQ(faults("block linear X (R[1] + R[2 + 300])\n"), Codes{"IR-011"}) << "deep inside a word";
  EXPECT_EQ(faults(read_ir("space v \"\"\nroutine main 1 {\nset v[5] = 1\n}\n")), Codes{"IR-011"});
}

TEST(WellFormed, Expressions) {
  EXPECT_EQ(faults("set R[1] = nothing\n"), Codes{"IR-012"});
  EXPECT_EQ(faults("while nothing {\n}\n"), Codes{"IR-012"});
  EXPECT_EQ(faults("set R[1] = 1 + \"a\"\n"), Codes{"IR-013"});
  EXPECT_EQ(faults("set R[1] = -\"a\"\n"), Codes{"IR-013"});
  EXPECT_EQ(faults("set R[1] = \"a\" == 2\n"), Codes{"IR-013"});
  EXPECT_EQ(faults("set R[1] = \"a\" == \"b\"\n"), Codes{});
  EXPECT_EQ(faults("set R[1] = atan2(1)\n"), Codes{"IR-013"});
  EXPECT_EQ(faults("set R[1] = sin(\"a\")\n"), Codes{"IR-013"});
  EXPECT_EQ(faults("set R[1] = string_length(\"a\")\n"), Codes{});
  EXPECT_EQ(faults("jump \"\" if \"text\" search to_start\n"), Codes{"IR-013"});
  EXPECT_EQ(faults("block linear axis12 5\n"), Codes{"IR-014"});
}

TEST(WellFormed, Labels) {
  EXPECT_EQ(faults("jump N10\n"), Codes{"IR-020"});
  EXPECT_EQ(faults("jump N10 quiet\n"), Codes{});
  EXPECT_EQ(faults("jump at R[1]\n"), Codes{});
  EXPECT_EQ(faults("N10 block\njump N10 search forward\n"), Codes{"IR-020"});
  EXPECT_EQ(faults("N10 block\nrepeat N10 N20\n"), Codes{"IR-020"});
  EXPECT_EQ(faults("N10 block\nN10 block\njump N10\n"), Codes{"IR-021"});
  EXPECT_EQ(faults("N10 block\nN10 block\njump N10 search backward\n"), Codes{}) << "the nearest one, no doubt";
  EXPECT_EQ(faults("switch R[1] case 1 jump N7\n"), Codes{"IR-020"});
}

TEST(WellFormed, Structure) {
  EXPECT_EQ(faults("exit\n"), Codes{"IR-022"});
  EXPECT_EQ(faults("if R[1] {\nexit\n}\n"), Codes{"IR-022"});
  EXPECT_EQ(faults("loop {\nif R[1] {\nexit\n}\n}\n"), Codes{});
  EXPECT_EQ(faults("A: switch R[1] default A default A\n"), Codes{"IR-023"});
  Program p = read_main("if R[1] {\n}\n");
  std::get<If>(p.routines[0].body[0].node).else_body.emplace_back();
  EXPECT_EQ(faults(p), Codes{"IR-023"});
}

TEST(WellFormed, Blocks) {
  EXPECT_EQ(faults("block plane #9\n"), Codes{"IR-030"});
  EXPECT_EQ(faults("block stop after, feed 3\n"), Codes{"IR-031"});
  EXPECT_EQ(faults("block linear X 1 X 2\n"), Codes{"IR-032"});
  EXPECT_EQ(faults("block arc_cw X 1\n"), Codes{"IR-033"});
  EXPECT_EQ(faults("block arc_cw X 1 centre X 1 radius 5\n"), Codes{"IR-033"});
  EXPECT_EQ(faults("block arc_cw X 1 centre X 1 centre X 2\n"), Codes{"IR-033"});
  EXPECT_EQ(faults("block arc_cw\n"), Codes{}) << "only the code: nothing moves yet";
  EXPECT_EQ(faults("block frame nothing\n"), Codes{"IR-034"});
  EXPECT_EQ(faults("block cycle nothing\n"), Codes{"IR-034"});
  EXPECT_EQ(faults("block pole nothing\n"), Codes{}) << "the pole at the present point";
}

TEST(WellFormed, Routines) {
  EXPECT_EQ(faults(read_ir("routine main 1 {\n}\nroutine sub 2 {\n}\nroutine sub 2 {\n}\n")), Codes{"IR-040"});
  EXPECT_EQ(faults(read_ir("routine main 1 {\n}\nroutine sub unnamed {\n}\n")), Codes{"IR-040"});
  EXPECT_EQ(faults(read_ir("routine sub 2 {\n}\nroutine main 1 {\n}\n")), Codes{"IR-041"});
  EXPECT_EQ(faults(read_ir("routine main 1 {\nN10 block\n}\nroutine sub 2 {\njump N10\n}\n")), Codes{"IR-020"})
      << "labels of another routine do not count";
}

TEST(WellFormed, FaultsStandAtTheirLineAlsoWithoutNumbers) {
  Diagnostics diagnostics;
  const Program p = from_text("routine main 1 {\n  block\n  jump N10\n}\n", 4, diagnostics);
  check_well_formed(p, diagnostics);
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_EQ(diagnostics.all()[0].span.file, 4U);
  EXPECT_EQ(diagnostics.all()[0].span.line, 3U);
}

TEST(WellFormed, SurvivesRandomPrograms) {
  std::size_t found = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) found += faults(test::random_program(seed)).size();
  EXPECT_GT(found, 100U);
}

}  // namespace
}  // namespace cnctrans::ir
