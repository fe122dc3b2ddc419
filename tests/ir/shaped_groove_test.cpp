// Grooves with flanks, corner elements and allowances (reference-language 18.4, CYCLE93). Positions by hand: the insert
// steps at most 95 % of its flat part, lifts 1 mm, and the finishing passes go from both edges toward the middle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "ir/cycles/machining.h"

namespace cnctrans::ir::cycles {
namespace {

std::string rounded(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4f", std::round(v * 1e4) / 1e4 + 0.0);
  std::string s = text;
  s.erase(s.find_last_not_of('0') + 1);
  if (s.back() == '.') s.pop_back();
  return s;
}

std::vector<std::string> moves(const TurnNumbers& numbers, const TurnContext& context, std::string* error) {
  std::vector<std::string> out;
  const auto made = expand(*find_machining("groove.shaped"), numbers, context, error);
  if (!made) return out;
  for (const auto& m : *made) {
    const std::string to = rounded(m.to.x) + " " + rounded(m.to.z);
    if (m.step == TurnStep::rapid) out.push_back("rapid " + to);
    if (m.step == TurnStep::feed) out.push_back("feed " + to);
    if (m.step == TurnStep::dwell) out.push_back("dwell " + rounded(m.seconds));
    if (m.step == TurnStep::arc)
      out.push_back((m.ccw ? "ccw " : "cw ") + to + " about " + rounded(m.centre.x) + " " + rounded(m.centre.z));
  }
  return out;
}
using Lines = std::vector<std::string>;

TEST(ShapedGroove, InsideFromTheRightWithAnInsertOfItsWidth) {
  TurnContext c;
  c.start = {15, 5};
  c.nose_width = 4;
  const TurnNumbers n{{"x", 20},   {"z", -10},          {"width", 4},  {"depth", 3},
                      {"step", 2}, {"base_dwell", 0.5}, {"variant", 7}};
  std::string error;
  // The programmed corner lies toward -Z, so the insert between -14 and -10 is programmed at -14.
  EXPECT_EQ(moves(n, c, &error), (Lines{"rapid 19 5", "rapid 19 -14", "feed 21.5 -14", "rapid 20.5 -14", "feed 23 -14",
                                        "dwell 0.5", "rapid 19 -14", "feed 20 -14", "feed 23 -14", "rapid 19 -14",
                                        "feed 20 -14", "feed 23 -14", "rapid 19 -14"}))
      << error;
  c.edge = 1;  // toward +Z and +X
  EXPECT_EQ(moves(n, c, &error).at(1), "rapid 19 -10");
  c.edge = 0;
  c.edge_at_plus = true;
  EXPECT_EQ(moves(n, c, &error).at(1), "rapid 19 -10");
}

TEST(ShapedGroove, InTheFace) {
  TurnContext c;
  c.start = {50, 10};
  c.nose_width = 3;
  TurnNumbers n{{"x", 30}, {"z", 0}, {"width", 5}, {"depth", 2}, {"step", 2}, {"variant", 2}, {"slope_angle", 90}};
  std::string error;
  EXPECT_TRUE(moves(n, c, &error).empty());
  EXPECT_NE(error.find("cycle.face_groove_left"), std::string::npos);
  c.left_is_larger = true;
  EXPECT_EQ(moves(n, c, &error),
            (Lines{"rapid 27 10", "rapid 27 1", "feed 27 -2", "rapid 27 1", "rapid 25 1", "feed 25 -2", "rapid 25 1",
                   "rapid 27 1", "feed 27 0", "feed 27 -2", "feed 25 -2", "rapid 25 1", "feed 25 0", "feed 25 -2",
                   "feed 27 -2", "rapid 27 1"}))
      << error;
  n["variant"] = 6;
  EXPECT_EQ(moves(n, c, &error).at(1), "rapid 30 1");
  c.left_is_larger = false;
  n["variant"] = 2;
  EXPECT_EQ(moves(n, c, &error).at(1), "rapid 30 1");
}

TEST(ShapedGroove, FlanksOf45DegreesWithChamfersAndRadii) {
  TurnContext c;
  c.start = {40, 20};
  c.nose_width = 2;
  const TurnNumbers n{{"x", 30},       {"z", 0},        {"width", 8},   {"depth", 4},   {"step", 4},    {"flank_1", 45},
                      {"flank_2", 45}, {"outer_1", -1}, {"inner_1", 1}, {"inner_2", 1}, {"variant", 11}};
  std::string error;
  const auto all = moves(n, c, &error);
  ASSERT_FALSE(all.empty()) << error;
  // The radius begins tan(22.5) = 0.4142 before the corner: 5.1716 remain for the insert, in three equal steps.
  EXPECT_EQ(Lines(all.begin(), all.begin() + 6), (Lines{"rapid 40 4.4142", "rapid 31 4.4142", "feed 26 4.4142",
                                                        "rapid 31 4.4142", "rapid 31 6.1381", "feed 26 6.1381"}));
  // The first flank, 4.4142 wide, in three steps: 2.9428 and 1.4714, where it is as deep as it is wide.
  const Lines flank{"rapid 31 2.9428",     "feed 27.0572 2.9428",
                    "rapid 31 2.9428",     "rapid 31 1.4714",
                    "feed 28.5286 1.4714", "rapid 31 1.4714",
                    "rapid 31 0",          "feed 30 0",
                    "feed 26.2929 3.7071", "ccw 26 4.4142 about 27 4.4142",
                    "rapid 31 4.4142"};
  // 16 is the far corner; the insert's other corner lies 2 further.
  const Lines far{"rapid 31 11.0572"};
  // Finishing: the chamfer (width 1 along both), the flank, the radius, to the middle.
  const Lines fine{"rapid 31 -1",
                   "feed 30 -1",
                   "feed 29.2929 0.7071",
                   "feed 26.2929 3.7071",
                   "ccw 26 4.4142 about 27 4.4142",
                   "feed 26 8",
                   "rapid 31 8",
                   "rapid 31 14",
                   "feed 30 14",
                   "feed 26.2929 10.2929",
                   "cw 26 9.5858 about 27 9.5858",
                   "feed 26 6",
                   "rapid 31 6",
                   "rapid 31 4.4142"};
  const auto holds = [&](const Lines& part) {
    return std::search(all.begin(), all.end(), part.begin(), part.end()) != all.end();
  };
  EXPECT_TRUE(holds(flank)) << ::testing::PrintToString(all);
  EXPECT_TRUE(holds(far)) << ::testing::PrintToString(all);
  EXPECT_TRUE(holds(fine)) << ::testing::PrintToString(all);
  EXPECT_EQ(all.back(), fine.back());
}

TEST(ShapedGroove, ARoundCornerOfTheInsertKeepsTheFlank) {
  TurnContext c;
  c.start = {40, 20};
  c.nose_width = 3;
  c.nose_radius = 0.5;
  const TurnNumbers n{{"x", 30}, {"z", 0}, {"width", 8}, {"depth", 4}, {"step", 4}, {"flank_1", 30}, {"variant", 1}};
  std::string error;
  const auto all = moves(n, c, &error);
  ASSERT_FALSE(all.empty()) << error;
  // On the flank the corner's centre is 0.5 away from it: the point of the tool starts at
  // x = 30 + 0.5 sin 30 - 0.5, z = 0.5 cos 30 - 0.5; on the base it is 4 tan 30 + 0.5 / cos 30 - 0.5 - 0.5 tan 30.
  const double z = 4 * std::tan(std::numbers::pi / 6) + 0.5 / std::cos(std::numbers::pi / 6) - 0.5 -
                   0.5 * std::tan(std::numbers::pi / 6);
  const Lines flank{"feed " + rounded(29.75) + " " + rounded(0.5 * std::cos(std::numbers::pi / 6) - 0.5),
                    "feed 26 " + rounded(z)};
  EXPECT_NE(std::search(all.begin(), all.end(), flank.begin(), flank.end()), all.end())
      << ::testing::PrintToString(all);
}

TEST(ShapedGroove, WhatMakesNoSenseIsRefused) {
  TurnContext c;
  c.start = {40, 20};
  c.nose_width = 3;
  const TurnNumbers good{{"x", 30}, {"z", 0}, {"width", 8}, {"depth", 4}, {"step", 4}, {"variant", 1}};
  const auto why = [&](const char* name, double value) {
    TurnNumbers n = good;
    n[name] = value;
    std::string error;
    EXPECT_TRUE(moves(n, c, &error).empty()) << name;
    return error;
  };
  EXPECT_EQ(why("variant", 9), "the machining type of the groove is 1 to 8 or 11 to 18");
  EXPECT_EQ(why("width", 2.9), "the groove is narrower than the tool");
  EXPECT_EQ(why("stock_flank", 2.6), "the groove is narrower than the tool");
  EXPECT_EQ(why("slope_angle", 5), "a groove on a slope is not carried out");
  EXPECT_EQ(why("flank_1", 90), "a flank angle of the groove is not within 0 and 89.999 degrees");
  EXPECT_EQ(why("inner_1", 4.1), "the corner elements of the groove do not fit to its flanks");
  EXPECT_EQ(why("base_dwell", -1), "a dwell in revolutions at the base of a groove is not carried out");
  EXPECT_EQ(why("step", 0), "the step of the groove is not greater than zero");
  c.nose_width = 0;
  EXPECT_NE(why("step", 1).find("nose_width"), std::string::npos);
}

}  // namespace
}  // namespace cnctrans::ir::cycles
