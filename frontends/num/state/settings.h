// What the reader needs of a machine profile, looked up once: options, axes, the meaning of every M function.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "dialects/num/assumed_cycles.h"
#include "dialects/num/options.h"
#include "ir/block.h"
#include "machine/profile.h"

namespace cnctrans::frontends::num {

struct MEntry {
  machine::MMeaning meaning = machine::MMeaning::machine_function;
  ir::Order order = ir::Order::before;
  std::int16_t argument = 0;
  bool known = false;
};

struct Settings {
  bool lathe = false;
  dialects::num::Options options;
  bool structured = true;          ///< 10xx and later: IF, WHILE, VAR
  bool centre_absolute = true;     ///< I J K absolute under G90
  bool range_by_position = false;  ///< which of the two blocks of a range comes first
  bool stop_ends_spindle = false;  ///< M00 stops the spindle (3.2.1)
  bool face_radius = true;         ///< X of G21 is a radius
  dialects::num::CycleHabits chased, reentrant, plunged_by_p, plunged_by_r;
  double units_per_mm = 1000, units_per_degree = 10000;  ///< of E parameters
  std::uint32_t axes = 0;                                ///< bit n: the machine has axis n
  std::uint32_t modulo = 0;                              ///< bit n: the sign of an absolute value is a direction
  ir::ModalState power_on;
  std::array<MEntry, 1000> m{};
  std::map<std::int64_t, std::int64_t> m_programs;  ///< M functions that call a program of the machine (13.6)
  std::string bad_m_programs;                       ///< what of num.m_programs can't be read
};

Settings make_settings(const machine::Profile& profile);

}  // namespace cnctrans::frontends::num
