// Long traces are compared piece by piece as they would be at once.
#include "verifier/piecewise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace cnctrans::verifier {
namespace {

using interpreter::Event;
using interpreter::EventKind;

Event move(double x, double y) {
  Event e;
  e.kind = EventKind::linear;
  e.to.value[0] = x;
  e.to.value[1] = y;
  e.to.known = 3;
  e.feed = 500;
  return e;
}

Event spindle(double speed) {
  Event e;
  e.kind = EventKind::spindle;
  e.number = 1;
  e.state = "cw";
  e.value = speed;
  return e;
}

/// Moves to places of their own, the spindle and the coolant every now and then, and the end.
std::vector<Event> long_trace(std::size_t moves) {
  std::vector<Event> events;
  for (std::size_t i = 0; i < moves; ++i) {
    const auto n = static_cast<double>(i);
    if (i % 9'000 == 0) {
      Event coolant;
      coolant.kind = EventKind::coolant;
      coolant.state = i % 18'000 == 0 ? "flood" : "off";
      events.push_back(coolant);
    }
    if (i % 7'000 == 0) events.push_back(spindle(1000 + n));
    events.push_back(move(n * 0.37, i % 2 == 0 ? n * 0.11 : -n * 0.13));
  }
  Event end;
  end.kind = EventKind::end;
  events.push_back(end);
  return events;
}

/// Both sides come in parts of different lengths. nullopt: a part was not the same.
std::optional<Verdict> piecewise(const std::vector<Event>& a, const std::vector<Event>& b) {
  PiecewiseComparison comparison{Options{}};
  const auto feed = [](const std::vector<Event>& from, std::size_t& at, std::size_t count, std::vector<Event>& to) {
    const std::size_t end = std::min(from.size(), at + count);
    for (; at < end; ++at) to.push_back(from[at]);
  };
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    feed(a, i, 30'000, comparison.source);
    feed(b, j, 23'000, comparison.target);
    if (!comparison.advance()) return std::nullopt;
  }
  if (!comparison.finish()) return std::nullopt;
  return comparison.verdict();
}

TEST(Piecewise, SaysWhatTheWholeComparisonSays) {
  const auto a = long_trace(100'000);
  const Verdict whole = compare(a, a, {});
  const auto parts = piecewise(a, a);
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->status, Status::verified);
  EXPECT_EQ(parts->moves, 100'000U);
  EXPECT_EQ(parts->events, whole.events);
}

TEST(Piecewise, FindsWhatDiffersWhereverItIs) {
  const auto a = long_trace(100'000);
  for (const std::size_t at : {std::size_t{5}, std::size_t{20'000}, std::size_t{60'001}, a.size() - 2}) {
    auto b = a;
    ASSERT_TRUE(b[at].kind == EventKind::linear);
    b[at].to.value[1] += 0.1;
    EXPECT_FALSE(piecewise(a, b)) << at;
    b = a;
    b[at].feed = 600;
    EXPECT_FALSE(piecewise(a, b)) << at;
    b = a;
    b.erase(b.begin() + static_cast<std::ptrdiff_t>(at));
    EXPECT_FALSE(piecewise(a, b)) << at;
    b = a;
    b.insert(b.begin() + static_cast<std::ptrdiff_t>(at), spindle(50));
    EXPECT_FALSE(piecewise(a, b)) << at;
  }
}

TEST(Piecewise, TheStateGoesOnFromPieceToPiece) {
  const auto a = long_trace(100'000);
  auto b = a;  // says again what holds: that is nothing
  b.insert(b.begin() + 50'000, spindle(1000 + 49'000));
  EXPECT_TRUE(piecewise(a, b));
}

TEST(Piecewise, TellsHowFarTheyAreApart) {
  const auto a = long_trace(60'000);
  auto b = a;
  b[40'000].to.value[0] += 0.0005;
  const auto parts = piecewise(a, b);
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->status, Status::within_tolerance);
  EXPECT_NEAR(parts->max_length, 0.0005, 1e-9);
}

}  // namespace
}  // namespace cnctrans::verifier
