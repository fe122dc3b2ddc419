// What holds at the start of a subprogram that nothing of the program calls.
#pragma once

#include "ir/dataflow.h"

namespace cnctrans::ir {

enum class Uncalled : std::uint8_t {
  unknown,  ///< nothing: its callers are not at hand
  power_on  ///< the state of power-on is assumed
};

/// As analyse(program, power_on), which takes `Uncalled::unknown`.
FactTable analyse(const Program& program, const ModalState& power_on, Uncalled uncalled);

}  // namespace cnctrans::ir
