// Standard cycles: parameter names in call order (reference-language 18). Names are those printed there, without
// leading underscores.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace cnctrans::sinumerik {

enum class CycleFamily : std::uint8_t { drilling, pattern, milling, turning, swivel, measuring };

struct CycleRow {
  std::string_view name;  ///< "CYCLE81"
  CycleFamily family;
  bool carried;                 ///< has a node in the IR
  std::string_view parameters;  ///< separated by one comma each
};
std::span<const CycleRow> cycles();
/// Capitals; null when it is no standard cycle.
const CycleRow* cycle(std::string_view capitals);
/// A position pattern (18.2) and its parameters in ir/cycles/pattern, in call order; what is not there has no place.
struct PatternRow {
  std::string_view name;        ///< "HOLES1"
  std::string_view pattern;     ///< "points.row"
  std::string_view parameters;  ///< separated by one comma each
};
std::span<const PatternRow> patterns();
/// CYCLE802: one digit a point in the first two parameters; 1: an absolute coordinate (18.2).
inline constexpr double all_absolute = 111111111;
inline constexpr std::string_view every_place_absolute = "111111111,111111111,";
/// Pitch in mm of the metric coarse thread of a size (8 for M8); 0: no such size.
double coarse_pitch(double size);
/// Place of a parameter in the call, or -1.
int parameter_index(const CycleRow& row, std::string_view name);
int parameter_index(std::string_view parameters, std::string_view name);

}  // namespace cnctrans::sinumerik
