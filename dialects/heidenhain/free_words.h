// The words of free contours (reference 7.1).
#pragma once

#include <string_view>

#include "dialects/heidenhain/patterns.h"

namespace cnctrans::dialects::heidenhain {

/// Data of an element, with a number each. P1X is written P1X; DR, CLSD, F, M and the compensation are no data.
inline constexpr std::string_view free_words = "X Y PR PA LEN AN R CCX CCY CCPR CCPA P1X P1Y P2X P2Y P3X P3Y PDX PDY D";
/// By the number of another block, which other controls do not have.
inline constexpr std::string_view relative_words = "RX RY RPR RPA RAN PAR DP RCCX RCCY RCCPR RCCPA";

}  // namespace cnctrans::dialects::heidenhain
