// Where an axis that rolls over stands when its turns are counted: what an absolute word with a direction means on an
// axis that does not roll over.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "ir/analysis/dataflow.h"
#include "ir/program.h"

namespace cnctrans::ir {

class RotaryPlaces {
 public:
  /// Of a whole program; its statements must have ids. The axes stand at 0 degrees where the main program begins.
  RotaryPlaces(const Program& program, const ModalState& power_on);
  /// The counted position (degrees) to which the word of `axis` leads in the statement; nullopt: the ways to it
  /// disagree, or it is no number.
  [[nodiscard]] std::optional<double> target(std::uint32_t statement, AxisId axis) const;

 private:
  std::map<std::pair<std::uint32_t, AxisId>, double> targets_;
};

}  // namespace cnctrans::ir
