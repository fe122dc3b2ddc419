// Numbers without the last bits that sines, cosines and roots leave in them.
#pragma once

#include <cmath>

namespace cnctrans {

/// Rounded to a part of 1, 1e-9 unless said otherwise; never -0.
inline double without_noise(double x, double parts = 1e9) {
  return std::round(x * parts) / parts + 0.0;
}

}  // namespace cnctrans
