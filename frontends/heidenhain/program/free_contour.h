// Free contours (reference 7.1): elements by whatever the drawing says, solved one behind the other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frontends/heidenhain/state/flat.h"
#include "ir/geometry/geometry.h"

namespace cnctrans::frontends::heidenhain {

struct FreeResult {
  std::string error;                            ///< empty: solved
  std::size_t at = 0;                           ///< the element that the error is about
  std::vector<ir::geometry::Element> elements;  ///< one for each
};
/// `start` and `direction`: of the tool before the first element. The poles (FPOL) are in the elements.
FreeResult solve_free_contour(const std::vector<FreeElement>& elements, ir::geometry::Vec start,
                              std::optional<ir::geometry::Vec> direction);

}  // namespace cnctrans::frontends::heidenhain
