// Offsets and programmable frames (manual 8.2 to 8.6, 11.4, 11.5, 25.1).
#include "tests/backend_fagor/build.h"

namespace cnctrans::test {
namespace {

using ir::FrameCombine;
using ir::FrameKind;
using ir::FrameSlot;
using ir::Value;
namespace axis = ir::axis;

ir::Action shift(FrameCombine combine, std::vector<ir::FrameWord> words) {
  return frame(FrameSlot::shift, FrameKind::translate, combine, std::move(words));
}
ir::Action rotation(FrameCombine combine, double angle, std::vector<ir::FrameWord> words = {}) {
  ir::FrameChange f;
  f.slot = FrameSlot::rotation;
  f.kind = FrameKind::rotate;
  f.combine = combine;
  f.has_angle = combine != FrameCombine::clear;
  f.angle = Value(angle);
  f.words = std::move(words);
  return action(ir::FrameOp{std::make_shared<const ir::FrameChange>(std::move(f))});
}

TEST(FagorFrames, WorkOffsetsStandAlone) {  // 8.3: each alone in its block
  EXPECT_EQ(lines_of(action(ir::WorkOffset{Value(1), false})), "G54\n");
  EXPECT_EQ(lines_of(action(ir::WorkOffset{Value(4), false})), "G57\n");
  EXPECT_EQ(lines_of(action(ir::WorkOffset{Value(5), false})), "G159 N5\n");
  EXPECT_EQ(lines_of(action(ir::WorkOffset{Value(P(100)), false})), "G159 NP100\n");
  EXPECT_EQ(lines_of(action(ir::WorkOffset{Value(), true})), "G53\n");
  EXPECT_EQ(refused(actions({action(ir::WorkOffset{Value(21), false})})), "TRN-202");
  ir::Block b = move(ir::MotionKind::rapid, {coord(axis::x, Value(0))});
  b.actions = {action(ir::WorkOffset{Value(1), false}), action(ir::SpindleRun{1, ir::SpindleState::cw})};
  EXPECT_EQ(lines_of(b), "G54\nG0 X0 M3\n");
}

TEST(FagorFrames, ShiftReplacesNamedAxesOrAll) {  // 8.4
  EXPECT_EQ(lines_of(shift(FrameCombine::replace_named, {frame_word(axis::y, 60), frame_word(axis::x, 100)})),
            "G158 X100 Y60\n");
  EXPECT_EQ(lines_of(shift(FrameCombine::clear, {})), "G158\n");
  // "only this": what is on other axes must go first
  EXPECT_EQ(lines_of(shift(FrameCombine::replace, {frame_word(axis::x, 100)})), "G158\nG158 X100\n");
  EXPECT_EQ(refused(actions({shift(FrameCombine::add, {frame_word(axis::x, 1)})})), "TRN-202");
}

TEST(FagorFrames, ShiftByDistanceModeNeedsTheMode) {
  ir::FrameChange f;
  f.by_distance_mode = true;
  f.words = {frame_word(axis::x, 5)};
  const auto op = action(ir::FrameOp{std::make_shared<const ir::FrameChange>(f)});
  Build b;
  b.add(actions({set(ir::Setting::distance, ir::Distance::absolute)}));
  b.add(actions({op}));
  EXPECT_EQ(b.lines(), "G90\nG158 X5\n");
}

TEST(FagorFrames, RotationsAddUpSoOneThatReplacesEndsThemFirst) {  // 25.1
  EXPECT_EQ(lines_of(rotation(FrameCombine::replace, 30)), "G73\nG73 Q30\n");
  EXPECT_EQ(lines_of(rotation(FrameCombine::add, 30)), "G73 Q30\n");
  EXPECT_EQ(lines_of(rotation(FrameCombine::clear, 0)), "G73\n");
  Build b;
  b.add(actions({set(ir::Setting::plane, ir::Plane::zx)}));
  b.add(actions({rotation(FrameCombine::add, 30, {frame_word(axis::x, 1), frame_word(axis::z, 2)})}));
  EXPECT_EQ(b.lines(), "G18\nG73 Q30 I2 J1\n");  // I is the abscissa, Z in G18
  EXPECT_EQ(refused(actions({rotation(FrameCombine::add, 30)}), "fagor-lathe"), "TRN-202");
}

TEST(FagorFrames, TwoBlocksCannotEndARepeatedRange) {
  Build b;
  b.add(move(ir::MotionKind::rapid, {coord(axis::x, Value(0))})).line.number = "10";
  b.add(actions({rotation(FrameCombine::replace, 30)})).line.number = "20";
  ir::Repeat r;
  r.first = block_number("10");
  r.last = block_number("20");
  b.add(r);
  (void)b.text();
  EXPECT_EQ(b.codes(), "TRN-202");
}

TEST(FagorFrames, MirrorAndScale) {  // 11.4, 11.5
  const auto mirror = [](FrameCombine c, std::vector<ir::FrameWord> w) {
    return frame(FrameSlot::mirror, FrameKind::mirror, c, std::move(w));
  };
  EXPECT_EQ(lines_of(mirror(FrameCombine::replace_named, {frame_word(axis::x, 1)})), "G11\n");
  EXPECT_EQ(lines_of(mirror(FrameCombine::replace, {frame_word(axis::y, 1), frame_word(axis::x, 1)})),
            "G10\nG11 G12\n");
  EXPECT_EQ(lines_of(mirror(FrameCombine::replace, {frame_word(axis::y, 0)})), "G10\n");
  EXPECT_EQ(lines_of(mirror(FrameCombine::clear, {})), "G10\n");
  EXPECT_EQ(refused(actions({mirror(FrameCombine::replace_named, {frame_word(axis::x, 0)})})), "TRN-202");
  ir::FrameChange f;
  f.slot = FrameSlot::scale;
  f.kind = FrameKind::scale;
  f.uniform_scale = true;
  f.words = {frame_word(axis::x, 2)};
  EXPECT_EQ(lines_of(action(ir::FrameOp{std::make_shared<const ir::FrameChange>(f)})), "G72 S2\n");
  f.uniform_scale = false;
  EXPECT_EQ(refused(actions({action(ir::FrameOp{std::make_shared<const ir::FrameChange>(f)})})), "TRN-202");
  f.combine = FrameCombine::clear;
  EXPECT_EQ(lines_of(action(ir::FrameOp{std::make_shared<const ir::FrameChange>(f)})), "G72 S1\n");
}

TEST(FagorFrames, PresetAndItsEndByAWorkOffset) {  // 8.5: G54 ends G92
  EXPECT_EQ(lines_of(frame(FrameSlot::preset, FrameKind::translate, FrameCombine::preset, {frame_word(axis::x, 10)})),
            "G92 X10\n");
  const auto end = frame(FrameSlot::preset, FrameKind::translate, FrameCombine::clear, {});
  EXPECT_EQ(lines_of(actions({action(ir::WorkOffset{Value(1), false}), end})), "G54\n");
  Build split;
  split.add(actions({action(ir::WorkOffset{Value(1), false})}));
  split.add(actions({end}));
  EXPECT_EQ(split.lines(), "G54\n");
  EXPECT_EQ(split.codes(), "");
  EXPECT_EQ(refused(actions({end})), "TRN-202");
}

TEST(FagorFrames, PoleByAbscissaAndOrdinate) {  // 8.6
  ir::FrameChange at;
  at.words = {frame_word(axis::x, 90), frame_word(axis::z, 60)};
  Build b("fagor-lathe");
  b.add(actions({set(ir::Setting::plane, ir::Plane::zx)}));
  b.add(actions({action(ir::PoleSet{std::make_shared<const ir::FrameChange>(at)})}));
  b.add(actions({action(ir::PoleSet{std::make_shared<const ir::FrameChange>(ir::FrameChange{})})}));
  b.add(actions({action(ir::PoleSet{})}));  // the present point
  EXPECT_EQ(b.lines(), "G18\nG93 I60 J90\nG93 I0 J0\nG93\n");
}

TEST(FagorFrames, WordsThatAreRadiusOrDiameterByThemselvesFollowTheMode) {  // 6.4
  Build b("fagor-lathe");
  b.add(actions({set(ir::Setting::diameter, ir::DiameterMode::diameter)}));
  b.add(actions(
      {shift(FrameCombine::replace_named, {frame_word(axis::x, 5, ir::WordScale::radius), frame_word(axis::z, 3)})}));
  EXPECT_EQ(b.lines(), "G151\nG158 X10 Z3\n");
}

}  // namespace
}  // namespace cnctrans::test
