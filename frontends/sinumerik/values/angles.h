// Angles of the language are in degrees.
#pragma once

namespace cnctrans::sinumerik {

inline constexpr double degrees = 180 / 3.14159265358979323846;  ///< of one radian

}  // namespace cnctrans::sinumerik
