// Points of cycles that the maker's manuals leave open. A machine's profile decides them; what it does not say is taken
// as written here, and said.
#pragma once

#include <array>
#include <string_view>

namespace cnctrans::sinumerik {

struct Assumption {
  std::string_view option;  ///< of the profile
  std::string_view text;    ///< what holds without it
};
struct AssumedCycle {
  std::string_view name;
  std::string_view code;
  std::array<Assumption, 4> points;
};

// clang-format off
inline constexpr std::array assumed_cycles = {
    AssumedCycle{"CYCLE92", "SIN-120",
                 {{{"cycle.parting_part", "the part lies toward +Z of Z0 and the insert toward -Z"},
                   {"cycle.parting_speed", "SV1 is a cutting speed where SV2 or thousands of AMODE say so"},
                   {"cycle.parting_retract", "the tool goes back to the safety distance at the end"},
                   {"cycle.parting_after", "behind it the spindle turns as at its end, under G97 where the caller had G96 too"}}}},
    AssumedCycle{"CYCLE930", "SIN-121",
                 {{{"cycle.groove_position", "hundreds of VARI name the side of the start as VARI of CYCLE93 does"},
                   {"cycle.groove_depth", "without a mode in AMODE, DIAG is the depth from the surface"},
                   {"cycle.groove_dwell", "there is no dwell behind the plunges"}}}},
};
// clang-format on

/// nullptr: the manuals say all of it.
inline constexpr const AssumedCycle* assumed_cycle(std::string_view name) {
  for (const auto& c : assumed_cycles) {
    if (c.name == name) return &c;
  }
  return nullptr;
}

}  // namespace cnctrans::sinumerik
