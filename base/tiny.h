// Where lengths in mm and angles in degrees end and the errors of arithmetic begin.
#pragma once

namespace cnctrans {

inline constexpr double tiny = 1e-9;

}  // namespace cnctrans
