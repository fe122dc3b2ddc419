// Patterns of points at which the machining in force is repeated, carried as ir::NamedCycle with the names below.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/cycle.h"

namespace cnctrans::ir::cycles {

enum class PatternKind : std::uint8_t {
  line,     ///< from the tool: `count` points in all, the tool stands on number 0
  outline,  ///< sides of a parallelogram, once round, the tool stands on number 0
  grid,     ///< row by row, every other row backwards, the tool stands on number 0
  circle,   ///< from the tool round a centre
  arc,
  chord,   ///< one point: the other end of a chord
  row,     ///< from a reference point, beginning at the end that is nearer to the tool
  ring,    ///< round a centre by angles
  matrix,  ///< row by row, each in the same sense
  frame,   ///< only the outer points of a matrix, once round
  list     ///< up to nine points as they stand
};
/// What a parameter is counted in.
enum class PatternQuantity : std::uint8_t { length, feed, plain };
struct PatternParameter {
  std::string_view name;
  PatternQuantity quantity;
};
struct Pattern {
  std::string_view name;
  PatternKind kind;
  bool from_tool;  ///< counted from where the tool stands, that point being done; else by absolute coordinates
};
/// nullptr: no pattern has this name, or no parameter of this name.
const Pattern* find_pattern(std::string_view name);
const PatternParameter* find_pattern_parameter(std::string_view name);

/// A point in the plane, mm in the work frame, and the way to it.
struct PatternPoint {
  double u = 0, v = 0;
  enum class Way : std::uint8_t { rapid, linear, cw, ccw } way = Way::rapid;
  double centre_u = 0, centre_v = 0;  ///< of an arc
  double feed = 0;                    ///< as F words, when `way` is not rapid
};
/// Values by parameter name: mm, degrees, counts. What the source left out is not there.
using PatternNumbers = std::map<std::string_view, double>;

/// The points in their order, those left out (skip1 to skip7: n, or n.mmm for n to m) not among them. The tool stands
/// at (u, v). nullopt and a sentence in `error` when the words do not make a pattern.
std::optional<std::vector<PatternPoint>> pattern_points(const Pattern& pattern, const PatternNumbers& numbers, double u,
                                                        double v, std::string* error);

}  // namespace cnctrans::ir::cycles
