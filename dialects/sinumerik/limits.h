// Numbers that bound a Sinumerik program (reference-language 1.3, 1.4, 1.7, 3.2, 6-8).
#pragma once

#include <cstdint>

namespace cnctrans::sinumerik {

inline constexpr int block_characters = 512;  ///< with the line end
inline constexpr int m_functions_in_block = 5;
inline constexpr int name_characters = 31;   ///< variables, programs
inline constexpr int label_characters = 32;  ///< at least 2; the first two letters or underscores
inline constexpr int string_characters = 200;
inline constexpr int skip_level_max = 9;               ///< `/0` .. `/9`
inline constexpr int r_parameter_default_count = 100;  ///< MD28050
inline constexpr int r_parameter_max = 32535;
inline constexpr int program_levels = 16;
inline constexpr int structure_nesting = 16;  ///< control structures of one program level
inline constexpr int call_count_max = 9999;   ///< `P9999`
inline constexpr int parameters_max = 127;
inline constexpr int array_dimensions_max = 3;
inline constexpr int plane_tolerance_um = 10;          ///< end point error of an arc the control corrects (MD21000)
inline constexpr double comparison_tolerance = 1e-12;  ///< relative, of all comparisons of reals

}  // namespace cnctrans::sinumerik
