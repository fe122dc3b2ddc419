// Ranges and lengths (manual: "G-Code Overview", "O Codes", "Coordinate Systems").
#pragma once

#include <cstddef>
#include <cstdint>

namespace cnctrans::dialects::linuxcnc {

/// #1-#30 are the arguments of a subroutine and belong to each call; #31 and above are shared by all routines, start at
/// 0 and are forgotten at the end of the session; #5001 and above belong to the control.
inline constexpr std::int64_t shared_parameter_min = 31, shared_parameter_max = 4999;
inline constexpr std::int64_t line_number_max = 99999;
inline constexpr std::int64_t o_word_max = 99999;
/// G54-G59, G59.1-G59.3. The last one stands for "no offset", which the language does not have.
inline constexpr std::int32_t work_offset_rows = 9;
inline constexpr std::int32_t zero_offset_row = work_offset_rows;
inline constexpr std::size_t line_length = 255;
/// Two values are EQ when they differ by less than this.
inline constexpr double equal_tolerance = 0.0001;
/// M functions that a machine's builder defines.
inline constexpr std::int32_t user_m_min = 100, user_m_max = 199;

}  // namespace cnctrans::dialects::linuxcnc
