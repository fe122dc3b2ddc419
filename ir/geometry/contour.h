// Contours whose points are not written: lines and arcs given by angle, centre, radius, tangency and intersection.
// Shared by the interpreter and by the pass that writes the points out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/block.h"
#include "ir/geometry/geometry.h"

namespace cnctrans::ir::contour {

/// How the end point of an element is found: given (or by its own words), or from the element that follows.
enum class ElementEnd : std::uint8_t { given, secant, tangent };
/// Which of two points that fit: the one with the greater (plus) or smaller (minus) first coordinate of the plane.
enum class Branch : std::uint8_t { none, plus, minus };

/// A block carries them as marked words beside its motion.
namespace mark {
inline constexpr std::string_view secant = "ES", tangent = "ET", plus = "E+", minus = "E-";
}
struct Marks {
  ElementEnd end = ElementEnd::given;
  Branch branch = Branch::none;
  [[nodiscard]] bool any() const { return end != ElementEnd::given || branch != Branch::none; }
};
inline Marks marks_of(const Block& b) {
  Marks m;
  for (const auto& a : b.actions) {
    const auto* w = std::get_if<OpaqueWord>(&a.data);
    if (w == nullptr) continue;
    if (w->word == mark::secant) m.end = ElementEnd::secant;
    if (w->word == mark::tangent) m.end = ElementEnd::tangent;
    if (w->word == mark::plus) m.branch = Branch::plus;
    if (w->word == mark::minus) m.branch = Branch::minus;
  }
  return m;
}

/// A point of the plane, mm (a diameter axis as radius).
using Point = geometry::Vec;

/// What is written of one element. Of a line: its direction; of an arc: sense, centre, radius.
struct Element {
  bool arc = false, ccw = false;
  std::optional<double> u, v;   ///< end point
  std::optional<double> angle;  ///< degrees from the first axis of the plane, in the direction of travel
  std::optional<Point> centre;
  std::optional<double> radius;  ///< above 0; an arc by its radius alone turns less than 180 degrees
  ElementEnd end = ElementEnd::given;
  Branch branch = Branch::none;
};

struct Solved {
  Point from, to, centre;
};
struct Result {
  bool ok = false;
  bool chosen = false;  ///< several contours fit and no branch is written: the nearest one was taken
  std::string error;
  std::vector<Solved> elements;
};

/// Elements whose end may follow from the next one in a row.
inline constexpr std::size_t longest = 4;

/// The contour from `start` on; the last element's end must be given. `tolerance` (mm): how far radii and tangent
/// points may miss each other. Never throws.
Result solve(Point start, const std::vector<Element>& elements, double tolerance);

}  // namespace cnctrans::ir::contour
