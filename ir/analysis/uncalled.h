// What holds at the start of a subprogram that nothing of the program calls.
#pragma once

#include <cstdint>

namespace cnctrans::ir {

enum class Uncalled : std::uint8_t {
  unknown,  ///< nothing: its callers are not at hand
  power_on  ///< the state of power-on is assumed
};

}  // namespace cnctrans::ir
