// Variables: L ranges (reference 14.1) and E parameters with meaning, unit and access (14.3).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/program.h"

namespace cnctrans::dialects::num {

struct LRange {
  std::int64_t lo, hi;
  bool stops_preparation;  ///< an assignment waits for the end of the block before
  std::string_view title;
};
inline constexpr std::array l_ranges{
    LRange{0, 19, false, "assigned in preparation"},
    LRange{100, 199, true, "assigned when the block before has ended; not under compensation"},
    LRange{900, 959, false, "used by macros and symbols (10xx)"},
};

enum class EMeaning : std::uint8_t {
  user,          ///< memory for programs
  scale_factor,  ///< of G74, thousandths
  pref,
  dec1,
  dec3,
  shift,     ///< of G59
  position,  ///< machine position, live
  tool_length,
  tool_length_z,
  tool_radius,
  active_offset,  ///< number of the corrector in use
  feed_override,
  tool_note,      ///< of the tool table, without effect on the programmed path: memory
  active_radius,  ///< radius of the corrector in use
  slot_switch,    ///< suspends a part of the programmable frame; the index is its ir::FrameSlot
  latched,        ///< position where the last interruptible block ended
  spindle_speed,
  display,  ///< graphics, minimum block time: no effect on the path
  machine   ///< known to the machine only
};
enum class EUnit : std::uint8_t { none, length, axis };  ///< length: micrometre; axis: micrometre, or 1/10000 degree

/// Rows lo..hi in steps of `step`; the axis, or the number in a table, is (number - lo) / step + `first`.
struct EParameter {
  std::int32_t lo, hi;
  std::int32_t step;
  std::int32_t first;
  EMeaning meaning;
  EUnit unit;
  bool writable;
  std::string_view title;
};
constexpr std::int32_t slot(ir::FrameSlot s) {
  return static_cast<std::int32_t>(s);
}
inline constexpr std::array e_parameters{
    EParameter{10000, 10031, 1, 0, EMeaning::machine, EUnit::none, true, "PLC bits out"},
    EParameter{11000, 11000, 1, slot(ir::FrameSlot::rotation), EMeaning::slot_switch, EUnit::none, true, "ED counts"},
    EParameter{11001, 11001, 1, slot(ir::FrameSlot::shift), EMeaning::slot_switch, EUnit::none, true, "G59 counts"},
    EParameter{11002, 11002, 1, 0, EMeaning::machine, EUnit::none, true, "a switch of the control"},
    EParameter{11003, 11003, 1, slot(ir::FrameSlot::mirror), EMeaning::slot_switch, EUnit::none, true, "G51 counts"},
    EParameter{11004, 11004, 1, slot(ir::FrameSlot::scale), EMeaning::slot_switch, EUnit::none, true, "G74 counts"},
    EParameter{11005, 11015, 1, 0, EMeaning::machine, EUnit::none, true, "switches: spindle override, corners"},
    EParameter{20000, 20031, 1, 0, EMeaning::machine, EUnit::none, false, "PLC bits in"},
    EParameter{21000, 21255, 1, 0, EMeaning::machine, EUnit::none, false, "options present"},
    EParameter{30000, 30127, 1, 0, EMeaning::machine, EUnit::none, true, "PLC words out"},
    EParameter{31000, 31001, 1, 0, EMeaning::display, EUnit::none, true, "graphic line types"},
    EParameter{32000, 32000, 1, 0, EMeaning::display, EUnit::none, true, "minimum block time"},
    EParameter{40000, 40127, 1, 0, EMeaning::machine, EUnit::none, false, "PLC words in"},
    EParameter{41000, 41000, 1, 0, EMeaning::machine, EUnit::none, false, "operating mode"},
    EParameter{50000, 50000, 1, 0, EMeaning::active_offset, EUnit::none, false, "active corrector"},
    EParameter{50001, 50255, 1, 1, EMeaning::tool_length, EUnit::length, true, "tool length (X on a lathe)"},
    EParameter{51000, 51000, 1, 0, EMeaning::machine, EUnit::none, false, "active orientation"},
    EParameter{51001, 51255, 1, 1, EMeaning::tool_length_z, EUnit::length, true, "tip radius, lathe: length Z"},
    EParameter{52000, 52000, 1, 0, EMeaning::active_radius, EUnit::length, false, "active radius"},
    EParameter{52001, 52255, 1, 1, EMeaning::tool_radius, EUnit::length, true, "cutter or nose radius"},
    EParameter{53001, 54255, 1, 1, EMeaning::tool_note, EUnit::length, true, "wear"},
    EParameter{55001, 55255, 1, 1, EMeaning::tool_note, EUnit::none, true, "nose orientation"},
    EParameter{56001, 57255, 1, 1, EMeaning::tool_note, EUnit::none, true, "other data of the tool"},
    EParameter{60000, 68000, 1000, 0, EMeaning::pref, EUnit::axis, true, "PREF"},
    EParameter{60001, 68001, 1000, 0, EMeaning::dec1, EUnit::axis, true, "DEC1"},
    EParameter{60002, 68002, 1000, 0, EMeaning::machine, EUnit::axis, true, "travel minimum"},
    EParameter{60003, 68003, 1000, 0, EMeaning::machine, EUnit::axis, true, "travel maximum"},
    EParameter{60004, 68004, 1000, 0, EMeaning::dec3, EUnit::axis, true, "DEC3"},
    EParameter{60005, 68005, 1000, 0, EMeaning::shift, EUnit::axis, true, "G59 shift"},
    EParameter{69000, 69000, 1, 0, EMeaning::scale_factor, EUnit::none, true, "scale factor, thousandths"},
    EParameter{70000, 78000, 1000, 0, EMeaning::position, EUnit::axis, false, "present position"},
    EParameter{70001, 78001, 1000, 0, EMeaning::latched, EUnit::axis, false, "latched position"},
    EParameter{70002, 78002, 1000, 0, EMeaning::machine, EUnit::axis, false, "static travel minimum"},
    EParameter{70003, 78003, 1000, 0, EMeaning::machine, EUnit::axis, false, "static travel maximum"},
    EParameter{70004, 78004, 1000, 0, EMeaning::machine, EUnit::none, false, "direction of movement"},
    EParameter{70005, 78005, 1000, 0, EMeaning::machine, EUnit::none, true, "axis assignment"},
    EParameter{70006, 78006, 1000, 0, EMeaning::machine, EUnit::none, true, "carried axis"},
    EParameter{79000, 79000, 1, 0, EMeaning::machine, EUnit::none, false, "spindle position"},
    EParameter{79001, 79001, 1, 0, EMeaning::spindle_speed, EUnit::none, false, "spindle set speed"},
    EParameter{79002, 79002, 1, 0, EMeaning::feed_override, EUnit::none, false, "feed override"},
    EParameter{79003, 79003, 1, 0, EMeaning::machine, EUnit::none, true, "distance left"},
    EParameter{79004, 79004, 1, 0, EMeaning::machine, EUnit::none, false, "path speed"},
    EParameter{80000, 80050, 1, 0, EMeaning::user, EUnit::none, true, "free for programs"},
    EParameter{81000, 82999, 1, 0, EMeaning::machine, EUnit::none, true, "calibration between axes"},
    EParameter{90000, 99999, 1, 0, EMeaning::machine, EUnit::none, true, "machine data of axes"},
};

inline constexpr std::int64_t e_parameter_max = 99999;
/// The row of a parameter number; nullptr when the control has none.
constexpr const EParameter* e_parameter(std::int64_t number) {
  for (const auto& p : e_parameters) {
    if (number >= p.lo && number <= p.hi && (number - p.lo) % p.step == 0) return &p;
  }
  return nullptr;
}
constexpr std::int64_t e_index(const EParameter& p, std::int64_t number) {
  return (number - p.lo) / p.step + p.first;
}

constexpr const LRange* l_range(std::int64_t number) {
  for (const auto& r : l_ranges) {
    if (number >= r.lo && number <= r.hi) return &r;
  }
  return nullptr;
}

/// L900 to L951 are the words beside a macro, in the order A to Z, EA to EZ (13.7).
inline constexpr std::int64_t first_argument = 900, last_argument = 951;
/// Under their names in the macro: 'A to 'Z, 'EA to 'EZ.
constexpr std::optional<std::int64_t> argument_variable(std::string_view name) {
  const bool extended = name.size() == 3 && (name[1] == 'E' || name[1] == 'e');
  if (name.empty() || name[0] != '\'' || (name.size() != 2 && !extended)) return std::nullopt;
  const char letter = name.back() >= 'a' ? static_cast<char>(name.back() - 'a' + 'A') : name.back();
  if (letter < 'A' || letter > 'Z') return std::nullopt;
  return first_argument + (letter - 'A') + (extended ? 26 : 0);
}

/// System units in a millimetre and in a degree.
inline constexpr double units_per_mm = 1000, units_per_degree = 10000;
/// The one settable offset row of a NUM; PREF, DEC1 and DEC3 add up in it.
inline constexpr int offset_row = 1;

/// Machine datum: not 0 when the last interruptible block (G10) was interrupted.
inline constexpr std::string_view interruption_datum = "G10";

/// Indices of the spaces below in a program.
inline constexpr ir::SpaceId space_l = 0, space_e = 1, space_symbol = 2;

/// The spaces of a NUM program, in this order: L, E (what is memory only), symbols.
inline std::vector<ir::VariableSpace> spaces() {
  std::vector<ir::VariableSpace> list(3);
  list[space_l].prefix = "L";
  list[space_l].starts_at_zero = true;
  for (const auto& r : l_ranges) {
    list[space_l].segments.push_back({r.lo, r.hi, ir::Scope::global, false, false, r.stops_preparation});
  }
  list[space_e].prefix = "E";
  list[space_e].type = ir::Type::integer;
  for (const auto& p : e_parameters) {
    if (p.meaning == EMeaning::user || p.meaning == EMeaning::scale_factor || p.meaning == EMeaning::tool_note) {
      list[space_e].segments.push_back({p.lo, p.hi, ir::Scope::global, true, false, true});
    }
  }
  list[space_e].segments.push_back({51001, 51255, ir::Scope::global, true, false, true});  // tip radius of a mill
  // PREF, DEC1 and DEC3, where a program keeps them apart.
  list[space_e].segments.push_back({60000, 68999, ir::Scope::global, true, false, true, true});
  list[space_symbol].scope = ir::Scope::program;
  list[space_symbol].starts_at_zero = true;
  return list;
}

}  // namespace cnctrans::dialects::num
