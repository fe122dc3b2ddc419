// Call frames and variables: who sees which variable stays as it was.
#include <gtest/gtest.h>

#include "support.h"

namespace cnctrans::test {
namespace {

TEST(Calls, NewLevelWithArguments) {
  // The callee's P0, P1 are its own; the caller's P0 keeps 7.
  const std::string text = letters_source + R"(routine main 1 {
    set P[0] = 7
    call 5 ("A" = 3, "C" = P[0] * 2) new_level
    block rapid X (P[0]) Y (P[1])
    call 5 ("C" = 1) new_level
    end_program
  }
  routine sub 5 {
    set P[1] = P[0] + P[2]
    block rapid X (P[0]) Y (P[1]) Z (P[2])
    set P[0] = 100
    return
  })";
  EXPECT_EQ(difference(text, chain_target()), "");
  EXPECT_EQ(difference(text, structured_target()), "");
  EXPECT_EQ(difference(text, letters_target()), "");
}

TEST(Calls, SharedLevelSeesTheCallersVariables) {
  const std::string text = letters_source + R"(routine main 1 {
    set P[0] = 7, P[3] = 1
    call 5
    block rapid X (P[0]) Y (P[3])
    end_program
  }
  routine sub 5 {
    set P[0] = P[0] + 1
    call 6
    return
  }
  routine sub 6 {
    set P[3] = P[0] * 2
    return
  })";
  EXPECT_EQ(difference(text, chain_target()), "");
  EXPECT_EQ(difference(text, structured_target()), "");
}

TEST(Calls, NamesakesArePartedAndCallsReachTheFirst) {
  // A local and a global subprogram 10: X10 comes from the first, the other keeps a place of its own.
  const std::string text = letters_source + R"(routine main 1 {
    call 10
    call 20
    end_program
  }
  routine sub 10 {
    block rapid X 10
    return
  }
  routine sub 10 {
    block rapid X 99
    return
  }
  routine sub 20 {
    call 10
    block rapid Y 5
    return
  })";
  for (const auto& target : {chain_target(), structured_target()}) {
    EXPECT_EQ(difference(text, target), "");
    const auto r = legalise(text, target);
    EXPECT_TRUE(has_code(r.diagnostics, "TRN-186"));
    for (const auto& routine : r.program.routines) EXPECT_EQ(r.program.find(routine.name), &routine);
  }
}

TEST(Calls, VariableOfTheCallersLevelOutlivesTheCalledRoutine) {
  // 5 counts P3 on the main program's level: Y1, Y2. 7 does so on its own level for 6: Y1, Y2, and again Y1, Y2.
  EXPECT_EQ(difference(letters_source + R"(routine main 1 {
    call 5
    call 5
    call 7 new_level
    call 7 new_level
    end_program
  }
  routine sub 5 {
    set P[3] = P[3] + 1
    block rapid Y (P[3])
    return
  }
  routine sub 7 {
    call 6
    call 6
    return
  }
  routine sub 6 {
    set P[4] = P[4] + 1
    block rapid Y (P[4])
    return
  })",
                       structured_target()),
            "");
}

TEST(Calls, TwoLevelsShareOneHelper) {
  // 6 works once on the main program's P3 and once on that of 5: the outer one must survive.
  const std::string text = letters_source + R"(routine main 1 {
    set P[3] = 1
    call 6
    call 5 ("D" = 40) new_level
    block rapid X (P[3])
    end_program
  }
  routine sub 5 {
    call 6
    block rapid Y (P[3])
    return
  }
  routine sub 6 {
    set P[3] = P[3] + 10
    return
  })";
  EXPECT_EQ(difference(text, chain_target()), "");
  EXPECT_EQ(difference(text, structured_target()), "");
}

TEST(Calls, CalleesThatDoNotUseAVariableLeaveItAlone) {
  // 6 is called on the main program's level and on one of its own; P7 is the main program's alone.
  const std::string text = letters_source + R"(routine main 1 {
    set P[7] = 70, P[0] = 1
    call 6
    call 6 ("A" = 5) new_level
    block rapid X (P[7]) Y (P[0])
    end_program
  }
  routine sub 6 {
    set P[0] = P[0] + 1
    block rapid Z (P[0])
    return
  })";
  EXPECT_EQ(difference(text, chain_target()), "");
  EXPECT_EQ(difference(text, structured_target()), "");
  // P0 of the main program waits while the call on a level of its own works in it; P7 is never touched.
  const auto target_text = legalise(text, structured_target()).text;
  EXPECT_EQ(target_text.find("P7_OF_CALLER"), std::string::npos) << target_text;
  EXPECT_NE(target_text.find("P0_OF_CALLER"), std::string::npos) << target_text;
}

TEST(Calls, ArgumentsAreSetAtOnce) {
  // A and B swap the caller's values: on shared variables that needs a copy.
  const std::string text = letters_source + R"(routine main 1 {
    set P[0] = 1, P[1] = 2
    call 5 ("A" = P[1], "B" = P[0]) new_level
    end_program
  }
  routine sub 5 {
    block rapid X (P[0]) Y (P[1])
    return
  })";
  EXPECT_EQ(difference(text, chain_target()), "");
  EXPECT_EQ(difference(text, structured_target()), "");
}

