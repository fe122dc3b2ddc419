// What is known before each statement: straight lines, joins, loops, calls, positions.
#include <gtest/gtest.h>

#include <cmath>

#include <chrono>
#include <optional>
#include <string>

#include "ir/analysis/dataflow.h"
#include "ir/analysis/fact_set.h"
#include "tests/ir/read_ir.h"
#include "tests/support/random_program.h"

namespace cnctrans::ir {
namespace {

/// Facts before the statement that stands on the line with block number `n`.
class Known {
 public:
  explicit Known(Program p, const ModalState& power_on = {}) : program_(std::move(p)) {
    table_ = analyse(program_, power_on);
  }
  const Facts& at(const std::string& n) const {
    const Facts* found = nullptr;
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        if (s.line.number == n) found = &table_.before(s.id);
      });
    }
    EXPECT_NE(found, nullptr) << n;
    return found != nullptr ? *found : table_.before(0);
  }
  std::string setting(const std::string& n, Setting s) const {
    const auto x = at(n).settings[static_cast<std::size_t>(s)];
    return x ? std::string(setting_value_name(s, *x)) : "unknown";
  }
  std::string plane(const std::string& n) const { return setting(n, Setting::plane); }
  std::string distance(const std::string& n) const { return setting(n, Setting::distance); }
  std::string x(const std::string& n) const { return coordinate(n, axis::x); }
  std::string y(const std::string& n) const { return coordinate(n, axis::y); }
  std::string z(const std::string& n) const { return coordinate(n, axis::z); }

 private:
  std::string coordinate(const std::string& n, AxisId id) const {
    const auto v = at(n).position[id];
    return v ? shortest(*v) : "unknown";
  }
  Program program_;
  FactTable table_;
};

Known known(const std::string& lines, const ModalState& power_on = {}) {
  return Known(read_main(lines), power_on);
}

TEST(Dataflow, StartsAtPowerOn) {
  ModalState power_on;
  power_on.plane = Plane::zx;
  power_on.work_offset = 1;
  const Known k = known("N1 block\n", power_on);
  EXPECT_EQ(k.plane("1"), "zx");
  EXPECT_EQ(k.at("1").work_offset, 1);
  EXPECT_EQ(k.at("1").motion, MotionKind::rapid);
  EXPECT_EQ(k.x("1"), "unknown") << "where the machine stands is not the program's knowledge";
  EXPECT_TRUE(k.at("1").cycle_active_known);
  EXPECT_FALSE(k.at("1").cycle_active);
}

TEST(Dataflow, SettingsMotionFeedSpindleOffset) {
  const Known k = known(
      "block plane yz, distance incremental, feed 200, spindle 1500, work_offset 2, linear X absolute 1\n"
      "N1 block linear once X 5\n"
      "N2 block arc_cw once X absolute 2\n"
      "N3 block feed (R[1]), work_offset off\n"
      "N4 block\n");
  EXPECT_EQ(k.plane("1"), "yz");
  EXPECT_EQ(k.distance("1"), "incremental");
  EXPECT_EQ(k.at("1").feed, 200.0);
  EXPECT_EQ(k.at("1").spindle, 1500.0);
  EXPECT_EQ(k.at("1").work_offset, 2);
  EXPECT_EQ(k.at("3").motion, MotionKind::linear) << "a one-shot motion does not stay";
  EXPECT_EQ(k.at("4").feed, std::nullopt);
  EXPECT_EQ(k.at("4").work_offset, 0);
}

TEST(Dataflow, IfWithDifferingModesIsUnknown) {
  const Known k =
      known("if R[1] == 1 {\nblock distance incremental, plane zx\n} else {\nblock plane zx\n}\nN1 block\n");
  EXPECT_EQ(k.distance("1"), "unknown");
  EXPECT_EQ(k.plane("1"), "zx") << "both ways agree";
}

