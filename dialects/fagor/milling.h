// Pockets of the mill (25.3): letters and the parameters they are in ir/cycles/milling/milling. The depth I, the
// reference plane and D (from the reference plane to the surface) are levels of the cycle.
#pragma once

#include <array>
#include <string_view>

namespace cnctrans::dialects::fagor {

struct MillLetter {
  char letter = 0;
  std::string_view parameter;
  bool zero_refused = false;  ///< error 1042
};
struct MillingCycle {
  int code;
  std::string_view name;   ///< "G87"
  std::string_view shape;  ///< row of ir/cycles/milling/milling
  std::array<MillLetter, 7> letters;
};
/// What the letters mean when they are left out.
inline constexpr double pocket_step = 0.75;   ///< C in tool diameters
inline constexpr double pocket_plunge = 0.5;  ///< V in the feed

inline constexpr std::array milling_cycles = {
    MillingCycle{87,
                 "G87",
                 "pocket.rect",
                 {{{'J', "half_length", true},
                   {'K', "half_width", true},
                   {'B', "signed_infeed", true},
                   {'C', "step", true},
                   {'H', "finish_feed"},
                   {'L', "wall_pass"},
                   {'V', "plunge_feed"}}}},
    MillingCycle{88,
                 "G88",
                 "pocket.circle",
                 {{{'J', "signed_radius", true},
                   {'B', "signed_infeed", true},
                   {'C', "step", true},
                   {'H', "finish_feed"},
                   {'L', "wall_pass"},
                   {'V', "plunge_feed"}}}},
};
inline constexpr const MillingCycle* find_milling(int code) {
  for (const auto& c : milling_cycles) {
    if (c.code == code) return &c;
  }
  return nullptr;
}

}  // namespace cnctrans::dialects::fagor
