// Control flow, conditions and expressions keep what the program does.
#include <gtest/gtest.h>

#include "support.h"

namespace cnctrans::test {
namespace {

using ir::Capabilities;

const std::vector<std::pair<std::string, Capabilities>>& targets() {
  static const std::vector<std::pair<std::string, Capabilities>> list{
      {"chain", chain_target()}, {"letters", letters_target()}, {"structured", structured_target()}};
  return list;
}

void keeps_trace(const std::string& spaces, const std::string& body) {
  for (const auto& [name, target] : targets()) {
    const std::string text = spaces + "routine main 1 {\n" + body + "}\n";
    EXPECT_EQ(difference(text, target), "") << name;
  }
}

TEST(Flow, CountedLoopWithComputedWords) {
  keeps_trace(named_source, R"(
    for R[1] = 1 to 4 {
      block rapid X (R[1] * 10 + 3) Y (R[1] - 2 * (R[1] + 1))
    }
    end_program
  )");
}

TEST(Flow, ForCountsDownAndTestsBeforeTheFirstPass) {
  keeps_trace(named_source, R"(
    block rapid X 1
    for R[1] = 3 to 1 step -1 {
      block rapid X (R[1])
    }
    for R[1] = 5 to 1 {
      block rapid X 99
    }
    end_program
  )");
}

TEST(Flow, WhileUntilLoopAndExit) {
  keeps_trace(named_source, R"(
    set R[1] = 0
    while R[1] < 3 {
      set R[1] = R[1] + 1
      block rapid X (R[1])
    }
    until {
      set R[1] = R[1] - 1
      block rapid Y (R[1])
    } until R[1] <= 0
    loop {
      set R[1] = R[1] + 1
      if R[1] > 2 {
        exit
      }
      block rapid Z (R[1])
    }
    end_program
  )");
}

TEST(Flow, NestedIfElse) {
  keeps_trace(named_source, R"(
    for R[1] = 0 to 5 {
      if R[1] mod 2 == 0 {
        if R[1] > 2 and R[1] < 5 {
          block rapid X (R[1])
        } else {
          block rapid Y (R[1])
        }
      } else {
        block rapid Z (R[1])
      }
    }
    end_program
  )");
}

TEST(Flow, ConditionsWithAndOrNot) {
  keeps_trace(named_source, R"(
    for R[1] = 0 to 7 {
      if not (R[1] == 2 or R[1] > 5) and (R[1] != 0) == 1 {
        block rapid X (R[1])
      }
    }
    end_program
  )");
}

TEST(Flow, SwitchAndBackwardJump) {
  keeps_trace(named_source, R"(
    set R[1] = 0
    N10 set R[1] = R[1] + 1
    switch R[1] case 1 jump N20 case 2 jump N30 default N40
    N20 block rapid X 20
    jump N10
    N30 block rapid X 30
    jump N10
    N40 block rapid X 40
    end_program
  )");
}

TEST(Flow, DuplicateLabelsAndDirections) {
  // The nearest label ahead, not the first of the text.
  const std::string text = named_source + R"(routine main 1 {
    jump N10 search forward
    block rapid X 1
    N10 block rapid X 2
    jump N10 search forward
    block rapid X 3
    N10 block rapid X 4
    end_program
  })";
  EXPECT_EQ(difference(text, letters_target()), "");
  EXPECT_EQ(difference(text, chain_target()), "");
}

TEST(Flow, RepeatedRange) {
  keeps_trace(named_source, R"(
    block rapid X 0
    N10 block rapid X incremental 5
    N20 block rapid X incremental -1
    repeat N10 N20 count 3
    end_program
  )");
}

TEST(Flow, RepeatedRangeOfComputedWords) {
  // The temporaries of the first and the last block of the part belong to it.
  keeps_trace(named_source, R"(
    set R[1] = 1
    N10 block rapid X (R[1] * 2 + 1)
    set R[1] = R[1] + 1
    N20 block rapid Y (R[1] * 3 - 1)
    repeat N10 N20 count 2
    end_program
  )");
}

TEST(Expressions, FunctionsThatTargetsLack) {
  keeps_trace(named_source, R"(
    set R[1] = -3.7, R[2] = 2
    block rapid X (round(R[1])) Y (ceil(R[1])) Z (trunc(R[1]))
    block rapid X (abs(R[1])) Y (R[1] mod R[2]) Z (tan(30))
    block rapid X (atan2(R[1], R[2])) Y (atan2(R[2], R[1])) Z (atan2(-1, R[1]))
    block rapid X (atan2(R[2], 0)) Y (atan2(-1, 0)) Z (atan2(0, R[2]))
    block rapid X (arg(R[2], R[1])) Y (arg(R[1], R[2])) Z (arg(0, R[1]))
    block rapid X (min(R[1], R[2])) Y (max(R[1], R[2])) Z (square(R[1]))
    block rapid X (asin(0.5)) Y (acos(0.25)) Z (sqrt(square(R[1]) + square(R[2])))
    block rapid X (R[2] pow 3) Y (sign(R[1])) Z (R[1] > R[2])
    block rapid X (R[1] - (R[2] - 4) * (R[1] + 1) / (R[2] + 3))
    end_program
  )");
}

TEST(Expressions, ChainsGoFromLeftToRight) {
  const auto p = run_pass(
      "lower_expressions",
      shared_source + "routine main 1 {\n  set L[1] = 15 + L[2] * 25\n  set L[3] = (L[1] + L[2]) * L[4] / L[5]\n}\n",
      chain_target());
  EXPECT_TRUE(p.good) << all(p.diagnostics);
  // The product first, no temporary; the second is one chain as it stands.
  EXPECT_NE(p.text.find("set L[1] = (L[2] * 25) + 15"), std::string::npos) << p.text;
  EXPECT_NE(p.text.find("set L[3] = ((L[1] + L[2]) * L[4]) / L[5]"), std::string::npos) << p.text;
}

