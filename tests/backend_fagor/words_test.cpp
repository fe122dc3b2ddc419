// Word blocks of programs from other languages: what each word must be on the control (manual ch. 5, 6, 9, 10, 25.1).
#include "tests/backend_fagor/build.h"

namespace cnctrans::test {
namespace {

using ir::MotionKind;
using ir::Value;
namespace axis = ir::axis;

TEST(FagorWords, OrderIsGThenAxesThenFSTDM) {  // 2.4: the control reports any other order
  ir::Block b = move(MotionKind::linear, {coord(axis::z, Value(5)), coord(axis::x, Value(1))});
  b.actions = {action(ir::SpindleRun{1, ir::SpindleState::cw}), action(ir::ToolOffset{Value(2)}),
               action(ir::ToolSelect{Value(1), {}, false}),     action(ir::SetSpindle{1, Value(800)}),
               action(ir::SetFeed{Value(200), false}),          set(ir::Setting::distance, ir::Distance::absolute)};
  std::uint32_t column = 90;  // places of the source must not count
  for (auto& a : b.actions) a.pos = {column--, 1};
  EXPECT_EQ(lines_of(b), "G90 G1 X1 Z5 F200 S800 T1 D2 M3\n");
}

TEST(FagorWords, NumbersHaveFourDecimalsInMillimetresAndFiveInInches) {  // 2.2
  Build mm;
  mm.add(
      move(MotionKind::linear, {coord(axis::x, Value(10.5, "10.500")), coord(axis::y, Value(0.123456, "0.123456"))}));
  EXPECT_EQ(mm.lines(), "G1 X10.500 Y0.1235\n");
  EXPECT_EQ(mm.codes(), "TRN-210");
  Build inch;
  inch.add(actions({set(ir::Setting::units, ir::Units::inch)}));
  inch.add(move(MotionKind::linear, {coord(axis::y, Value(0.12345, "0.12345"))}));
  EXPECT_EQ(inch.lines(), "G70\nG1 Y0.12345\n");
  EXPECT_EQ(inch.codes(), "");
}

TEST(FagorWords, AValueIsANumberOrOneParameterWithASign) {  // ch. 4, 25.10
  EXPECT_EQ(lines_of(move(MotionKind::rapid, {coord(axis::x, Value(P(100))), coord(axis::y, Value(minus(P(3))))})),
            "G0 XP100 Y-P3\n");
  EXPECT_EQ(refused(move(MotionKind::rapid, {coord(axis::x, Value(op(ir::BinaryOp::add, P(1), num(2))))})), "TRN-203");
}

TEST(FagorWords, Settings) {
  const auto mill = actions(
      {set(ir::Setting::plane, ir::Plane::xy), set(ir::Setting::comp, ir::CompSide::off),
       set(ir::Setting::path_mode, ir::PathMode::continuous), set(ir::Setting::units, ir::Units::metric),
       set(ir::Setting::distance, ir::Distance::absolute), set(ir::Setting::feed_mode, ir::FeedMode::per_minute)});
  EXPECT_EQ(lines_of(mill), "G17 G40 G05 G71 G90 G94\n");
  EXPECT_EQ(lines_of(set(ir::Setting::path_mode, ir::PathMode::exact_stop)), "G07\n");
  EXPECT_EQ(lines_of(set(ir::Setting::feed_mode, ir::FeedMode::inverse_time)), "G32\n");
  EXPECT_EQ(lines_of(set(ir::Setting::length_comp, ir::OnOff::on)), "G43\n");
}

TEST(FagorWords, TheSameNumberMeansSomethingElseOnLatheAndMill) {  // pitfall 1: G96, G97
  EXPECT_EQ(lines_of(set(ir::Setting::spindle_mode, ir::SpindleMode::css), "fagor-lathe"), "G96\n");
  EXPECT_EQ(lines_of(set(ir::Setting::feed_point, ir::FeedPoint::contact), "fagor-mill"), "G96\n");
  EXPECT_EQ(lines_of(set(ir::Setting::spindle_mode, ir::SpindleMode::rpm), "fagor-mill"), "");  // always so
  EXPECT_EQ(refused(actions({set(ir::Setting::spindle_mode, ir::SpindleMode::css)}), "fagor-mill"), "TRN-202");
  EXPECT_EQ(lines_of(set(ir::Setting::length_comp, ir::OnOff::on), "fagor-lathe"), "");
  EXPECT_EQ(refused(actions({set(ir::Setting::diameter, ir::DiameterMode::diameter)}), "fagor-mill"), "TRN-202");
}

TEST(FagorWords, DiameterActsOnTheBlocksThatFollow) {  // erratum to 6.4
  ir::Block b = move(MotionKind::linear, {coord(axis::x, Value(20))});
  b.actions = {set(ir::Setting::diameter, ir::DiameterMode::radius)};
  EXPECT_EQ(lines_of(b, "fagor-lathe"), "G152\nG1 X20\n");
  b.actions = {set(ir::Setting::diameter, ir::DiameterMode::radius, ir::Order::after)};
  EXPECT_EQ(lines_of(b, "fagor-lathe"), "G152 G1 X20\n");
}

TEST(FagorWords, FeedOfZeroIsNeverWritten) {  // 9.1: F0 is the greatest feed
  EXPECT_EQ(refused(actions({action(ir::SetFeed{Value(0), false})})), "TRN-202");
  EXPECT_EQ(lines_of(action(ir::SetFeed{Value(0), true})), "F0\n");
}

TEST(FagorWords, MFunctionsKeepTheirSideOfTheMotion) {  // 9.4: M5 after, M8 before
  ir::Block b = move(MotionKind::linear, {coord(axis::x, Value(1))});
  b.actions = {action(ir::SpindleRun{1, ir::SpindleState::off})};
  EXPECT_EQ(lines_of(b), "M5\nG1 X1\n");
  b.actions = {action(ir::SpindleRun{1, ir::SpindleState::off}, ir::Order::after)};
  EXPECT_EQ(lines_of(b), "G1 X1 M5\n");
  b.actions = {action(ir::Coolant{ir::CoolantState::flood}, ir::Order::after)};
  EXPECT_EQ(lines_of(b), "G1 X1\nM8\n");
}

TEST(FagorWords, SpindleLimitOrientationAndGear) {
  EXPECT_EQ(lines_of(action(ir::SpindleLimit{1, Value(2500), false})), "G92 S2500\n");
  EXPECT_EQ(lines_of(action(ir::SpindleOrient{1, Value(-30)})), "S-30 M19\n");
  EXPECT_EQ(lines_of(action(ir::SpindleOrient{1, Value(0)})), "M19\n");
  EXPECT_EQ(lines_of(action(ir::SpindleGear{1, 3, false})), "M43\n");
  EXPECT_EQ(refused(actions({action(ir::SpindleGear{1, 5, false})})), "TRN-202");
}

TEST(FagorWords, ToolsByTheMachinesWayOfChange) {  // 9.3
  EXPECT_EQ(lines_of(action(ir::ToolSelect{Value(3), {}, false}), "fagor-mill"), "T3\n");
  EXPECT_EQ(lines_of(action(ir::ToolSelect{Value(3), {}, true}), "fagor-mill"), "T3 M6\n");
  EXPECT_EQ(lines_of(action(ir::ToolSelect{Value(3), {}, true}), "fagor-lathe"), "T3\n");
  EXPECT_EQ(refused(actions({action(ir::ToolSelect{Value(3), {}, false})}), "fagor-lathe"), "TRN-202");
  EXPECT_EQ(refused(actions({action(ir::ToolSelect{Value(), "DRILL", false})})), "TRN-202");
}

TEST(FagorWords, DwellIsInHundredthsOfASecondAndNeverZero) {  // 11.1
  EXPECT_EQ(lines_of(action(ir::Dwell{Value(2.5), 1, false})), "G04 K250\n");
  EXPECT_EQ(lines_of(action(ir::Dwell{Value(30), 0.01, false})), "G04 K30\n");
  EXPECT_EQ(lines_of(action(ir::Dwell{Value(P(5)), 0.01, false})), "G04 KP5\n");
  EXPECT_EQ(lines_of(action(ir::Dwell{Value(0), 1, false})), "");
  EXPECT_EQ(refused(actions({action(ir::Dwell{Value(P(5)), 1, false})})), "TRN-203");
  EXPECT_EQ(refused(actions({action(ir::Dwell{Value(3), 1, true})})), "TRN-202");
  EXPECT_EQ(lines_of(action(ir::PreparationStop{})), "G04\n");
  ir::Block b = move(MotionKind::linear, {coord(axis::x, Value(1))});
  b.actions = {action(ir::Dwell{Value(1), 1, false})};
  EXPECT_EQ(lines_of(b), "G04 K100\nG1 X1\n");
}

TEST(FagorWords, ArcsByCentreFromTheStartAbsoluteAndRadius) {  // 10.3, 10.4
  ir::Block b = move(MotionKind::arc_cw, {coord(axis::x, Value(10)), coord(axis::y, Value(0))});
  b.motion.centers = {center(axis::y, Value(-5)), center(axis::x, Value(5))};
  EXPECT_EQ(lines_of(b), "G2 X10 Y0 I5 J-5\n");
  b.motion.centers = {center(axis::x, Value(42), ir::CenterMode::absolute),
                      center(axis::y, Value(0), ir::CenterMode::absolute)};
  EXPECT_EQ(lines_of(b), "G6 G2 X10 Y0 I42 J0\n");
  b.motion.centers[1].mode = ir::CenterMode::from_start;
  EXPECT_EQ(refused(b), "TRN-202");  // G6 holds for both
  b.motion.centers.clear();
  b.motion.radius_given = true;
  b.motion.radius = Value(-25);
  EXPECT_EQ(lines_of(b), "G2 X10 Y0 R-25\n");
}

TEST(FagorWords, CentreThatFollowsTheDistanceModeIsWrittenByTheModeInForce) {
  ir::Block b = move(MotionKind::arc_ccw, {coord(axis::x, Value(10)), coord(axis::y, Value(0))});
  b.motion.centers = {center(axis::x, Value(5), ir::CenterMode::follows_distance),
                      center(axis::y, Value(1), ir::CenterMode::follows_distance)};
  Build absolute;
  absolute.add(actions({set(ir::Setting::distance, ir::Distance::absolute)}));
  absolute.add(b);
  EXPECT_EQ(absolute.lines(), "G90\nG6 G3 X10 Y0 I5 J1\n");
  Build incremental;
  incremental.add(actions({set(ir::Setting::distance, ir::Distance::incremental)}));
  incremental.add(b);
  EXPECT_EQ(incremental.lines(), "G91\nG3 X10 Y0 I5 J1\n");
}

TEST(FagorWords, CentreOnALatheIsARadiusAndAnAbsoluteOneLikeTheEndPoint) {  // 6.4
  Build b("fagor-lathe");
  b.add(actions({set(ir::Setting::diameter, ir::DiameterMode::diameter)}));
  ir::Block arc = move(MotionKind::arc_cw, {coord(axis::x, Value(40)), coord(axis::z, Value(-5))});
  arc.motion.centers = {center(axis::x, Value(3)), center(axis::z, Value(-5))};
  b.add(arc);
  arc.motion.centers = {center(axis::x, Value(30), ir::CenterMode::absolute),
                        center(axis::z, Value(-5), ir::CenterMode::absolute)};
  arc.motion.centers[0].scale = ir::WordScale::radius;
  b.add(arc);
  EXPECT_EQ(b.lines(), "G151\nG2 X40 Z-5 I3 K-5\nG6 G2 X40 Z-5 I60 K-5\n");
  EXPECT_EQ(b.codes(), "");
}

TEST(FagorWords, HelixWithPitchPolarAndAngle) {  // 10.7, 25.10, 6.6
  ir::Block helix =
      move(MotionKind::arc_cw, {coord(axis::x, Value(0)), coord(axis::y, Value(0)), coord(axis::z, Value(-12))});
  helix.motion.centers = {center(axis::x, Value(-20)), center(axis::y, Value(0))};
  ir::MotionExtra extra;
  extra.has_pitch = true;
  extra.pitch = Value(4);
  helix.motion.extra = std::make_shared<const ir::MotionExtra>(extra);
  EXPECT_EQ(lines_of(helix), "G2 X0 Y0 Z-12 I-20 J0 K4\n");
  ir::Block polar = move(MotionKind::linear, {coord(axis::z, Value(5))});
  ir::MotionExtra at;
  at.has_polar_radius = at.has_polar_angle = true;
  at.polar_radius = Value(40);
  at.polar_angle = Value(60);
  polar.motion.extra = std::make_shared<const ir::MotionExtra>(at);
  EXPECT_EQ(lines_of(polar), "G1 R40 Q60 Z5\n");  // polar words first
  extra.has_pitch = false;
  extra.has_turns = true;
  helix.motion.extra = std::make_shared<const ir::MotionExtra>(extra);
  EXPECT_EQ(refused(helix), "TRN-202");
}

TEST(FagorWords, CornersTakeTheFirstRadius) {  // 10.8: the R after G36 is the corner's
  ir::Block b = move(MotionKind::arc_cw, {coord(axis::x, Value(60)), coord(axis::y, Value(50))});
  b.motion.radius_given = true;
  b.motion.radius = Value(28);
  ir::Corner round;
  round.value = Value(10);
  b.actions = {action(round, ir::Order::with)};
  EXPECT_EQ(lines_of(b), "G36 R10 G2 X60 Y50 R28\n");
  round.kind = ir::CornerKind::chamfer_chord;
  b.actions = {action(round, ir::Order::with)};
  EXPECT_EQ(refused(b), "TRN-202");
}

TEST(FagorWords, MachineCoordinatesWithoutLength) {  // 8.2
  ir::Block b = move(MotionKind::rapid, {coord(axis::z, Value(0))});
  b.motion.frame = ir::FrameUse::machine;
  EXPECT_EQ(lines_of(b), "G53 G0 Z0\n");
  b.motion.frame = ir::FrameUse::machine_with_length;
  EXPECT_EQ(refused(b), "TRN-202");
  b.actions = {action(ir::ToolOffset{Value(0)})};
  EXPECT_EQ(lines_of(b), "G53 G0 Z0 D0\n");  // offset 0 has no length
  Build inch;
  inch.add(actions({set(ir::Setting::units, ir::Units::inch)}));
  b.motion.coords[0].value = Value(2, "2");
  inch.add(b);
  EXPECT_EQ(inch.lines(), "G70\nG53 G0 Z50.8 D0\n");  // in the machine's own unit
}

TEST(FagorWords, DirectionOfARotaryMoveIsItsSign) {  // 6.7
  auto c = coord(axis::c, Value(90));
  c.direction = ir::RotaryDirection::negative;
  Build plain;  // no rollover axis: from 0 back to 90
  plain.add(move(MotionKind::rapid, {c}));
  EXPECT_EQ(plain.lines(), "G0 C-270\n");
  EXPECT_EQ(plain.codes(), "TRN-483");
  const auto on_rollover = [](const ir::Block& b) {
    Build build;
    build.profile.policies.rotary_rollover = true;
    build.add(b);
    return build.lines();
  };
  EXPECT_EQ(on_rollover(move(MotionKind::rapid, {c})), "G0 C-90\n");
  c.direction = ir::RotaryDirection::positive;
  c.value = Value(-90);
  EXPECT_EQ(on_rollover(move(MotionKind::rapid, {c})), "G0 C270\n");
  c.direction = ir::RotaryDirection::shortest;
  EXPECT_EQ(refused(move(MotionKind::rapid, {c})), "TRN-202");
}

TEST(FagorWords, SkipLevels) {  // 2.5
  Build b;
  b.add(move(MotionKind::rapid, {coord(axis::x, Value(1))})).line.skip_mask = 1;
  b.add(move(MotionKind::modal, {coord(axis::x, Value(2))})).line.skip_mask = 4;
  EXPECT_EQ(b.lines(), "/G0 X1\n/3 X2\n");
  b.add(move(MotionKind::modal, {coord(axis::x, Value(3))})).line.skip_mask = 8;
  (void)b.text();
  EXPECT_EQ(b.codes().substr(0, 7), "TRN-201");
}

}  // namespace
}  // namespace cnctrans::test
