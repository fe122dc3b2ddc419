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
    machine::OptionRow<Options>{"sinumerik.default_edge", "number", "0",
                                &machine::put_option<&Options::default_edge, Options>,
                                "D that a tool change selects when none is written after its T (MD20270); 0: none"},
    machine::OptionRow<Options>{
        "sinumerik.spigot_size", "radius|diameter", "radius", &machine::put_option<&Options::spigot_size, Options>,
        "PRAD and AP1 of CYCLE77: radii, or diameters (a spigot that is taken for a diameter is cut smaller)"},
    machine::OptionRow<Options>{
        "sinumerik.undefined_names", "error|global", "error", &machine::put_option<&Options::undefined_names, Options>,
        "a name that nothing defines: refused, or a global user variable (GUD) that starts at 0"},
    machine::OptionRow<Options>{
        "sinumerik.geometry_axes", "XYZ|YZX|ZXY", "XYZ", &machine::put_option<&Options::geometry_axes, Options>,
        "which axis is the first, second and third geometry axis (MD20050): G17 to G19 and I, J, K go by this order"},
    machine::OptionRow<Options>{"sinumerik.contour_ok", "0|1", "0", &machine::put_option<&Options::contour_ok, Options>,
                                "what EXECUTE answers where a contour could be prepared (the manual says both)"},
    machine::OptionRow<Options>{
        "sinumerik.inclined_axis", "plus|minus", "plus", &machine::put_option<&Options::inclined_axis, Options>,
        "which way Z goes where an inclined axis alone takes X up (G5, G7 under TRAANG with an angle above 0)"},
    machine::OptionRow<Options>{
        "sinumerik.gotos", "goes_on|jumps", "goes_on", &machine::put_option<&Options::gotos, Options>,
        "GOTOS: the PLC does not ask for the jump (DB21.DBX384.0 is 0: one pass), or it always does"},
    machine::OptionRow<Options>{
        "sinumerik.table_turn", "unknown|with_angle|against_angle", "unknown",
        &machine::put_option<&Options::table_turn, Options>,
        "which way PAROT turns the coordinates with an angle of a table in $TC_CARR; unknown: such a turn is refused"},
    machine::OptionRow<Options>{"sinumerik.exact_greater", "no|yes", "no",
                                &machine::put_option<&Options::exact_greater, Options>,
                                "> and < compare exactly (MD10280 bit 0)"},
};
/// Those that set what every control has.
inline constexpr std::array shared_option_rows{
    machine::OptionSpec{"sinumerik.tool_change", "immediate|m6", "m6",
                        &machine::put_option<&machine::Policies::tool_change, machine::Policies>,
                        "T changes at once, or selects for M6 (MD22550)"},
    machine::OptionSpec{"sinumerik.r_count", "number", "100",
                        &machine::put_option<&machine::Policies::numbered_variables, machine::Policies>,
                        "number of R parameters"},
};

inline Options options_of(const machine::Profile& profile) {
  return machine::read_options(profile, option_rows);
}

}  // namespace cnctrans::sinumerik
