// Cycles of Q parameters (reference 15, 16): what each is in the IR and its parameters in the order in which the
// control lists them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "dialects/heidenhain/cycle_words.h"
#include "ir/cycle.h"

namespace cnctrans::dialects::heidenhain {

enum class CycleKind : std::uint8_t {
  hole,     ///< ir::HoleCycle of `hole`
  mill,     ///< ir::HoleCycle of kind `mill`, shape `name`
  pattern,  ///< ir::NamedCycle `name`: repeats the cycle in force, at once
  datum,    ///< 247: a row of the preset table
  data,     ///< data for later cycles (20, 270): no motion
  carried   ///< read, not carried: refused where it is called
};
/// What the labels of cycle 14 are to a cycle.
enum class Contours : std::uint8_t {
  none,
  areas,          ///< pockets and islands, with the data of cycle 20
  line,           ///< one line that is followed
  line_in_space,  ///< ... at the heights of its points
  middle_line,    ///< the middle of a slot; the way onto it, APPR, is none of it
  developed       ///< a line on a cylinder
};
struct CycleParameter {
  std::int16_t number;  ///< of the Q parameter; 0: none
  bool needed = true;   ///< false: older programs may leave it out
  double fallback = 0;  ///< the value then
};
struct CycleRow {
  std::int16_t number;
  CycleKind kind;
  ir::HoleKind hole;       ///< of kind `hole`
  std::string_view name;   ///< shape or pattern in the IR
  std::string_view title;  ///< behind the number in the editor
  bool called;             ///< CYCL CALL, M99 and M89 run it; false: the definition acts
  std::array<CycleParameter, 25> parameters;
  Contours contours = Contours::none;  ///< of the labels of cycle 14
};

// clang-format off
inline constexpr std::array cycle_rows{
    CycleRow{200, CycleKind::hole, ir::HoleKind::peck_full, "", "DRILLING", true,
             {{{200}, {201}, {206}, {202}, {210, false}, {203}, {204}, {211, false}, {395, false}}}},
    CycleRow{201, CycleKind::hole, ir::HoleKind::ream, "", "REAMING", true,
             {{{200}, {201}, {206}, {211}, {208}, {203}, {204}}}},
    CycleRow{202, CycleKind::hole, ir::HoleKind::bore_shift, "", "BORING", true,
             {{{200}, {201}, {206}, {211}, {208}, {203}, {204}, {214}, {336, false}}}},
    CycleRow{203, CycleKind::hole, ir::HoleKind::peck_break, "", "UNIVERSAL DRILLING", true,
             {{{200}, {201}, {206}, {202}, {210, false}, {203}, {204}, {212}, {213}, {205}, {211}, {208}, {256, false, 0.2},
               {395, false}}}},
    CycleRow{204, CycleKind::hole, ir::HoleKind::back_bore, "", "BACK BORING", true,
             {{{200}, {249}, {250}, {251}, {252}, {253}, {254}, {255}, {203}, {204}, {214}, {336, false}}}},
    CycleRow{205, CycleKind::hole, ir::HoleKind::peck_full, "", "UNIVERSAL PECKING", true,
             {{{200}, {201}, {206}, {202}, {203}, {204}, {212}, {205}, {258}, {259}, {257}, {256}, {211}, {379, false},
               {253, false, 750}, {208, false, 99999}, {395, false}}}},
    CycleRow{206, CycleKind::hole, ir::HoleKind::tap_floating, "", "TAPPING NEW", true,
             {{{200}, {201}, {206}, {211}, {203}, {204}}}},
    CycleRow{207, CycleKind::hole, ir::HoleKind::tap, "", "RIGID TAPPING NEW", true,
             {{{200}, {201}, {239}, {203}, {204}}}},
    CycleRow{208, CycleKind::mill, ir::HoleKind::mill, "bore.helix", "BORE MILLING", true,
             {{{200}, {201}, {206}, {334}, {203}, {204}, {335}, {342, false}, {351, false, 1}}}},
    CycleRow{209, CycleKind::hole, ir::HoleKind::tap, "", "TAPPING W/ CHIP BRKG", true,
             {{{200}, {201}, {239}, {203}, {204}, {257}, {256}, {336}, {403, false, 1}}}},
    CycleRow{240, CycleKind::hole, ir::HoleKind::drill, "", "CENTERING", true,
             {{{200}, {343}, {201}, {344}, {206}, {211}, {203}, {204}}}},
    CycleRow{241, CycleKind::hole, ir::HoleKind::drill, "", "SINGLE-LIP D.H.DRLNG", true,
             {{{200}, {201}, {206}, {211}, {203}, {204}, {379}, {253}, {208}, {426}, {427}, {428}, {429}, {430},
               {435, false}}}},
    CycleRow{251, CycleKind::mill, ir::HoleKind::mill, "pocket.rect", "RECTANGULAR POCKET", true,
             {{{215}, {218}, {219}, {220}, {368}, {224}, {367}, {207}, {351}, {201}, {202}, {369}, {206}, {338}, {200},
               {203}, {204}, {370}, {366}, {385, false}}}},
    CycleRow{252, CycleKind::mill, ir::HoleKind::mill, "pocket.circle", "CIRCULAR POCKET", true,
             {{{215}, {223}, {368}, {207}, {351}, {201}, {202}, {369}, {206}, {338}, {200}, {203}, {204}, {370}, {366},
               {385, false}}}},
    CycleRow{253, CycleKind::mill, ir::HoleKind::mill, "slot.radial", "SLOT MILLING", true,
             {{{215}, {218}, {219}, {368}, {374}, {367}, {207}, {351}, {201}, {202}, {369}, {206}, {338}, {200}, {203},
               {204}, {366}, {385, false}, {439, false}}}},
    CycleRow{254, CycleKind::mill, ir::HoleKind::mill, "slot.ring", "CIRCULAR SLOT", true,
             {{{215}, {219}, {368}, {375}, {367}, {216}, {217}, {376}, {248}, {378}, {377}, {207}, {351}, {201}, {202},
               {369}, {206}, {338}, {200}, {203}, {204}, {366}, {385, false}, {439, false}}}},
    CycleRow{256, CycleKind::mill, ir::HoleKind::mill, "boss.rect", "RECTANGULAR STUD", true,
             {{{218}, {424}, {219}, {425}, {220}, {368}, {224}, {367}, {207}, {351}, {201}, {202}, {206}, {200}, {203},
               {204}, {370}, {437, false}}}},
    CycleRow{257, CycleKind::mill, ir::HoleKind::mill, "boss.circle", "CIRCULAR STUD", true,
             {{{223}, {222}, {368}, {207}, {351}, {201}, {202}, {206}, {200}, {203}, {204}, {370}, {376, false}}}},
    CycleRow{210, CycleKind::mill, ir::HoleKind::mill, "pocket.rect", "SLOT RECIP. PLNG", true,
             {{{200}, {201}, {207, false}, {202, false}, {215, false}, {203, false}, {204, false}, {216, false},
               {217, false}, {218, false}, {219, false}, {224, false}, {338, false}, {206, false}}}},
    CycleRow{211, CycleKind::mill, ir::HoleKind::mill, "slot.ring", "CIRCULAR SLOT", true,
             {{{200}, {201}, {207, false}, {202, false}, {215, false}, {203, false}, {204, false}, {216, false},
               {217, false}, {244, false}, {219, false}, {245, false}, {248, false}, {338, false}, {206, false}}}},
    CycleRow{212, CycleKind::mill, ir::HoleKind::mill, "pocket.rect", "POCKET FINISHING", true,
             {{{200}, {201}, {206, false}, {202, false}, {207, false}, {203, false}, {204, false}, {216, false},
               {217, false}, {218, false}, {219, false}, {220, false}, {221, false}}}},
    CycleRow{213, CycleKind::mill, ir::HoleKind::mill, "boss.rect", "STUD FINISHING", true,
             {{{200}, {201}, {206, false}, {202, false}, {207, false}, {203, false}, {204, false}, {216, false},
               {217, false}, {218, false}, {219, false}, {220, false}, {221, false}}}},
    CycleRow{214, CycleKind::mill, ir::HoleKind::mill, "pocket.circle", "C. POCKET FINISHING", true,
             {{{200}, {201}, {206, false}, {202, false}, {207, false}, {203, false}, {204, false}, {216, false},
               {217, false}, {222, false}, {223, false}}}},
    CycleRow{215, CycleKind::mill, ir::HoleKind::mill, "boss.circle", "C. STUD FINISHING", true,
             {{{200}, {201}, {206, false}, {202, false}, {207, false}, {203, false}, {204, false}, {216, false},
               {217, false}, {222, false}, {223, false}}}},
    CycleRow{262, CycleKind::mill, ir::HoleKind::mill, "thread.helix", "THREAD MILLING", true,
             {{{335}, {239}, {201}, {355}, {253}, {351}, {200}, {203}, {204}, {207}, {512, false}}}},
    CycleRow{263, CycleKind::mill, ir::HoleKind::mill, "thread.helix", "THREAD MLLNG/CNTSNKG", true,
             {{{335}, {239}, {201}, {356}, {253}, {351}, {200}, {357}, {358}, {359}, {203}, {204}, {254}, {207},
               {512, false}}}},
    CycleRow{264, CycleKind::mill, ir::HoleKind::mill, "thread.helix", "THREAD DRILLNG/MLLNG", true,
             {{{335}, {239}, {201}, {356}, {253}, {351}, {202}, {258}, {257}, {256}, {358}, {359}, {200}, {203}, {204},
               {206}, {207}, {512, false}}}},
    CycleRow{265, CycleKind::mill, ir::HoleKind::mill, "thread.helix", "HEL.THREAD DRLG/MLG", true,
             {{{335}, {239}, {201}, {253}, {358}, {359}, {360}, {200}, {203}, {204}, {254}, {207}}}},
    CycleRow{267, CycleKind::mill, ir::HoleKind::mill, "thread.helix", "OUTSIDE THREAD MLLNG", true,
             {{{335}, {239}, {201}, {355}, {253}, {351}, {200}, {358}, {359}, {203}, {204}, {254}, {207},
               {512, false}}}},
    CycleRow{220, CycleKind::pattern, ir::HoleKind::drill, "points.ring", "POLAR PATTERN", false,
             {{{216}, {217}, {244}, {245}, {246}, {247}, {241}, {200}, {203}, {204}, {301, false}, {365, false}}}},
    CycleRow{221, CycleKind::pattern, ir::HoleKind::drill, "points.grid", "CARTESIAN PATTERN", false,
             {{{225}, {226}, {237}, {238}, {242}, {243}, {224}, {200}, {203}, {204}, {301, false}}}},
    CycleRow{230, CycleKind::mill, ir::HoleKind::mill, "face", "MULTIPASS MILLING", true,
             {{{225}, {226}, {227}, {218}, {219}, {240}, {206}, {207}, {209}, {200}}}},
    CycleRow{231, CycleKind::mill, ir::HoleKind::mill, "", "RULED SURFACE", true,
             {{{225}, {226}, {227}, {228}, {229}, {230}, {231}, {232}, {233}, {234}, {235}, {236}, {240}, {207}}}},
    CycleRow{232, CycleKind::mill, ir::HoleKind::mill, "face", "FACE MILLING", true,
             {{{389}, {225}, {226}, {227}, {386}, {218}, {219}, {202}, {369}, {370}, {207}, {385}, {253}, {200}, {357},
               {204}}}},
    CycleRow{247, CycleKind::datum, ir::HoleKind::drill, "", "DATUM SETTING", false, {{{339}}}},
    CycleRow{20, CycleKind::data, ir::HoleKind::mill, "", "CONTOUR DATA", false,
             {{{1}, {2}, {3}, {4}, {5}, {6}, {7}, {8}, {9}}}},
    CycleRow{21, CycleKind::mill, ir::HoleKind::mill, "pocket.entries", "PILOT DRILLING", true,
             {{{10}, {11}, {13}}}, Contours::areas},
    CycleRow{22, CycleKind::mill, ir::HoleKind::mill, "pocket.contour", "ROUGH-OUT", true,
             {{{10}, {11}, {12}, {18, false}, {19, false}, {208, false}, {401, false, 100}, {404, false}}},
             Contours::areas},
    CycleRow{23, CycleKind::mill, ir::HoleKind::mill, "pocket.contour", "FLOOR FINISHING", true,
             {{{11}, {12}, {208, false}}}, Contours::areas},
    CycleRow{24, CycleKind::mill, ir::HoleKind::mill, "pocket.contour", "SIDE FINISHING", true,
             {{{9}, {10}, {11}, {12}, {14}, {438, false, -1}}}, Contours::areas},
    CycleRow{25, CycleKind::mill, ir::HoleKind::mill, "path", "CONTOUR TRAIN", true,
             {{{1}, {3}, {5}, {7}, {10}, {11}, {12}, {15}, {18, false}, {446, false, 0.01}, {447, false, 10},
               {448, false, 2}}}, Contours::line},
    CycleRow{275, CycleKind::mill, ir::HoleKind::mill, "pocket.contour", "TROCHOIDAL SLOT", true,
             {{{215}, {219}, {368}, {436}, {207}, {351}, {201}, {202}, {206}, {338}, {385}, {200}, {203}, {204},
               {366, false}}}, Contours::middle_line},
    CycleRow{276, CycleKind::mill, ir::HoleKind::mill, "path", "THREE-D CONT. TRAIN", true,
             {{{1}, {3}, {7}, {10}, {11}, {12}, {15}, {18, false}, {446, false, 0.01}, {447, false, 10},
               {448, false, 2}}}, Contours::line_in_space},
    CycleRow{27, CycleKind::mill, ir::HoleKind::mill, "", "CYLINDER SURFACE", true,
             {{{1}, {3}, {6}, {10}, {11}, {12}, {16}, {17}}}, Contours::developed},
    CycleRow{28, CycleKind::mill, ir::HoleKind::mill, "", "CYLINDRICAL SURFACE", true,
             {{{1}, {3}, {6}, {10}, {11}, {12}, {16}, {17}, {20}, {21, false}}}, Contours::developed},
    CycleRow{270, CycleKind::data, ir::HoleKind::mill, "", "CONTOUR TRAIN DATA", false,
             {{{390}, {391}, {392}, {393}, {394}}}},
};
// clang-format on

/// nullptr: no cycle of Q parameters has this number, or none that is in the table.
constexpr const CycleRow* find_cycle(std::int64_t number) {
  for (const auto& row : cycle_rows) {
    if (row.number == number) return &row;
  }
  return nullptr;
}
constexpr const CycleParameter* find_parameter(const CycleRow& row, std::int64_t q) {
  for (const auto& p : row.parameters) {
    if (p.number == q && q != 0) return &p;
  }
  return nullptr;
}

}  // namespace cnctrans::dialects::heidenhain