TEST(Dataflow, LoopThatChangesAModeMakesItUnknownInsideAndAfter) {
  const Known k = known("block plane xy\nN1 while R[1] < 3 {\nN2 block\nN3 block plane zx\nN4 }\nN5 block\n");
  EXPECT_EQ(k.plane("2"), "unknown");
  EXPECT_EQ(k.plane("5"), "unknown");
  const Known same = known("block plane zx\nwhile R[1] < 3 {\nN2 block\nblock plane zx\n}\nN5 block\n");
  EXPECT_EQ(same.plane("2"), "zx");
  EXPECT_EQ(same.plane("5"), "zx");
}

TEST(Dataflow, UntilRunsAtLeastOnce) {
  const Known k = known("until {\nblock plane zx\n} until R[1]\nN1 block\n");
  EXPECT_EQ(k.plane("1"), "zx");
}

TEST(Dataflow, JumpBackJoins) {
  const Known k =
      known("N1 block\nN2 block linear X 10\nN3 block linear X incremental 5\njump N3 if R[1] > 0\nN4 block\n");
  EXPECT_EQ(k.x("2"), "unknown");
  EXPECT_EQ(k.x("3"), "unknown") << "10, 15, 20...";
  const Known straight = known("block linear X 10\nN3 block linear X incremental 5\nN4 block\n");
  EXPECT_EQ(straight.x("3"), "10");
  EXPECT_EQ(straight.x("4"), "15");
}

TEST(Dataflow, DuplicateLabelsAndTheSearchDecideWhatIsReached) {
  const std::string lines =
      "N10 block\nblock plane zx\njump N10 search forward\nN1 block plane yz\nN10 block\nN2 block\n";
  const Known forward = known(lines);
  EXPECT_FALSE(forward.at("1").reachable);
  EXPECT_EQ(forward.plane("2"), "zx");
}

TEST(Dataflow, UnreachableCodeKnowsNothing) {
  const Known k = known("jump N2\nN1 block plane zx\nN2 block\n");
  EXPECT_FALSE(k.at("1").reachable);
  EXPECT_EQ(k.plane("1"), "unknown");
  EXPECT_EQ(k.plane("2"), "xy");
}

TEST(Dataflow, BlockSkipMayLeaveABlockOut) {
  const Known k = known("/0 block plane zx\n& block distance incremental\nN1 block\n");
  EXPECT_EQ(k.plane("1"), "unknown");
  EXPECT_EQ(k.distance("1"), "unknown") << "the second statement of the skipped line";
  EXPECT_EQ(k.setting("1", Setting::units), "metric");
}

// --- positions ----------------------------------------------------------------------------------------------------

TEST(Positions, AbsoluteAndIncrementalWords) {
  const Known k = known(
      "block rapid X 10 Y (2 * 3) Z (R[1])\n"
      "N1 block distance incremental, linear X -2.5 Y absolute 1\n"
      "N2 block linear X (R[2])\n"
      "N3 block linear X 1\n");
  EXPECT_EQ(k.x("1"), "10");
  EXPECT_EQ(k.y("1"), "6") << "an expression of numbers is a number";
  EXPECT_EQ(k.z("1"), "unknown");
  EXPECT_EQ(k.x("2"), "7.5");
  EXPECT_EQ(k.y("2"), "1");
  EXPECT_EQ(k.x("3"), "unknown");
}

TEST(Positions, DiameterWordsBecomeRadius) {
  ModalState lathe;
  lathe.diameter = DiameterMode::diameter;
  const Known k =
      known("block rapid X 50 Z 50\nN1 block linear X incremental 4\nN2 block linear X radius 3\nN3 block\n", lathe);
  EXPECT_EQ(k.x("1"), "25");
  EXPECT_EQ(k.z("1"), "50");
  EXPECT_EQ(k.x("2"), "27");
  EXPECT_EQ(k.x("3"), "3");
  lathe.diameter = DiameterMode::absolute_only;
  const Known half = known("block rapid X 50\nblock linear X incremental 4\nN2 block\n", lathe);
  EXPECT_EQ(half.x("2"), "29");
}

