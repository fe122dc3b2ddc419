// Frames along a program: subprograms, several ends, what outlives the program on the target.
#include <gtest/gtest.h>

#include "support.h"

namespace cnctrans::test {
namespace {

ir::Capabilities keeping_target() {
  auto target = letters_target();
  target.shift_survives_end = true;
  return target;
}
std::string program(const std::string& body, const std::string& subs = {}) {
  return "space L \"L\" starts_at_zero segment 0 19 forgotten\nroutine main 1 {\n" + body + "  end_program\n}\n" + subs;
}
std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(FramesOfPrograms, EveryEndTakesTheShiftBack) {
  const auto p =
      run_pass("convert_frames",
               program("  block frame chain translate replace X 100\n  block frame chain rotate compose angle 30\n"
                       "  jump N10 if L[1] > 0\n  block rapid X 0\n  end_program\n  N10 block rapid X 5\n"),
               keeping_target(), "sinumerik-mill", "fagor-mill");
  EXPECT_EQ(count(p.text, "frame shift translate clear"), 2U) << p.text;
  EXPECT_EQ(count(p.text, "frame rotation rotate clear"), 2U) << p.text;
}

TEST(FramesOfPrograms, OnlyTheEndWhereItCanBeInForce) {
  const auto p = run_pass("convert_frames",
                          program("  jump N10 if L[1] > 0\n  block rapid X 1\n  end_program\n"
                                  "  N10 block frame chain translate replace X 100\n  block rapid X 0\n"),
                          keeping_target(), "sinumerik-mill", "fagor-mill");
  EXPECT_EQ(count(p.text, "frame shift translate clear"), 1U) << p.text;
  EXPECT_EQ(count(p.text, "rotation"), 0U) << p.text;  // nothing ever turns
}

TEST(FramesOfPrograms, SubprogramStartsWithTheShiftOfItsCaller) {
  // 100 and then 5 more: the target has no additive shift.
  const std::string text = program(
      "  block frame chain translate replace X 100\n  call 20\n  block rapid Y 1\n  block frame chain translate add Y "
      "3\n"
      "  block rapid X 0 Y 0\n",
      "routine sub 20 {\n  block frame chain translate add X 5\n  block rapid X 1\n  return\n}\n");
  const auto p = run_pass("convert_frames", text, keeping_target(), "sinumerik-mill", "fagor-mill");
  EXPECT_TRUE(p.good) << all(p.diagnostics);
  EXPECT_NE(p.text.find("frame shift translate replace_named X #105"), std::string::npos) << p.text;
  EXPECT_EQ(difference(text, keeping_target(), "sinumerik-mill", "fagor-mill"), "");
}

TEST(FramesOfPrograms, CallersThatDisagreeShareAVariable) {
  const auto p =
      run_pass("convert_frames",
               program("  call 20\n  block frame chain translate replace X 100\n  call 20\n",
                       "routine sub 20 {\n  block frame chain translate add X 5\n  block rapid X 1\n  return\n}\n"),
               keeping_target(), "sinumerik-mill", "fagor-mill");
  EXPECT_TRUE(has_code(p.diagnostics, "TRN-490")) << p.text;
  EXPECT_NE(p.text.find("set P[299] = #0\n  call 20\n  set P[299] = 100"), std::string::npos) << p.text;
  EXPECT_NE(p.text.find("set P[299] = #5 + P[299]\n  block frame shift translate replace_named X P[299]"),
            std::string::npos)
      << p.text;
}

TEST(FramesOfPrograms, EndInASubprogram) {
  // The shift of the caller is in force where the subprogram ends the program.
  const auto p = run_pass("convert_frames",
                          program("  block frame chain translate replace X 100\n  call 20\n  block rapid X 0\n",
                                  "routine sub 20 {\n  block rapid X 1\n  jump N10 if L[1] > 0\n  return\n  N10 "
                                  "end_program\n}\n"),
                          keeping_target(), "sinumerik-mill", "fagor-mill");
  EXPECT_EQ(count(p.text, "frame shift translate clear"), 2U) << p.text;
  EXPECT_EQ(count(p.text, "rotation"), 0U) << p.text;
}

TEST(FramesOfPrograms, UnknownShiftIsReplacedOnTheAxesThatHaveOne) {
  // One branch has shifted Y: X 5 alone must end that. No axis that the program never shifts is named.
  const auto p = run_pass("convert_frames",
                          program("  jump N10 if L[1] > 0\n  block frame chain translate replace Y 7\n"
                                  "  N10 block frame chain translate replace X 5\n  block rapid X 0\n"),
                          keeping_target(), "sinumerik-mill", "fagor-mill");
  EXPECT_NE(p.text.find("replace_named X 5 Y #0\n"), std::string::npos) << p.text;
}

TEST(FramesOfPrograms, AVariableThatTheCalleeChangesIsNotReadAgain) {
  const auto p = run_pass("convert_frames",
                          program("  set L[1] = 10\n  block frame chain translate replace X (L[1])\n  call 20\n"
                                  "  block frame chain translate add Y 3\n  block rapid X 0\n",
                                  "routine sub 20 {\n  set L[1] = 20\n  return\n}\n"),
                          structured_target(), "sinumerik-mill", "sinumerik-mill");
  // What the shift was set from is kept before the call changes it.
  EXPECT_NE(p.text.find("set v._T1 = L[1]\n  block frame chain translate replace X L[1]\n  call 20\n"),
            std::string::npos)
      << p.text;
  EXPECT_NE(p.text.find("replace X v._T1 Y #3"), std::string::npos) << p.text;
}

TEST(FramesOfPrograms, ARotationInsideTheShiftIsAddedToIt) {
  const auto p =
      run_pass("convert_frames",
               program("  block frame shift translate replace X 5\n  block frame rotation rotate replace angle 30\n"
                       "  block rapid X 0\n"),
               structured_target(), "num-mill", "sinumerik-mill");
  EXPECT_EQ(count(p.text, "translate"), 1U) << p.text;
  EXPECT_EQ(count(p.text, "rotate compose"), 1U) << p.text;
}

}  // namespace
}  // namespace cnctrans::test
