// Axes whose words move each other: a statement kept as text makes two axes change places for the moves behind it. The
// IR names the axis that moves, so every word behind such a statement is given the other axis; done a second time, the
// words are as they were, which is how a program is written back.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "ir/program.h"

namespace cnctrans::ir::passes {

/// What one statement does to the pairs in force.
struct AxisExchange {
  std::vector<std::pair<AxisId, AxisId>> pairs;  ///< change places from here on
  std::vector<AxisId> ends;                      ///< the pairs of these axes end
};
/// nullopt: the statement exchanges nothing.
using ReadExchange = std::function<std::optional<AxisExchange>(const Statement&)>;

enum class ExchangeFault : std::uint8_t {
  unsure,    ///< whether the axes are exchanged depends on the way that leads to the statement
  not_said,  ///< what the statement does with exchanged axes is not settled (arcs, frames, cycles, angles)
  twice,     ///< the statement exchanges an axis that is exchanged already
  outside    ///< a routine that is not at hand is called while axes are exchanged
};
/// A statement that can't be rewritten; it is left as it is.
using TellExchange = std::function<void(Statement&, ExchangeFault)>;
/// A block was given other axes.
using TellExchanged = std::function<void(Statement&)>;

/// True when the program exchanges axes at all. Ids are given anew (number_statements).
bool exchange_axes(Program& program, const ReadExchange& read, const TellExchange& fault, const TellExchanged& done);

}  // namespace cnctrans::ir::passes