TEST(Positions, FramesAndOffsetsForgetThemUnitsScaleThem) {
  EXPECT_EQ(known("block rapid X 1\nblock frame shift translate replace X 5\nN1 block\n").x("1"), "unknown");
  EXPECT_EQ(known("block rapid X 1\nblock work_offset 1\nN1 block\n").x("1"), "unknown");
  EXPECT_EQ(known("block work_offset 1, rapid X 1\nblock work_offset 1\nN1 block\n").x("1"), "1") << "the same again";
  EXPECT_EQ(known("block rapid X 254\nblock units inch\nN1 block\n").x("1"), "10") << "the same point";
  EXPECT_EQ(known("block rapid X 1\nblock units metric\nN1 block\n").x("1"), "1");
  const Known preset = known("block rapid X 1 Y 2\nblock frame preset translate preset X 70\nN1 block\n");
  EXPECT_EQ(preset.x("1"), "70");
  EXPECT_EQ(preset.y("1"), "2");
}

TEST(Positions, MachineCoordinatesAreNotInTheWorkFrame) {
  const Known k = known("block rapid X 1 Y 2\nblock rapid in_frame machine X 0\nN1 block\n");
  EXPECT_EQ(k.x("1"), "unknown");
  EXPECT_EQ(k.y("1"), "2");
}

TEST(Positions, AxesOfTheMachineUnderARotation) {
  const std::string turned = "block frame chain rotate compose angle 90\n";
  const Known k = known(turned + "block rapid X 1 Y 2\nblock rapid in_frame machine X 0\nN1 block\n");
  EXPECT_EQ(k.y("1"), "unknown") << "X of the machine is Y of the turned frame";
}

TEST(Positions, MotionsThatEndElsewhere) {
  EXPECT_EQ(known("block rapid X 1 Y 2\nblock probe_toward once X 9\nN1 block\n").x("1"), "unknown");
  EXPECT_EQ(known("block rapid X 1 Y 2\nblock probe_toward once X 9\nN1 block\n").y("1"), "2");
  EXPECT_EQ(known("block rapid X 1 Y 2\nblock reference_point once\nN1 block\n").y("1"), "unknown");
  EXPECT_EQ(known("block rapid X 1 Y 2 Z 3\nblock linear extra polar_radius 5 polar_angle 30\nN1 block\n").z("1"), "3");
  EXPECT_EQ(known("block rapid X 1 Y 2 Z 3\nblock linear extra polar_radius 5 polar_angle 30\nN1 block\n").x("1"),
            "unknown");
  const Known line = known("block rapid X 1 Y 2\nblock linear X 8 extra line_angle 30\nN1 block\n");
  EXPECT_EQ(line.x("1"), "8");
  EXPECT_NEAR(std::stod(line.y("1")), 2 + 7 / std::sqrt(3.0), 1e-9);  // 7 along, tan 30 across
}

TEST(Positions, HoleCyclesLeaveTheToolOverTheHole) {
  const std::string cycle = "cycle hole drill reference 2 bottom -10";
  const Known k =
      known("block rapid X 1 Y 2 Z 3\nblock " + cycle +
            ", rapid X 4\nN1 block rapid X incremental 5\nN2 block cycle_cancel\nN3 block rapid Z 9\nN4 block\n");
  EXPECT_EQ(k.x("1"), "4");
  EXPECT_EQ(k.z("1"), "3");  // back at the height of the definition
  EXPECT_EQ(k.z("2"), "unknown");
  EXPECT_TRUE(k.at("1").cycle_active);
  EXPECT_EQ(k.x("2"), "9");
  EXPECT_EQ(k.y("2"), "2");
  EXPECT_FALSE(k.at("3").cycle_active);
  EXPECT_EQ(k.z("4"), "9");
  const Known named = known("block rapid X 1\nblock cycle named \"POCKET\" (), rapid X 4\nN1 block\n");
  EXPECT_EQ(named.x("1"), "unknown");
}

