// What no program says of its machine: where it stands at the start, where its zero points and reference points are,
// how long its tools are. On the machine of a profile most of that is 0, so that things coincide which do not on a real
// one: work zero, machine zero and reference point, one offset and the next. In a world every one of them is another
// odd value, and it is the same on every machine that is put there: what corresponds stays equal, nothing else does.
#pragma once

#include <cstdint>
#include <map>

#include "machine/profile.h"

namespace cnctrans::machine {

struct World {
  /// All machines begin with the zero point of this row of work offsets in force; 0: with one of its own, which nothing
  /// selects.
  std::int32_t start_row = 0;
  /// They stand there at the start; else at a place of its own (but for the rotary axes, whose turns count from there).
  bool stands_at_zero = false;
  /// Zero points and reference points are elsewhere; else where the profiles have them.
  bool zeros = true, reference_points = true;

  // Lengths in mm (radius), angles in degrees.
  [[nodiscard]] double start(const AxisSpec& axis) const;
  [[nodiscard]] double reference_point(ir::AxisId axis) const;
  [[nodiscard]] double fixed_point(std::size_t number, ir::AxisId axis) const;  ///< from 1
  [[nodiscard]] double work_offset(std::int32_t row, ir::AxisId axis) const;
  [[nodiscard]] double tool_length(double row, ir::AxisId axis) const;  ///< of a row of the tool table
  [[nodiscard]] double tool_radius(double row) const;
  /// The zero point at the start.
  [[nodiscard]] std::map<ir::AxisId, double> start_offset(const Profile& machine) const;
};

/// A world for a program and its translation: both begin with the zero point that power-on selects, on the source's
/// machine or else on the target's.
World world_for(const Profile& source, const Profile& target);

/// The machine in this world. Tools stay as they are: their data are asked of the world.
Profile put_into(const World& world, const Profile& machine);

}  // namespace cnctrans::machine
