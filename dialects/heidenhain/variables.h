// Variables (reference 12.1, 12.5, 12.6): Q, QL, QR, QS, and the machine data that the control keeps in Q100 to Q199 or
// gives through FN 18.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "ir/program.h"

namespace cnctrans::dialects::heidenhain {

struct QRange {
  std::int64_t lo, hi;
  std::string_view title;
};
inline constexpr std::array q_ranges{
    QRange{0, 99, "free; 1 to 20 are those of the SL cycles"},
    QRange{100, 199, "set by the control"},
    QRange{200, 1399, "parameters of cycles"},
    QRange{1400, 1599, "parameters of the machine maker's cycles"},
    QRange{1600, 1999, "free"},
};
inline constexpr std::int64_t q_max = 1999, ql_max = 499, qr_max = 499, qs_max = 1999;
/// Parameters that a program may use for itself without a cycle or the control changing them.
constexpr bool is_free_q(std::int64_t n) {
  return (n >= 21 && n <= 99) || (n >= 1600 && n <= 1999);
}

/// Indices of the spaces in a program.
inline constexpr ir::SpaceId space_q = 0, space_ql = 1, space_qr = 2, space_qs = 3;

/// The spaces of a program, in this order. QL belongs to one run of a program file: CALL PGM opens a new level, CALL
/// LBL does not.
inline std::vector<ir::VariableSpace> spaces() {
  std::vector<ir::VariableSpace> list(4);
  list[space_q].prefix = "Q";
  for (const auto& r : q_ranges) list[space_q].segments.push_back({r.lo, r.hi, ir::Scope::global, true, false, false});
  list[space_ql].prefix = "QL";
  list[space_ql].starts_at_zero = true;
  list[space_ql].segments.push_back({0, ql_max, ir::Scope::level, false, false, false});
  list[space_qr].prefix = "QR";
  list[space_qr].segments.push_back({0, qr_max, ir::Scope::global, true, false, false});
  list[space_qs].prefix = "QS";
  list[space_qs].type = ir::Type::string;
  list[space_qs].scope = ir::Scope::global;
  return list;
}

/// Parameters that the control itself keeps up to date.
struct SystemQ {
  std::int16_t number;
  ir::Datum datum;
  std::string_view title;
};
inline constexpr std::array system_q{
    SystemQ{108, ir::Datum::tool_radius, "radius of the tool in use"},
    SystemQ{114, ir::Datum::tool_length, "length of the tool in use"},
};
constexpr const SystemQ* find_system_q(std::int64_t number) {
  for (const auto& s : system_q) {
    if (s.number == number) return &s;
  }
  return nullptr;
}
/// What the text says: 0 X, 1 Y, 2 Z, -1 no tool; 0 mm, 1 inch.
inline constexpr std::int64_t q_tool_axis = 109, q_unit = 113;
/// Without a neutral counterpart: read as machine data under their own name.
constexpr bool is_control_q(std::int64_t n) {
  return (n >= 100 && n <= 107) || (n >= 109 && n <= 113);
}

/// FN 18: SYSREAD ID NR (IDX), always in mm. `axis_index`: IDX names an axis, 1 = X.
struct SystemRead {
  std::int16_t id, nr;
  ir::Datum datum;
  bool axis_index = false;
  bool axis_number = false;  ///< NR names an axis
  std::string_view title;
  bool by_unit = false;  ///< the neutral datum is in the unit of the program
};
inline constexpr std::array system_reads{
    SystemRead{20, 1, ir::Datum::tool_number, false, false, "tool in use"},
    SystemRead{20, 2, ir::Datum::next_tool, false, false, "tool made ready"},
    SystemRead{20, 4, ir::Datum::rpm, false, false, "programmed speed"},
    SystemRead{20, 9, ir::Datum::feed, false, false, "feed in force", true},
    SystemRead{50, 1, ir::Datum::tool_length, false, false, "length in the tool table"},
    SystemRead{50, 2, ir::Datum::tool_radius, false, false, "radius in the tool table"},
    SystemRead{200, 1, ir::Datum::tool_radius, false, false, "radius in force"},
    SystemRead{200, 2, ir::Datum::tool_length, false, false, "length in force"},
    SystemRead{210, 2, ir::Datum::rotation_angle, false, false, "programmed rotation"},
    SystemRead{210, 3, ir::Datum::mirrored_axes, false, false, "mirrored axes, a bit each"},
    SystemRead{210, 4, ir::Datum::axis_scale, true, false, "scale of an axis"},
    SystemRead{220, 2, ir::Datum::programmed_shift, true, false, "datum shift of an axis", true},
    SystemRead{240, 1, ir::Datum::machine_position, true, false, "position from the machine datum"},
    SystemRead{270, 1, ir::Datum::work_position, true, false, "position in the coordinates in force", true},
};
constexpr const SystemRead* find_system_read(std::int64_t id, std::int64_t nr) {
  for (const auto& s : system_reads) {
    if (s.id == id && s.nr == nr) return &s;
  }
  return nullptr;
}

}  // namespace cnctrans::dialects::heidenhain