TEST(Dataflow, ATapInForceTakesTheSpindleOver) {
  const Known k = known(
      "block spindle 200\nmodal_call cycle hole tap bottom -15 pitch 1.25 rigid orient_first speed 200\n"
      "N1 block spindle 500\nN2 block rapid X 10\nmodal_call off\nblock spindle 300\nN4 end_program\n");
  EXPECT_EQ(k.at("1").spindle, 200);
  EXPECT_EQ(k.at("2").spindle, std::nullopt);
  EXPECT_EQ(k.at("4").spindle, 300);
}

TEST(Positions, OpaqueTextForgetsEverythingUnlessHarmless) {
  const Known k =
      known("block rapid X 1\nopaque \"?\" harmless\nN1 block\nopaque \"?\" feature \"text.unread\"\nN2 block\n");
  EXPECT_EQ(k.x("1"), "1");
  EXPECT_EQ(k.x("2"), "unknown");
  EXPECT_EQ(k.plane("2"), "unknown");
  EXPECT_FALSE(k.at("2").cycle_active_known);
  EXPECT_TRUE(k.at("2").reachable);
}

TEST(Positions, WhatAPassHasRefusedIsSaidOnce) {
  // No feature: refused with its own diagnostic. What follows is not blamed for it.
  const Known k = known("block rapid X 1\nopaque \"?\"\nN1 block\n");
  EXPECT_EQ(k.x("1"), "1");
}

// --- calls --------------------------------------------------------------------------------------------------------

Known with_subs(const std::string& lines, const std::string& subs) {
  return Known(read_ir("space R \"R\" segment 0 99\nroutine main 1 {\n" + lines + "}\n" + subs));
}

TEST(Calls, CalledInTwoModesUnknownInsideKeptOutside) {
  const Known k =
      with_subs("block distance absolute\ncall 20\nN1 block distance incremental\ncall 20\nN2 block\nend_program\n",
                "routine sub 20 {\nN10 block plane zx\nreturn\n}\n");
  EXPECT_EQ(k.distance("10"), "unknown");
  EXPECT_EQ(k.distance("1"), "absolute") << "the callee does not touch it";
  EXPECT_EQ(k.distance("2"), "incremental");
  EXPECT_EQ(k.plane("2"), "zx") << "what the callee sets comes back";
}

TEST(Calls, NestedCallsAndFallingOffTheEnd) {
  const Known k =
      with_subs("block rapid X 1 Y 2 Z 3\ncall 20\nN1 block\n",
                "routine sub 30 {\nblock linear Z -5\n}\nroutine sub 20 {\nN10 call 30\nN11 block linear X 9\n}\n");
  EXPECT_EQ(k.z("11"), "-5");
  EXPECT_EQ(k.x("1"), "9");
  EXPECT_EQ(k.y("1"), "2");
  EXPECT_EQ(k.z("1"), "-5");
}

TEST(Calls, RepeatedCallsJoin) {
  const Known k = with_subs("block rapid X 0\ncall 20 count 4\nN1 block\n",
                            "routine sub 20 {\nN10 block linear X incremental 1\n}\n");
  EXPECT_EQ(k.x("10"), "unknown");
  EXPECT_EQ(k.x("1"), "unknown");
  const Known maybe =
      with_subs("block plane xy\ncall 20 count R[1]\nN1 block\n", "routine sub 20 {\nblock plane zx\n}\n");
  EXPECT_EQ(maybe.plane("1"), "unknown") << "a count that may be 0";
}

