// The points of the path where they are numbers, and words for points that a pass has computed.
#pragma once

#include <optional>

#include "ir/geometry.h"
#include "ir/passes/facts.h"
#include "ir/passes/legalise.h"

namespace cnctrans::ir::passes {

/// An element of the path and the plane it lies in. Radius on a diameter axis.
struct Path {
  Plane plane = Plane::xy;
  geometry::Element e;
};

class PathPoints {
 public:
  PathPoints(const LegaliseContext& context, const FactsOf& facts) : context_(context), facts_(facts) {}
  /// The programmed points of a plain line or arc, as far as they are numbers.
  [[nodiscard]] std::optional<Path> path_of(const Statement& s) const;
  /// Both words of the plane, absolute and as radius; the other words stay.
  void set_end(Motion& m, Plane plane, geometry::Vec to) const;
  /// The centre as seen from the start of the arc.
  static void set_centre(Motion& m, Plane plane, geometry::Vec from, geometry::Vec centre);

 private:
  const LegaliseContext& context_;
  const FactsOf& facts_;
};

/// The frame or the work offset changes in this block.
bool moves_frames(const Block& b);

}  // namespace cnctrans::ir::passes
