// Options of a NUM machine profile (reference 1): where the manual is silent, or controls differ. Name, values,
// default.
#pragma once

#include <array>
#include <string_view>

namespace cnctrans::dialects::num {

struct OptionRow {
  std::string_view name;
  std::string_view values;  ///< separated by blanks; "*" = free
  std::string_view fallback;
  std::string_view title;
};

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

inline constexpr std::array options{
    OptionRow{option::family, "7xx 10xx flx", "10xx", "the control; 7xx has no IF, WHILE, VAR"},
    OptionRow{option::centre, "absolute_in_G90 incremental", "absolute_in_G90", "meaning of I J K under G90"},
    OptionRow{option::rotary_modulo, "*", "BC", "letters of the axes whose sign is a direction; - for none"},
    OptionRow{option::letter_o, "true false", "true", "GO is read as G0, with a warning"},
    OptionRow{option::range_order, "number position", "number", "what puts the two labels of a G77 range in order"},
    OptionRow{option::missing_end, "error to_last_lower", "error", "a G77 range whose last block is missing"},
    OptionRow{"num.linear_unit_um", "*", "1", "micrometres in one unit of a linear E parameter"},
    OptionRow{"num.rotary_unit", "*", "0.0001", "degrees in one unit of a rotary E parameter"},
    OptionRow{option::m30, "none end", "none", "whether M30 ends the program"},
    OptionRow{option::structured, "yes no", "yes", "IF, WHILE, REPEAT, FOR are written (10xx and later)"},
    OptionRow{option::face_x, "radius machine", "radius", "X under G21: a radius, or as the machine's X is"},
    OptionRow{option::m_programs, "*", "", "M functions that call a program: `6:9100 55:8055`"},
    OptionRow{option::chased_radial, "tool 1+ 1- 2+ 2-", "",
              "G31: what takes the point to its depth: the tool itself, or the plane's first or second axis; not set: "
              "`tool` in a run, no translation"},
    OptionRow{option::chased_back, "oriented middle reversed", "oriented",
              "G31: back with the spindle stopped at EC and 2 mm aside, from the middle of the hole, or along the "
              "thread with the spindle reversed"},
    OptionRow{
        option::reentrant, "corner tool", "",
        "G63: begins before the corner X Z of the blank, or where the tool stands; not set: `corner` in a run, no "
        "translation"},
    OptionRow{option::plunged, "from_tool from_end", "",
              "G66: the first plunge; not set: `from_tool` in a run, no translation"},
    OptionRow{option::plunged_axis, "by_step x z", "by_step", "G66: axis of the plunges; by_step: Z with P, X with R"},
    OptionRow{option::plunged_steps, "equal whole", "equal", "G66: equal steps, or whole ones and a last smaller one"},
    OptionRow{option::plunged_back, "rapid feed", "rapid", "G66: how a plunge comes back"},
    OptionRow{option::plunged_width, "*", "",
              "G66: mm between the two edges of the tool; not set: the width in the tool table"},
    OptionRow{option::peck_withdraw, "EH ER", "EH", "G83 with EH: the height between the pecks"},
    OptionRow{option::peck_law, "degressive constant", "degressive", "how the pecks of G83 and G87 go from P to Q"},
};

constexpr std::string_view option_default(std::string_view name) {
  for (const auto& o : options) {
    if (o.name == name) return o.fallback;
  }
  return {};
}

}  // namespace cnctrans::dialects::num