TEST(Calls, RecursionEndsTheAnalysis) {
  const Known k = with_subs("block plane xy\ncall 20\nN1 block\n",
                            "routine sub 20 {\nN10 if R[1] > 0 {\ncall 20\nblock plane zx\n}\n}\n");
  EXPECT_EQ(k.plane("1"), "unknown");
  EXPECT_EQ(k.distance("1"), "absolute");
  const Known endless = with_subs("call 20\nN1 block\n", "routine sub 20 {\ncall 20\n}\n");
  EXPECT_FALSE(endless.at("1").reachable) << "never comes back";
}

TEST(Calls, UnknownAndComputedCallees) {
  EXPECT_EQ(with_subs("call 77\nN1 block\n", "").plane("1"), "unknown");
  const Known k =
      with_subs("block plane zx\ncall unnamed computed R[1]\nN1 block\n", "routine sub 20 {\nN10 block\n}\n");
  EXPECT_EQ(k.plane("1"), "unknown");
  EXPECT_EQ(k.plane("10"), "zx") << "it may be this one";
}

TEST(Calls, EndInASubEndsAllUnlessItReturns) {
  EXPECT_FALSE(with_subs("call 20\nN1 block\n", "routine sub 20 {\nend_program\n}\n").at("1").reachable);
  EXPECT_TRUE(
      with_subs("call 20\nN1 block\n", "routine sub 20 {\nend_program returns_from_sub\n}\n").at("1").reachable);
}

TEST(Calls, SavedModalsComeBack) {
  const Known k = with_subs("block plane xy, rapid X 1 Y 2\ncall 20\nN1 block\n",
                            "routine sub 20 saves_modals {\nblock plane zx, feed 5, linear X 4\n}\n");
  EXPECT_EQ(k.plane("1"), "xy");
  EXPECT_EQ(k.at("1").motion, MotionKind::rapid);
  EXPECT_EQ(k.at("1").feed, 5.0);
  EXPECT_EQ(k.x("1"), "unknown");
  EXPECT_EQ(k.y("1"), "2");
}

TEST(Calls, RangesOfAnotherRoutine) {
  const Known k = with_subs(
      "block plane xy\ncall 20 range N10 N11\nN1 block\n",
      "routine sub 20 {\nN9 block distance incremental\nN10 block plane zx\nN11 block\nN12 block plane yz\n}\n");
  EXPECT_EQ(k.plane("1"), "zx");
  EXPECT_EQ(k.distance("1"), "absolute");
  EXPECT_FALSE(k.at("9").reachable);
  const Known repeat = with_subs("repeat N10 N10 in 20\nN1 block\n", "routine sub 20 {\nN10 block plane zx\n}\n");
  EXPECT_EQ(repeat.plane("1"), "zx");
}

TEST(Calls, RepeatInPlaceJoins) {
  const Known k = known("N10 block linear X incremental 1\nN20 block plane zx\nrepeat N10 N20\nN30 block\n");
  EXPECT_EQ(k.plane("10"), "unknown");
  EXPECT_EQ(k.plane("30"), "zx");
}

TEST(Calls, ModalCallsRunAfterMotions) {
  const std::string sub = "routine sub 20 {\nN10 block plane zx\n}\n";
  const Known k = with_subs(
      "block rapid X 1\nmodal_call call 20\nN1 block feed 3\nN2 block linear X 5\nN3 block\nmodal_call off\nblock "
      "plane xy\nblock linear X 6\nN4 block\n",
      sub);
  EXPECT_EQ(k.plane("2"), "unknown") << "no motion yet, but some machines run it at F alone";
  EXPECT_EQ(k.plane("3"), "zx");
  EXPECT_EQ(k.x("3"), "5");
  EXPECT_EQ(k.plane("4"), "xy");
}

TEST(Calls, ModalCallsWaitForAMoveOfThePath) {
  const Known k = with_subs("block rapid X 1\nmodal_call call 20\nblock modal X alone 3\nN1 block\n",
                            "routine sub 20 {\nblock rapid X 0\n}\n");
  EXPECT_EQ(k.x("1"), "3") << "an axis that is positioned beside the path (840D POS)";
}