const char* const named_program = R"(routine main 1 {
    declare real in v "LEN" = (80), "ALPHA"
    set R[1] = 5
    call "BOSS" (v.LEN / 2, nothing, ref R[1])
    block rapid X (R[1]) Y (v.LEN)
    call "BOSS" (1)
    end_program
  }
  routine sub "BOSS" has_signature param "RAD" sets v.RAD param "DEP" sets v.DEP param "RES" by_reference sets v.RES {
    declare real in v "LEN"
    set v.LEN = v.LEN + v.RAD
    set v.RES = v.RES + v.LEN
    block rapid X (v.RAD) Y (v.DEP) Z (v.RES)
    return
  })";

TEST(Calls, FormalParametersToLettersAndToSharedVariables) {
  const std::string text = named_source + named_program;
  EXPECT_EQ(difference(text, letters_target()), "");
  EXPECT_EQ(difference(text, chain_target()), "");
}

TEST(Calls, LettersFollowThePosition) {
  const auto p = legalise(named_source + named_program, letters_target());
  ASSERT_TRUE(p.good) << all(p.diagnostics);
  EXPECT_NE(p.text.find("(\"A\" = "), std::string::npos) << p.text;
  EXPECT_NE(p.text.find("new_level"), std::string::npos) << p.text;
}

TEST(Calls, ModalCallsRunAfterEachMotion) {
  const std::string text = letters_source + R"(routine main 1 {
    set P[1] = 100
    modal_call here call 6 ("A" = 3) new_level
    block rapid X 1
    set P[2] = 5
    block rapid Y (P[2])
    modal_call off
    block rapid X 9
    call 6
    end_program
  }
  routine sub 6 {
    set P[1] = P[1] + P[0]
    block rapid Z (P[1])
    return
  })";
  EXPECT_EQ(difference(text, chain_target()), "");
  EXPECT_EQ(difference(text, structured_target()), "");
}

TEST(Calls, RecursionIsRefused) {
  const auto p = run_pass(
      "lower_calls",
      letters_source +
          "routine main 1 {\n  call 5 (\"A\" = 3) new_level\n}\nroutine sub 5 {\n  call 5 new_level\n  return\n}\n",
      chain_target());
  EXPECT_TRUE(has_code(p.diagnostics, "TRN-121"));
}

TEST(Returns, EarlyReturnBecomesAJump) {
  const std::string text = shared_source + R"(routine main 1 {
    set L[1] = 1
    call 5
    set L[1] = 2
    call 5
    end_program
  }
  routine sub 5 {
    block rapid X (L[1])
    if L[1] > 1 {
      return
    }
    block rapid Y 5
    return
  })";
  EXPECT_EQ(difference(text, letters_target()), "");
  EXPECT_EQ(difference(text, chain_target()), "");
}

TEST(Returns, ProgramEndInsideASubprogram) {
  const std::string text = shared_source + R"(routine main 1 {
    call 5
    block rapid X 99
    end_program
  }
  routine sub 5 {
    block rapid X 1
    call 6
    block rapid X 88
    return
  }
  routine sub 6 {
    block rapid X 2
    end_program
  })";
  EXPECT_EQ(difference(text, structured_target()), "");
}

TEST(Variables, NumbersStayWhereTheTargetHasThem) {
  const auto p = run_pass("map_variables",
                          "space P \"P\" segment 0 25 level forgotten segment 100 299\nroutine main 1 {\n  set P[110] "
                          "= 1, P[199] = P[110]\n}\n",
                          chain_target());
  EXPECT_NE(p.text.find("set L[110] = 1, L[199] = L[110]"), std::string::npos) << p.text;
}

TEST(Variables, WholeRangeIsShifted) {
  // R0.. go to P100..: the same last digits.
  const auto p = run_pass("map_variables", "space R \"R\" segment 0 99\nroutine main 1 {\n  set R[7] = R[R[8]]\n}\n",
                          letters_target());
  EXPECT_NE(p.text.find("set P[107] = P[P[108] + #100]"), std::string::npos) << p.text;
  EXPECT_NE(p.text.find("R7=P107"), std::string::npos) << p.text;
}

TEST(Variables, ComputedNumberNeedsOneDistance) {
  const auto p = run_pass("map_variables",
                          "space P \"P\" segment 100 299\nroutine main 1 {\n  set P[150] = 1, P[250] = P[P[150]]\n}\n",
                          structured_target());
  EXPECT_TRUE(has_code(p.diagnostics, "TRN-129")) << p.text;
}

TEST(Variables, ReadBeforeWrittenStartsAtZero) {
  const std::string text =
      shared_source +
      "routine main 1 {\n  N10 set L[5] = L[5] + 1\n  block rapid X (L[5])\n  jump N10 if L[5] < 3\n  end_program\n}\n";
  const auto p = run_pass("map_variables", text, letters_target());
  EXPECT_NE(p.text.find("set P[5] = #0"), std::string::npos) << p.text;
  EXPECT_EQ(difference(text, letters_target()), "");
}

}  // namespace
}  // namespace cnctrans::test
