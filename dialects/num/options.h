// Names of the options of a NUM machine profile (reference 1): where the manual is silent, or controls differ. Their
// values and meanings: machine/options.cpp.
#pragma once

#include <string_view>

namespace cnctrans::dialects::num {

namespace option {
inline constexpr std::string_view family = "num.family", centre = "num.g02_center", rotary_modulo = "num.rotary_modulo",
                                  letter_o = "num.lenient_letter_O", range_order = "num.range_order", m30 = "num.m30",
                                  missing_end = "num.missing_range_end", peck_law = "num.peck_law",
                                  peck_withdraw = "num.g83_withdraw", structured = "num.structured",
                                  face_x = "num.face_x", m_programs = "num.m_programs", chased_radial = "num.g31",
                                  chased_back = "num.g31_back", reentrant = "num.g63", plunged = "num.g66",
                                  plunged_axis = "num.g66_axis", plunged_steps = "num.g66_steps",
                                  plunged_back = "num.g66_back", plunged_width = "num.g66_width";
}  // namespace option

}  // namespace cnctrans::dialects::num
