// Ranges and lengths (reference 2.2, 27).
#pragma once

#include <cstddef>
#include <cstdint>

namespace cnctrans::dialects::num {

inline constexpr std::int64_t label_max = 32767;
inline constexpr std::int64_t program_min = 1, program_max = 9999, system_program_max = 99999;
inline constexpr std::int64_t macro_program_base = 10000;  ///< Gxxx calls %10xxx
inline constexpr std::int64_t call_repeat_max = 100;
inline constexpr std::int64_t offset_max = 255;
inline constexpr std::int64_t g_max = 999, m_max = 999;
inline constexpr std::int64_t tool_max = 99999999;
inline constexpr double dwell_min = 0.01, dwell_max = 99.99;  ///< seconds
inline constexpr double linear_max = 99999.999;               ///< mm
inline constexpr std::int32_t linear_decimals = 3, linear_decimals_inch = 4, rotary_decimals = 4;
inline constexpr std::int32_t call_depth = 8, structure_depth = 15;
inline constexpr std::size_t block_length = 118;
inline constexpr std::size_t message_length = 39;
inline constexpr double arc_tolerance = 0.02;    ///< mm
inline constexpr double oriented_clearance = 2;  ///< mm, G86
inline constexpr double reapproach = 1;          ///< mm above the last depth, G83
inline constexpr double power_on_feed = 1000;    ///< mm/min

}  // namespace cnctrans::dialects::num
