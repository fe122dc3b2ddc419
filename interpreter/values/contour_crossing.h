// Where two elements of contours cut.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "interpreter/trace/failure.h"

namespace cnctrans::interpreter {

/// Values of one element: its code (units digit 0, 1: straight; 2, 3: arc clockwise, counterclockwise), start, end,
/// centre; abscissa before ordinate.
inline constexpr std::size_t element_values = 7;

/// The points that lie on both, their ends included. Elements that share a piece give its two ends; an element without
/// length gives none.
std::vector<std::pair<double, double>> crossings(std::span<const double, element_values> a,
                                                 std::span<const double, element_values> b);

/// What the row ir::frame_rows::crossing answers; false (reported): there are several points.
bool crossing(std::span<const double> args, Failure& failure, double& out);

}  // namespace cnctrans::interpreter
