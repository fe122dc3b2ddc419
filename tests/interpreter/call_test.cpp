// Subprograms: levels, arguments, counts, ranges, modal calls, the library.
#include "tests/interpreter/run_ir.h"

namespace cnctrans::interpreter {
namespace {

TEST(Call, ReturnAndEnd) {
  EXPECT_THAT(run_text("routine main 1 {\ncall 20\nblock rapid X 2\nend_program\n}\nroutine sub 20 {\nblock rapid X "
                       "1\nreturn\nblock rapid X 9\n}")
                  .lines,
              ElementsAre("rapid X1", "rapid X2"));
  // Falling off the end returns; an end word ends everything, or returns where the language says so.
  EXPECT_THAT(run_text("routine main 1 {\ncall 20\nblock rapid X 2\n}\nroutine sub 20 {\nblock rapid X 1\n}").lines,
              ElementsAre("rapid X1", "rapid X2"));
  EXPECT_THAT(
      run_text("routine main 1 {\ncall 20\nblock rapid X 2\n}\nroutine sub 20 {\nblock rapid X 1\nend_program\n}")
          .lines,
      ElementsAre("rapid X1"));
  EXPECT_THAT(run_text("routine main 1 {\ncall 20\nblock rapid X 2\n}\nroutine sub 20 {\nblock rapid X 1\nend_program "
                       "returns_from_sub\n}")
                  .lines,
              ElementsAre("rapid X1", "rapid X2"));
}

TEST(Call, CountAndModalStateLeaksUnlessSaved) {
  EXPECT_THAT(run_text("routine main 1 {\ncall 20 count 3\nblock modal X 5\n}\nroutine sub 20 {\nblock distance "
                       "incremental, rapid X 1\n}")
                  .lines,
              ElementsAre("rapid X1", "rapid X2", "rapid X3", "rapid X8"));
  EXPECT_THAT(run_text("routine main 1 {\ncall 20\nblock modal X 5\n}\nroutine sub 20 saves_modals {\nblock distance "
                       "incremental, rapid X 1\n}")
                  .lines,
              ElementsAre("rapid X1", "linear X5"));
  EXPECT_THAT(run_text("routine main 1 {\ncall 20 count 0\n}\nroutine sub 20 {\nblock rapid X 1\n}").lines,
              ElementsAre());
}

TEST(Call, EachPassStartsFromItsArguments) {
  // 8.4 of the language: what the callee makes of a parameter passed by value is gone with the next pass.
  EXPECT_THAT(run_text("routine main 1 {\ncall 20 (\"A\" = 2) new_level count 2\n}\nroutine sub 20 {\nblock rapid X "
                       "(P[0])\nset P[0] = P[0] + 1\nblock rapid Y (P[0])\nblock rapid Y 0\n}")
                  .lines,
              ElementsAre("rapid X2", "rapid Y3", "rapid Y0", "rapid Y3", "rapid Y0"));
}

TEST(Call, SharedAndNewLevel) {
  const std::string sub = "\nroutine sub 20 {\nblock rapid X (P[0])\nset P[0] = 7\n}";
  EXPECT_THAT(run_text("routine main 1 {\nset P[0] = 3\ncall 20\nblock rapid Y (P[0])\n}" + sub).lines,
              ElementsAre("rapid X3", "rapid Y7"));
  EXPECT_THAT(run_text("routine main 1 {\nset P[0] = 3\ncall 20 new_level\nblock rapid Y (P[0])\n}" + sub).lines,
              ElementsAre("rapid Y3"));
}

TEST(Call, LettersFillTheNewLevel) {
  const auto r = run_text(
      "routine main 1 {\nset P[1] = 5\ncall 20 (\"A\" = P[1] + 1, \"C\" = 4, \"P3\" = 9) new_level\n}\n"
      "routine sub 20 {\nblock rapid X (P[0]) Y (P[2]) Z (P[3])\nset P[100] = P[1]\n}");
  EXPECT_THAT(r.lines, ElementsAre("rapid X6 Y4 Z9"));
  EXPECT_EQ(r.variables.at("P100"), "0") << "what is not given is 0 in a new level";
  EXPECT_EQ(r.variables.at("P1"), "5");
  EXPECT_EQ(r.variables.at("P0@1"), "6");
  EXPECT_EQ(r.variables.at("P3@1"), "9");
  EXPECT_FALSE(r.variables.contains("P1@1"));
}

TEST(Call, ArgumentsAreEvaluatedByTheCaller) {
  EXPECT_THAT(run_text("routine main 1 {\nset P[0] = 1, P[1] = 2\ncall 20 (\"A\" = P[1], \"B\" = P[0]) new_level\n}\n"
                       "routine sub 20 {\nblock rapid X (P[0]) Y (P[1])\n}")
                  .lines,
              ElementsAre("rapid X2 Y1"));
}

TEST(Call, WhichArgumentsWereGiven) {
  EXPECT_THAT(
      run_text("routine main 1 {\ncall 20 (\"A\" = 1, \"C\" = 1) new_level\n}\nroutine sub 20 {\n"
               "block rapid X (sys(call_has_argument, none, \"G\")) Y (sys(call_has_argument, none, \"G\", 1)) Z "
               "(sys(call_has_argument, none, \"G\", 2))\n}")
          .lines,
      ElementsAre("rapid X5 Z1"));
}

const std::string proc =
    "\nroutine sub \"DRILL\" has_signature param \"A\" sets V.A param \"B\" type integer default 8 sets V.B param "
    "\"C\" by_reference sets V.C {\n"
    "set V.A = V.A + 1\nset V.C = V.A * 10\nblock rapid X (V.A) Y (V.B)\n}";

TEST(Call, ParametersByPositionDefaultAndReference) {
  const auto r = run_text(
      "routine main 1 {\nset R[1] = 4\ncall \"DRILL\" (R[1], nothing, ref R[2] value R[2])\n"
      "call \"DRILL\" (1, 2.6, ref R[3] value R[3]) count 2\n}" +
      proc);
  EXPECT_THAT(r.lines, ElementsAre("rapid X5 Y8", "rapid X2 Y3"))
      << "by value; integers round; the second pass starts from the arguments again";
  EXPECT_EQ(r.variables.at("R1"), "4");
  EXPECT_EQ(r.variables.at("R2"), "50");
  EXPECT_EQ(r.variables.at("R3"), "20");
  EXPECT_EQ(r.variables.at("A@1"), "2");
}

TEST(Call, TooManyArguments) {
  EXPECT_THAT(run_text("routine main 1 {\ncall \"DRILL\" (1, 2, 3, 4)\n}" + proc).lines,
              ElementsAre("end error RUN-026"));
  EXPECT_THAT(run_text("routine main 1 {\ncall 20 (\"?\" = 1) new_level\n}\nroutine sub 20 {\n}").lines,
              ElementsAre("end error RUN-026"));
}

TEST(Call, AVariableGoesByReferenceThoughTheCallerDoesNotKnow) {
  EXPECT_EQ(run_text("routine main 1 {\ncall \"DRILL\" (1, 1, R[9])\ncall \"DRILL\" (1, 1, R[9] + 1)\n}" + proc)
                .variables.at("R9"),
            "20");
}

TEST(Call, ArraysByReference) {
  EXPECT_THAT(
      run_text("routine main 1 {\ndeclare real in V \"LIST\"[3] = (1, 2, 3)\ncall \"S\" (ref V.LIST)\nblock rapid "
               "X (V.LIST[1])\n}\n"
               "routine sub \"S\" param \"V\" by_reference sets V.IT {\nset V.IT[1] = V.IT[2] + 10\n}")
          .lines,
      ElementsAre("rapid X13"));
}

TEST(Call, RangesOfARoutine) {
  const std::string sub =
      "\nroutine sub 20 {\nN1 block rapid X incremental 1\nN2 block rapid X incremental 2\nN3 block rapid X "
      "incremental 4\n}";
  EXPECT_THAT(run_text("routine main 1 {\ncall 20 range N2 N3\n}" + sub).lines, ElementsAre("rapid X2", "rapid X6"));
  EXPECT_THAT(run_text("routine main 1 {\ncall 20 count 2 range N2 N2\n}" + sub).lines,
              ElementsAre("rapid X2", "rapid X4"));
  EXPECT_THAT(run_text("routine main 1 {\ncall 20 range N3 N2\n}" + sub).lines, ElementsAre("rapid X2", "rapid X6"));
  EXPECT_THAT(run_text("routine main 1 {\ncall 20 range N2 N9\n}" + sub).lines, ElementsAre("end error RUN-101"));
  EXPECT_THAT(run_text("routine main 1 {\nrepeat N2 N3 count 2 in 20\n}" + sub).lines,
              ElementsAre("rapid X2", "rapid X6", "rapid X8", "rapid X12"));
}

TEST(Call, ComputedAndMissing) {
  const std::string sub = "\nroutine sub 20 {\nblock rapid X 1\n}\nroutine sub \"L7\" {\nblock rapid X 7\n}";
  EXPECT_THAT(
      run_text("routine main 1 {\ncall unnamed computed (R[1] + 20)\ncall unnamed computed (\"L\" << 7)\n}" + sub)
          .lines,
      ElementsAre("rapid X1", "rapid X7"));
  EXPECT_THAT(run_text("routine main 1 {\nblock rapid X 3\ncall unnamed computed (R[1] + 21)\n}" + sub).lines,
              ElementsAre("rapid X3", "end error RUN-021"));
}

TEST(Call, RecursionEndsWithAnError) {
  auto p = mill();
  p.call_depth = 5;
  const auto r = run_text("routine main 1 {\ncall 20\n}\nroutine sub 20 {\nblock rapid X incremental 1\ncall 20\n}", p);
  EXPECT_THAT(r.lines, ElementsAre("rapid X1", "rapid X2", "rapid X3", "rapid X4", "rapid X5", "end error RUN-022"));
  p.policies.calls_local_levels = 2;
  EXPECT_THAT(
      run_text(
          "routine main 1 {\ncall 20 new_level\n}\nroutine sub 20 {\nblock rapid X incremental 1\ncall 20 new_level\n}",
          p)
          .lines,
      ElementsAre("rapid X1", "rapid X2", "end error RUN-023"));
}

TEST(Call, TailDoesNotComeBack) {
  EXPECT_THAT(
      run_text("routine main 1 {\ncall 20 tail\nblock rapid X 9\n}\nroutine sub 20 {\nblock rapid X 1\n}").lines,
      ElementsAre("rapid X1"));
}

TEST(ModalCall, AfterEveryBlockThatMoves) {
  const std::string sub = "\nroutine sub 20 {\nblock rapid Z 0\nblock rapid Z (P[0])\n}";
  EXPECT_THAT(run_text("routine main 1 {\nset R[1] = 5\nmodal_call call 20 (\"A\" = R[1]) new_level\nset R[1] = "
                       "8\nblock rapid X 1\nblock tool 3\n"
                       "block rapid X 2\nmodal_call off\nblock rapid X 3\n}" +
                       sub)
                  .lines,
              ElementsAre("rapid X1", "rapid Z5", "tool 3", "rapid X2", "rapid Z0", "rapid Z5", "rapid X3"))
      << "arguments are taken once; moves of the subprogram do not call it again";
  EXPECT_THAT(
      run_text("routine main 1 {\nmodal_call here call 20 (\"A\" = 4) new_level\nmodal_call off\n}" + sub).lines,
      ElementsAre("rapid Z4"));
}

TEST(ModalCall, WithABlockThatRepeats) {
  EXPECT_THAT(run_text("routine main 1 {\nmodal_call call 20\nblock rapid X incremental 5, times 2\nblock rapid X "
                       "incremental 1, times 0\n}\n"
                       "routine sub 20 {\nmessage show (\"sub\")\n}")
                  .lines,
              ElementsAre("rapid X5", "message sub", "rapid X10", "message sub", "rapid X11"));
}

TEST(ModalCall, Cycle) {
  EXPECT_THAT(lines_of("block feed 10\nmodal_call cycle hole drill reference absolute 2 bottom absolute -1 retract "
                       "absolute 2\nblock rapid X 1\n"
                       "modal_call off\nblock rapid X 2"),
              ElementsAre("rapid X1", "rapid Z2", "linear Z-1 F10", "rapid Z2", "rapid X2"));
}

TEST(Library, IsAskedForWhatTheProgramDoesNotHave) {
  const auto other = program_of(
      std::string(spaces) +
      "routine main 30 {\nset R[5] = R[5] + 1\nblock rapid X (R[5])\ncall 31\n}\nroutine sub 31 {\nblock rapid Y 1\n}");
  Options o;
  int asked = 0;
  o.library = [&](const ir::RoutineName& n) {
    ++asked;
    return n.number == 30 ? &other : nullptr;
  };
  const auto r = run_text("routine main 1 {\nset R[5] = 6\ncall 30\nblock rapid Z (R[5])\n}", mill(), o);
  EXPECT_THAT(r.lines, ElementsAre("rapid X7", "rapid Y1", "rapid Z7"));
  EXPECT_GT(asked, 0);
  EXPECT_THAT(run_text("routine main 1 {\ncall 33\n}", mill(), o).lines, ElementsAre("end error RUN-102"));
}

TEST(Library, FaultsOfACalledFileAreFoundBeforeAnythingMoves) {
  const auto other = program_of(std::string(spaces) + "routine main 30 {\njump N77\n}");
  Options o;
  o.library = [&](const ir::RoutineName&) { return &other; };
  EXPECT_THAT(run_text("routine main 1 {\nblock rapid X 1\ncall 30\n}", mill(), o).lines,
              ElementsAre("end error RUN-101"));
}

}  // namespace
}  // namespace cnctrans::interpreter