TEST(Calls, ModalCallsOfACountedBlock) {
  const Known k = with_subs("modal_call call 20\nblock distance incremental, rapid Y 10, times R[3]\nN1 block\n",
                            "routine sub 20 {\nblock distance absolute\n}\n");
  EXPECT_EQ(k.distance("1"), "unknown") << "no run with the count 0";
}

TEST(Calls, ModalSubprogramRunsAgainBehindItsOwnRun) {
  const Known k = with_subs("block rapid X 1\nmodal_call call 20\nblock modal Y 10, times 2\n",
                            "routine sub 20 {\nN1 block linear Z 1\n}\n");
  EXPECT_EQ(k.at("1").motion, std::nullopt) << "the second point is reached on a line";
}

TEST(Calls, ModalSubprogramThatNamesAnotherForTheNextPoint) {
  const Known k = with_subs("block rapid X 1\nmodal_call call 20\nblock modal Y 10, times 2\nN1 block\n",
                            "routine sub 20 {\nblock rapid Z 1\nmodal_call call 30\n}\n"
                            "routine sub 30 {\nblock linear Z 2\n}\n");
  EXPECT_EQ(k.at("1").motion, std::nullopt) << "20 runs at the first point, 30 at the second one";
}

TEST(Calls, ReturnToALabelOfTheCaller) {
  const Known k =
      with_subs("block rapid X 1\ncall 20\nblock linear\nN1 block\n", "routine sub 20 {\nreturn (\"N1\")\n}\n");
  EXPECT_EQ(k.at("1").motion, std::nullopt) << "the linear block may be left out";
}

TEST(Calls, SubsOfALibraryStartWithNothingKnown) {
  const Known k(read_ir("routine sub 20 {\nN10 block plane zx\nN11 block\n}\n"));
  EXPECT_TRUE(k.at("10").reachable);
  EXPECT_EQ(k.plane("10"), "unknown");
  EXPECT_EQ(k.plane("11"), "zx");
}

// --- properties ---------------------------------------------------------------------------------------------------

TEST(Dataflow, LongStraightProgramsStayLinear) {
  std::string lines;
  for (int i = 0; i < 30000; ++i) lines += "block linear X " + std::to_string(i % 700) + ".5 Y 2\n";
  const Program p = read_main(lines + "N1 block\n");
  const auto start = std::chrono::steady_clock::now();
  const FactTable table = analyse(p, {});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(table.before(30001).position[axis::x], 29999 % 700 + 0.5);
  EXPECT_LT(took.count(), 3.0) << "about 0.2 s unoptimised";
}

/// Whatever is thrown at it: it ends, and what holds before a statement that can be reached holds on every edge.
TEST(Dataflow, RandomProgramsReachAFixedPoint) {
  for (unsigned seed = 1; seed <= 150; ++seed) {
    const Program p = test::random_program(seed);
    const FactTable table = analyse(p, {});
    const detail::FrameReach framed = detail::frame_reach(p, {});
    for (const auto& r : p.routines) {
      const ControlFlow flow = control_flow(p, r);
      for_each_statement(r.body, [&](const Statement& s) {
        const bool plain = std::holds_alternative<Block>(s.node) || std::holds_alternative<Jump>(s.node);
        if (!plain || !table.before(s.id).reachable || table.before(s.id).modal_call != 0) return;
        Facts after = table.before(s.id);
        detail::apply(s, after, framed);  // frame statements reach the axes of this program only
        for (const auto to : flow.successors[s.id]) {
          if (to == 0) continue;
          Facts there = table.before(to);
          EXPECT_FALSE(join(there, after)) << "seed " << seed << " from " << s.id << " to " << to;
        }
      });
    }
  }
}

}  // namespace
}  // namespace cnctrans::ir
