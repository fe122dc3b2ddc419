// Tools: where length compensation is switched on for a target that asks for it.
#include <gtest/gtest.h>

#include "support.h"

namespace cnctrans::test {
namespace {

/// The main program's lines after the pass, on a mill that has length compensation only when it is switched on.
std::string with_switches(const std::string& body, const std::string& subs = {}) {
  const std::string text =
      "space L \"L\" starts_at_zero segment 0 19 forgotten\nroutine main 1 {\n" + body + "  end_program\n}\n" + subs;
  return run_pass("convert_tools", text, letters_target(), "sinumerik-mill", "fagor-mill").text;
}
std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(LengthCompensation, StandsInTheFirstMoveAlongTheToolAxis) {
  const auto text = with_switches("  block rapid X 0 Y 0\n  block rapid Z 50\n  block rapid Z 10\n");
  EXPECT_NE(text.find("block length_comp on, rapid Z"), std::string::npos) << text;
  EXPECT_EQ(count(text, "length_comp on"), 1U) << text;
}

TEST(LengthCompensation, ACycleIsSuchAMove) {
  const auto text = with_switches(
      "  block feed 100, rapid X 0 Y 0\n  block cycle hole drill reference 2 bottom -15 retract 50, modal X 5\n");
  EXPECT_NE(text.find("block length_comp on, "), std::string::npos) << text;
}

TEST(LengthCompensation, EveryPathHasIt) {
  // The jump passes the first move along Z: the second one has to say it as well.
  const auto text = with_switches("  jump N10 if L[1] > 0\n  block rapid Z 50\n  N10 block rapid Z 20\n");
  EXPECT_EQ(count(text, "length_comp on"), 2U) << text;
}

TEST(LengthCompensation, FirstMoveInASubprogram) {
  const auto text = with_switches("  block rapid X 0\n  call 20\n  block rapid Z 9\n",
                                  "routine sub 20 {\n  block rapid Z 5\n  block rapid Z 6\n  return\n}\n");
  EXPECT_EQ(count(text, "length_comp on"), 1U) << text;
  EXPECT_GT(text.find("length_comp on"), text.find("routine sub")) << text;
}

TEST(LengthCompensation, OnAgainAfterTheReferencePoint) {
  const auto text = with_switches("  block rapid Z 50\n  block reference_point Z 0\n  block rapid Z 20\n");
  EXPECT_EQ(count(text, "length_comp on"), 2U) << text;
  EXPECT_EQ(count(text, "length_comp off"), 0U) << text;
}

}  // namespace
}  // namespace cnctrans::test
