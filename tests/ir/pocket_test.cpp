// Pockets with islands: the way of the tool, measured against walls that are computed here by themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "ir/cycles/milling/pocket_moves.h"

namespace cnctrans::ir::cycles {
namespace {

constexpr double pi = 3.14159265358979323846;

MillContour polygon(const std::vector<PocketPoint>& points) {
  MillContour c;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto a = points[i], b = points[(i + 1) % points.size()];
    c.elements.push_back({a.u, a.v, b.u, b.v});
  }
  return c;
}
MillContour box(double u0, double v0, double u1, double v1) {
  return polygon({{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}});
}
MillContour circle(double u, double v, double r, bool ccw = true) {
  MillContour c;
  c.elements.push_back({u + r, v, u + r, v, true, ccw, u, v});
  return c;
}

struct Case {
  std::vector<MillContour> contours;
  std::map<std::string_view, double> words = {{"operation", 1}, {"along", 1}, {"signed_infeed", 5}, {"mill_feed", 300}};
  double radius = 3, bottom = -10;
  bool over = false;
};
std::optional<std::vector<MillMove>> moves_of(Case c, std::string* error) {
  c.contours.front().surface = 0;
  MillNumbers mill;
  mill.shape = find_mill_shape("pocket.contour");
  mill.words = c.words;
  HoleNumbers levels;
  levels.reference = levels.surface = 2;
  levels.bottom = c.bottom;
  levels.initial = levels.retract = 50;
  levels.has_retract = true;
  MillContext context;
  context.w = 50;
  context.tool_radius = c.radius;
  context.contours = &c.contours;
  context.links_at_depth = !c.over;
  return expand(mill, levels, context, error);
}

double to_segment(PocketPoint p, PocketPoint a, PocketPoint b) {
  const double du = b.u - a.u, dv = b.v - a.v, l = du * du + dv * dv;
  const double t = l == 0 ? 0 : std::clamp(((p.u - a.u) * du + (p.v - a.v) * dv) / l, 0.0, 1.0);
  return std::hypot(p.u - a.u - t * du, p.v - a.v - t * dv);
}
/// Points of the contour, closer together than `step` mm.
std::vector<PocketPoint> dots(const MillContour& c, double step) {
  std::vector<PocketPoint> out;
  for (const auto& e : c.elements) {
    const int n = std::max(1, static_cast<int>(length_of(e) / step) + 1);
    for (int k = 0; k < n; ++k) out.push_back(point_on(e, double(k) / n));
  }
  return out;
}
bool in_polygon(const std::vector<PocketPoint>& points, PocketPoint p) {
  bool in = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto a = points[i], b = points[(i + 1) % points.size()];
    if ((a.v > p.v) != (b.v > p.v) && p.u < a.u + (b.u - a.u) * (p.v - a.v) / (b.v - a.v)) in = !in;
  }
  return in;
}
/// Distance to the nearest wall that bounds the pocket, lines and circles exactly.
double to_walls(const std::vector<MillContour>& contours, PocketPoint p) {
  double least = 1e300;
  for (const auto& c : contours) {
    for (const auto& e : c.elements) {
      const double d = e.arc ? std::abs(std::hypot(p.u - e.cu, p.v - e.cv) - std::hypot(e.u0 - e.cu, e.v0 - e.cv))
                             : to_segment(p, {e.u0, e.v0}, {e.u1, e.v1});
      least = std::min(least, d);
    }
  }
  return least;
}

/// The straight pieces of the ways below the surface.
struct Piece {
  PocketPoint a, b;
  double w = 0;
};
std::vector<Piece> below(const std::vector<MillMove>& moves) {
  std::vector<Piece> out;
  PocketPoint at;
  double w = 50;
  for (const auto& m : moves) {
    const bool deep = m.w < 0 || w < 0;
    if (m.step == MillStep::arc) {
      const MillElement e{at.u, at.v, m.u, m.v, true, m.ccw, m.cu, m.cv};
      const int n = static_cast<int>(length_of(e) / 0.05) + 8;
      for (int k = 0; deep && k < n; ++k)
        out.push_back({point_on(e, double(k) / n), point_on(e, double(k + 1) / n), m.w});
    } else if (deep) {
      out.push_back({at, {m.u, m.v}, std::max(w, m.w)});
    }
    at = {m.u, m.v};
    w = m.w;
  }
  return out;
}

