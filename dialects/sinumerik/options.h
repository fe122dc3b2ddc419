// The options of a Sinumerik machine profile: where the manual is silent, or machines differ. Each names its values,
// what holds when the profile does not say, and its meaning.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "machine/options.h"

namespace cnctrans::sinumerik {

// The values of an enum stand in the order of its row below.
enum class SpigotSize : std::uint8_t { radius, diameter };
enum class UndefinedNames : std::uint8_t { error, global };
enum class ContourOk : std::uint8_t { zero, one };
enum class InclinedAxis : std::uint8_t { plus, minus };
enum class Gotos : std::uint8_t { goes_on, jumps };
enum class TableTurn : std::uint8_t { unknown, with_angle, against_angle };

/// What the reader and the writer ask; the values are those of a profile that does not say.
struct Options {
  double default_edge = 0;
  SpigotSize spigot_size = SpigotSize::radius;
  UndefinedNames undefined_names = UndefinedNames::error;
  std::string geometry_axes = "XYZ";
  ContourOk contour_ok = ContourOk::zero;
  InclinedAxis inclined_axis = InclinedAxis::plus;
  Gotos gotos = Gotos::goes_on;
  TableTurn table_turn = TableTurn::unknown;
  bool exact_greater = false;

  bool operator==(const Options&) const = default;
};

inline constexpr std::array option_rows{
    machine::option<&Options::default_edge>(
        "sinumerik.default_edge", "number", "0",
        "D that a tool change selects when none is written after its T (MD20270); 0: none"),
    machine::option<&Options::spigot_size>(
        "sinumerik.spigot_size", "radius|diameter", "radius",
        "PRAD and AP1 of CYCLE77: radii, or diameters (a spigot that is taken for a diameter is cut smaller)"),
    machine::option<&Options::undefined_names>(
        "sinumerik.undefined_names", "error|global", "error",
        "a name that nothing defines: refused, or a global user variable (GUD) that starts at 0"),
    machine::option<&Options::geometry_axes>(
        "sinumerik.geometry_axes", "XYZ|YZX|ZXY", "XYZ",
        "which axis is the first, second and third geometry axis (MD20050): G17 to G19 and I, J, K go by this order"),
    machine::option<&Options::contour_ok>(
        "sinumerik.contour_ok", "0|1", "0",
        "what EXECUTE answers where a contour could be prepared (the manual says both)"),
    machine::option<&Options::inclined_axis>(
        "sinumerik.inclined_axis", "plus|minus", "plus",
        "which way Z goes where an inclined axis alone takes X up (G5, G7 under TRAANG with an angle above 0)"),
    machine::option<&Options::gotos>(
        "sinumerik.gotos", "goes_on|jumps", "goes_on",
        "GOTOS: the PLC does not ask for the jump (DB21.DBX384.0 is 0: one pass), or it always does"),
    machine::option<&Options::table_turn>(
        "sinumerik.table_turn", "unknown|with_angle|against_angle", "unknown",
        "which way PAROT turns the coordinates with an angle of a table in $TC_CARR; unknown: such a turn is refused"),
    machine::option<&Options::exact_greater>("sinumerik.exact_greater", "no|yes", "no",
                                             "> and < compare exactly (MD10280 bit 0)"),
};
/// Those that set what every control has.
inline constexpr std::array shared_option_rows{
    machine::option<&machine::Policies::tool_change>("sinumerik.tool_change", "immediate|m6", "m6",
                                                     "T changes at once, or selects for M6 (MD22550)"),
    machine::option<&machine::Policies::numbered_variables>("sinumerik.r_count", "number", "100",
                                                            "number of R parameters"),
};

inline Options options_of(const machine::Profile& profile) {
  return machine::read_options(profile, option_rows);
}

}  // namespace cnctrans::sinumerik
