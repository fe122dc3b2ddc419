// Two traces made by hand: what counts as the same path, and which difference is named.
#include "verifier/compare.h"

#include <gtest/gtest.h>

namespace cnctrans::test {
namespace {

using interpreter::Event;
using interpreter::EventKind;
using verifier::Status;

interpreter::Position at(double x, double y = 0) {
  interpreter::Position p;
  p.known = 3;
  p.value[0] = x;
  p.value[1] = y;
  return p;
}
Event move(EventKind kind, double x, double y, std::uint32_t line) {
  Event e;
  e.kind = kind;
  e.to = at(x, y);
  e.line = line;
  e.feed = kind == EventKind::rapid ? 0 : 100;
  return e;
}
Event rapid(double x, std::uint32_t line = 1) {
  return move(EventKind::rapid, x, 0, line);
}
Event linear(double x, std::uint32_t line = 1) {
  return move(EventKind::linear, x, 0, line);
}
Event dwell(double amount, bool revolutions = false) {
  Event e;
  e.kind = EventKind::dwell;
  e.amount = amount;
  e.revolutions = revolutions;
  e.number = 1;
  return e;
}
Event spindle(double rpm) {
  Event e;
  e.kind = EventKind::spindle;
  e.number = 1;
  e.state = "cw";
  e.value = rpm;
  return e;
}
verifier::Verdict compare(const std::vector<Event>& a, const std::vector<Event>& b) {
  verifier::Options options;
  options.source_start = options.target_start = at(0);
  return verifier::compare(a, b, options);
}

TEST(Compare, AMissingFirstMoveIsADifference) {
  EXPECT_EQ(compare({rapid(10), linear(20)}, {linear(20)}).status, Status::differs);
  EXPECT_EQ(verifier::compare({rapid(10), linear(20)}, {linear(20)}, {}).status, Status::differs);
}

TEST(Compare, AMoveGoesByTheSameZeroPoint) {
  Event of_machine = rapid(10);
  of_machine.in_machine = true;
  EXPECT_EQ(compare({of_machine}, {of_machine}).status, Status::verified);
  EXPECT_EQ(compare({of_machine}, {rapid(10)}).status, Status::differs);

  Event open = rapid(10);
  open.zero_open = true;
  verifier::Options options;
  EXPECT_EQ(verifier::compare({open}, {rapid(10)}, options).open_zero_moves, 0U);
  options.zero_is_open = true;
  EXPECT_EQ(verifier::compare({open}, {rapid(10)}, options).open_zero_moves, 1U);
  options.selects_zero = true;
  EXPECT_EQ(verifier::compare({open}, {rapid(10)}, options).status, Status::verified);
  EXPECT_EQ(verifier::compare({open}, {open}, options).status, Status::differs);
}

Event with_offset(Event e, bool with) {
  e.offset.known = 1;
  e.offset.with = with ? 1 : 0;
  return e;
}

TEST(Compare, AMoveWithoutTheToolOffsetOfTheSourceDiffers) {
  EXPECT_EQ(compare({with_offset(rapid(10), true)}, {with_offset(rapid(10), true)}).status, Status::verified);
  const auto verdict = compare({with_offset(rapid(10), true)}, {with_offset(rapid(10), false)});
  EXPECT_EQ(verdict.status, Status::differs);
  EXPECT_NE(verdict.difference.what.find("without tool offset"), std::string::npos) << verdict.difference.what;
  EXPECT_EQ(compare({with_offset(rapid(10), true)}, {rapid(10)}).status, Status::verified);  // nobody knows
}

TEST(Compare, OffsetAndSideHoldForEachPartOfAMove) {
  const Event whole = with_offset(linear(30), true), end = whole;
  EXPECT_EQ(compare({whole}, {with_offset(linear(10), true), end}).status, Status::verified);
  EXPECT_EQ(compare({whole}, {with_offset(linear(10), false), end}).status, Status::differs);
  Event left = linear(30), right = linear(10);
  left.centre_side = ir::CompSide::left;
  right.centre_side = ir::CompSide::right;
  EXPECT_EQ(compare({left}, {right, left}).status, Status::differs);
}

TEST(Compare, SmallStepsThatLeadAwayAreNotPassedOver) {
  std::vector<Event> steps;
  for (int n = 1; n <= 5000; ++n) steps.push_back(linear(0.001 * n));
  std::vector<Event> target = steps;
  target.push_back(rapid(50));
  EXPECT_EQ(compare({rapid(50)}, target).status, Status::differs);
  EXPECT_EQ(compare(target, {rapid(50)}).status, Status::differs);
  EXPECT_EQ(compare({rapid(10)}, {rapid(10), linear(10.0005), linear(10)}).status, Status::verified);
}

Event fed(double feed) {
  Event e = linear(10);
  e.feed = feed;
  e.feed_mode = ir::FeedMode::per_rev;
  return e;
}
TEST(Compare, SmallFeedsAndPitchesAreComparedByWhatTheyAre) {
  EXPECT_EQ(compare({fed(0.05)}, {fed(0.0509)}).status, Status::differs);
  EXPECT_EQ(compare({fed(0.002)}, {fed(0.001)}).status, Status::differs);
  EXPECT_EQ(compare({fed(0.0254)}, {fed(0.025)}).status, Status::verified);  // three decimals
  EXPECT_EQ(compare({fed(1234.5)}, {fed(1235)}).status, Status::differs);    // every control writes decimals
  Event thread = move(EventKind::thread, 10, 0, 1), other = thread;
  thread.pitch = 0.25;
  other.pitch = 0.2509;
  EXPECT_EQ(compare({thread}, {other}).status, Status::differs);
  other.pitch = 0.2503;
  EXPECT_EQ(compare({thread}, {other}).status, Status::verified);
  EXPECT_EQ(compare({spindle(0.4), linear(10)}, {spindle(0.4008), linear(10)}).status, Status::differs);
}

Event stopping(double x, bool exact) {
  Event e = linear(x);
  e.stop = {exact, false};
  return e;
}

TEST(Compare, AnExactStopIsComparedWhereAMoveFollows) {
  verifier::Options by_mode;
  by_mode.stops_by_mode = true;
  const auto status = [](const std::vector<Event>& a, const std::vector<Event>& b, const verifier::Options& o) {
    return verifier::compare(a, b, o).status;
  };
  const std::vector<Event> round{stopping(10, false), linear(20)}, exact{stopping(10, true), linear(20)};
  EXPECT_EQ(status(round, exact, by_mode), Status::differs);
  EXPECT_EQ(status(exact, round, by_mode), Status::differs);
  EXPECT_EQ(status(exact, round, {}), Status::verified);  // the target has no such mode
  EXPECT_EQ(status(round, exact, {}), Status::differs);
  EXPECT_EQ(status({stopping(10, false)}, {stopping(10, true)}, by_mode), Status::verified);
}

TEST(Compare, WhereThePathTurnsRoundThereIsNoCorner) {
  const auto path = [](bool exact, double back) {
    return std::vector<Event>{stopping(5, true), stopping(10, exact), linear(back)};
  };
  verifier::Options by_mode;
  by_mode.stops_by_mode = true;
  for (const double back : {5.0, 7.0, 2.0}) {  // to the start of the move, less far, further
    EXPECT_EQ(verifier::compare(path(true, back), path(false, back), by_mode).status, Status::verified) << back;
  }
  EXPECT_EQ(verifier::compare(path(true, 12), path(false, 12), by_mode).status, Status::differs);
}

TEST(Compare, DwellsThatFollowEachOtherAreComparedOneByOneOrTogether) {
  const auto status = [](std::vector<Event> a, std::vector<Event> b) {
    a.push_back(linear(10));
    b.push_back(linear(10));
    return compare(a, b).status;
  };
  EXPECT_EQ(status({dwell(100)}, {dwell(75), dwell(25)}), Status::verified);
  EXPECT_EQ(status({dwell(100)}, {dwell(75.006), dwell(25)}), Status::differs);
  EXPECT_EQ(status({dwell(0.3333), dwell(0.3333), dwell(0.1)}, {dwell(0.33), dwell(0.33), dwell(0.1)}),
            Status::verified);
  EXPECT_EQ(status({dwell(1.0), dwell(2.0)}, {dwell(1.01), dwell(2.0)}), Status::differs);
}

TEST(Compare, AMoveSplitInPartsIsOneMove) {
  EXPECT_EQ(compare({linear(30)}, {linear(10), linear(20), linear(30)}).status, Status::verified);
  EXPECT_EQ(compare({linear(10), linear(30)}, {linear(20), linear(30)}).status, Status::verified);
}

TEST(Compare, PartsThatGoBackAreNot) {
  EXPECT_EQ(compare({linear(30)}, {linear(20), linear(10), linear(30)}).status, Status::differs);
  EXPECT_EQ(compare({linear(20), linear(10), linear(30)}, {linear(30)}).status, Status::differs);
}

TEST(Compare, ALongerMoveIsNamedItself) {
  // The translation goes on to 15 where the source stops at 10: the blocks in line 5 and 7 differ, not those behind.
  const auto v =
      compare({linear(10, 5), spindle(100), linear(10.5, 6)}, {linear(15, 7), spindle(100), linear(10.5, 8)});
  ASSERT_EQ(v.status, Status::differs);
  EXPECT_EQ(v.difference.source_line, 5U);
  EXPECT_EQ(v.difference.target_line, 7U);
  EXPECT_EQ(v.difference.what, "end of the linear move: X10 in the source, X15 in the translation");
}

TEST(Compare, ALongerLastMoveIsNamedItself) {
  const auto v = compare({linear(10, 5)}, {linear(15, 7)});
  ASSERT_EQ(v.status, Status::differs);
  EXPECT_EQ(v.difference.what, "end of the linear move: X10 in the source, X15 in the translation");
}

TEST(Compare, AnArcShorterThanTheToleranceMayBeMissing) {
  // About (5, 0) from (0, 0): clockwise up to (0, 0.0005), or all the way round to it.
  Event arc = move(EventKind::arc, 0, 0.0005, 1);
  arc.center_u = 5;
  arc.cw = true;
  EXPECT_TRUE(compare({arc, linear(10)}, {linear(10)}).good());
  arc.cw = false;
  EXPECT_EQ(compare({arc, linear(10)}, {linear(10)}).status, Status::differs);
}

/// About (cu, cv), counter-clockwise, from where the tool stands.
Event arc_about(double x, double y, double cu, double cv) {
  Event e = move(EventKind::arc, x, y, 1);
  e.center_u = cu;
  e.center_v = cv;
  return e;
}

TEST(Compare, AShortArcIsJudgedByItsPath) {  // docs/verify.md, tolerances
  // From X0 Y0 to X10 about (0, 100): 6 degrees. A centre 0.0125 mm aside leaves the path within 1.3 um.
  const auto end = [](double cu, double cv) { return std::vector<Event>{linear(0), arc_about(10, 0.5, cu, cv)}; };
  EXPECT_TRUE(compare(end(0, 100), end(0.0125, 100.0006)).good());
  // About (0, 104) it would be at Y0.482 there.
  EXPECT_EQ(compare(end(0, 100), end(0, 104)).status, Status::differs);
  // Half a turn: the path goes with its centre.
  const auto half = [](double cu) { return std::vector<Event>{linear(0), arc_about(20, 0, cu, 0)}; };
  EXPECT_EQ(compare(half(10), half(10.0035)).status, Status::differs);
}

Event compensated(double x, double y, ir::CompSide side, ir::Plane plane = ir::Plane::xy) {
  Event e = move(EventKind::linear, x, y, 1);
  e.centre_side = side;
  e.plane = plane;
  return e;
}
Event comp(const char* state) {
  Event e;
  e.kind = EventKind::comp;
  e.state = state;
  return e;
}

TEST(Compare, TheCentreOfTheToolGoesTheSameWay) {
  using ir::CompSide;
  const std::vector<Event> left{comp("left"), compensated(10, 0, CompSide::left)};
  EXPECT_EQ(compare(left, left).status, Status::verified);
  EXPECT_EQ(compare(left, {comp("right"), compensated(10, 0, CompSide::right)}).status, Status::differs);
  EXPECT_EQ(compare(left, {comp("left"), compensated(10, 0, CompSide::left, ir::Plane::zx)}).status, Status::differs);
  EXPECT_EQ(compare(left, {compensated(10, 0, CompSide::off)}).status, Status::differs);
  // A mirror on one side only: G42 there is left of the path of the machine.
  EXPECT_EQ(compare(left, {comp("right"), compensated(10, 0, CompSide::left)}).status, Status::verified);
  // Without compensation a straight move has no plane.
  EXPECT_EQ(compare({compensated(10, 0, CompSide::off)}, {compensated(10, 0, CompSide::off, ir::Plane::zx)}).status,
            Status::verified);
}

TEST(Compare, DwellsThatFollowEachOtherAreOne) {
  EXPECT_EQ(compare({linear(1), dwell(10)}, {linear(1), dwell(4), dwell(6)}).status, Status::verified);
  EXPECT_EQ(compare({linear(1), dwell(10)}, {linear(1), dwell(4), dwell(5)}).status, Status::differs);
  EXPECT_EQ(compare({linear(1), dwell(4), dwell(6)}, {linear(1), dwell(10)}).status, Status::verified);
}

TEST(Compare, RevolutionsAreATimeAtAKnownSpeed) {
  // 5 revolutions at 600/min take 0.5 s.
  EXPECT_EQ(compare({spindle(600), linear(1), dwell(5, true)}, {spindle(600), linear(1), dwell(0.5)}).status,
            Status::verified);
  EXPECT_EQ(compare({spindle(600), linear(1), dwell(5, true)}, {spindle(600), linear(1), dwell(0.6)}).status,
            Status::differs);
  EXPECT_EQ(compare({linear(1), dwell(5, true)}, {linear(1), dwell(0.5)}).status, Status::differs);
  EXPECT_EQ(compare({spindle(600), linear(1), dwell(5, true), dwell(1)}, {spindle(600), linear(1), dwell(1.5)}).status,
            Status::verified);
  EXPECT_EQ(compare({spindle(600), linear(1), dwell(5, true), dwell(1)}, {spindle(600), linear(1), dwell(1)}).status,
            Status::differs);
  EXPECT_EQ(compare({linear(1), dwell(5, true), dwell(1)}, {linear(1), dwell(1), dwell(5, true)}).status,
            Status::verified);
}

}  // namespace
}  // namespace cnctrans::test