void keeps_off_walls(const Case& c, const std::vector<MillMove>& moves) {
  for (const auto& piece : below(moves)) {
    const int n = static_cast<int>(std::hypot(piece.b.u - piece.a.u, piece.b.v - piece.a.v) / 0.5) + 1;
    for (int k = 0; k <= n; ++k) {
      const double t = double(k) / n;
      const PocketPoint p{piece.a.u + t * (piece.b.u - piece.a.u), piece.a.v + t * (piece.b.v - piece.a.v)};
      ASSERT_GT(to_walls(c.contours, p), c.radius - 0.004) << p.u << ' ' << p.v;
    }
  }
}
/// Every place that the tool's middle can take is cut at the bottom.
void clears(const Case& c, const std::vector<MillMove>& moves) {
  std::vector<std::vector<PocketPoint>> outlines;
  for (const auto& contour : c.contours) outlines.push_back(dots(contour, 0.5));
  std::vector<Piece> floor;
  for (const auto& p : below(moves)) {
    if (std::abs(p.w - c.bottom) < 1e-9) floor.push_back(p);
  }
  ASSERT_FALSE(floor.empty());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-70, 70);
  for (int i = 0; i < 4000; ++i) {
    const PocketPoint p{place(random), place(random)};
    bool in = in_polygon(outlines[0], p);
    for (std::size_t k = 1; in && k < outlines.size(); ++k) in = !in_polygon(outlines[k], p);
    if (!in || to_walls(c.contours, p) < c.radius + 0.6) continue;
    double least = 1e300;
    for (const auto& f : floor) least = std::min(least, to_segment(p, f.a, f.b));
    ASSERT_LT(least, c.radius + 0.02) << p.u << ' ' << p.v;
  }
}

bool has_move(const std::vector<MillMove>& moves, MillStep step, double u, double v, double w) {
  return std::any_of(moves.begin(), moves.end(), [&](const MillMove& m) {
    return m.step == step && std::abs(m.u - u) < 1e-9 && std::abs(m.v - v) < 1e-9 && std::abs(m.w - w) < 1e-9;
  });
}

TEST(Pocket, FinishingOfASquareWithASquareIslandIsExact) {
  Case c;
  c.contours = {box(0, 0, 60, 40), box(25, 15, 35, 25)};
  c.words["operation"] = 2;
  c.words.erase("signed_infeed");  // in one pass
  std::string error;
  const auto moves = moves_of(c, &error);
  ASSERT_TRUE(moves) << error;
  // Walls less the radius 3: corners (3,3) to (57,37). Round the island: sides 3 off, quadrants about its corners.
  for (const auto& [u, v] : {std::pair(3, 3), {57, 3}, {57, 37}, {3, 37}})
    EXPECT_TRUE(has_move(*moves, MillStep::feed, u, v, -10)) << u << ' ' << v;
  for (const auto& [u, v] : {std::pair(35, 12), {22, 15}, {25, 28}, {38, 25}}) {
    const auto arc = std::find_if(moves->begin(), moves->end(), [u = u, v = v](const MillMove& m) {
      return m.step == MillStep::arc && std::hypot(m.u - u, m.v - v) < 1e-9;
    });
    ASSERT_NE(arc, moves->end()) << u << ' ' << v;
    EXPECT_FALSE(arc->ccw);  // the outline goes counter-clockwise, the island the other way round
    EXPECT_NEAR(std::hypot(arc->u - arc->cu, arc->v - arc->cv), 3, 1e-9);
  }
  keeps_off_walls(c, *moves);
}

TEST(Pocket, RingsOfARoundPocket) {
  Case c;
  c.contours = {circle(0, 0, 20)};
  c.radius = 5;
  c.bottom = -5;
  c.words["step"] = 6;
  c.words["wall_stock"] = 1;
  std::string error;
  const auto moves = moves_of(c, &error);
  ASSERT_TRUE(moves) << error;
  // 20 - 5 - 1 = 14 at the wall, then 8 and 2: nothing is left inside of 2 + 5.
  std::vector<double> radii;
  for (const auto& m : *moves) {
    if (m.step == MillStep::arc) radii.push_back(std::hypot(m.u - m.cu, m.v - m.cv));
  }
  ASSERT_EQ(radii.size(), 3U);
  EXPECT_NEAR(radii[0], 2, 1e-9);
  EXPECT_NEAR(radii[1], 8, 1e-9);
  EXPECT_NEAR(radii[2], 14, 1e-9);
  EXPECT_EQ(moves->back().w, 50);
}

TEST(Pocket, EqualAndFixedPasses) {
  const auto depths = [](double infeed) {
    Case c;
    c.contours = {circle(0, 0, 20)};
    c.words["signed_infeed"] = infeed;
    std::string error;
    const auto moves = moves_of(c, &error);
    std::set<double> out;
    for (const auto& m : moves.value_or(std::vector<MillMove>{})) {
      if (m.step == MillStep::arc) out.insert(-m.w);
    }
    return out;
  };
  EXPECT_EQ(depths(4), (std::set<double>{10.0 / 3, 20.0 / 3, 10}));  // 10 in 3 equal passes
  EXPECT_EQ(depths(-4), (std::set<double>{4, 8, 10}));
}

TEST(Pocket, RampIntoTheMaterial) {
  Case c;
  c.contours = {circle(0, 0, 20)};
  c.bottom = -4;
  c.words["plunge_angle"] = 10;
  std::string error;
  const auto moves = moves_of(c, &error);
  ASSERT_TRUE(moves) << error;
  PocketPoint at;
  double w = 50;
  for (const auto& m : *moves) {
    if (m.step != MillStep::rapid && m.w < w) {  // falls by the tangent of 10 degrees
      const double way = m.step == MillStep::arc ? length_of({at.u, at.v, m.u, m.v, true, m.ccw, m.cu, m.cv})
                                                 : std::hypot(m.u - at.u, m.v - at.v);
      EXPECT_NEAR((w - m.w) / way, std::tan(10 * pi / 180), 1e-6);
    }
    at = {m.u, m.v};
    w = m.w;
  }
  clears(c, *moves);
}

