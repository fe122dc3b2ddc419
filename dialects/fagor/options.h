// The options of a Fagor machine profile: where the manual is silent, or machines differ. Each names its values, what
// holds when the profile does not say, and its meaning.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "machine/options.h"

namespace cnctrans::dialects::fagor {

// The values of an enum stand in the order of its row below.
enum class RepeatUnderModal : std::uint8_t { sub_only, move_and_sub };
enum class PresetOfMirror : std::uint8_t { untouched, through };
enum class PlaneAngles : std::uint8_t { trace, axis };
enum class PlaneTilt : std::uint8_t { rises, falls };

/// What the reader and the writer ask; the values are those of a profile that does not say.
struct Options {
  RepeatUnderModal mcall_repeat = RepeatUnderModal::move_and_sub;
  PresetOfMirror g92_mirror = PresetOfMirror::untouched;
  PlaneAngles plane_angles = PlaneAngles::trace;
  PlaneTilt plane_tilt = PlaneTilt::rises;

  bool operator==(const Options&) const = default;
};

inline constexpr std::array option_rows{
    machine::option<&Options::mcall_repeat>("fagor.mcall_repeat", "sub_only|move_and_sub", "move_and_sub",
                                            "what a block repeat does under MCALL"),
    machine::option<&Options::g92_mirror>(
        "fagor.g92_mirror", "untouched|through", "untouched",
        "G92 of a mirrored axis: the origin is set as without the mirror image, or so that the "
        "axis stands at the value in the mirrored coordinates"),
    machine::option<&Options::plane_angles>(
        "fagor.plane_angles", "trace|axis", "trace",
        "angles I J of G49: between an axis and the line in which the plane meets the plane of "
        "that axis and Z, or between the axis and the plane itself"),
    machine::option<&Options::plane_tilt>(
        "fagor.plane_tilt", "rises|falls", "rises",
        "a positive angle I or J of G49: the plane rises, or falls, toward the plus side of the axis"),
};
/// Those that set what every control has.
inline constexpr std::array shared_option_rows{
    machine::option<&machine::Policies::tool_change>("fagor.tool_change", "turret|m6", "m6",
                                                     "T changes at once, or selects for M06"),
    machine::option<&machine::Policies::rotary_rollover>(
        "fagor.rotary_rollover", "no|yes", "no",
        "absolute words of rotary axes: the sign is the direction and the value the target, or a plain coordinate"),
};

inline Options options_of(const machine::Profile& profile) {
  return machine::read_options(profile, option_rows);
}

}  // namespace cnctrans::dialects::fagor
