// Cycles of numbered parts (reference 16.y, 18, 19): `CYCL DEF 7.0 DATUM SHIFT` / `CYCL DEF 7.1 X+60`. The words behind
// the numbers are in the language of the control's screen: only their place counts.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cnctrans::dialects::heidenhain {

enum class OldKind : std::uint8_t {
  pecking,
  tapping,
  slot,
  pocket,
  round_pocket,
  datum_shift,
  mirror,
  dwell,
  rotation,
  scale,
  program,      ///< 12: a program becomes the machining cycle
  orientation,  ///< 13: the angle for M19 and M20
  contour,      ///< 14: labels of the contours
  rigid_tapping,
  thread,
  working_plane,
  axis_scale,
  point_file,  ///< 30
  tolerance    ///< 32
};
struct OldPart {
  std::string_view word;  ///< as the editor writes it; empty: there is no such part
};
struct OldCycle {
  std::int16_t number;
  OldKind kind;
  std::string_view title;        ///< behind n.0
  bool called;                   ///< CYCL CALL, M99 and M89 run it
  std::array<OldPart, 6> parts;  ///< n.1 to n.6
};
// clang-format off
inline constexpr std::array old_cycles{
    OldCycle{1, OldKind::pecking, "PECKING", true, {{{"SET UP"}, {"DEPTH"}, {"PECKG"}, {"DWELL"}, {"F"}}}},
    OldCycle{2, OldKind::tapping, "TAPPING", true, {{{"SET UP"}, {"DEPTH"}, {"DWELL"}, {"F"}}}},
    OldCycle{3, OldKind::slot, "SLOT MILLING", true, {{{"SET UP"}, {"DEPTH"}, {"PECKG"}, {"X"}, {"Y"}, {"F"}}}},
    OldCycle{4, OldKind::pocket, "POCKET MILLING", true, {{{"SET UP"}, {"DEPTH"}, {"PECKG"}, {"X"}, {"Y"}, {"F"}}}},
    OldCycle{5, OldKind::round_pocket, "CIRCULAR POCKET", true,
             {{{"SET UP"}, {"DEPTH"}, {"PECKG"}, {"RADIUS"}, {"F"}}}},
    OldCycle{7, OldKind::datum_shift, "DATUM SHIFT", false, {{{"X"}, {"Y"}, {"Z"}}}},
    OldCycle{8, OldKind::mirror, "MIRROR IMAGE", false, {{{"X"}}}},
    OldCycle{9, OldKind::dwell, "DWELL TIME", false, {{{"DWELL"}}}},
    OldCycle{10, OldKind::rotation, "ROTATION", false, {{{"ROT"}}}},
    OldCycle{11, OldKind::scale, "SCALING FACTOR", false, {{{"SCL"}}}},
    OldCycle{12, OldKind::program, "PGM CALL", true, {{{"PGM"}}}},
    OldCycle{13, OldKind::orientation, "ORIENTATION", false, {{{"ANGLE"}}}},
    OldCycle{14, OldKind::contour, "CONTOUR GEOMETRY", false, {{{"CONTOUR LABEL"}}}},
    OldCycle{17, OldKind::rigid_tapping, "RIGID TAPPING", true, {{{"SET UP"}, {"DEPTH"}, {"PITCH"}}}},
    OldCycle{18, OldKind::thread, "THREAD CUTTING", true, {{{"DEPTH"}, {"PITCH"}}}},
    OldCycle{19, OldKind::working_plane, "WORKING PLANE", false, {{{"A"}}}},
    OldCycle{26, OldKind::axis_scale, "AXIS-SPEC. SCALING", false, {{{"X"}}}},
    OldCycle{30, OldKind::point_file, "RUN 3-D DATA", true, {}},
    OldCycle{32, OldKind::tolerance, "TOLERANCE", false, {{{"T"}, {"HSC-MODE"}}}},
};
// clang-format on

constexpr const OldCycle* find_old_cycle(std::int64_t number) {
  for (const auto& c : old_cycles) {
    if (c.number == number) return &c;
  }
  return nullptr;
}

}  // namespace cnctrans::dialects::heidenhain
