// G45, simple pockets (reference 11.6): addresses and the parameters they are in ir/cycles/milling/milling. ER, EH and
// the depth are levels of the cycle.
#pragma once

#include <array>
#include <string_view>

namespace cnctrans::dialects::num {

inline constexpr double pocket_clearance = 1;  ///< mm above the surface EH, where the feed starts

struct PocketWord {
  char letter;
  bool e;  ///< behind E
  std::string_view address, parameter;
};
inline constexpr std::array pocket_words = {
    PocketWord{'X', true, "EX", "length"},      PocketWord{'Y', true, "EY", "width"},
    PocketWord{'B', true, "EB", "corner"},      PocketWord{'P', false, "P", "infeed"},
    PocketWord{'Q', false, "Q", "step"},        PocketWord{'I', false, "I", "floor_stock"},
    PocketWord{'J', false, "J", "wall_stock"},  PocketWord{'P', true, "EP", "plunge_feed"},
    PocketWord{'Q', true, "EQ", "mill_feed"},   PocketWord{'I', true, "EI", "finish_plunge_feed"},
    PocketWord{'J', true, "EJ", "finish_feed"},
};
/// Without EX and EY the corner is the radius of a circle.
inline constexpr std::string_view rectangle = "pocket.rect", circle = "pocket.circle";

}  // namespace cnctrans::dialects::num
