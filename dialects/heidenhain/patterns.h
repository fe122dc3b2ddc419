// The figures of PATTERN DEF (reference 15.1).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cnctrans::dialects::heidenhain {

enum class FigureKind : std::uint8_t {
  point,    ///< POS
  row,      ///< points at a distance
  grid,     ///< PAT: row by row, every other row backwards
  frame,    ///< the outer points of a grid, once round
  circle,   ///< evenly round
  segment,  ///< PITCHCIRC: on a circle, by a step or up to an angle
};
struct FigureRow {
  std::string_view word;
  FigureKind kind;
  std::string_view needed;   ///< addresses, one blank between two
  std::string_view allowed;  ///< 0 without them
};
/// The longer one first where one ends with the other.
inline constexpr std::array figures{
    FigureRow{"POS", FigureKind::point, "X Y", "Z"},
    FigureRow{"ROW", FigureKind::row, "X Y D NUM", "ROT Z"},
    FigureRow{"PAT", FigureKind::grid, "X Y DX DY NUMX NUMY", "ROT ROTX ROTY Z"},
    FigureRow{"FRAME", FigureKind::frame, "X Y DX DY NUMX NUMY", "ROT ROTX ROTY Z"},
    FigureRow{"CIRC", FigureKind::circle, "X Y D NUM", "START Z"},
    FigureRow{"PITCHCIRC", FigureKind::segment, "X Y D NUM", "START STEP END Z"},
};
constexpr const FigureRow* find_figure(std::string_view word) {
  for (const auto& f : figures) {
    if (f.word == word) return &f;
  }
  return nullptr;
}
constexpr const FigureRow& figure_row(FigureKind kind) {
  return figures[static_cast<std::size_t>(kind)];
}
/// `word` is one of the words of a list.
constexpr bool in_words(std::string_view list, std::string_view word) {
  while (!list.empty()) {
    const auto blank = list.find(' ') == std::string_view::npos ? list.size() : list.find(' ');
    if (list.substr(0, blank) == word) return true;
    list.remove_prefix(blank == list.size() ? blank : blank + 1);
  }
  return false;
}

}  // namespace cnctrans::dialects::heidenhain
