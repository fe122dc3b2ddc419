// Affine maps between the work frame and the machine: X Y Z through a matrix, the other axes each for itself.
#pragma once

#include <array>

#include "ir/axis.h"
#include "ir/modal.h"

namespace cnctrans::interpreter {

/// One value per axis: mm (radius) or degrees.
using Axes = std::array<double, ir::axis::count_max>;

struct Frame {
  std::array<std::array<double, 3>, 3> m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Axes d;    ///< factor of the axes from 3 on
  Axes t{};  ///< translation of every axis

  Frame() { d.fill(1); }
  [[nodiscard]] Axes apply(const Axes& p) const;
  [[nodiscard]] bool is_translation() const;  ///< only t differs from the identity
  [[nodiscard]] bool is_identity() const;
  [[nodiscard]] Frame linear_part() const;  ///< without t
  bool operator==(const Frame&) const = default;
};

Frame translation(const Axes& t);
/// By `degrees` from axis u toward axis v (0..2).
Frame rotation(ir::AxisId u, ir::AxisId v, double degrees);
/// `a` after `b`: (a . b)(p) = a(b(p)).
Frame compose(const Frame& a, const Frame& b);
/// False when the frame cannot be turned round (a factor of zero).
bool invert(const Frame& f, Frame& out);

/// What a frame makes of the arcs of a plane.
struct PlaneMap {
  bool circles = false;   ///< the plane maps onto its like and circles stay circles
  bool mirrored = false;  ///< clockwise becomes counter-clockwise
};
PlaneMap plane_map(const Frame& f, ir::Plane plane);

/// sin and cos of degrees, exact at multiples of 30 and 45 where the result is exact.
double sin_degrees(double a);
double cos_degrees(double a);

}  // namespace cnctrans::interpreter
