// Sets of axes: one bit an axis.
#pragma once

#include <cstdint>

#include "ir/axis.h"

namespace cnctrans::ir {

using AxisMask = std::uint32_t;

constexpr AxisMask axis_bit(AxisId a) {
  return AxisMask{1} << a;
}

}  // namespace cnctrans::ir
