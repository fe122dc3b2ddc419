// Parting off and grooves with alternating plunges (operating manual turning, CYCLE92 and CYCLE930). Positions by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
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

using Lines = std::vector<std::string>;
Lines moves(const char* cycle, const TurnNumbers& numbers, const TurnContext& context, std::string* error) {
  Lines out;
  const auto made = expand(*find_machining(cycle), numbers, context, error);
  if (!made) return out;
  for (const auto& m : *made) {
    const std::string to = rounded(m.to.x) + " " + rounded(m.to.z);
    if (m.step == TurnStep::rapid) out.push_back("rapid " + to);
    if (m.step == TurnStep::feed) out.push_back("feed " + to);
    if (m.step == TurnStep::arc)
      out.push_back((m.ccw ? "ccw " : "cw ") + to + " about " + rounded(m.centre.x) + " " + rounded(m.centre.z));
    if (m.step == TurnStep::spindle_speed) out.push_back("turns " + rounded(m.speed));
    if (m.step == TurnStep::spindle_cutting_speed)
      out.push_back("cutting " + rounded(m.speed) + " below " + rounded(m.limit));
  }
  return out;
}
std::string why(const char* cycle, const TurnNumbers& numbers, const TurnContext& context) {
  std::string error;
  EXPECT_TRUE(moves(cycle, numbers, context, &error).empty());
  return error;
}
TurnContext tool(double width, double radius) {
  TurnContext c;
  c.start = {40, 5};
  c.nose_width = width;
  c.nose_radius = radius;
  return c;
}

// The middle of the corner goes round the edge at 1.4: it begins 1.4 - 1 above the surface, so the programmed corner is
// on the surface there; Z of it is -50 + 1 + 0.4 - 3.
TEST(PartingOff, ARoundedEdgeWithARoundedCorner) {
  const TurnNumbers n{{"nominal", 60}, {"z", -50},       {"depth", -0.2},       {"change_depth", 10}, {"outer_1", 1},
                      {"mode", 0},     {"clearance", 2}, {"second_speed", 500}, {"finish_feed", 1}};
  std::string error;
  EXPECT_EQ(moves("part.off", n, tool(3, 0.4), &error),
            (Lines{"rapid 40 -51.6", "rapid 32 -51.6", "feed 30 -51.6", "ccw 28.6 -53 about 28.6 -51.6", "feed 5 -53",
                   "turns 500", "feed -0.1 -53", "rapid 32 -53"}))
      << error;
}

TEST(PartingOff, DepthsAsIncrements) {
  const TurnNumbers n{{"nominal", 60}, {"z", -50},       {"depth", 8},        {"change_depth", 3},
                      {"mode", 1011},  {"clearance", 1}, {"first_speed", 90}, {"second_speed", 400}};
  std::string error;
  EXPECT_EQ(moves("part.off", n, tool(3, 0), &error),
            (Lines{"rapid 40 -53", "rapid 31 -53", "cutting 90 below 0", "feed 27 -53", "turns 400", "feed 22 -53",
                   "rapid 31 -53"}))
      << error;
}

TEST(PartingOff, WhatIsRefused) {
  TurnNumbers n{{"nominal", 60}, {"z", -50}, {"depth", 20}, {"clearance", 2}};
  EXPECT_NE(why("part.off", n, tool(0, 0)).find("nose_width"), std::string::npos);
  n["finish_feed"] = 0.1;  // the change at X0, below the end at X20
  EXPECT_NE(why("part.off", n, tool(3, 0)).find("below the final depth"), std::string::npos);
  n["change_depth"] = 59;
  n["outer_1"] = 2;
  EXPECT_NE(why("part.off", n, tool(3, 0)).find("edge of the part"), std::string::npos);
  n["change_depth"] = 30;
  n["first_speed"] = 100;
  n["speed_limit"] = 2000;
  EXPECT_NE(why("part.off", n, tool(3, 0)).find("cutting speed"), std::string::npos);
}

TEST(AlternatingGroove, InsideWithAToolOfItsWidth) {
  TurnContext c = tool(3, 0);
  c.start = {15, 5};
  const TurnNumbers n{{"nominal", 40}, {"z", -10},       {"width", 3},    {"depth", 2},
                      {"mode", 1},     {"clearance", 1}, {"variant", 330}};
  std::string error;
  EXPECT_EQ(moves("groove.alternate", n, c, &error),
            (Lines{"rapid 19 5", "rapid 19 -10", "feed 22 -10", "rapid 19 -10", "feed 20 -10", "feed 22 -10",
                   "rapid 19 -10", "feed 20 -10", "feed 22 -10", "rapid 19 -10"}))
      << error;
}

TEST(AlternatingGroove, FinishingWithAChamferByItsDigit) {
  const TurnNumbers n{{"nominal", 60}, {"z", -20},  {"width", 3},     {"depth", 5},    {"mode", 101},
                      {"outer_1", 1},  {"form", 1}, {"clearance", 1}, {"variant", 120}};
  std::string error;
  EXPECT_EQ(moves("groove.alternate", n, tool(3, 0), &error),
            (Lines{"rapid 40 -20", "rapid 31 -20", "rapid 31 -21", "feed 30 -21", "feed 29 -20", "feed 25 -20",
                   "rapid 31 -20", "feed 30 -20", "feed 25 -20", "rapid 31 -20"}))
      << error;
}

TEST(AlternatingGroove, WhatIsRefused) {
  TurnNumbers n{{"nominal", 60}, {"z", -20}, {"width", 10}, {"depth", 50}, {"clearance", 1}, {"variant", 110}};
  TurnContext c = tool(3, 0);
  EXPECT_NE(why("groove.alternate", n, c).find("cycle.groove_depth"), std::string::npos);
  c.choices.groove_depth = GrooveDepth::absolute;
  std::string error;
  EXPECT_EQ(moves("groove.alternate", n, c, &error).at(2), "feed 25 -16.5") << error;
  n["step"] = 1e-6;
  EXPECT_NE(why("groove.alternate", n, c).find("too many"), std::string::npos);
  n["step"] = 0;
  n["variant"] = 100;
  EXPECT_NE(why("groove.alternate", n, c).find("machining type"), std::string::npos);
  n["variant"] = 110;
  n["width_top"] = 12;
  EXPECT_NE(why("groove.alternate", n, c).find("widths"), std::string::npos);
  n["width_top"] = 10;
  n["flank_1"] = 10;
  EXPECT_NE(why("groove.alternate", n, c).find("plain form"), std::string::npos);
  n["flank_1"] = 0;
  n["slope_angle"] = 5;
  EXPECT_NE(why("groove.alternate", n, c).find("slope"), std::string::npos);
}

}  // namespace
}  // namespace cnctrans::ir::cycles