TEST(Pocket, LargestContourIsOutsideAndIslandsInIslandsDoNotCount) {
  Case c;
  c.contours = {circle(0, 0, 4), box(-30, -30, 30, 30), circle(0, 0, 10)};
  c.radius = 5;
  std::string error;
  const auto moves = moves_of(c, &error);
  ASSERT_TRUE(moves) << error;
  for (const auto& p : below(*moves)) EXPECT_GT(std::hypot(p.a.u, p.a.v), 15 - 1e-6);
  clears({{box(-30, -30, 30, 30), circle(0, 0, 10)}, c.words, 5, -10, false}, *moves);
}

TEST(Pocket, EntriesAreWhereTheRoughingGoesIn) {
  Case c;
  c.contours = {box(0, 0, 100, 20)};
  c.contours.push_back(box(40, -5, 60, 25));  // parts the pocket in two
  std::string error;
  const auto moves = moves_of(c, &error);
  ASSERT_TRUE(moves) << error;
  MillNumbers mill;
  mill.shape = find_mill_shape("pocket.contour");
  mill.words = c.words;
  MillContext context;
  context.tool_radius = 3;
  context.contours = &c.contours;
  const auto entries = pocket_entries(mill, context, &error);
  ASSERT_EQ(entries.size(), 2U) << error;
  for (const auto& e : entries) EXPECT_TRUE(has_move(*moves, MillStep::feed, e.u, e.v, -5)) << e.u << ' ' << e.v;
}

TEST(Pocket, FaultsAreTold) {
  const auto error_of = [](Case c) {
    std::string error;
    EXPECT_FALSE(moves_of(std::move(c), &error));
    return error;
  };
  Case c;
  c.contours = {box(0, 0, 5, 40)};
  EXPECT_EQ(error_of(c), "the tool is too large for the pocket and its allowance");
  c.contours = {box(0, 0, 50, 40)};
  c.words["step"] = 6.5;
  EXPECT_EQ(error_of(c), "the step in the plane is larger than the diameter of the tool");
  c.words.erase("step");
  c.contours[0].elements.pop_back();
  EXPECT_EQ(error_of(c), "a contour of the pocket is not closed");
  c.contours = {polygon({{0, 0}, {50, 40}, {50, 0}, {0, 30}})};
  EXPECT_EQ(error_of(c), "a contour of the pocket crosses itself");
  c.contours = {box(0, 0, 50, 40), box(0, 0, 10, 10)};
  EXPECT_EQ(error_of(c), "two contours of the pocket begin at the same point");
  c.contours = {box(0, 0, 50, 40), box(-5, 10, 10, 20)};
  c.words["apart"] = 1;
  EXPECT_EQ(error_of(c), "contours of the pocket that cross each other are not carried out yet");
  c.words.erase("apart");
  c.bottom = 1;
  EXPECT_EQ(error_of(c), "the pocket has no depth");
}

/// Pockets of chance: a star-shaped outline, round and square islands, both ways of roughing, and finishing.
TEST(Pocket, NeverNearerThanTheRadiusAndNothingLeft) {
  std::mt19937 random(20);
  const auto between = [&random](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  int carried = 0;
  for (int round = 0; round < 16; ++round) {
    Case c;
    std::vector<PocketPoint> outline;
    const int corners = 4 + round % 6;
    for (int k = 0; k < corners; ++k) {
      const double a = 2 * pi * (k + between(-0.3, 0.3)) / corners, r = between(30, 65);
      outline.push_back({r * std::cos(a), r * std::sin(a)});
    }
    if (round % 2 != 0) std::reverse(outline.begin(), outline.end());
    c.contours.push_back(polygon(outline));
    for (int k = 0; k < round % 3; ++k) {
      const double u = between(-25, 25), v = between(-25, 25), r = between(2, 8);
      c.contours.push_back(k == 0 ? circle(u, v, r, round % 4 == 1) : box(u - r, v - r, u + r, v + r));
    }
    c.radius = between(1.5, 5);
    c.bottom = -5;
    c.over = round % 5 == 4;
    c.words["step"] = c.radius * between(0.5, 2);
    if (round % 4 == 3) c.words["pass_angle"] = between(-90, 90);
    std::string error;
    const auto moves = moves_of(c, &error);
    ASSERT_TRUE(moves) << round << ": " << error;
    ++carried;
    SCOPED_TRACE(round);
    keeps_off_walls(c, *moves);
    clears(c, *moves);
    c.words["operation"] = 2;
    const auto finish = moves_of(c, &error);
    ASSERT_TRUE(finish) << round << ": " << error;
    keeps_off_walls(c, *finish);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_EQ(carried, 16);
}

}  // namespace
}  // namespace cnctrans::ir::cycles
