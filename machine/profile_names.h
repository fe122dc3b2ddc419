// Words of the profile's JSON form.
#pragma once

#include <array>
#include <string_view>

#include "machine/profile.h"

namespace cnctrans::machine {

template <class Enum>
struct Word {
  Enum value;
  std::string_view text;
};

inline constexpr std::array kind_words{Word<Kind>{Kind::mill, "mill"}, Word<Kind>{Kind::lathe, "lathe"}};

inline constexpr std::array meaning_words{
    Word<MMeaning>{MMeaning::machine_function, "machine_function"},
    Word<MMeaning>{MMeaning::stop, "stop"},
    Word<MMeaning>{MMeaning::optional_stop, "optional_stop"},
    Word<MMeaning>{MMeaning::program_end, "program_end"},
    Word<MMeaning>{MMeaning::subprogram_end, "subprogram_end"},
    Word<MMeaning>{MMeaning::spindle_cw, "spindle_cw"},
    Word<MMeaning>{MMeaning::spindle_ccw, "spindle_ccw"},
    Word<MMeaning>{MMeaning::spindle_stop, "spindle_stop"},
    Word<MMeaning>{MMeaning::spindle_orient, "spindle_orient"},
    Word<MMeaning>{MMeaning::tool_change, "tool_change"},
    Word<MMeaning>{MMeaning::coolant_off, "coolant_off"},
    Word<MMeaning>{MMeaning::coolant_flood, "coolant_flood"},
    Word<MMeaning>{MMeaning::coolant_mist, "coolant_mist"},
    Word<MMeaning>{MMeaning::coolant_second, "coolant_second"},
    Word<MMeaning>{MMeaning::gear, "gear"},
    Word<MMeaning>{MMeaning::none, "none"},
};

inline constexpr std::array order_words{Word<ir::Order>{ir::Order::before, "before"},
                                        Word<ir::Order>{ir::Order::with, "with"},
                                        Word<ir::Order>{ir::Order::after, "after"}};

inline constexpr std::array slot_words{
    Word<ir::FrameSlot>{ir::FrameSlot::preset, "preset"},     Word<ir::FrameSlot>{ir::FrameSlot::shift, "shift"},
    Word<ir::FrameSlot>{ir::FrameSlot::rotation, "rotation"}, Word<ir::FrameSlot>{ir::FrameSlot::scale, "scale"},
    Word<ir::FrameSlot>{ir::FrameSlot::mirror, "mirror"},     Word<ir::FrameSlot>{ir::FrameSlot::chain, "chain"},
};

template <class Words>
constexpr std::string_view word_of(const Words& words, decltype(words[0].value) value) {
  for (const auto& w : words) {
    if (w.value == value) return w.text;
  }
  return {};
}

}  // namespace cnctrans::machine
