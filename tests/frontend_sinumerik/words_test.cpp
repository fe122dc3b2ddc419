// Word blocks -> IR. What each G function, address and attribute means; sections are those of the language reference.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/frontend_sinumerik/show.h"

namespace {

using namespace cnctrans;
using namespace cnctrans::sinumerik;
using cnctrans::sinumerik::testing::body;
using cnctrans::sinumerik::testing::read;

const ir::Block& block_of(const ir::Program& p, std::size_t i = 0) {
  return std::get<ir::Block>(p.routines.at(0).body.at(i).node);
}
template <class Action>
const Action& only(const ir::Block& b) {
  const Action* found = nullptr;
  for (const auto& a : b.actions) {
    if (const auto* x = std::get_if<Action>(&a.data); x != nullptr) found = x;
  }
  if (found == nullptr) throw std::runtime_error("the action is not there");
  return *found;
}

TEST(SinumerikWords, ArcForms) {  // 14.3
  auto r = read("G2 X10 Y0 I5 J0\nG3 X0 I=AC(20) J5\nG2 X5 CR=-12.5\nG3 X1 AR=120.5\nG2 X0 Y0 Z-5 I5 TURN=2\n");
  EXPECT_EQ(r.errors(), "");
  const auto& centre = block_of(r.program, 0).motion;
  EXPECT_EQ(centre.kind, ir::MotionKind::arc_cw);
  EXPECT_EQ(centre.centers.at(0).mode, ir::CenterMode::from_start);  // always from the start, also under G90
  EXPECT_EQ(centre.centers.at(0).scale, ir::WordScale::radius);
  EXPECT_EQ(block_of(r.program, 1).motion.centers.at(0).mode, ir::CenterMode::absolute);
  EXPECT_EQ(block_of(r.program, 1).motion.centers.at(0).scale, ir::WordScale::modal);  // a diameter under DIAMON
  EXPECT_EQ(block_of(r.program, 1).motion.centers.at(1).mode, ir::CenterMode::from_start);
  EXPECT_TRUE(block_of(r.program, 2).motion.radius_given);
  EXPECT_EQ(block_of(r.program, 2).motion.radius.number, -12.5);
  EXPECT_EQ(block_of(r.program, 3).motion.extra->opening_angle.number, 120.5);
  EXPECT_EQ(block_of(r.program, 4).motion.extra->turns.number, 2);
}

TEST(SinumerikWords, ArcThroughPointAndTangentArc) {  // 14.3
  auto r = read("CIP X10 Y0 I1=5 J1=AC(5)\nCT X20 Y5\n");
  EXPECT_EQ(r.errors(), "");
  const auto& through = block_of(r.program, 0).motion;
  EXPECT_EQ(through.kind, ir::MotionKind::arc_through_point);
  EXPECT_EQ(through.extra->through.at(0).mode, ir::CenterMode::follows_distance);
  EXPECT_EQ(through.extra->through.at(1).mode, ir::CenterMode::absolute);
  EXPECT_EQ(block_of(r.program, 1).motion.kind, ir::MotionKind::arc_tangent);
}

TEST(SinumerikWords, PositionAttributes) {  // 1.5, 14.1
  auto r = read("G1 X=AC(10) Y=IC(-2) Z5 A=DC(90) B=ACP(10) C=ACN(20)\n");
  EXPECT_EQ(r.errors(), "");
  const auto& c = block_of(r.program).motion.coords;
  EXPECT_EQ(c.at(0).mode, ir::WordMode::absolute);
  EXPECT_EQ(c.at(1).mode, ir::WordMode::incremental);
  EXPECT_EQ(c.at(1).value.number, -2);
  EXPECT_EQ(c.at(2).mode, ir::WordMode::modal);
  EXPECT_EQ(c.at(3).direction, ir::RotaryDirection::shortest);
  EXPECT_EQ(c.at(4).direction, ir::RotaryDirection::positive);
  EXPECT_EQ(c.at(5).direction, ir::RotaryDirection::negative);
  auto lathe = read("G1 X=DIC(10)\nX=RAC(5)\n", "sinumerik-lathe");
  EXPECT_EQ(block_of(lathe.program, 0).motion.coords.at(0).scale, ir::WordScale::diameter);
  EXPECT_EQ(block_of(lathe.program, 1).motion.coords.at(0).scale, ir::WordScale::radius);
  EXPECT_EQ(block_of(lathe.program, 1).motion.coords.at(0).mode, ir::WordMode::absolute);
}

TEST(SinumerikWords, UnitsAndFeedModes) {  // 14.2, 14.7
  auto r = read("G70\nG700\nG95\nG96 S200 LIMS=3000\nG97 S1000\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_FALSE(only<ir::ModalSet>(block_of(r.program, 0)).feed_too);  // G70 leaves F alone
  EXPECT_TRUE(only<ir::ModalSet>(block_of(r.program, 1)).feed_too);
  EXPECT_EQ(only<ir::ModalSet>(block_of(r.program, 2)).feed_memory, ir::FeedMemory::cleared);
  const auto& css = block_of(r.program, 3);
  EXPECT_EQ(std::get<ir::ModalSet>(css.actions.at(0).data).setting, ir::Setting::spindle_mode);
  EXPECT_EQ(std::get<ir::ModalSet>(css.actions.at(1).data).setting, ir::Setting::feed_mode);  // G96 brings G95
  EXPECT_EQ(std::get<ir::ModalSet>(css.actions.at(1).data).value, static_cast<int>(ir::FeedMode::per_rev));
  EXPECT_EQ(only<ir::SpindleLimit>(css).value.number, 3000);
  EXPECT_EQ(only<ir::SetSpindle>(css).value.number, 200);
}

TEST(SinumerikWords, ActionsStandInTheOrderTheyAreCarriedOut) {
  auto r = read("D1 M6 M3 F100 S500 T2 G90 M0 M8 X10\n");
  EXPECT_EQ(r.errors(), "");
  const auto& a = block_of(r.program).actions;
  ASSERT_EQ(a.size(), 9U);
  EXPECT_TRUE(std::holds_alternative<ir::ModalSet>(a[0].data));
  EXPECT_TRUE(std::holds_alternative<ir::SetFeed>(a[1].data));
  EXPECT_TRUE(std::holds_alternative<ir::SetSpindle>(a[2].data));
  EXPECT_TRUE(std::holds_alternative<ir::ToolSelect>(a[3].data));
  EXPECT_TRUE(std::holds_alternative<ir::ToolChange>(a[4].data));
  EXPECT_TRUE(std::holds_alternative<ir::ToolOffset>(a[5].data));
  EXPECT_TRUE(std::holds_alternative<ir::SpindleRun>(a[6].data));
  EXPECT_TRUE(std::holds_alternative<ir::Coolant>(a[7].data));
  EXPECT_TRUE(std::holds_alternative<ir::Stop>(a[8].data));
  EXPECT_EQ(a[8].order, ir::Order::after);
  EXPECT_EQ(a[0].pos.column, 23U);  // the place in the line stays
}

TEST(SinumerikWords, DwellTakesItsOwnFAndS) {  // 14.3
  auto r = read("G4 F2.5\nS3 G4\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(only<ir::Dwell>(block_of(r.program, 0)).value.number, 2.5);
  EXPECT_FALSE(only<ir::Dwell>(block_of(r.program, 0)).revolutions);
  EXPECT_TRUE(only<ir::Dwell>(block_of(r.program, 1)).revolutions);
  EXPECT_EQ(block_of(r.program, 0).actions.size(), 1U);  // the modal F and S are not touched
  EXPECT_EQ(block_of(r.program, 1).actions.size(), 1U);
  EXPECT_EQ(read("G4\n").errors(), "SIN-004");
  EXPECT_EQ(read("G4 F1 X10\n").errors(), "SIN-005");
}

TEST(SinumerikWords, ProgrammableFrames) {  // 14.5
  auto r = read("TRANS X10 Y20\nATRANS Z5\nAROT RPL=30\nROT Z45\nSCALE X2 Y2\nMIRROR X0\nTRANS\n");
  EXPECT_EQ(r.errors(), "");
  const auto change = [&](std::size_t i) { return only<ir::FrameOp>(block_of(r.program, i)).change; };
  EXPECT_EQ(change(0)->combine, ir::FrameCombine::replace);  // deletes the whole programmable frame first
  EXPECT_EQ(change(0)->slot, ir::FrameSlot::chain);
  EXPECT_EQ(change(0)->words.at(1).value.number, 20);
  EXPECT_EQ(change(1)->combine, ir::FrameCombine::compose);
  EXPECT_EQ(change(2)->rotation_axis, ir::axis::none);  // in the plane in force
  EXPECT_EQ(change(2)->angle.number, 30);
  EXPECT_EQ(change(3)->rotation_axis, ir::axis::z);
  EXPECT_EQ(change(4)->kind, ir::FrameKind::scale);
  EXPECT_EQ(change(4)->words.at(0).scale, ir::WordScale::radius);  // a factor is never a diameter
  EXPECT_EQ(change(5)->words.at(0).value.number, 1);               // the value of MIRROR does not count
  EXPECT_EQ(change(6)->combine, ir::FrameCombine::clear);
  EXPECT_FALSE(block_of(r.program, 0).has_motion);
  const auto turned = read("ROT X10 Y20\nG58 X3\nG59 X1\nROTS X30 Y20\n");
  EXPECT_EQ(turned.warnings(), "");
  const auto& both = *only<ir::FrameOp>(block_of(turned.program, 0)).change;
  EXPECT_FALSE(both.has_angle);  // words are angles: about Z, then Y, then X
  EXPECT_EQ(both.words.at(1).value.number, 20);
  EXPECT_EQ(only<ir::FrameOp>(block_of(turned.program, 1)).change->combine, ir::FrameCombine::replace_named);
  EXPECT_TRUE(only<ir::FrameOp>(block_of(turned.program, 2)).change->fine);
}

TEST(SinumerikWords, WorkOffsetsAndSuppression) {  // 14.5, motion 7.6
  auto r = read("G54\nG599\nG500\nG0 SUPA Z0 D0\nG[8]=2\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(only<ir::WorkOffset>(block_of(r.program, 0)).index.number, 1);
  EXPECT_EQ(only<ir::WorkOffset>(block_of(r.program, 1)).index.number, 99);
  EXPECT_TRUE(only<ir::WorkOffset>(block_of(r.program, 2)).off);
  EXPECT_EQ(block_of(r.program, 3).motion.frame, ir::FrameUse::machine);  // D0 takes the tool length off
  EXPECT_EQ(block_of(read("G0 G53 Z0\n").program).motion.frame, ir::FrameUse::machine_with_length);
  EXPECT_EQ(only<ir::WorkOffset>(block_of(r.program, 4)).index.number, 1);  // group 8, second member: G54
}

TEST(SinumerikWords, CornersAndThreads) {  // 14.3, 14.4
  auto r = read("G1 X10 RND=2.5 FRC=100\nX20 CHR=1\nX30 CHF=1\nG33 Z-30 K1.5 SF=90\nZ-40 K2\nG35 Z-50 K2 F0.1\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(only<ir::Corner>(block_of(r.program, 0)).kind, ir::CornerKind::round);
  EXPECT_EQ(only<ir::Corner>(block_of(r.program, 0)).feed->number, 100);
  EXPECT_EQ(only<ir::Corner>(block_of(r.program, 1)).kind, ir::CornerKind::chamfer_leg);
  EXPECT_EQ(only<ir::Corner>(block_of(r.program, 2)).kind, ir::CornerKind::chamfer_chord);
  EXPECT_EQ(block_of(r.program, 3).motion.extra->lead.number, 1.5);
  EXPECT_EQ(block_of(r.program, 3).motion.extra->lead_axis, ir::axis::z);
  EXPECT_EQ(block_of(r.program, 3).motion.extra->start_angle.number, 90);
  EXPECT_EQ(block_of(r.program, 4).motion.extra->lead.number, 2);            // G33 is modal
  EXPECT_EQ(block_of(r.program, 5).motion.extra->lead_change.number, -0.1);  // G35 decreases
}

TEST(SinumerikWords, SpindlesAndTools) {  // 14.7, 14.8
  auto r = read("M2=4 S2=800\nSPOS=45\nT=\"MILL 20\"\nH5=3\nM77\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(only<ir::SpindleRun>(block_of(r.program, 0)).number, 2);
  EXPECT_EQ(only<ir::SpindleRun>(block_of(r.program, 0)).state, ir::SpindleState::ccw);
  EXPECT_EQ(only<ir::SetSpindle>(block_of(r.program, 0)).number, 2);
  EXPECT_EQ(only<ir::SpindleOrient>(block_of(r.program, 1)).angle.number, 45);
  EXPECT_EQ(only<ir::ToolSelect>(block_of(r.program, 2)).name, "MILL 20");
  EXPECT_FALSE(only<ir::ToolSelect>(block_of(r.program, 2)).changes);  // M6 changes on the mill
  EXPECT_TRUE(only<ir::MachineFunction>(block_of(r.program, 3)).auxiliary);
  EXPECT_EQ(only<ir::MachineFunction>(block_of(r.program, 3)).extension, 5);
  EXPECT_EQ(only<ir::MachineFunction>(block_of(r.program, 4)).code, 77);
  EXPECT_TRUE(only<ir::ToolSelect>(block_of(read("T1\n", "sinumerik-lathe").program)).changes);  // a turret
}

TEST(SinumerikWords, PoleAndPolarWords) {  // 14.3
  auto r = read("G111 X10 Y20\nG1 AP=30 RP=50\nAP=IC(10)\nG110 X0 Y0\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(only<ir::PoleSet>(block_of(r.program, 0)).at->words.at(1).value.number, 20);
  EXPECT_EQ(block_of(r.program, 1).motion.extra->polar_radius.number, 50);
  EXPECT_EQ(block_of(r.program, 2).motion.extra->polar_angle_mode, ir::WordMode::incremental);
  EXPECT_EQ(block_of(r.program, 2).motion.extra->polar_mode, ir::WordMode::modal);
  EXPECT_NE(only<ir::PoleSet>(block_of(r.program, 3)).at, nullptr);  // from the point programmed last
  EXPECT_EQ(read("G112 X5\n").errors() + read("G112 X5\n").warnings(), "");
}

TEST(SinumerikWords, ProgramEnds) {  // 1.2, 8.3
  auto r = read("X10 M30\nM17\nM2\nRET\n");
  const auto& b = r.program.routines.at(0).body;
  ASSERT_EQ(b.size(), 5U);
  EXPECT_TRUE(std::get<ir::Block>(b[0].node).has_motion);  // the motion of the block comes first
  EXPECT_TRUE(std::get<ir::End>(b[1].node).returns_from_sub);
  EXPECT_TRUE(b[1].line.joined);
  EXPECT_TRUE(std::holds_alternative<ir::Return>(b[2].node));
  EXPECT_TRUE(std::holds_alternative<ir::End>(b[3].node));
  EXPECT_TRUE(std::holds_alternative<ir::Return>(b[4].node));
}

TEST(SinumerikWords, WhatCanNotBeReadIsRefused) {
  EXPECT_EQ(read("G88 X5\n").errors(), "SIN-002");
  EXPECT_EQ(read("G1.5\n").errors(), "SIN-002");
  EXPECT_EQ(read("G90 G91\n").errors(), "SIN-005");
  EXPECT_EQ(read("X1 X2\n").errors(), "SIN-005");
  EXPECT_EQ(read("G1 Q5\n").warnings(), "SIN-003");
  EXPECT_EQ(read("Y10\n", "sinumerik-lathe").warnings(), "SIN-003");
  EXPECT_EQ(read("G1 X\n").errors(), "SIN-004");
  EXPECT_EQ(read("G1 X10 I5\n").errors(), "SIN-003");
  EXPECT_EQ(read("G2 X1 CR=5 I2\n").errors(), "SIN-005");
  EXPECT_EQ(read("R1 X5\n").errors(), "SIN-003");
  EXPECT_EQ(read("INVCW X1\n").warnings(), "SIN-008");
  EXPECT_EQ(read("G58\n").errors(), "SIN-004");
  EXPECT_EQ(read("M1.5\n").errors(), "SIN-017");
  auto r = read("N10 G88 X5 ;why\nG0 X1\n");
  const auto& opaque = std::get<ir::Opaque>(r.program.routines[0].body[0].node);
  EXPECT_EQ(opaque.text, "G88 X5");
  EXPECT_FALSE(opaque.harmless);
  EXPECT_EQ(r.program.routines[0].body[0].line.number, "10");
  EXPECT_EQ(r.stats.blocks, 2U);
  EXPECT_EQ(r.stats.blocks_read, 1U);
}

TEST(SinumerikWords, WordsWithoutEffectOnThePathAreNoted) {
  auto r = read("SOFT G601 G1 X10 G451 CTOL=0.01\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(r.codes(Severity::note), "SIN-009 SIN-009 SIN-009 SIN-009");
  EXPECT_EQ(block_of(r.program).motion.coords.size(), 1U);
  EXPECT_EQ(read("ACC[X]=50 OVRA[Y]=90\n").codes(Severity::note), "SIN-009 SIN-009");
  const auto pos = read("POS[X]=50\n");
  EXPECT_EQ(pos.warnings(), "");
  EXPECT_EQ(block_of(pos.program).motion.coords.at(0).positioning, ir::Positioning::alone);
}

}  // namespace
