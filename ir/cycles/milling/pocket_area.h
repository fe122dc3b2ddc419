// The area of a pocket with islands, and the places in it that a tool of a given radius reaches. Polygons stand for
// arcs within a tolerance; a way along the wall gets its exact lines and arcs back.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ir/cycles/milling/mill_contour.h"

namespace cnctrans::ir::cycles {

/// A closed way, its elements head to tail, mm. One element alone is a full circle.
using PocketWay = std::vector<MillElement>;
/// The same way in the opposite sense.
PocketWay reversed(const PocketWay& way);
/// The same way from the point that is `at` (0 to 1) along its element `index`.
PocketWay started_at(const PocketWay& way, std::size_t index, double at);
/// Length of an element, mm, and the point `at` (0 to 1) along it.
double length_of(const MillElement& e);
struct PocketPoint {
  double u = 0, v = 0;
};
PocketPoint point_on(const MillElement& e, double at);

struct PocketPolygons;  ///< of one connected piece

/// One connected piece of the area. The piece lies on the left of its ways.
struct PocketPiece {
  PocketWay outside;
  std::vector<PocketWay> islands;
  std::shared_ptr<const PocketPolygons> polygons;
};
/// The point lies in the piece, or the straight line does, the edge included.
bool contains(const PocketPiece& piece, double u, double v);
bool passes(const PocketPiece& piece, PocketPoint from, PocketPoint to);
/// Parallel lines at `degrees` to the first axis, at equal distances not above `step`, cut off at the edge; in the
/// order of a boustrophedon.
std::vector<MillElement> stripes(const PocketPiece& piece, double degrees, double step);

class PocketArea {
 public:
  /// The contours are closed ways without a crossing of their own. Outside is the largest, or the first one; the others
  /// are islands as far as they lie in it. `tolerance`: mm between an arc and the polygon that stands for it.
  /// nullopt with a sentence.
  static std::optional<PocketArea> of(const std::vector<MillContour>& contours, bool first_is_outside, double tolerance,
                                      std::string* error);

  /// What closed contours cover together, or (`common`) each of them.
  static std::optional<PocketArea> joined(const std::vector<MillContour>& contours, bool common, double tolerance,
                                          std::string* error);

  [[nodiscard]] bool outside_ccw() const;  ///< as it is programmed
  [[nodiscard]] bool overlap() const;      ///< contours cross each other
  /// The places at least `distance` (0 or more) from every wall.
  [[nodiscard]] std::vector<PocketPiece> inside(double distance) const;
  /// What a tool of this radius that goes along `ways` leaves of what it reaches from the piece: closed ways round it,
  /// which a tool's middle may go. What is thinner than some tolerances does not count.
  [[nodiscard]] std::vector<PocketWay> left_over(const PocketPiece& piece, const std::vector<PocketWay>& ways,
                                                 double radius) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace cnctrans::ir::cycles
