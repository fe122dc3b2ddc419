// Milling cycles that the IR carries: their parameters and those of ir/cycles/milling/milling
// (reference-language 18.3).
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "dialects/sinumerik/options.h"

namespace cnctrans::sinumerik {

/// Trailing parameters of the newer signatures that change nothing in the machinings that are carried: size and depth
/// of a chamfer, and how the cycle was entered. They are kept, and written again.
inline constexpr std::string_view kept_milling_modes = "FS,ZFS,GMODE,DMODE,AMODE,LIM";
/// The step in the plane, which AMODE may count in hundredths of the tool's diameter.
inline constexpr std::string_view step_parameter = "MIDA";

/// The parameter that names a contour: a subprogram, or two labels with a colon between them; without it, the cycle
/// that named one before.
inline constexpr std::string_view mill_contour_parameter = "KNAME", contour_cycle = "CYCLE62";
/// Labels that enclose a contour which is called by its name.
inline constexpr std::string_view contour_begin = "E_LAB_A_", contour_end = "E_LAB_E_";

struct MillingCycle {
  std::string_view name;                                                     ///< "POCKET3"
  std::string_view shape;                                                    ///< row of ir/cycles/milling/milling
  std::array<std::pair<std::string_view, std::string_view>, 20> parameters;  ///< own name, name in the IR
  std::string_view needs;      ///< own names that must be given, separated by one comma each
  std::string_view variants;   ///< values of VARI that are carried; empty: it has none
  std::string_view only_zero;  ///< own names that are carried as 0 only
  /// Which size of a round spigot and of its blank the row holds for, where the tables differ.
  std::optional<SpigotSize> spigot = {};
};

// clang-format off
inline constexpr std::array milling_cycles = {
    MillingCycle{"POCKET3", "pocket.rect",
                 {{{"LENG", "length"}, {"WID", "width"}, {"CRAD", "corner"}, {"PA", "u"}, {"PO", "v"}, {"STA", "angle"},
                   {"MID", "infeed"}, {"FAL", "wall_stock"}, {"FALD", "floor_stock"}, {"FFP1", "mill_feed"},
                   {"FFD", "plunge_feed"}, {"CDIR", "sense"}, {"VARI", "variant"}, {"MIDA", "step"},
                   {"AP1", "blank_length"}, {"AP2", "blank_width"}, {"AD", "blank_depth"}, {"RAD1", "plunge_radius"},
                   {"DP1", "plunge_pitch"}}},
                 "LENG,WID,PA,PO,MID,VARI", "1,2,11,12,21,22,31,32", ""},
    MillingCycle{"POCKET4", "pocket.circle",
                 {{{"PRAD", "radius"}, {"PA", "u"}, {"PO", "v"}, {"MID", "infeed"}, {"FAL", "wall_stock"},
                   {"FALD", "floor_stock"}, {"FFP1", "mill_feed"}, {"FFD", "plunge_feed"}, {"CDIR", "sense"},
                   {"VARI", "variant"}, {"MIDA", "step"}, {"AP1", "blank_length"}, {"AD", "blank_depth"},
                   {"RAD1", "plunge_radius"}, {"DP1", "plunge_pitch"}}},
                 "PRAD,PA,PO,MID,VARI", "1,2,11,12,21,22", ""},
    MillingCycle{"SLOT1", "slot.radial",
                 {{{"NUM", "count"}, {"LENG", "length"}, {"WID", "width"}, {"CPA", "u"}, {"CPO", "v"},
                   {"RAD", "radius"}, {"STA1", "angle"}, {"INDA", "angle_step"}, {"FFD", "plunge_feed"},
                   {"FFP1", "mill_feed"}, {"MID", "infeed"}, {"CDIR", "sense"}, {"FAL", "wall_stock"},
                   {"VARI", "operation"}, {"MIDF", "finish_infeed"}, {"FFP2", "finish_feed"}, {"SSF", "finish_speed"},
                   {"FALD", "floor_stock"}}},
                 "NUM,LENG,WID,CPA,CPO,RAD,STA1", "0,1,2", "STA2,DP1"},
    MillingCycle{"SLOT2", "slot.ring",
                 {{{"NUM", "count"}, {"AFSL", "opening"}, {"WID", "width"}, {"CPA", "u"}, {"CPO", "v"},
                   {"RAD", "radius"}, {"STA1", "angle"}, {"INDA", "angle_step"}, {"FFD", "plunge_feed"},
                   {"FFP1", "mill_feed"}, {"MID", "infeed"}, {"CDIR", "sense"}, {"FAL", "wall_stock"},
                   {"VARI", "operation"}, {"MIDF", "finish_infeed"}, {"FFP2", "finish_feed"},
                   {"SSF", "finish_speed"}}},
                 "NUM,AFSL,WID,CPA,CPO,RAD,STA1", "0,1,2", ""},
    MillingCycle{"LONGHOLE", "slot.long",
                 {{{"NUM", "count"}, {"LENG", "length"}, {"CPA", "u"}, {"CPO", "v"}, {"RAD", "radius"},
                   {"STA1", "angle"}, {"INDA", "angle_step"}, {"FFD", "plunge_feed"}, {"FFP1", "mill_feed"},
                   {"MID", "infeed"}}},
                 "NUM,LENG,CPA,CPO,RAD,STA1", "", ""},
    MillingCycle{"CYCLE71", "face",
                 {{{"PA", "u"}, {"PO", "v"}, {"LENG", "length"}, {"WID", "width"}, {"STA", "angle"}, {"MID", "infeed"},
                   {"MIDA", "step"}, {"FDP", "overrun"}, {"FALD", "floor_stock"}, {"FFP1", "mill_feed"},
                   {"VARI", "variant"}, {"FDP1", "overrun_across"}}},
                 "PA,PO,LENG,WID,MID,VARI", "11,12,21,22,31,32,41,42", ""},
    MillingCycle{"CYCLE61", "face",
                 {{{"PA", "u"}, {"PO", "v"}, {"LENG", "length"}, {"WID", "width"}, {"MID", "infeed"}, {"MIDA", "step"},
                   {"FALD", "floor_stock"}, {"FFP1", "mill_feed"}, {"VARI", "variant"}}},
                 "PA,PO,LENG,WID,MID,VARI", "11,12,21,22,31,32,41,42", "LIM"},
    MillingCycle{"CYCLE72", "path",
                 {{{"MID", "infeed"}, {"FAL", "wall_stock"}, {"FALD", "floor_stock"}, {"FFP1", "mill_feed"},
                   {"FFD", "plunge_feed"}, {"VARI", "variant"}, {"RL", "side"}, {"AS1", "approach"},
                   {"LP1", "approach_length"}, {"FF3", "link_feed"}, {"AS2", "leave"}, {"LP2", "leave_length"}}},
                 "VARI,RL,AS1,LP1,AS2,LP2", "1,2,11,12,101,102,111,112,201,202,211,212,301,302,311,312", ""},
    MillingCycle{"POCKET1", "pocket.rect",
                 {{{"LENG", "length"}, {"WID", "width"}, {"CRAD", "corner"}, {"CPA", "u"}, {"CPO", "v"},
                   {"STA1", "angle"}, {"FFD", "plunge_feed"}, {"FFP1", "mill_feed"}, {"MID", "infeed"},
                   {"CDIR", "sense"}, {"FAL", "wall_stock"}, {"VARI", "operation"}, {"MIDF", "finish_infeed"},
                   {"FFP2", "finish_feed"}, {"SSF", "finish_speed"}}},
                 "LENG,WID,CPA,CPO", "0,1,2", ""},
    MillingCycle{"POCKET2", "pocket.circle",
                 {{{"PRAD", "radius"}, {"CPA", "u"}, {"CPO", "v"}, {"FFD", "plunge_feed"}, {"FFP1", "mill_feed"},
                   {"MID", "infeed"}, {"CDIR", "sense"}, {"FAL", "wall_stock"}, {"VARI", "operation"},
                   {"MIDF", "finish_infeed"}, {"FFP2", "finish_feed"}, {"SSF", "finish_speed"}}},
                 "PRAD,CPA,CPO", "0,1,2", ""},
    MillingCycle{"CYCLE76", "boss.rect",
                 {{{"LENG", "length"}, {"WID", "width"}, {"CRAD", "corner"}, {"PA", "u"}, {"PO", "v"}, {"STA", "angle"},
                   {"MID", "infeed"}, {"FAL", "wall_stock"}, {"FALD", "floor_stock"}, {"FFP1", "mill_feed"},
                   {"FFD", "plunge_feed"}, {"CDIR", "sense"}, {"VARI", "variant"}, {"AP1", "blank_length"},
                   {"AP2", "blank_width"}}},
                 "LENG,WID,PA,PO,VARI", "1,2", ""},
    MillingCycle{"CYCLE77", "boss.circle",
                 {{{"PRAD", "radius"}, {"PA", "u"}, {"PO", "v"}, {"MID", "infeed"}, {"FAL", "wall_stock"},
                   {"FALD", "floor_stock"}, {"FFP1", "mill_feed"}, {"FFD", "plunge_feed"}, {"CDIR", "sense"},
                   {"VARI", "variant"}, {"AP1", "blank_radius"}}},
                 "PRAD,PA,PO,VARI", "1,2", "", SpigotSize::radius},
    MillingCycle{"CYCLE77", "boss.circle",
                 {{{"PRAD", "diameter"}, {"PA", "u"}, {"PO", "v"}, {"MID", "infeed"}, {"FAL", "wall_stock"},
                   {"FALD", "floor_stock"}, {"FFP1", "mill_feed"}, {"FFD", "plunge_feed"}, {"CDIR", "sense"},
                   {"VARI", "variant"}, {"AP1", "blank_diameter"}}},
                 "PRAD,PA,PO,VARI", "1,2", "", SpigotSize::diameter},
    MillingCycle{"CYCLE90", "thread.mill",
                 {{{"DIATH", "diameter"}, {"KDIAM", "core"}, {"PIT", "pitch"}, {"FFR", "mill_feed"}, {"CDIR", "sense"},
                   {"TYPTH", "external"}, {"CPA", "u"}, {"CPO", "v"}}},
                 "DIATH,KDIAM,PIT,CPA,CPO", "", ""},
};
// clang-format on

/// By its own name (capitals); null: none.
inline constexpr const MillingCycle* milling_cycle(std::string_view name, SpigotSize spigot = SpigotSize::radius) {
  for (const auto& c : milling_cycles) {
    if (c.name == name && c.spigot.value_or(spigot) == spigot) return &c;
  }
  return nullptr;
}

}  // namespace cnctrans::sinumerik
