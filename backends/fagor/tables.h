// How a Fagor program looks: the tables of the language (dialects/fagor) in the form that the shared writers read.
#pragma once

#include <string_view>

#include "backends/common/expression_printer.h"
#include "backends/common/style.h"
#include "dialects/fagor/g_codes.h"

namespace cnctrans::backends::fagor {

inline constexpr std::string_view dialect_name = "fagor";

/// `foreign`: the program comes from another language (its words are put in the order the control wants, its texts and
/// numbers are adapted). `inch`: length words have five decimals.
Style make_style(bool lathe, bool inch, bool foreign);

/// Word of the G function that does this on this model: "G57"; empty when there is none.
std::string_view g_word(bool lathe, dialects::fagor::Use use, int value = 0);

const ExpressionStyle& expression_style();
/// Levels of the manual's table (16.4) turned round: higher binds tighter.
inline constexpr std::uint8_t level_of(int level) {
  return static_cast<std::uint8_t>(90 - 10 * (level - 1));
}

/// Letter of a centre or pitch by its axis (manual 6.3): X U A -> I, Y V B -> J, Z W C -> K.
inline constexpr std::string_view center_letter(ir::AxisId axis) {
  constexpr std::string_view letters = "IJK";
  return axis < ir::axis::first_extra ? letters.substr(axis % 3U, 1) : std::string_view{};
}

}  // namespace cnctrans::backends::fagor
