// Limits of the language. Numbers of the control's own errors in brackets.
#pragma once

#include <cstdint>

namespace cnctrans::dialects::fagor {

inline constexpr std::int64_t max_label = 99'999'999;     ///< N0..N99999999 (error 2)
inline constexpr std::int64_t max_profile_label = 9'999;  ///< labels named by the profile cycles
inline constexpr std::int64_t max_repeat = 9'999;         ///< N at the block's end, RPT (error 2)
inline constexpr std::int64_t max_subroutine = 9'999;     ///< SUB, LSUB (error 63)
inline constexpr std::int64_t first_oem_parameter = 2000;
inline constexpr std::int64_t max_oem_subroutine = 20'000;  ///< 10000..20000 only in OEM programs
inline constexpr int max_m_functions = 7;                   ///< in one block (error 10)
inline constexpr int max_assignments = 26;                  ///< in one ( ) block, also arguments of PCALL
inline constexpr int max_call_levels = 15;                  ///< nested subroutines (error 1055)
inline constexpr int max_parameter_levels = 6;              ///< levels of local parameters (error 1054)
inline constexpr int max_local_subroutines = 100;
inline constexpr int max_message = 59;          ///< characters of MSG and ERROR texts (error 148)
inline constexpr int max_header_comment = 20;   ///< characters between % and the first comma
inline constexpr int max_error_number = 9'999;  ///< (error 79)
inline constexpr int program_digits = 6;        ///< a program's file is named by six digits
inline constexpr double max_coordinate_mm = 99'999.9999;
inline constexpr int decimals_mm = 4;
inline constexpr double max_coordinate_inch = 3'937.00787;
inline constexpr int decimals_inch = 5;
inline constexpr double max_constant = 999'999.99999;  ///< decimal constants of expressions: 6.5
inline constexpr int constant_decimals = 5;
inline constexpr double max_dwell = 99'999;      ///< hundredths of a second (G04 K)
inline constexpr int max_skip_levels = 3;        ///< /, /1, /2, /3 and / are the same first level
inline constexpr int uncompensated_blocks = 48;  ///< without path information under G41/G42 (error 1000)

/// Ranges of the arithmetic parameters.
struct ParameterRange {
  std::int32_t lo, hi;
  bool local;  ///< one set per level of calls with arguments
  bool oem;    ///< only in programs with attribute O
};
inline constexpr ParameterRange parameter_ranges[] = {
    {0, 25, true, false}, {100, 299, false, false}, {1000, 1255, false, false}, {2000, 2255, false, true}};
inline constexpr bool valid_parameter(std::int64_t n) {
  for (const auto& r : parameter_ranges) {
    if (n >= r.lo && n <= r.hi) return true;
  }
  return false;
}
/// In no list of the manual, but in programs of its own (22: P80 and P88 beside GPOS).
inline constexpr ParameterRange unlisted_parameters{26, 99, false, false};
inline constexpr bool unlisted_parameter(std::int64_t n) {
  return n >= unlisted_parameters.lo && n <= unlisted_parameters.hi;
}
/// Written by canned cycles and probing cycles: not for temporaries.
inline constexpr std::int32_t first_cycle_parameter = 294, last_cycle_parameter = 299;

/// Local parameter of a letter: A = P0 ... Z = P25.
inline constexpr int letter_parameter(char letter) {
  return letter - 'A';
}
inline constexpr char parameter_letter(int n) {
  return static_cast<char>('A' + n);
}

}  // namespace cnctrans::dialects::fagor
