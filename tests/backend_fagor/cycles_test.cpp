// Hole cycles of the mill model (manual 25.2, 25.3): written natively only when their moves are those of the neutral
// cycle.
#include "backends/fagor/cycles.h"

#include "tests/backend_fagor/build.h"

namespace cnctrans::test {
namespace {

using ir::HoleKind;
using ir::LevelBase;
using ir::PeckLaw;
using ir::Value;
namespace axis = ir::axis;

/// Reference plane 2, bottom -18, both absolute.
ir::HoleCycle drill() {
  ir::HoleCycle c;
  c.reference = level(2);
  c.bottom = level(-18);
  return c;
}
ir::CyclePtr cycle(const ir::HoleCycle& c) {
  return std::make_shared<const ir::Cycle>(ir::Cycle{c});
}
bool native(const ir::HoleCycle& c) {
  return backends::fagor::native_cycle(*cycle(c));
}

ir::Action define(const ir::HoleCycle& c, bool modal = true) {
  ir::CycleDefine d;
  d.cycle = cycle(c);
  d.modal = modal;
  return action(d, ir::Order::after);
}

/// In the XY plane and absolute mode, after a move to Z20.
std::string written(ir::Block b, std::string* codes = nullptr) {
  Build p;
  p.add(actions({set(ir::Setting::plane, ir::Plane::xy), set(ir::Setting::distance, ir::Distance::absolute),
                 set(ir::Setting::units, ir::Units::metric),
                 set(ir::Setting::retract_plane, ir::RetractPlane::initial)}));
  p.add(move(ir::MotionKind::rapid, {coord(axis::z, Value(20))}));
  p.add(std::move(b));
  std::string text = p.lines();
  if (codes != nullptr) {
    *codes = p.codes();
  } else {
    EXPECT_EQ(p.codes(), "") << text;
  }
  const std::string start = "G17 G90 G71 G98\nG0 Z20\n";
  EXPECT_EQ(text.substr(0, start.size()), start);
  return text.substr(start.size());
}

TEST(FagorCycles, DrillingWithPointAndDwell) {
  ir::Block b = move(ir::MotionKind::rapid, {coord(axis::x, Value(10)), coord(axis::y, Value(24))});
  b.motion.explicit_code = false;
  b.actions = {define(drill())};
  EXPECT_EQ(written(b), "G81 G98 X10 Y24 Z2 I-18\n");
  b.actions[0].order = ir::Order::before;  // defined first or last: it runs at the point
  EXPECT_EQ(written(b), "G81 G98 X10 Y24 Z2 I-18\n");
  ir::HoleCycle c = drill();
  c.dwell_bottom = Value(0.3);
  b.actions = {set(ir::Setting::retract_plane, ir::RetractPlane::reference), define(c)};
  EXPECT_EQ(written(b), "G82 G99 X10 Y24 Z2 I-18 K30\n");
}

TEST(FagorCycles, ParametersInTheWords) {
  ir::HoleCycle c = drill();
  c.bottom.value = Value(P(2));
  EXPECT_EQ(written(actions({define(c)})), "G81 G98 Z2 IP2\n");
}

TEST(FagorCycles, OneHoleOnlyIsEndedAtOnce) {
  EXPECT_EQ(written(actions({define(drill(), false)})), "G81 G98 Z2 I-18\nG80\n");
  EXPECT_EQ(written(actions({action(ir::CycleCancel{})})), "G80\n");
}

TEST(FagorCycles, LevelsFromSurfaceAndReference) {  // 22.2: the R plane is surface + distance
  ir::HoleCycle c = drill();
  c.surface = level(0);
  c.reference = level(2, LevelBase::from_surface);
  EXPECT_EQ(written(actions({define(c)})), "G81 G98 Z2 I-18\n");
  c.bottom = level(-20, LevelBase::from_reference);
  EXPECT_EQ(written(actions({define(c)})), "G81 G98 Z2 I-18\n");
  c.surface = {};
  EXPECT_FALSE(native(c));
}

TEST(FagorCycles, RetractPlaneIsTheHeightBeforeTheCycle) {  // G98 returns to where the tool stood
  ir::HoleCycle c = drill();
  c.retract = level(20);
  EXPECT_EQ(written(actions({define(c)})), "G81 G98 Z2 I-18\n");
  c.retract = level(2);
  EXPECT_EQ(written(actions({define(c)})), "G81 G99 Z2 I-18\n");
  c.retract = level(10);  // below the tool: a stop on the way down changes nothing
  EXPECT_EQ(written(actions({define(c)})), "G0 Z10\nG81 G98 Z2 I-18\n");
  c.retract = level(50);
  std::string codes;
  EXPECT_EQ(written(actions({define(c)}), &codes), "G0 Z50\nG81 G98 Z2 I-18\n");
  EXPECT_EQ(codes, "TRN-243");
}

TEST(FagorCycles, EqualPecksAreG83) {  // 25.3: I one peck with sign, J their number; feeds again 1 mm above
  ir::HoleCycle c = drill();
  c.kind = HoleKind::peck_full;
  c.pecks.law = PeckLaw::constant;
  c.pecks.first = Value(5);
  c.pecks.reapproach = Value(1);
  EXPECT_EQ(written(actions({define(c)})), "G83 G98 Z2 I-5 J4\n");
  c.pecks.first = Value(6);  // 6+6+6+2
  EXPECT_EQ(written(actions({define(c)})), "G69 G98 Z2 I-18 B6\n");
  c.pecks.first = Value(5);
  c.pecks.reapproach = Value(0.6);
  EXPECT_EQ(written(actions({define(c)})), "G69 G98 Z2 I-18 B5 C0.6\n");
  c.pecks.reapproach = Value(1);
  c.pecks.law = PeckLaw::count;
  c.pecks.first = Value(-5);
  c.pecks.count = Value(P(3));
  c.bottom = {};
  EXPECT_EQ(written(actions({define(c)})), "G83 G98 Z2 I-5 JP3\n");
}

TEST(FagorCycles, WhatHasOtherMovesIsNotNative) {
  const auto with = [](auto change) {
    ir::HoleCycle c = drill();
    change(c);
    return native(c);
  };
  EXPECT_TRUE(with([](ir::HoleCycle&) {}));
  EXPECT_FALSE(with([](ir::HoleCycle& c) { c.kind = HoleKind::peck_break; }));
  EXPECT_TRUE(with([](ir::HoleCycle& c) { c.kind = HoleKind::ream; }));
  EXPECT_FALSE(with([](ir::HoleCycle& c) { c.kind = HoleKind::bore_shift; }));
  EXPECT_FALSE(with([](ir::HoleCycle& c) { c.has_feed = true; }));
  EXPECT_FALSE(with([](ir::HoleCycle& c) { c.has_feed_out = true; }));
  EXPECT_FALSE(with([](ir::HoleCycle& c) { c.dwell_top = Value(1); }));
  EXPECT_FALSE(with([](ir::HoleCycle& c) { c.dwell_in_revolutions = true; }));
  EXPECT_FALSE(with([](ir::HoleCycle& c) { c.axis = axis::x; }));
  EXPECT_FALSE(with([](ir::HoleCycle& c) { c.approach_by_retract = true; }));
  EXPECT_FALSE(with([](ir::HoleCycle& c) { c.bottom.given = false; }));
  EXPECT_FALSE(with([](ir::HoleCycle& c) { c.retract = level(5, LevelBase::from_initial); }));
}

TEST(FagorCycles, AbsoluteLevelsNeedAbsoluteMode) {
  Build b;
  b.add(actions({set(ir::Setting::plane, ir::Plane::xy), set(ir::Setting::distance, ir::Distance::incremental)}));
  b.add(actions({define(drill())}));
  (void)b.text();
  EXPECT_EQ(b.codes(), "TRN-214");
}

TEST(FagorCycles, TheLatheHasNoHoles) {
  const auto backend = backends::fagor::make_backend();
  const auto& native = backend->capabilities_for(profile_of("fagor-lathe")).native_cycle;
  EXPECT_FALSE(native(ir::Cycle{drill()}));
  EXPECT_TRUE(native(ir::Cycle{ir::NamedCycle{"turn.thread", {{"x", ir::Value(40)}}}}));
  EXPECT_FALSE(native(ir::Cycle{ir::NamedCycle{"turn.profile", {{"first_label", ir::Value(100)}}}}));
  EXPECT_EQ(refused(actions({define(drill())}), "fagor-lathe"), "TRN-214");
}

TEST(FagorCycles, TheToolAxisNamesTheReferenceWord) {
  Build b;
  b.add(actions({set(ir::Setting::plane, ir::Plane::yz), set(ir::Setting::distance, ir::Distance::absolute)}));
  b.add(actions({set(ir::Setting::retract_plane, ir::RetractPlane::initial), define(drill())}));
  EXPECT_EQ(b.lines(), "G19 G90\nG81 G98 X2 I-18\n");
}

}  // namespace
}  // namespace cnctrans::test
