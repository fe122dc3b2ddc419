// Control flow: structures, jumps with every search, repeated parts, loops that end by a limit.
#include "tests/interpreter/run_ir.h"

namespace cnctrans::interpreter {
namespace {

/// The messages of a run, as one text.
std::string said(const Run& r) {
  std::string s;
  for (const auto& l : r.lines) {
    if (!s.empty()) s += ' ';
    s += l.starts_with("message ") ? l.substr(8) : "<" + l + ">";
  }
  return s;
}
std::string say(const std::string& statements, const Options& options = {}) {
  return said(run_lines(statements, mill(), options));
}

TEST(Flow, IfElse) {
  EXPECT_EQ(say("set R[1] = 2\nif R[1] == 2 {\nmessage show (\"yes\")\n} else {\nmessage show (\"no\")\n}\nmessage "
                "show (\"end\")"),
            "yes end");
  EXPECT_EQ(say("if R[1] == 2 {\nmessage show (\"yes\")\n} else {\nmessage show (\"no\")\n}\nmessage show (\"end\")"),
            "no end");
  EXPECT_EQ(say("if R[1] == 2 {\nmessage show (\"yes\")\n}\nmessage show (\"end\")"), "end");
}

TEST(Flow, Loops) {
  EXPECT_EQ(say("while R[1] < 3 {\nmessage show (R[1])\nset R[1] = R[1] + 1\n}"), "0 1 2");
  EXPECT_EQ(say("until {\nmessage show (R[1])\nset R[1] = R[1] + 1\n} until R[1] >= 0"), "0") << "runs at least once";
  EXPECT_EQ(say("for R[1] = 1 to 3 {\nmessage show (R[1])\n}\nmessage show (\"after\", R[1])"), "1 2 3 after4");
  EXPECT_EQ(say("for R[1] = 5 to 3 {\nmessage show (R[1])\n}"), "") << "tested before the first pass";
  EXPECT_EQ(say("for R[1] = 4 to 0 step (0 - 2) {\nmessage show (R[1])\n}"), "4 2 0");
  EXPECT_EQ(say("set R[2] = 3\nfor R[1] = 1 to R[2] {\nset R[2] = 2\nmessage show (R[1])\n}"), "1 2")
      << "the limit is read each time";
  EXPECT_EQ(say("loop {\nset R[1] = R[1] + 1\nif R[1] > 2 {\nexit\n}\nmessage show (R[1])\n}\nmessage show (\"out\")"),
            "1 2 out");
}

TEST(Flow, ExitLeavesTheInnermostLoop) {
  EXPECT_EQ(say("for R[1] = 1 to 2 {\nloop {\nexit\n}\nmessage show (R[1])\n}"), "1 2");
}

TEST(Flow, JumpsSearchAsTheySay) {
  const std::string labels = "N10 message show (\"a\")\nset R[1] = R[1] + 1\nif R[1] > 1 {\nend_program\n}\n";
  const auto with = [&](const std::string& search) {
    return say(labels + "jump N10" + search + "\nmessage show (\"no\")\nN10 message show (\"b\")");
  };
  EXPECT_EQ(with(""), "a a");
  EXPECT_EQ(with(" search backward"), "a a");
  EXPECT_EQ(with(" search forward"), "a b");
  EXPECT_EQ(with(" search forward_then_backward"), "a b");
  EXPECT_EQ(say("set R[1] = R[1] + 1\nif R[1] > 1 {\nend_program\n}\nmessage show (\"x\")\njump N0 search to_start"),
            "x");
}

TEST(Flow, NearestDuplicateInTheDirectionOfTheSearch) {
  EXPECT_EQ(say("jump L2 search forward\nL1: message show (\"1\")\nend_program\nL1: message show (\"2\")\nend_program\n"
                "L2: jump L1 search backward\nL1: message show (\"3\")"),
            "2");
}

TEST(Flow, JumpIntoAndOutOfStructures) {
  EXPECT_EQ(say("jump N20\nwhile R[1] < 2 {\nmessage show (\"top\")\nN20 set R[1] = R[1] + 1\nmessage show "
                "(R[1])\n}\nmessage show (\"end\")"),
            "1 top 2 end");
  EXPECT_EQ(say("for R[1] = 1 to 9 {\nif R[1] == 3 {\njump N50\n}\n}\nN50 message show (R[1])"), "3");
}

TEST(Flow, ComputedJump) {
  EXPECT_EQ(say("set R[1] = 30\njump at (R[1] + 10)\nN30 message show (\"30\")\nN40 message show (\"40\")"), "40");
  EXPECT_EQ(say("set R[1] = 30\njump at (\"N\" << R[1])\nmessage show (\"no\")\nN30 message show (\"30\")"), "30");
  EXPECT_EQ(say("jump at (\"HERE\")\nmessage show (\"no\")\nHERE: message show (\"yes\")"), "yes");
  EXPECT_EQ(say("message show (\"before\")\njump at (99)"), "before <end error RUN-020>");
  EXPECT_EQ(say("jump at (99) quiet\nmessage show (\"on\")"), "on");
}

TEST(Flow, LeadingZerosOfBlockNumbersDoNotCount) {
  EXPECT_EQ(say("jump N20\nmessage show (\"no\")\nN0020 message show (\"yes\")"), "yes");
}

TEST(Flow, Switch) {
  const std::string rest =
      "\nmessage show (\"next\")\nend_program\nN1 message show (\"one\")\nend_program\nN2 message show (\"two\")";
  EXPECT_EQ(say("set R[1] = 2\nswitch R[1] case 1 jump N1 case 2 jump N2" + rest), "two");
  EXPECT_EQ(say("set R[1] = 3\nswitch R[1] case 1 jump N1 case 2 jump N2" + rest), "next");
  EXPECT_EQ(say("set R[1] = 3\nswitch R[1] case 1 jump N1 default N2" + rest), "two");
}

// --- repeated parts ------------------------------------------------------------------------------------------------

TEST(Repeat, CountsItsOwnExecutions) {
  // Once in line, three times by the statement.
  EXPECT_EQ(say("N1 message show (\"a\")\nN2 message show (\"b\")\nrepeat N1 N2 count 3\nmessage show (\"end\")"),
            "a b a b a b a b end");
  EXPECT_EQ(say("N1 message show (\"a\")\nrepeat N1 N1 count 0\nmessage show (\"end\")"), "a end");
  EXPECT_EQ(say("N1 message show (\"a\")\nrepeat N1 N1"), "a a");
}

TEST(Repeat, AheadBehindAndUpToTheStatement) {
  EXPECT_EQ(say("repeat N1 N2\nend_program\nN1 message show (\"a\")\nN2 message show (\"b\")"), "a b");
  EXPECT_EQ(say("A1: message show (\"a\")\nmessage show (\"b\")\nrepeat A1 \"\" count 2 search backward\nmessage show "
                "(\"c\")"),
            "a b a b a b c");
}

TEST(Repeat, LabelsInEitherOrder) {
  EXPECT_EQ(say("jump N9\nN1 message show (\"a\")\nN2 message show (\"b\")\nend_program\nN9 repeat N2 N1 "
                "order_free\nmessage show (\"end\")"),
            "a b end");
}

TEST(Repeat, Nested) {
  EXPECT_EQ(say("jump N9\nN1 message show (\"a\")\nN2 message show (\"b\")\nN3 repeat N2 N2 count 2\nend_program\nN9 "
                "repeat N1 N3 count 2\nmessage show (\"end\")"),
            "a b b b a b b b end");
}

TEST(Repeat, JumpOutLeavesItOpenUntilItsEndIsReached) {
  // The jump to the block behind the range does not count as its end; the second pass comes when control runs through
  // it.
  EXPECT_EQ(say("repeat N1 N2 count 2\nend_program\nN1 message show (\"a\")\nset R[1] = R[1] + 1\nif R[1] == 1 {\njump "
                "N5\n}\n"
                "N2 message show (\"b\")\nN5 message show (\"out\")\nif R[1] < 3 {\njump N1\n}\nend_program"),
            "a out a b a b");
}

TEST(Repeat, ReturnInsideEndsTheRepetitionOnly) {
  EXPECT_EQ(say("jump N9\nN1 message show (\"a\")\nreturn\nN2 message show (\"b\")\nN9 repeat N1 N2 count 3\nmessage "
                "show (\"end\")"),
            "a end");
}

TEST(Repeat, LastLabelOnAStructure) {
  EXPECT_EQ(say("jump N9\nN1 message show (\"a\")\nN2 if R[1] == 0 {\nmessage show (\"in\")\n}\nend_program\nN9 repeat "
                "N1 N2 count 2\nmessage show (\"end\")"),
            "a in a in end");
}

// --- skip levels -----------------------------------------------------------------------------------------------------

TEST(Skip, LevelsThatAreOn) {
  const std::string text =
      "/0 message show (\"0\")\n/3 message show (\"3\")\n& message show (\"joined\")\n/0 /1 message show "
      "(\"01\")\nmessage show (\"x\")";
  Options o;
  EXPECT_EQ(say(text, o), "0 3 joined 01 x");
  o.skip_mask = 1;
  EXPECT_EQ(say(text, o), "3 joined x");
  o.skip_mask = 0b1010;
  EXPECT_EQ(say(text, o), "0 x");
}

TEST(Skip, ALabelOfASkippedBlockIsStillATarget) {
  Options o;
  o.skip_mask = 1;
  EXPECT_EQ(say("jump N5\nmessage show (\"no\")\n/0 N5 message show (\"skipped\")\nmessage show (\"x\")", o), "x");
}

// --- limits ----------------------------------------------------------------------------------------------------------

TEST(Limits, Events) {
  Options o;
  o.max_events = 3;
  const auto r = run_lines("N1 block rapid X incremental 1\njump N1", mill(), o);
  EXPECT_THAT(r.lines, ElementsAre("rapid X1", "rapid X2", "rapid X3", "end event_limit"));
  EXPECT_EQ(r.result.reason, EndReason::event_limit);
}

TEST(Limits, Steps) {
  Options o;
  o.max_steps = 1000;
  const auto r = run_lines("N1 block rapid X incremental 1\njump N1", mill(), o);
  EXPECT_EQ(r.lines.back(), "end step_limit");
  EXPECT_EQ(r.result.steps, 1000U);
}

TEST(Limits, LoopThatDoesNothingEndsByItself) {
  Options o;
  o.max_silent_steps = 100'000;
  const auto lines = [&](const std::string& text) { return run_lines(text, mill(), o).lines; };
  EXPECT_THAT(lines("block rapid X 1\nN1 jump N1"), ElementsAre("rapid X1", "end step_limit"));
  EXPECT_THAT(lines("loop {\n}"), ElementsAre("end step_limit"));
  EXPECT_THAT(lines("until {\n} until R[1] == 1"), ElementsAre("end step_limit"));
}

// --- static faults ---------------------------------------------------------------------------------------------------

TEST(Check, UnknownLabelIsRefusedBeforeAnythingMoves) {
  const auto r = run_lines("block rapid X 1\njump N99");
  EXPECT_THAT(r.lines, ElementsAre("end error RUN-101"));
  ASSERT_EQ(r.diagnostics.error_count(), 1U);
  EXPECT_EQ(r.diagnostics.all()[0].span.line, r.events[0].line);
  EXPECT_THAT(lines_of("block rapid X 1\nif R[1] == 5 {\njump N99\n}"), ElementsAre("end error RUN-101"));
  EXPECT_THAT(lines_of("repeat N1 N2"), ElementsAre("end error RUN-101"));
  EXPECT_THAT(lines_of("N1 label\nrepeat N1 N2"), ElementsAre("end error RUN-101"));
  EXPECT_THAT(lines_of("N1 label\njump N1 search forward"), ElementsAre("end error RUN-101"));
}

TEST(Check, WhatIsNeverReachedOnlyWarns) {
  const auto r = run_lines("block rapid X 1\nend_program\njump N99");
  EXPECT_THAT(r.lines, ElementsAre("rapid X1"));
  EXPECT_EQ(r.diagnostics.warning_count(), 1U);
  EXPECT_THAT(lines_of("jump N99 quiet\nblock rapid X 1"), ElementsAre("rapid X1"));
}

TEST(Check, OpaqueAndUnknownSubprogram) {
  EXPECT_THAT(lines_of("block rapid X 1\nopaque \"WHATEVER(1)\""), ElementsAre("end error RUN-103"));
  EXPECT_THAT(lines_of("block rapid X 1\nopaque \"WHATEVER(1)\" harmless"), ElementsAre("rapid X1"));
  const auto beside =
      run_lines("block rapid X 1\nopaque \"TRAILON(Y,X)\" feature \"beside.coupling\"\nblock rapid X 2");
  EXPECT_THAT(beside.lines, ElementsAre("rapid X1", "rapid X2"));
  ASSERT_EQ(beside.diagnostics.warning_count(), 1U);
  EXPECT_EQ(beside.diagnostics.all()[0].code, "RUN-043");
  EXPECT_THAT(lines_of("block rapid X 1\ncall 7"), ElementsAre("end error RUN-102"));
  EXPECT_THAT(lines_of("block rapid X 1\ncall 7 optional"), ElementsAre("rapid X1"));
  EXPECT_THAT(lines_of("exit"), ElementsAre("end error RUN-105"));
  EXPECT_THAT(run_text("").lines, ElementsAre("end error RUN-104"));
}

TEST(Run, CountsStepsBlocksEventsAndCoverage) {
  const auto r = run_lines("block rapid X 1\nif R[1] == 1 {\nblock rapid X 2\n}\nblock rapid X 3");
  EXPECT_EQ(r.result.blocks, 2U);
  EXPECT_EQ(r.result.steps, 3U);
  EXPECT_EQ(r.result.events, 3U);
  ASSERT_GE(r.result.covered.size(), 5U);
  EXPECT_TRUE(r.result.covered[1]);
  EXPECT_TRUE(r.result.covered[2]);
  EXPECT_FALSE(r.result.covered[3]);
  EXPECT_TRUE(r.result.covered[4]);
}

TEST(Run, ErrorLeavesTheEventsBeforeIt) {
  const auto r = run_lines("block rapid X 1\nset R[1] = 1 / R[2]\nblock rapid X 2");
  EXPECT_THAT(r.lines, ElementsAre("rapid X1", "end error RUN-001"));
  EXPECT_EQ(r.result.reason, EndReason::error);
  EXPECT_EQ(r.events.back().line, r.events[0].line + 1);
  EXPECT_EQ(r.diagnostics.error_count(), 1U);
}

TEST(Run, ErrorStatementStops) {
  EXPECT_THAT(lines_of("message error (\"tool broken\") number 12\nblock rapid X 1"),
              ElementsAre("message tool broken", "end error RUN-030"));
}

TEST(Run, VariableOfAReadOnlyRangeIsNotWritten) {
  const auto r = run_text("space E \"E\" segment 0 9 read_only\nroutine main 1 {\n  set E[3] = 1\n  end_program\n}\n");
  EXPECT_THAT(r.lines, ElementsAre("end error RUN-008"));
}

TEST(Run, SpindlesHaveNumbersUpTo31) {
  EXPECT_THAT(lines_of("block spindle_run cw of 32"), ElementsAre("end error RUN-041"));
}

}  // namespace
}  // namespace cnctrans::interpreter
