// The fourth value of Surface: the coordinates of the tool under a transformation whose axes only the machine knows.
// Positions are as programmed; increments count in the frame in force, like on a face or a cylinder.
#pragma once

#include "ir/modal.h"

namespace cnctrans::ir {

inline constexpr auto surface_of_tool = static_cast<Surface>(3);

/// The C axis follows the coordinates.
inline constexpr bool turns_part(Surface s) {
  return s == Surface::face || s == Surface::cylinder;
}

}  // namespace cnctrans::ir
