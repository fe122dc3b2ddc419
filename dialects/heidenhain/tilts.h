// PLANE (reference 18.8): the forms and their words.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "dialects/heidenhain/patterns.h"

namespace cnctrans::dialects::heidenhain {

enum class TiltForm : std::uint8_t { spatial, projected, euler, vector, points, relative, axial, reset };
struct TiltRow {
  std::string_view word;
  TiltForm form;
  std::string_view words;  ///< before STAY, TURN or MOVE; one blank between two
};
inline constexpr std::array tilts{
    TiltRow{"SPATIAL", TiltForm::spatial, "SPA SPB SPC"},
    TiltRow{"PROJECTED", TiltForm::projected, "PROPR PROMIN ROT"},
    TiltRow{"EULER", TiltForm::euler, "EULPR EULNU EULROT"},
    TiltRow{"VECTOR", TiltForm::vector, "BX BY BZ NX NY NZ"},
    TiltRow{"POINTS", TiltForm::points, "P1X P1Y P1Z P2X P2Y P2Z P3X P3Y P3Z"},
    TiltRow{"RELATIV", TiltForm::relative, "SPA SPB SPC"},
    TiltRow{"AXIAL", TiltForm::axial, "A B C"},
    TiltRow{"RESET", TiltForm::reset, ""},
};
constexpr const TiltRow* find_tilt(std::string_view word) {
  for (const auto& row : tilts) {
    if (row.word == word) return &row;
  }
  return nullptr;
}

}  // namespace cnctrans::dialects::heidenhain
