// Word blocks: what each word must be on the control (reference-language 14 and 15, reference-motion 2 and 7).
#include "tests/backend_sinumerik/build.h"

namespace cnctrans::test {
namespace {

using ir::MotionKind;
using ir::Value;
namespace axis = ir::axis;

std::string line_of(ir::Block block, const std::string& machine = "sinumerik-mill") {
  Build b(machine);
  b.add(std::move(block));
  const std::string text = b.text();
  EXPECT_TRUE(b.diagnostics.empty()) << b.codes();
  return text;
}
std::string line_of(ir::Action a, const std::string& machine = "sinumerik-mill") {
  return line_of(actions({std::move(a)}), machine);
}

TEST(SinumerikWords, LinearMoveKeepsTheNumberTextOfTheSource) {
  ir::Block b = move(MotionKind::linear, {coord(axis::x, Value(10.5, "10.500")), coord(axis::z, Value(-3, "-3"))});
  b.actions.push_back(action(ir::SetFeed{Value(200, "+200"), false}));
  EXPECT_EQ(line_of(b), "G1 X10.500 Z-3 F200\n");
}

TEST(SinumerikWords, NumbersMadeByPassesHaveNoExponentAndNoTrailingZeros) {
  EXPECT_EQ(line_of(move(MotionKind::rapid,
                         {coord(axis::x, Value(1e-6)), coord(axis::y, Value(-0.0)), coord(axis::z, Value(2.50))})),
            "G0 X0.000001 Y0 Z2.5\n");
}

TEST(SinumerikWords, AComputedValueNeedsTheEqualsSign) {  // 1.5: X=R1*2
  EXPECT_EQ(line_of(move(MotionKind::linear, {coord(axis::x, Value(op(ir::BinaryOp::multiply, R(1), num(2)))),
                                              coord(axis::z, Value(ir::unary(ir::UnaryOp::negate, R(2))))})),
            "G1 X=R1*2 Z=-R2\n");
}

TEST(SinumerikWords, WordsKeepTheOrderOfTheirColumns) {
  ir::Block b = move(MotionKind::linear, {coord(axis::z, Value(5), 4), coord(axis::x, Value(1), 9)});
  b.motion.code_pos.column = 14;
  EXPECT_EQ(line_of(b), "Z5 X1 G1\n");
}

// A word says absolute or incremental only where the mode in force does not say it already.
TEST(SinumerikWords, AbsoluteAndIncrementalPerWord) {
  Build b;
  auto x = coord(axis::x, Value(10));
  x.mode = ir::WordMode::absolute;
  auto y = coord(axis::y, Value(R(3)));
  y.mode = ir::WordMode::incremental;
  b.add(actions({set(ir::Setting::distance, ir::Distance::absolute)}));
  b.add(move(MotionKind::linear, {x, y}));
  b.add(actions({set(ir::Setting::distance, ir::Distance::incremental)}));
  b.add(move(MotionKind::linear, {x, y}));
  EXPECT_EQ(b.text(), "G90\nG1 X10 Y=IC(R3)\nG91\nG1 X=AC(10) Y=R3\n");
}

TEST(SinumerikWords, DiameterPerWordOnALathe) {
  auto x = coord(axis::x, Value(40));
  x.mode = ir::WordMode::incremental;
  x.scale = ir::WordScale::diameter;
  EXPECT_EQ(line_of(move(MotionKind::linear, {x}), "sinumerik-lathe"), "G1 X=DIC(40)\n");
}

// A signed rotary target of other controls: the sign is the direction, the target lies in 0..360 (equivalences 8).
TEST(SinumerikWords, TheSignOfARotaryTargetBecomesItsDirection) {
  Build b;
  b.add(actions({set(ir::Setting::distance, ir::Distance::absolute)}));
  auto c = coord(axis::b, Value(-233));
  c.direction = ir::RotaryDirection::by_sign;
  b.add(move(MotionKind::rapid, {c}));
  c.value = Value(90);
  b.add(move(MotionKind::rapid, {c}));
  c.value = Value(-0.0);
  b.add(move(MotionKind::rapid, {c}));
  EXPECT_EQ(b.text(), "G90\nG0 B=ACN(233)\nG0 B=ACP(90)\nG0 B=ACN(0)\n");
}

TEST(SinumerikWords, ASignedRotaryIncrementIsAPlainWord) {
  Build b;
  b.add(actions({set(ir::Setting::distance, ir::Distance::incremental)}));
  auto c = coord(axis::c, Value(-90));
  c.direction = ir::RotaryDirection::by_sign;
  b.add(move(MotionKind::rapid, {c}));
  EXPECT_EQ(b.text(), "G91\nG0 C-90\n");
}

TEST(SinumerikWords, ArcByOffsetFromStart) {
  ir::Block b = move(MotionKind::arc_cw, {coord(axis::x, Value(10)), coord(axis::y, Value(0))});
  ir::CenterWord i;
  i.value = Value(5);
  b.motion.centers.push_back(i);
  EXPECT_EQ(line_of(b), "G2 X10 Y0 I5\n");
}

TEST(SinumerikWords, ArcByAbsoluteCentre) {  // 14.12: I=AC()
  ir::Block b = move(MotionKind::arc_ccw, {coord(axis::x, Value(10))});
  ir::CenterWord j;
  j.axis = axis::y;
  j.mode = ir::CenterMode::absolute;
  j.value = Value(R(1));
  b.motion.centers.push_back(j);
  EXPECT_EQ(line_of(b), "G3 X10 J=AC(R1)\n");
}

TEST(SinumerikWords, ArcByRadiusAndHelix) {
  ir::Block b = move(MotionKind::arc_cw, {coord(axis::x, Value(10))});
  b.motion.radius_given = true;
  b.motion.radius = Value(-7.5);
  EXPECT_EQ(line_of(b), "G2 X10 CR=-7.5\n");
  b.motion.radius_given = false;
  auto extra = std::make_shared<ir::MotionExtra>();
  extra->has_turns = true;
  extra->turns = Value(2);
  b.motion.extra = extra;
  EXPECT_EQ(line_of(b), "G2 X10 TURN=2\n");
}

TEST(SinumerikWords, AHelixByItsPitchIsRefused) {
  Build b;
  ir::Block block = move(MotionKind::arc_cw, {coord(axis::z, Value(-10))});
  auto extra = std::make_shared<ir::MotionExtra>();
  extra->has_pitch = true;
  block.motion.extra = extra;
  b.add(block);
  b.text();
  EXPECT_EQ(b.codes(), "TRN-202");
  EXPECT_TRUE(b.diagnostics.has_errors());
}

TEST(SinumerikWords, SettingsOfAMillStart) {
  EXPECT_EQ(
      line_of(actions({set(ir::Setting::plane, ir::Plane::xy), set(ir::Setting::comp, ir::CompSide::off),
                       set(ir::Setting::path_mode, ir::PathMode::continuous),
                       set(ir::Setting::units, ir::Units::metric), set(ir::Setting::distance, ir::Distance::absolute),
                       set(ir::Setting::feed_mode, ir::FeedMode::per_minute)})),
      "G17 G40 G64 G710 G90 G94\n");
}

TEST(SinumerikWords, UnitsOfLengthsOnlyAreG70) {
  ir::Action a = set(ir::Setting::units, ir::Units::inch);
  EXPECT_EQ(line_of(a), "G700\n");
  std::get<ir::ModalSet>(a.data).feed_too = false;
  EXPECT_EQ(line_of(a), "G70\n");
}

// G94 to G97 are one group (15, group 15): G95 after G96 would end the constant cutting speed.
TEST(SinumerikWords, FeedModeAndCuttingSpeedShareOneCode) {
  Build b("sinumerik-lathe");
  b.add(actions(
      {set(ir::Setting::feed_mode, ir::FeedMode::per_rev), set(ir::Setting::spindle_mode, ir::SpindleMode::rpm)}));
  b.add(actions({set(ir::Setting::spindle_mode, ir::SpindleMode::css), action(ir::SetSpindle{1, Value(180)})}));
  b.add(actions({set(ir::Setting::feed_mode, ir::FeedMode::per_minute)}));
  b.add(actions({set(ir::Setting::feed_mode, ir::FeedMode::per_rev)}));
  b.add(actions({set(ir::Setting::spindle_mode, ir::SpindleMode::rpm), action(ir::SetSpindle{1, Value(800)})}));
  const std::string text = b.text();
  EXPECT_EQ(text, "G95\nG96 S180\nG961\nG96\nG97 S800\n");
  EXPECT_TRUE(b.diagnostics.empty()) << b.codes();
}

TEST(SinumerikWords, WorkOffsets) {
  EXPECT_EQ(line_of(action(ir::WorkOffset{Value(1), false})), "G54\n");
  EXPECT_EQ(line_of(action(ir::WorkOffset{Value(5), false})), "G505\n");
  EXPECT_EQ(line_of(action(ir::WorkOffset{Value(0), true})), "G500\n");
}

TEST(SinumerikWords, DwellIsInSecondsWhateverTheUnitOfTheSource) {  // a bare number never crosses languages
  ir::Dwell d;
  d.value = Value(250, "250");
  d.scale = 0.01;
  EXPECT_EQ(line_of(action(d)), "G4 F2.5\n");
  d.value = Value(R(1));
  EXPECT_EQ(line_of(action(d)), "G4 F=R1*0.01\n");
  d = {};
  d.value = Value(3);
  d.revolutions = true;
  EXPECT_EQ(line_of(action(d)), "G4 S3\n");
}

TEST(SinumerikWords, ADwellBesideAMotionStandsAlone) {
  ir::Block b = move(MotionKind::linear, {coord(axis::x, Value(1))});
  ir::Dwell d;
  d.value = Value(1);
  b.actions.push_back(action(d));
  EXPECT_EQ(line_of(b), "G4 F1\nG1 X1\n");
}

TEST(SinumerikWords, FramesStandAloneAndBuildAChain) {  // 14.5
  auto change = [](ir::FrameKind kind, ir::FrameCombine combine) {
    auto c = std::make_shared<ir::FrameChange>();
    c->slot = ir::FrameSlot::chain;
    c->kind = kind;
    c->combine = combine;
    return c;
  };
  auto shift = change(ir::FrameKind::translate, ir::FrameCombine::replace);
  shift->words = {{axis::x, Value(100), ir::WordScale::modal, {}}, {axis::y, Value(R(2)), ir::WordScale::modal, {}}};
  auto turn = change(ir::FrameKind::rotate, ir::FrameCombine::compose);
  turn->has_angle = true;
  turn->angle = Value(45);
  auto grow = change(ir::FrameKind::scale, ir::FrameCombine::compose);
  grow->uniform_scale = true;
  grow->words = {{axis::x, Value(2), ir::WordScale::modal, {}}};
  auto mirror = change(ir::FrameKind::mirror, ir::FrameCombine::compose);
  mirror->words = {{axis::x, Value(1), ir::WordScale::modal, {}}, {axis::y, Value(0), ir::WordScale::modal, {}}};
  EXPECT_EQ(line_of(actions({action(ir::FrameOp{shift}), action(ir::FrameOp{turn}), action(ir::FrameOp{grow}),
                             action(ir::FrameOp{mirror}),
                             action(ir::FrameOp{change(ir::FrameKind::translate, ir::FrameCombine::clear)})})),
            "TRANS X100 Y=R2\nAROT RPL=45\nASCALE X2 Y2 Z2\nAMIRROR X0\nTRANS\n");
}

TEST(SinumerikWords, AFrameSlotOfAnotherControlIsRefused) {
  Build b;
  b.add(actions({action(ir::FrameOp{std::make_shared<ir::FrameChange>()})}));
  b.text();
  EXPECT_TRUE(b.diagnostics.has_errors());
}

// The length does not count in the source's machine move: D0, and the offset comes back with the next block
// (equivalences 8).
TEST(SinumerikWords, MachineMoveWithoutLengthSelectsTheOffsetAgain) {
  Build b;
  b.add(actions({action(ir::ToolSelect{Value(3), {}, true}), action(ir::ToolOffset{Value(2)})}));
  ir::Block m = move(MotionKind::rapid, {coord(axis::z, Value(0))});
  m.motion.frame = ir::FrameUse::machine;
  b.add(m);
  b.add(m);
  b.add(move(MotionKind::modal, {coord(axis::x, Value(5))}));
  b.add(move(MotionKind::modal, {coord(axis::x, Value(6))}));
  EXPECT_EQ(b.text(), "T3 D2\nSUPA G0 Z0 D0\nSUPA G0 Z0 D0\nX5 D2\nX6\n");
}

TEST(SinumerikWords, ALabelThatNothingLeadsToLeavesTheOffsetSure) {
  Build b;
  b.add(actions({action(ir::ToolOffset{Value(2)})}));
  b.add(actions({action(ir::ToolOffset{Value(3)})}));
  auto& label = b.add(move(MotionKind::rapid, {coord(axis::z, Value(0))}));
  std::get<ir::Block>(label.node).motion.frame = ir::FrameUse::machine;
  label.line.labels = {"LAB_A"};
  b.add(move(MotionKind::rapid, {coord(axis::x, Value(5))}));
  EXPECT_EQ(b.text(), "D2\nD3\nLAB_A: SUPA G0 Z0 D0\nG0 X5 D3\n");
  EXPECT_EQ(b.codes(), "");
}

TEST(SinumerikWords, SpindleToolAndCoolant) {
  EXPECT_EQ(line_of(actions({action(ir::ToolSelect{Value(4), {}, false}), action(ir::ToolChange{})})), "T4 M6\n");
  EXPECT_EQ(line_of(action(ir::ToolSelect{Value(0), "DRILL_5", false})), "T=\"DRILL_5\"\n");
  EXPECT_EQ(line_of(actions({action(ir::SetSpindle{1, Value(1200)}), action(ir::SpindleRun{1, ir::SpindleState::cw}),
                             action(ir::Coolant{ir::CoolantState::flood})})),
            "S1200 M3 M8\n");
  EXPECT_EQ(line_of(actions({action(ir::SetSpindle{2, Value(500)}), action(ir::SpindleRun{2, ir::SpindleState::ccw})})),
            "S2=500 M2=4\n");
  EXPECT_EQ(line_of(action(ir::SpindleLimit{1, Value(2500), false}), "sinumerik-lathe"), "LIMS=2500\n");
  EXPECT_EQ(line_of(action(ir::SpindleOrient{1, Value(90)})), "SPOS=90\n");
}

// M5 after the motion in the source, before it on this control (equivalences 4): a line of its own.
TEST(SinumerikWords, OneEventOneBlockWhenTheOrderDiffers) {
  ir::Block b = move(MotionKind::linear, {coord(axis::x, Value(1))});
  b.actions.push_back(action(ir::SpindleRun{1, ir::SpindleState::off}, ir::Order::after));
  b.actions.push_back(action(ir::Coolant{ir::CoolantState::flood}, ir::Order::before));
  b.actions.push_back(action(ir::Stop{false}, ir::Order::after));
  EXPECT_EQ(line_of(b), "G1 X1 M8\nM5 M0\n");
}

TEST(SinumerikWords, AMachineFunctionThatMeansSomethingElseThereIsRefused) {
  Build b;
  b.add(actions({action(m_function(41))}));  // the target shifts the gear with M41
  b.text();
  EXPECT_EQ(b.codes(), "TRN-207");
}

TEST(SinumerikWords, AMachineFunctionIsCarriedWithANote) {
  Build b;
  b.add(actions({action(m_function(77))}));
  b.add(actions({action(m_function(77))}));
  EXPECT_EQ(b.text(), "M77\nM77\n");
  EXPECT_EQ(b.codes(), "TRN-208");
  EXPECT_FALSE(b.diagnostics.has_errors());
}

TEST(SinumerikWords, Corners) {
  ir::Block b = move(MotionKind::linear, {coord(axis::x, Value(1))});
  ir::Corner c;
  c.value = Value(2);
  b.actions.push_back(action(c));
  EXPECT_EQ(line_of(b), "G1 X1 RND=2\n");
  c.kind = ir::CornerKind::chamfer_leg;
  b.actions[0] = action(c);
  EXPECT_EQ(line_of(b), "G1 X1 CHR=2\n");
}

TEST(SinumerikWords, ThreadWithItsLead) {  // 14.3: G33 Z K SF
  ir::Block b = move(MotionKind::thread, {coord(axis::z, Value(-30))});
  auto e = std::make_shared<ir::MotionExtra>();
  e->has_lead = true;
  e->lead = Value(1.5);
  e->lead_axis = axis::z;
  e->has_start_angle = true;
  e->start_angle = Value(180);
  b.motion.extra = e;
  EXPECT_EQ(line_of(b, "sinumerik-lathe"), "G33 Z-30 K1.5 SF=180\n");
}

// A one-shot motion leaves its code in force in the text: the next block must say what the IR has.
TEST(SinumerikWords, TheMotionCodeIsWrittenAgainAfterAOneShot) {
  Build b;
  b.add(move(MotionKind::linear, {coord(axis::x, Value(1))}));
  ir::Block once = move(MotionKind::rapid, {coord(axis::z, Value(5))});
  once.motion.keeps_modal = false;
  b.add(once);
  b.add(move(MotionKind::modal, {coord(axis::x, Value(2))}));
  b.add(move(MotionKind::modal, {coord(axis::x, Value(3))}));
  EXPECT_EQ(b.text(), "G1 X1\nG0 Z5\nG1 X2\nX3\n");
}

}  // namespace
}  // namespace cnctrans::test
