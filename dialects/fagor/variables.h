// Variables of the control (§11.2): mnemonic, index, access, and the machine datum they are in the IR.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "ir/axis.h"
#include "ir/expr.h"

namespace cnctrans::dialects::fagor {

enum class Index : std::uint8_t { none, maybe, always };
enum class Access : std::uint8_t { none, read, write, read_write };  ///< from the part program

/// What its value is counted in. Lengths and feeds follow G70/G71, coordinates of X also diameter programming.
enum class Unit : std::uint8_t {
  none,
  length,
  angle,  ///< degrees (NOSEA, CUTA: 1/10000)
  feed,
  feed_per_rev,
  inverse_time,
  percent,
  rpm,
  cutting_speed,  ///< m/min or feet/min
  time,           ///< seconds; CYTIME 1/100 s, TIME hhmmss
  volts,
  temperature
};

struct VariableInfo {
  std::string_view name;  ///< without axis letter and index
  bool axis = false;      ///< one of X Y Z U V W A B C follows
  Index index = Index::none;
  Access access = Access::read;
  bool stops_preparation = false;
  ir::Datum datum = ir::Datum::other;
  Unit unit = Unit::none;
  ir::Type type = ir::Type::integer;  ///< of its values; bit patterns are integers
};
std::span<const VariableInfo> variables();

struct VariableName {
  const VariableInfo* info = nullptr;  ///< null: no variable of the manual
  ir::AxisId axis = ir::axis::none;
};
std::string_view name(Unit u);
/// `name` in capitals with its axis letter, without its index: "ORGX", "PLCM".
VariableName find_variable(std::string_view name);

/// Rows of the zero offset table by number as in ORGXn: 54..59 are G54..G59; 1..20 are G159 N1..N20. 0: no such row.
/// Rows 1..4 are G54..G57, 5 and 6 the rows of G58 and G59.
inline constexpr int offset_row(int n) {
  if (n >= 54 && n <= 59) return n - 53;
  return n >= 1 && n <= 20 ? n : 0;
}

}  // namespace cnctrans::dialects::fagor
