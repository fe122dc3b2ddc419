// The points of the path where they are numbers, and words for points that a pass has computed.
#pragma once

#include <map>
#include <optional>

#include "ir/geometry/geometry.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// An element of the path and the plane it lies in. Radius on a diameter axis.
struct Path {
  Plane plane = Plane::xy;
  geometry::Element e;
};

class PathPoints {
 public:
  PathPoints(const LegaliseContext& context, const FactsOf& facts) : context_(context), facts_(facts) {}
  /// The programmed points of a line or arc, as far as they are numbers; `by_three`: also of an arc by three points,
  /// whose words set_end and set_centre don't take over.
  [[nodiscard]] std::optional<Path> path_of(const Statement& s, bool by_three = false) const;
  /// Both words of the plane, absolute and as radius; the other words stay.
  void set_end(Motion& m, Plane plane, geometry::Vec to) const;
  /// The element begins here and no longer where the one before it was programmed to end: a corner has cut it.
  void begins_at(const Statement& s, geometry::Vec at) { starts_[s.id] = at; }
  /// The centre as seen from the start of the arc.
  static void set_centre(Motion& m, Plane plane, geometry::Vec from, geometry::Vec centre);

 private:
  /// The point of an arc by three points that lies between its ends.
  [[nodiscard]] std::optional<geometry::Vec> through(const Block& b, const Facts& facts, const PlaneAxes& axes,
                                                     geometry::Vec start) const;
  const LegaliseContext& context_;
  const FactsOf& facts_;
  std::map<std::uint32_t, geometry::Vec> starts_;  ///< by the id of the statement
};

/// The frame or the work offset changes in this block.
bool moves_frames(const Block& b);

}  // namespace cnctrans::ir::passes
