// Names of the parameters that give the points of a blank: blank_x1, blank_z1, blank_x2 ...
#pragma once

#include <cstddef>
#include <string>

namespace cnctrans::ir::cycles {

inline constexpr std::size_t most_blank_points = 64;
/// `axis`: 'x' or 'z'; `point` from 1.
std::string blank_name(char axis, std::size_t point);

}  // namespace cnctrans::ir::cycles
