// Turning cycles that the IR carries: their parameters and those of ir/cycles/machining (reference-language 18.4).
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace cnctrans::sinumerik {

/// The parameter that is a fixed letter, and what a call may write there.
inline constexpr std::string_view form_parameter = "FORM";
/// The parameter that names a contour: a subprogram, or two labels with a colon between them.
inline constexpr std::string_view contour_parameter = "NPP";

struct TurningCycle {
  std::string_view name;                                                     ///< "CYCLE97"
  std::string_view cycle;                                                    ///< name in the IR
  std::array<std::pair<std::string_view, std::string_view>, 29> parameters;  ///< own name, name in the IR
  std::string_view needs;  ///< own names that must be given, separated by one comma each
};

// clang-format off
inline constexpr std::array turning_cycles = {
    TurningCycle{"CYCLE92", "part.off",
                 {{{"SPD", "nominal"}, {"SPL", "z"}, {"DIAG1", "change_depth"}, {"DIAG2", "depth"}, {"RC", "outer_1"},
                   {"SDIS", "clearance"}, {"SV1", "first_speed"}, {"SV2", "speed_limit"}, {"SDAC", "sense"},
                   {"FF1", "rough_feed"}, {"FF2", "finish_feed"}, {"SS2", "second_speed"}, {"DIAGM", "catcher"},
                   {"VARI", "variant"}, {"DN", "second_edge"}, {"DMODE", "display"}, {"AMODE", "mode"}}},
                 "SPD,SPL,DIAG2,SDIS"},
    TurningCycle{"CYCLE930", "groove.alternate",
                 {{{"SPD", "nominal"}, {"SPL", "z"}, {"WIDG", "width"}, {"WIDG2", "width_top"}, {"DIAG", "depth"},
                   {"DIAG2", "spare_1"}, {"STA", "slope_angle"}, {"ANG1", "flank_1"}, {"ANG2", "flank_2"},
                   {"RCO1", "outer_1"}, {"RCI1", "inner_1"}, {"RCI2", "inner_2"}, {"RCO2", "outer_2"},
                   {"FAL", "stock"}, {"IDEP1", "step"}, {"SDIS", "clearance"}, {"VARI", "variant"},
                   {"DN", "second_edge"}, {"NUM", "count"}, {"DBH", "group_step"}, {"FF1", "rough_feed"},
                   {"NR", "form"}, {"FALX", "stock_x"}, {"FALZ", "stock_z"}, {"DMODE", "display"},
                   {"AMODE", "mode"}}},
                 "SPD,SPL,DIAG,SDIS,VARI"},
    TurningCycle{"CYCLE93", "groove.shaped",
                 {{{"SPD", "x"}, {"SPL", "z"}, {"WIDG", "width"}, {"DIAG", "depth"}, {"STA1", "slope_angle"},
                   {"ANG1", "flank_1"}, {"ANG2", "flank_2"}, {"RCO1", "outer_1"}, {"RCO2", "outer_2"},
                   {"RCI1", "inner_1"}, {"RCI2", "inner_2"}, {"FAL1", "stock_base"}, {"FAL2", "stock_flank"},
                   {"IDEP", "step"}, {"DTB", "base_dwell"}, {"VARI", "variant"}, {"VRT", "withdrawal"},
                   {"DN", "second_edge"}}},
                 "SPD,SPL,WIDG,DIAG,IDEP,VARI"},
    TurningCycle{"CYCLE94", "relief.shoulder",
                 {{{"SPD", "x"}, {"SPL", "z"}, {"FORM", "form"}, {"VARI", "quadrant"}}}, "SPD,SPL,FORM"},
    TurningCycle{"CYCLE96", "relief.thread",
                 {{{"DIATH", "nominal"}, {"SPL", "z"}, {"FORM", "form"}, {"VARI", "quadrant"}}}, "DIATH,SPL,FORM"},
    TurningCycle{"CYCLE940", "relief.placed",
                 {{{"SPD", "nominal"}, {"SPL", "z"}, {"FORM", "form"}, {"LAGE", "position"}, {"SDIS", "clearance"},
                   {"FFP", "finish_feed"}, {"VARI", "variant"}, {"EPD", "spare_1"}, {"EPL", "spare_2"},
                   {"R1", "spare_3"}, {"R2", "spare_4"}, {"STA", "spare_5"}, {"VRT", "spare_6"}, {"MID", "spare_7"},
                   {"FAL", "spare_8"}, {"FALX", "spare_9"}, {"FALZ", "spare_10"}, {"PITI", "spare_11"},
                   {"PTAB", "spare_12"}, {"PTABA", "spare_13"}, {"DMODE", "display"}, {"AMODE", "spare_14"}}},
                 "SPD,SPL,FORM,LAGE"},
    TurningCycle{"CYCLE95", "stock.contour",
                 {{{"MID", "step"}, {"FALZ", "stock_z"}, {"FALX", "stock_x"}, {"FAL", "stock"}, {"FF1", "rough_feed"},
                   {"FF2", "groove_feed"}, {"FF3", "finish_feed"}, {"VARI", "variant"}, {"DT", "chip_dwell"},
                   {"DAM", "chip_length"}, {"VRT", "withdrawal"}}},
                 "NPP,VARI"},
    TurningCycle{"CYCLE97", "thread.counted",
                 {{{"PIT", "pitch"}, {"MPIT", "size"}, {"SPL", "z"}, {"FPL", "z_end"}, {"DM1", "x"}, {"DM2", "x_end"},
                   {"APP", "run_in"}, {"ROP", "run_out"}, {"TDEP", "depth"}, {"FAL", "finish_stock"},
                   {"IANG", "infeed_angle"}, {"NSP", "start_angle"}, {"NRC", "passes"}, {"NID", "idle"},
                   {"VARI", "variant"}, {"NUMT", "starts"}, {"VRT", "withdrawal"}}},
                 "FPL,DM1,DM2,TDEP,VARI"},
    TurningCycle{"CYCLE98", "thread.chain",
                 {{{"PO1", "z"}, {"DM1", "x"}, {"PO2", "z_2"}, {"DM2", "x_2"}, {"PO3", "z_3"}, {"DM3", "x_3"},
                   {"PO4", "z_end"}, {"DM4", "x_end"}, {"APP", "run_in"}, {"ROP", "run_out"}, {"TDEP", "depth"},
                   {"FAL", "finish_stock"}, {"IANG", "infeed_angle"}, {"NSP", "start_angle"}, {"NRC", "passes"},
                   {"NID", "idle"}, {"PP1", "pitch"}, {"PP2", "pitch_2"}, {"PP3", "pitch_3"}, {"VARI", "variant"},
                   {"NUMT", "starts"}, {"VRT", "withdrawal"}}},
                 "PO1,DM1,PO2,DM2,PO3,DM3,PO4,DM4,TDEP,PP1,PP2,PP3,VARI"},
    TurningCycle{"CYCLE99", "shape.thread",
                 {{{"SPL", "z"}, {"SPD", "nominal"}, {"FPL", "z_end"}, {"FPD", "nominal_end"}, {"APP", "run_in"},
                   {"ROP", "run_out"}, {"TDEP", "depth"}, {"FAL", "finish_stock"}, {"IANG", "infeed_angle"},
                   {"NSP", "start_angle"}, {"NRC", "passes"}, {"NID", "idle"}, {"PIT", "pitch"}, {"VARI", "variant"},
                   {"NUMT", "starts"}, {"SDIS", "withdrawal"}, {"MID", "first_infeed"}, {"GDEP", "change_depth"},
                   {"PIT1", "spare_1"}, {"FDEP", "spare_2"}, {"GST", "first_start"}, {"GUD", "spare_3"},
                   {"IFLANK", "flank_infeed"}, {"PITA", "pitch_unit"}, {"PITM", "spare_4"}, {"PTAB", "spare_5"},
                   {"PTABA", "spare_6"}, {"DMODE", "display"}, {"AMODE", "spare_7"}}},
                 "SPL,SPD,FPL,TDEP,PIT,VARI"},
    TurningCycle{"CYCLE951", "shape.corner",
                 {{{"SPD", "nominal"}, {"SPL", "z"}, {"EPD", "nominal_end"}, {"EPL", "z_end"}, {"ZPD", "spare_1"},
                   {"ZPL", "spare_2"}, {"LAGE", "position"}, {"MID", "step"}, {"FALX", "stock_x"}, {"FALZ", "stock_z"},
                   {"VARI", "variant"}, {"RF1", "spare_3"}, {"RF2", "spare_4"}, {"RF3", "spare_5"},
                   {"SDIS", "clearance"}, {"FF1", "rough_feed"}, {"NR", "spare_6"}, {"DMODE", "display"},
                   {"AMODE", "spare_7"}}},
                 "SPD,SPL,EPD,EPL,LAGE,MID,VARI"},
};
// clang-format on

/// By its own name (capitals), or by the name in the IR; null: none.
inline constexpr const TurningCycle* turning_cycle(std::string_view name) {
  for (const auto& c : turning_cycles) {
    if (c.name == name || c.cycle == name) return &c;
  }
  return nullptr;
}

}  // namespace cnctrans::sinumerik
