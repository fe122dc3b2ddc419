// Two cycles that leave the same part by other passes, made by hand, and every way in which they may not.
#include <gtest/gtest.h>

#include "verifier/compare.h"

namespace cnctrans::test {
namespace {

using interpreter::CycleRun;
using interpreter::Event;
using interpreter::EventKind;
using verifier::Status;

interpreter::Position at(double x, double z) {
  interpreter::Position p;
  p.known = 1U << ir::axis::x | 1U << ir::axis::z;
  p.value[ir::axis::x] = x;
  p.value[ir::axis::z] = z;
  return p;
}

/// A side of the comparison: the moves of its cycle, and one move behind it.
struct Side {
  std::vector<Event> events;
  std::vector<CycleRun> runs{1};
  double rough = 0.25, fine = 0.1;

  Event& add(EventKind kind, double x, double z, double feed = 0) {
    Event e;
    e.kind = kind;
    e.to = at(x, z);
    e.feed = feed;
    e.feed_mode = ir::FeedMode::per_rev;
    events.push_back(e);
    return events.back();
  }
  void rapid(double x, double z) { add(EventKind::rapid, x, z); }
  void feed(double x, double z) { add(EventKind::linear, x, z, rough); }
  void comp(const char* state) {
    Event e;
    e.kind = EventKind::comp;
    e.state = state;
    events.push_back(e);
  }
  void begin(std::string_view family) {
    runs[0].family = family;
    runs[0].first = events.size();
    runs[0].comparable = true;
  }
  void end() { runs[0].last = events.size(); }
};

/// Contour from (10, 0) along Z to -20 and out to 15, radii; allowances 0.2 and 0.1.
constexpr double wall = -19.9, bottom = 10.2;

void contours(CycleRun& run, double shift = 0, double sign = 1) {
  run.rough = {{10 + 0.2 * sign + shift, 0.1 * sign},
               {10 + 0.2 * sign + shift, -20 + 0.1 * sign},
               {15 + 0.2 * sign + shift, -20 + 0.1 * sign}};
  run.finish = {{10 + shift, 0}, {10 + shift, -20}, {15 + shift, -20}};
}

void finish(Side& s) {
  s.rapid(10, 2);
  s.comp("right");
  for (const auto& [x, z] : {std::pair(10.0, 0.0), std::pair(10.0, -20.0), std::pair(15.0, -20.0)})
    s.add(EventKind::linear, x, z, s.fine);
  s.comp("off");
}

/// From (17, 2) in steps of 2 from there, away at 45 degrees.
Side source() {
  Side s;
  s.rapid(17, 2);
  s.begin("stock");
  contours(s.runs[0]);
  for (const double h : {15.0, 13.0, 11.0, bottom}) {
    s.rapid(h, 2);
    s.feed(h, wall);
    s.rapid(h + 1, wall + 1);
    s.rapid(h + 1, 2);
  }
  s.rapid(17, 2);
  finish(s);
  s.rapid(17, -20);
  s.rapid(17, 2);
  s.end();
  s.rapid(50, 50);
  return s;
}

struct Change {
  std::vector<double> heights{13.5, 11.8, bottom};
  double end = wall, shift = 0, sign = 1, behind = 2;
  bool finishes = true, finish_contour = true, dives = false;
  double rough = 0.25;
};
/// In equal steps from 1 mm off the contour, along the wall after each pass.
Side target(const Change& c = {}) {
  Side s;
  s.rough = c.rough;
  s.rapid(17, 2);
  s.begin("stock");
  contours(s.runs[0], c.shift, c.sign);
  if (!c.finish_contour) s.runs[0].finish.clear();
  s.rapid(16.2, 1.1);
  double before = 15.2;
  for (const double h : c.heights) {
    s.rapid(h, c.dives ? -3 : 1.1);
    s.feed(h, c.end);
    s.feed(before, c.end);
    s.rapid(before + 1, c.end + 1);
    s.rapid(before + 1, 1.1);
    before = h;
  }
  s.rapid(16.2, 1.1);
  if (c.finishes) finish(s);
  s.rapid(16.2, -19);
  s.rapid(16.2, 1.1);
  s.end();
  s.rapid(17, c.behind);
  s.rapid(50, 50);
  return s;
}

verifier::Verdict compare(const Side& a, const Side& b, bool knows_cycles = true) {
  verifier::Options options;
  options.source_start = options.target_start = at(100, 100);
  if (knows_cycles) {
    options.source_cycles = &a.runs;
    options.target_cycles = &b.runs;
  }
  return verifier::compare(a.events, b.events, options);
}
std::string difference(const Change& c) {
  const auto v = compare(source(), target(c));
  EXPECT_EQ(v.status, Status::differs);
  return v.difference.what;
}
bool says(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(Similar, OtherPassesToTheSameContour) {
  const auto v = compare(source(), target());
  EXPECT_EQ(v.status, Status::within_tolerance) << v.difference.what;
  EXPECT_EQ(v.similar_cycles, 1U);
}

TEST(Similar, MovesThatAreNotOfCyclesAreComparedOneByOne) {
  EXPECT_EQ(compare(source(), target(), false).status, Status::differs);
}

TEST(Similar, TheSameMovesAreNoSimilarCycle) {
  const auto v = compare(source(), source());
  EXPECT_EQ(v.status, Status::verified);
  EXPECT_EQ(v.similar_cycles, 0U);
}

TEST(Similar, AllowanceIntoThePart) {
  Change c;
  c.sign = -1;
  EXPECT_TRUE(says(difference(c), "apart"));
}

TEST(Similar, ContourShiftedByAHundredth) {
  Change c;
  c.shift = 0.01;
  EXPECT_TRUE(says(difference(c), "0.01 mm apart"));
}

TEST(Similar, APassBelowTheContour) {
  Change c;
  c.heights.back() = bottom - 0.01;
  EXPECT_TRUE(says(difference(c), "goes below the contour"));
}

TEST(Similar, APassBeyondTheEnd) {
  Change c;
  c.end = wall - 0.01;
  EXPECT_TRUE(says(difference(c), "beyond the end of the contour"));
}

TEST(Similar, APassThatEndsTooEarly) {
  Change c;
  c.end = wall + 0.1;
  EXPECT_TRUE(says(difference(c), "leaves more than the source's"));
}

TEST(Similar, TheLastPassIsMissing) {
  Change c;
  c.heights.pop_back();
  EXPECT_TRUE(says(difference(c), "leaves more than the source's"));
}

TEST(Similar, TheFinishingPassIsMissing) {
  Change c;
  c.finishes = false;
  EXPECT_TRUE(says(difference(c), "lacks compensation right"));
  c.finish_contour = false;
  EXPECT_FALSE(difference(c).empty());
}

TEST(Similar, RapidThroughTheBlank) {
  Change c;
  c.dives = true;
  EXPECT_TRUE(says(difference(c), "rapid move of the translation's cycle goes through material"));
}

TEST(Similar, AnotherFeed) {
  Change c;
  c.rough = 0.5;
  EXPECT_TRUE(says(difference(c), "feed 0.5"));
}

TEST(Similar, TheToolStandsElsewhereBehindIt) {
  Change c;
  c.behind = 3;
  EXPECT_FALSE(difference(c).empty());
}

TEST(Similar, AWallOverTheContour) {
  auto b = target();
  b.runs[0].rough.push_back({18, wall});
  const auto v = compare(source(), b);
  EXPECT_EQ(v.status, Status::within_tolerance) << v.difference.what;
  b.runs[0].rough.back().z = wall + 0.1;  // it leans
  EXPECT_TRUE(says(compare(source(), b).difference.what, "apart"));
}

TEST(Similar, CyclesOfAnotherFamily) {
  auto b = target();
  b.runs[0].family = "thread";
  EXPECT_EQ(compare(source(), b).status, Status::differs);
}

// --- threads: along Z from 5 to -20, to the radius 9, pitch 1.5 -------------------------------------------------

struct ThreadChange {
  std::vector<double> depths{0.5, 0.8, 1};
  double pitch = 1.5, end = -20, clear = 11, angle = 0, first = 5;
  std::vector<double> shifts{};  ///< along the thread of where each pass begins
};
Side thread(const ThreadChange& c = {}) {
  Side s;
  s.rapid(12, 5);
  s.begin("thread");
  s.rapid(c.clear, c.first);
  for (std::size_t k = 0; k < c.depths.size(); ++k) {
    const double d = c.depths[k];
    s.rapid(10 - d, c.first + (k < c.shifts.size() ? c.shifts[k] : 0));
    auto& cut = s.add(EventKind::thread, 10 - d, c.end);
    cut.pitch = c.pitch;
    cut.start_angle = c.angle;
    s.rapid(c.clear, c.end);
    s.rapid(c.clear, c.first);
  }
  s.rapid(12, 5);
  s.end();
  s.rapid(50, 50);
  return s;
}
std::string thread_difference(const ThreadChange& c) {
  const auto v = compare(thread(), thread(c));
  EXPECT_EQ(v.status, Status::differs);
  return v.difference.what;
}

TEST(SimilarThread, OtherInfeeds) {
  ThreadChange c;
  c.depths = {0.45, 0.7, 0.9, 1};
  const auto v = compare(thread(), thread(c));
  EXPECT_EQ(v.status, Status::within_tolerance) << v.difference.what;
  EXPECT_EQ(v.similar_cycles, 1U);
}

/// Down the flank of 30 degrees: a pass of the depth d begins (1 - d) tan 30 before the last one, 0.2887 and 0.1155.
TEST(SimilarThread, WithinTheV) {
  ThreadChange flank;
  flank.shifts = {0.2887, 0.1155, 0};
  ThreadChange c = flank;
  c.shifts = {-0.2887, 0.1155, 0};  // on both flanks
  EXPECT_EQ(compare(thread(flank), thread(c)).status, Status::within_tolerance);
  c.shifts = {0, 0, 0};
  EXPECT_EQ(compare(thread(flank), thread(c)).status, Status::within_tolerance);
  c.shifts = {0.4, 0.1155, 0};
  EXPECT_TRUE(says(compare(thread(flank), thread(c)).difference.what, "outside of its V"));
  c.shifts = {0.2887, -1, 0};
  EXPECT_TRUE(says(compare(thread(flank), thread(c)).difference.what, "outside of its V"));
  EXPECT_TRUE(says(compare(thread(), thread(flank)).difference.what, "outside of its V"));  // straight in
}

TEST(SimilarThread, Faults) {
  ThreadChange c;
  c.depths = {0.45, 0.7, 0.9, 0.99};
  EXPECT_TRUE(says(thread_difference(c), "0.01 mm apart")) << thread_difference(c);
  c.depths = {0.45, 1.05, 1};
  EXPECT_TRUE(says(thread_difference(c), "below the thread")) << thread_difference(c);
  c.depths = {0.2, 1};
  EXPECT_TRUE(says(thread_difference(c), "deep")) << thread_difference(c);
  c = {};
  c.depths = {0.45, 0.7, 1};
  c.pitch = 1.6;
  EXPECT_TRUE(says(thread_difference(c), "pitch")) << thread_difference(c);
  c.pitch = 1.5;
  c.end = -20.01;
  EXPECT_TRUE(says(thread_difference(c), "apart")) << thread_difference(c);
  c.end = -20;
  c.angle = 10;
  EXPECT_TRUE(says(thread_difference(c), "starts at 0 degrees")) << thread_difference(c);
  c.angle = 0;
  c.clear = 10.5;
  EXPECT_TRUE(says(thread_difference(c), "closer to the thread")) << thread_difference(c);
  c.clear = 11;
  c.first = 4;
  EXPECT_FALSE(thread_difference(c).empty());
}

// --- taps: at (30, 20), from Z2 to Z-10, a thread of 1.25; the tool comes from (0, 0) at Z50
// --------------------------

/// `across`: how high the tool stands when it goes over to the hole.
Side tap(double across) {
  Side s;
  const auto to = [&](EventKind kind, double x, double y, double z) -> Event& {
    auto& e = s.add(kind, x, z);
    e.to.known |= 1U << ir::axis::y;
    e.to.value[ir::axis::y] = y;
    if (kind == EventKind::thread) e.pitch = 1.25;
    return e;
  };
  to(EventKind::rapid, 0, 0, 50);
  s.begin("tap");
  s.runs[0].surface = 2;
  to(EventKind::rapid, 0, 0, across);
  to(EventKind::rapid, 30, 20, across);
  to(EventKind::rapid, 30, 20, 2);
  for (const double z : {-4.0, 2.0, -10.0, 2.0}) to(EventKind::thread, 30, 20, z);
  to(EventKind::rapid, 30, 20, 50);
  s.end();
  return s;
}

TEST(SimilarTap, GoesAcrossNoLowerThanTheSource) {
  const auto with = [](double across) { return compare(tap(20), tap(across)); };
  EXPECT_EQ(with(50).status, Status::within_tolerance) << with(50).difference.what;
  EXPECT_TRUE(says(with(10).difference.what, "goes across to its cycle lower")) << with(10).difference.what;
}

}  // namespace
}  // namespace cnctrans::test
