// In a world nothing coincides.
#include "machine/world.h"
#include "dialects/options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace cnctrans::test {
namespace {

TEST(World, EveryPlaceIsAnother) {
  const machine::World world;
  std::set<double> places{0};
  std::size_t count = 1;
  const auto add = [&](double place) {
    places.insert(place);
    ++count;
    EXPECT_EQ(std::fmod(std::abs(std::round(place * 1000)), 2), 1) << place;  // of thousandths, an odd number
  };
  for (ir::AxisId a = 0; a < 9; ++a) {
    machine::AxisSpec axis;
    axis.id = a;
    add(world.start(axis));
    add(world.reference_point(a));
    for (std::size_t n = 1; n <= 4; ++n) add(world.fixed_point(n, a));
    for (std::int32_t row = 0; row < 20; ++row) add(world.work_offset(row, a));
  }
  EXPECT_EQ(places.size(), count);
}

TEST(World, WhatCorrespondsIsTheSameOnEveryMachine) {
  const machine::World world;
  std::string error;
  const auto mill = dialects::load_profile("num-mill", &error), lathe = dialects::load_profile("fagor-lathe", &error);
  ASSERT_TRUE(mill && lathe) << error;
  const auto a = machine::put_into(world, *mill), b = machine::put_into(world, *lathe);
  EXPECT_EQ(a.axis(ir::axis::x)->start, b.axis(ir::axis::x)->start);
  EXPECT_EQ(a.axis(ir::axis::z)->reference_point, b.axis(ir::axis::z)->reference_point);
  EXPECT_EQ(a.work_offsets.at(3).at(ir::axis::z), b.work_offsets.at(3).at(ir::axis::z));
  EXPECT_NE(a.work_offsets.at(3).at(ir::axis::z), a.work_offsets.at(4).at(ir::axis::z));
}

TEST(World, BothBeginWithTheZeroPointThatPowerOnSelects) {
  std::string error;
  const auto none = dialects::load_profile("sinumerik-mill", &error),
             first = dialects::load_profile("num-mill", &error);
  ASSERT_TRUE(none && first) << error;
  EXPECT_EQ(machine::world_for(*none, *first).start_row, 1);
  EXPECT_EQ(machine::world_for(*first, *none).start_row, 1);
  EXPECT_EQ(machine::world_for(*none, *none).start_row, 0);
}

}  // namespace
}  // namespace cnctrans::test
