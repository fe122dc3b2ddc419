// Ranges and lengths (reference 1.6, 11, 12.1).
#pragma once

#include <cstddef>
#include <cstdint>

namespace cnctrans::dialects::heidenhain {

inline constexpr std::int64_t label_max = 999;  ///< 0 ends a subprogram
inline constexpr std::size_t label_length = 32;
inline constexpr std::int64_t m_max = 999;
inline constexpr std::int64_t tool_max = 32767;
inline constexpr std::size_t tool_name_length = 32;
inline constexpr std::size_t program_name_length = 25;
inline constexpr std::size_t string_length = 256;
inline constexpr double value_max = 99999.9999;    ///< mm, degrees
inline constexpr double constant_max = 999999999;  ///< in a formula
inline constexpr std::int32_t linear_decimals = 4, rotary_decimals = 4;
inline constexpr double dwell_max = 3600;         ///< seconds
inline constexpr std::int32_t call_depth = 8;     ///< CALL LBL; newer releases 20
inline constexpr std::size_t m_functions = 2;     ///< of one block
inline constexpr double arc_tolerance = 0.016;    ///< mm
inline constexpr double freed_distance = 0.2;     ///< mm: sideways, cycle 202
inline constexpr double chip_break_feed = 3000;   ///< mm/min: of the lifts of cycle 205
inline constexpr double rapid_stand_in = 99999;   ///< a feed that the programs write where they mean rapid
inline constexpr std::size_t pattern_points = 9;  ///< POS1 to POS9 of PATTERN DEF

}  // namespace cnctrans::dialects::heidenhain
