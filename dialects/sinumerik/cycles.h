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
/// Place of a parameter in the call, or -1.
int parameter_index(const CycleRow& row, std::string_view name);

}  // namespace cnctrans::sinumerik
