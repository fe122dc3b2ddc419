// Dimensions of standard undercuts, in mm: DIN 509:1998 (forms E and F) and DIN 76-1:2004 (thread undercuts A to D).
#pragma once

#include <array>

namespace cnctrans::ir::cycles {

/// Forms E and F (DIN 509, table 1): by the finished diameter.
struct ShoulderRelief {
  double up_to;   ///< largest diameter
  double radius;  ///< r
  double depth;   ///< t1, below the cylinder
  double length;  ///< f, from the face to where the entry slope leaves the cylinder
  double face;    ///< t2, form F: into the face
};
inline constexpr std::array shoulder_reliefs = {
    ShoulderRelief{1.6, 0.1, 0.1, 0.5, 0.1}, ShoulderRelief{3, 0.2, 0.1, 1, 0.1},
    ShoulderRelief{10, 0.4, 0.2, 2, 0.1},    ShoulderRelief{18, 0.6, 0.2, 2, 0.1},
    ShoulderRelief{80, 0.6, 0.3, 2.5, 0.2},  ShoulderRelief{1e9, 1, 0.4, 4, 0.3},
};
inline constexpr double shoulder_slope = 15;  ///< degrees, between cylinder and undercut
inline constexpr double face_slope = 8;       ///< degrees, form F

/// Forms A to D (DIN 76-1, tables 1 and 2): by the pitch. A and B outside, C and D inside; B and D are the short ones.
struct ThreadRelief {
  double pitch;
  double radius;      ///< r
  double less;        ///< nominal diameter minus that of the undercut outside
  double more;        ///< diameter of the undercut inside minus the nominal one
  double a, b, c, d;  ///< g2, from the face to where the slope leaves the thread
};
inline constexpr std::array thread_reliefs = {
    ThreadRelief{0.5, 0.2, 0.8, 0.3, 1.75, 1.25, 2.7, 2},    ThreadRelief{0.6, 0.4, 1, 0.3, 2.1, 1.5, 3.3, 2.4},
    ThreadRelief{0.7, 0.4, 1.1, 0.3, 2.45, 1.75, 3.8, 2.75}, ThreadRelief{0.75, 0.4, 1.2, 0.3, 2.6, 1.9, 4, 2.9},
    ThreadRelief{0.8, 0.4, 1.3, 0.3, 2.8, 2, 4.2, 3},        ThreadRelief{1, 0.6, 1.6, 0.5, 3.5, 2.5, 5.2, 3.7},
    ThreadRelief{1.25, 0.6, 2, 0.5, 4.4, 3.2, 6.7, 4.9},     ThreadRelief{1.5, 0.8, 2.3, 0.5, 5.2, 3.8, 7.8, 5.6},
    ThreadRelief{1.75, 1, 2.6, 0.5, 6.1, 4.3, 9.1, 6.4},     ThreadRelief{2, 1, 3, 0.5, 7, 5, 10.3, 7.3},
    ThreadRelief{2.5, 1.2, 3.6, 0.5, 8.7, 6.3, 13, 9.3},     ThreadRelief{3, 1.6, 4.4, 0.5, 10.5, 7.5, 15.2, 10.7},
    ThreadRelief{3.5, 1.6, 5, 0.5, 12, 9, 17.7, 12.7},       ThreadRelief{4, 2, 5.7, 0.5, 14, 10, 20, 14},
    ThreadRelief{4.5, 2, 6.4, 0.5, 16, 11, 23, 16},          ThreadRelief{5, 2.5, 7, 0.5, 17.5, 12.5, 26, 18.5},
    ThreadRelief{5.5, 3.2, 7.7, 0.5, 19, 14, 28, 20},        ThreadRelief{6, 3.2, 8.3, 0.5, 21, 15, 30, 21},
};
inline constexpr double thread_slope = 30;  ///< degrees, between thread and undercut

}  // namespace cnctrans::ir::cycles