TEST(Expressions, RightOperandFirstIntoATemporary) {
  const auto p = run_pass("lower_expressions", shared_source + "routine main 1 {\n  set L[1] = L[1] - L[2] * L[3]\n}\n",
                          chain_target());
  EXPECT_NE(p.text.find("set L[19] = L[2] * L[3], L[1] = L[1] - L[19]"), std::string::npos) << p.text;
}

TEST(Expressions, ConstantsBeyondThePlacesAreBuilt) {
  const std::string text =
      "space P \"P\" segment 100 299\nroutine main 1 {\n  set P[100] = 2.718281828459\n  block rapid X (P[100])\n  "
      "end_program\n}\n";
  EXPECT_EQ(difference(text, letters_target()), "");
  const auto p = run_pass("lower_expressions", text, letters_target());
  EXPECT_NE(p.text.find("#2.71828 + (#0.18285 / #100000)"), std::string::npos) << p.text;  // to 1e-10
}

TEST(Expressions, WordsTakeVariablesOnly) {
  const auto p =
      run_pass("lower_expressions",
               "space P \"P\" segment 100 299\nroutine main 1 {\n  N5 block rapid X (P[100] * 2) Y (-P[101])\n}\n",
               letters_target());
  EXPECT_NE(p.text.find("N5 set P[299] = P[100] * 2"), std::string::npos)
      << p.text;  // the label leads to the temporary
  EXPECT_NE(p.text.find("X P[299]"), std::string::npos) << p.text;
}

TEST(Conditions, WholeNumbersCompareExactly) {
  const auto p = run_pass("lower_conditions",
                          "space R \"R\" segment 0 99\nroutine main 1 {\n  set R[1] = 0\n  N10 set R[1] = R[1] + 1\n  "
                          "jump N10 if R[1] ==~ 5\n  set R[2] = R[1] / 3\n  jump N10 if R[2] ==~ 5\n}\n",
                          letters_target());
  EXPECT_NE(p.text.find("if R[1] == 5"), std::string::npos) << p.text;
  EXPECT_NE(p.text.find("abs(R[2] - 5) <= #0.00001"), std::string::npos) << p.text;
  EXPECT_TRUE(has_code(p.diagnostics, "TRN-115"));
}

TEST(Labels, IdentifiersBecomeNumbersWithTheNameAsComment) {
  const auto p =
      run_pass("resolve_labels",
               "routine main 1 {\n  N10 block rapid X 1\n  START: block rapid X 2\n  jump START search backward\n}\n",
               chain_target());
  EXPECT_NE(p.text.find("N20 block rapid X 2 ; \"START\""), std::string::npos) << p.text;
  EXPECT_NE(p.text.find("jump N20"), std::string::npos) << p.text;
}

TEST(Labels, DirectionsFollowTheResolvedPlace) {
  const auto p = run_pass("resolve_labels",
                          "routine main 1 {\n  jump N20\n  N10 block rapid X 1\n  N20 block rapid X 2\n  jump N10\n}\n",
                          structured_target());
  EXPECT_NE(p.text.find("jump N20 search forward"), std::string::npos) << p.text;
  EXPECT_NE(p.text.find("jump N10 search backward"), std::string::npos) << p.text;
}

TEST(Labels, TooLargeNumbersAreRenumbered) {
  const auto p =
      run_pass("resolve_labels", "routine main 1 {\n  N99999 block rapid X 1\n  jump N99999\n}\n", chain_target());
  EXPECT_EQ(p.text.find("99999"), std::string::npos) << p.text;
  EXPECT_TRUE(p.good);
}

// Numbers that passes make stand between those of the source: N10, (made), N15, (made) -> 11 or 12 fits, then tens.
TEST(Numbers, MadeOnesGoBetweenThoseOfTheSource) {
  const auto p = legalise(shared_source + R"(routine main 1 {
  N10 block rapid X 1
  while L[1] < 2 {
    set L[1] = L[1] + 1
  }
  N15 block rapid X 2
  jump N15 if L[1] > 9
  while L[2] < 2 {
    set L[2] = L[2] + 1
  }
})",
                          chain_target());
  EXPECT_NE(p.text.find("N12 jump"), std::string::npos) << p.text;
  EXPECT_NE(p.text.find("N20 jump"), std::string::npos) << p.text;
}

TEST(Numbers, ARangeThatDescendsIsNumberedAnew) {
  const auto p = run_pass("order_numbers",
                          "routine main 1 {\n  N30 block rapid X 1\n  N20 block rapid X 2\n  repeat N30 N20 count 2\n"
                          "  jump N30\n}\n",
                          chain_target());
  EXPECT_NE(p.text.find("repeat N10 N20"), std::string::npos) << p.text;
  EXPECT_NE(p.text.find("jump N10"), std::string::npos) << p.text;
  EXPECT_TRUE(has_code(p.diagnostics, "TRN-190")) << all(p.diagnostics);
}

TEST(Numbers, WithoutRangesTheSourcesNumbersStay) {
  const auto p =
      run_pass("order_numbers", "routine main 1 {\n  N30 block rapid X 1\n  N20 block rapid X 2\n  jump N30\n}\n",
               chain_target());
  EXPECT_NE(p.text.find("N30 block"), std::string::npos) << p.text;
}

}  // namespace
}  // namespace cnctrans::test
