// From a real number to an integer type, for numbers that come from a text and may be anything.
#pragma once

#include <limits>

namespace cnctrans {

/// `x` without its fraction, or the nearest end of the range of `Int`; 0 for a NaN.
template <class Int>
constexpr Int saturate(double x) {
  if (!(x == x)) return 0;
  constexpr double low = static_cast<double>(std::numeric_limits<Int>::min());
  constexpr double high = static_cast<double>(std::numeric_limits<Int>::max());
  if (x <= low) return std::numeric_limits<Int>::min();
  if (x >= high) return std::numeric_limits<Int>::max();
  return static_cast<Int>(x);
}

}  // namespace cnctrans
