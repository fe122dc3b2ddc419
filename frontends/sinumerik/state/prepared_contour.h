// The table of a prepared contour (CONTPRON to EXECUTE): its elements, as far as the text tells them (motion reference
// 19.1, 19.2).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ir/expr.h"

namespace cnctrans::sinumerik {

/// A coordinate of the contour; `number` only where the text tells it.
struct ContourCoordinate {
  ir::ExprPtr expr;
  std::optional<double> number;
};
struct ContourPoint {
  ContourCoordinate u, v;  ///< abscissa and ordinate of the plane
  [[nodiscard]] bool known() const { return u.number && v.number; }
};
ContourPoint contour_point(double u, double v);

struct ContourElement {
  enum class Corner : std::uint8_t { none, round, leg, chord };

  int code = 1;  ///< G0 to G3
  ContourPoint start, end;
  double centre_u = 0, centre_v = 0;
  Corner corner = Corner::none;  ///< at its end
  double size = 0;               ///< of the corner
  [[nodiscard]] bool arc() const { return code > 1; }
};

/// Rounds and chamfers between straight elements become elements of their own. False: where this can't be told.
bool cut_corners(std::vector<ContourElement>& elements);

/// True when from the second element on the abscissa goes one way only and the ordinate too, the ordinate down
/// (`falls`) or up: then the control splits no element and finds no relief cut.
bool is_one_flank(const std::vector<ContourElement>& elements, bool falls);

/// The greatest angle between the element and the abscissa, 0 to 180 degrees.
ir::ExprPtr greatest_angle(const ContourElement& e);

}  // namespace cnctrans::sinumerik
