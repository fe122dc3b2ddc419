#include "machine/world.h"

namespace cnctrans::machine {

namespace {

enum class Thing : std::uint64_t { start, reference, fixed_point, work_offset, tool_length, tool_radius };

constexpr std::int32_t rows = 99;        ///< of work offsets, as many as the largest table of a control has
constexpr std::size_t fixed_points = 4;  ///< at least
constexpr double thousand = 1000;

/// A number of its own for each thing, from 0 up to `count`: SplitMix64.
std::uint64_t scattered(Thing thing, std::uint64_t number, std::uint64_t axis, std::uint64_t count) {
  std::uint64_t x = ((static_cast<std::uint64_t>(thing) << 48U) | (axis << 40U) | number) + 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return (x ^ (x >> 31U)) % count;
}

/// Three decimals, the last one odd: between `from` and from + range.
double odd(Thing thing, std::uint64_t number, std::uint64_t axis, double from, std::uint64_t range) {
  const auto steps = scattered(thing, number, axis, range * 500);
  return from + static_cast<double>(2 * steps + 1) / thousand;
}

}  // namespace

double World::start(const AxisSpec& axis) const {
  if (!stands_at_zero && !axis.rotary) return odd(Thing::start, 0, axis.id, 150, 100);
  return zeros ? work_offset(start_row, axis.id) : axis.start;
}
double World::reference_point(ir::AxisId axis) const {
  return odd(Thing::reference, 0, axis, 260, 100);
}
double World::fixed_point(std::size_t number, ir::AxisId axis) const {
  return odd(Thing::fixed_point, number, axis, 370, 300);
}
double World::work_offset(std::int32_t row, ir::AxisId axis) const {
  return odd(Thing::work_offset, static_cast<std::uint64_t>(row), axis, -140, 280);
}
double World::tool_length(double row, ir::AxisId axis) const {
  return odd(Thing::tool_length, static_cast<std::uint64_t>(row), axis, 20, 100);
}
double World::tool_radius(double row) const {
  return odd(Thing::tool_radius, static_cast<std::uint64_t>(row), 0, 1, 8);
}

std::map<ir::AxisId, double> World::start_offset(const Profile& machine) const {
  std::map<ir::AxisId, double> offset;
  for (const auto& a : machine.axes) offset[a.id] = work_offset(start_row, a.id);
  return offset;
}

World world_for(const Profile& source, const Profile& target) {
  World world;
  const std::int32_t row = source.power_on.work_offset;
  world.start_row = row != 0 ? row : target.power_on.work_offset;
  return world;
}

Profile put_into(const World& world, const Profile& machine) {
  Profile there = machine;
  for (auto& a : there.axes) {
    a.start = world.start(a);
    if (!world.reference_points) continue;  // where the target has no words for such points
    a.reference_point = world.reference_point(a.id);
    if (a.fixed_points.size() < fixed_points) a.fixed_points.resize(fixed_points);
    for (std::size_t n = 0; n < a.fixed_points.size(); ++n) a.fixed_points[n] = world.fixed_point(n + 1, a.id);
  }
  if (!world.zeros) return there;
  there.work_offsets.clear();
  for (std::int32_t row = 1; row <= rows; ++row) {
    auto& offset = there.work_offsets[row];
    for (const auto& a : there.axes) offset[a.id] = world.work_offset(row, a.id);
  }
  return there;
}

}  // namespace cnctrans::machine
