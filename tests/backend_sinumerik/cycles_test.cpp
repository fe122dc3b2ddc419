// Drilling cycles (reference-language 18.1): arguments RTP, RFP, SDIS, DP, DPR, DTB...
#include "backends/sinumerik/cycles.h"

#include "tests/backend_sinumerik/build.h"

namespace cnctrans::test {
namespace {

using ir::HoleKind;
using ir::LevelBase;
using ir::Value;

ir::HoleCycle drill() {
  ir::HoleCycle c;
  c.retract = level(50);
  c.surface = level(0);
  c.reference = level(2, LevelBase::from_surface);
  c.bottom = level(-20);
  return c;
}
ir::HoleCycle pecks(double surface, double bottom, double first) {
  ir::HoleCycle c = drill();
  c.kind = HoleKind::peck_full;
  c.surface = level(surface);
  c.bottom = level(bottom);
  c.pecks.law = ir::PeckLaw::balanced;
  c.pecks.first = Value(first);
  c.pecks.first_from_surface = true;
  c.pecks.reapproach_automatic = true;
  return c;
}
std::string call(const ir::HoleCycle& c) {
  ir::Cycle cycle;
  cycle.node = c;
  if (!backends::sinumerik::native_cycle(cycle)) return "none";
  return backends::sinumerik::cycle_call(cycle, [](const Value& v) {
    EXPECT_TRUE(v.literal());
    std::string s = std::to_string(v.number);
    while (s.back() == '0') s.pop_back();
    if (s.back() == '.') s.pop_back();
    return s;
  });
}

TEST(SinumerikCycles, DrillByAbsoluteDepth) {
  EXPECT_EQ(call(drill()), "CYCLE81(50,0,2,-20)");
}

TEST(SinumerikCycles, DepthFromTheSurfaceIsUnsigned) {
  auto c = drill();
  c.bottom = level(-15, LevelBase::from_surface);
  EXPECT_EQ(call(c), "CYCLE81(50,0,2,,15)");
}

TEST(SinumerikCycles, DwellInSecondsOrRevolutions) {
  auto c = drill();
  c.dwell_bottom = Value(30);
  c.dwell_scale = 0.01;
  EXPECT_EQ(call(c), "CYCLE82(50,0,2,-20,,0.3)");
  c.dwell_scale = 1;
  c.dwell_bottom = Value(3);
  c.dwell_in_revolutions = true;
  EXPECT_EQ(call(c), "CYCLE82(50,0,2,-20,,-3)");
}

// The R plane is RFP+SDIS, never RTP (equivalences 22.2).
TEST(SinumerikCycles, WithoutASurfaceTheReferencePlaneIsKept) {
  auto c = drill();
  c.surface = {};
  c.reference = level(3);
  EXPECT_EQ(call(c), "CYCLE81(50,0,3,-20)");
  c.reference = level(60);
  c.retract = level(80);
  EXPECT_EQ(call(c), "CYCLE81(80,60,0,-20)");
}

TEST(SinumerikCycles, WhatTheCallCanNotSayIsNotNative) {
  auto c = drill();
  c.retract = {};
  EXPECT_EQ(call(c), "none");  // RTP is absolute
  c = drill();
  c.retract = level(0, LevelBase::from_initial);
  EXPECT_EQ(call(c), "none");
  c = drill();
  c.has_feed = true;
  EXPECT_EQ(call(c), "none");
  c = drill();
  c.kind = HoleKind::tap;
  EXPECT_EQ(call(c), "none");
  c = drill();
  c.bottom.given = false;
  EXPECT_EQ(call(c), "none");  // a missing depth is an error, never a default
}

TEST(SinumerikCycles, PecksWithTheControlsOwnSchedule) {
  EXPECT_EQ(call(pecks(0, -20, 6)), "CYCLE83(50,0,2,-20,,,6,0,0,0,1,1)");
  auto c = pecks(0, -20, 6);
  c.pecks.reapproach_automatic = false;
  c.pecks.reapproach = Value(1);
  c.dwell_top = Value(0.5);
  EXPECT_EQ(call(c), "CYCLE83(50,0,2,-20,,,6,0,0,0.5,1,1,,,,,1)");
}

TEST(SinumerikCycles, ChipBreakingLiftsByVrt) {
  auto c = pecks(0, -20, 6);
  c.kind = HoleKind::peck_break;
  c.pecks.reapproach_automatic = false;
  c.pecks.lift = Value(0.5);
  EXPECT_EQ(call(c), "CYCLE83(50,0,2,-20,,,6,0,0,0,1,0,,,0.5)");
  c.pecks.lift_rapid = true;
  EXPECT_EQ(call(c), "none");
}

// Equal pecks and a remainder are not what the control does: it shares the rest between the last two.
TEST(SinumerikCycles, EqualPecksOnlyWithoutRemainder) {
  auto c = pecks(0, -18, 6);
  c.pecks.law = ir::PeckLaw::constant;
  EXPECT_EQ(call(c), "CYCLE83(50,0,2,-18,,,6,0,0,0,1,1)");
  c.bottom = level(-20);  // 6 6 6 2 against 6 6 4 4
  EXPECT_EQ(call(c), "none");
  c.bottom = level(-5);
  EXPECT_EQ(call(c), "CYCLE83(50,0,2,-5,,,6,0,0,0,1,1)");
}

TEST(SinumerikCycles, PecksCountedFromTheReferencePlaneMoveRfpThere) {
  auto c = pecks(0, -18, 6);
  c.pecks.first_from_surface = false;
  c.surface = {};
  c.reference = level(2);
  EXPECT_EQ(call(c), "CYCLE83(50,2,0,-18,,,6,0,0,0,1,1)");
}

// DTD 0 means DTB (18.1): a dwell at every peck but none at the bottom can't be said.
TEST(SinumerikCycles, DwellsOfPecks) {
  auto c = pecks(0, -18, 6);
  c.dwell_bottom = Value(1);
  EXPECT_EQ(call(c), "CYCLE83(50,0,2,-18,,,6,0,0,0,1,1,,,,1)");
  c.pecks.dwell = Value(1);
  EXPECT_EQ(call(c), "CYCLE83(50,0,2,-18,,,6,0,1,0,1,1)");
  c.dwell_bottom = Value(0);
  EXPECT_EQ(call(c), "none");
}

TEST(SinumerikCycles, ModalCycleIsAModalCall) {
  Build b;
  auto cycle = std::make_shared<ir::Cycle>();
  auto hole = drill();
  hole.bottom.value = Value(R(1));
  cycle->node = hole;
  ir::ModalCall m;
  m.cycle = cycle;
  b.add(m);
  b.add(move(ir::MotionKind::rapid, {coord(ir::axis::x, Value(10))}));
  b.add(actions({action(ir::CycleCancel{})}));
  b.add(actions({action(ir::CycleDefine{cycle, false, true, ir::CycleTrigger::path_motion})}));
  EXPECT_EQ(b.text(), "MCALL CYCLE81(50,0,2,R1)\nG0 X10\nMCALL\nCYCLE81(50,0,2,R1)\n");
}

}  // namespace
}  // namespace cnctrans::test
