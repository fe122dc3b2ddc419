// The cycles of a lathe that a run has carried out, beside its trace: for who compares two of them by what they leave.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "ir/modal.h"

namespace cnctrans::interpreter {

/// A point in the plane of X (radius) and Z, mm of the machine.
struct CyclePoint {
  double x = 0, z = 0;
};
/// One run of a cycle that belongs to a family (ir/cycles/machining.h).
struct CycleRun {
  std::string_view family;
  std::uint64_t first = 0, last = 0;  ///< its events: from `first` up to, not including, `last`
  /// Of stock removal: the contours that it comes down to, as points less than 0.001 mm from the arcs between them;
  /// empty: it has none.
  std::vector<CyclePoint> rough, finish;
  bool face = false;        ///< passes along X
  double out = 1;           ///< sense of X (with `face`: of Z) that leads away from the part
  bool comparable = false;  ///< the frame keeps the two axes: what stands above is right
  /// Of a pocket: the plane in which it lies, the radius of the tool, and where the material begins, mm of the machine.
  /// Of a tap: `radius` is -1 for a left-hand thread, else 1; `surface` is its reference plane.
  ir::Plane plane = ir::Plane::xy;
  double radius = 0, surface = 0;
};

}  // namespace cnctrans::interpreter
