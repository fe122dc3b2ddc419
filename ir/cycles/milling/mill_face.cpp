// Face milling of a rectangle in parallel passes.
#include <algorithm>
#include <cmath>
#include <utility>

#include "ir/cycles/milling/mill_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

/// Passes along p from `from` to `to`, one beside the other in q.
struct Passes {
  double from = 0, to = 0;
  std::vector<double> places;  ///< in q
  bool swapped = false;        ///< p and q are the second and the first axis of the shape
  void rapid(MillPath& path, double p, double q) const { swapped ? path.rapid(q, p) : path.rapid(p, q); }
  void mill(MillPath& path, double p, double q) const { swapped ? path.mill(q, p) : path.mill(p, q); }
};

void level(MillPath& path, const Passes& passes, bool one_way, double w) {
  double at = passes.from, other = passes.to;
  for (std::size_t k = 0; k < passes.places.size(); ++k) {
    const double q = passes.places[k];
    if (k == 0 || one_way) {
      passes.rapid(path, at, q);
      path.rapid_to(w);  // beside the part
    } else {
      passes.mill(path, at, q);
    }
    passes.mill(path, other, q);
    if (one_way)
      path.rapid_to(path.levels().reference);
    else
      std::swap(at, other);
  }
}

}  // namespace

bool face(MillPath& path, std::string* error) {
  const double length = path.get("length"), width = path.get("width");
  const auto way = static_cast<int>(std::lround(path.get("variant"))) / 10 % 10;
  const Operation operation = path.operation(error);
  const double step = path.step(usual_step, error);
  if (way < 1 || way > 4) *error = "the way of the passes is 1 to 4 (tens of the variant)";
  if (std::abs(length) < least_mm || std::abs(width) < least_mm) *error = "a face needs its two sizes";
  if (!error->empty()) return false;
  const auto& n = path.levels();
  const double stock = std::abs(path.get("floor_stock"));
  const double bottom = operation == Operation::rough ? n.bottom + n.up * stock : n.bottom;
  auto depths = operation == Operation::rough ? path.depths(n.surface, bottom) : std::vector<double>{bottom};
  if (depths.empty()) return *error = "the face has no height to be taken away", false;
  const auto [u, v] = path.place();
  path.frame(u, v, path.get("angle"));
  // The corner nearest to the tool; the one that is dimensioned when several are, or where the cycle says so.
  const bool dimensioned = path.get("from_dimension") != 0;
  const auto [tool_p, tool_q] = dimensioned ? std::pair{0.0, 0.0} : path.local();
  const bool far_p = !dimensioned && std::abs(tool_p - length) < std::abs(tool_p) - least_mm;
  const bool far_q = !dimensioned && std::abs(tool_q - width) < std::abs(tool_q) - least_mm;
  Passes passes;
  passes.swapped = way == 2 || way == 4;
  double along = length, across = width;
  bool along_far = far_p, across_far = far_q;
  if (passes.swapped) {
    std::swap(along, across);
    std::swap(along_far, across_far);
  }
  const double r = path.tool_radius(), beyond = std::abs(path.get("overrun")) + r;
  const double to_plus = along > 0 ? 1 : -1;
  passes.from = -to_plus * beyond;
  passes.to = along + to_plus * beyond;
  if (along_far) std::swap(passes.from, passes.to);
  const double total = std::abs(across) + std::abs(path.get("overrun_across"));
  const auto count = path.times(total / step);
  for (long k = 1; k <= count; ++k) {
    const double in = total * static_cast<double>(k) / static_cast<double>(count) - r;  // from the nearer edge
    const double q = across_far ? std::abs(across) - in : in;
    passes.places.push_back(across > 0 ? q : -q);
  }
  if (passes.swapped)
    path.approach(passes.places.front(), passes.from);
  else
    path.approach(passes.from, passes.places.front());
  for (const double w : depths) {
    path.rapid_to(n.reference);
    level(path, passes, way <= 2, w);
  }
  path.retract();
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
