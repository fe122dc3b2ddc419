// Contours that milling cycles work along: the blocks of the program they stand in, their elements, and the line at a
// distance from them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/cycle.h"
#include "ir/cycles/profile_blocks.h"

namespace cnctrans::ir::cycles {

/// One line or arc in mm of the work frame; `u`, `v` are the axes of the plane. An arc that ends where it starts is a
/// full circle.
struct MillElement {
  double u0 = 0, v0 = 0, u1 = 0, v1 = 0;
  bool arc = false, ccw = false;
  double cu = 0, cv = 0;
};
struct MillContour {
  std::vector<MillElement> elements;
  std::optional<double> surface;  ///< coordinate along the normal of the plane that its first block names, mm
  std::vector<double> heights;    ///< along that normal, of the first point and of each end, mm; empty: none of its own
};

/// The word of a milling cycle belongs to its contours, and is no number of the cycle.
bool is_contour_word(std::string_view word);
/// The contours that the cycle names, with the words that profile_blocks() reads; a word `contour_role` begins each
/// one where there are several.
std::vector<NamedCycle> contours_named(const HoleCycle& cycle);
/// It names contours, or has them as words.
bool has_contours(const HoleCycle& cycle);
/// Programs or subprograms that the cycle, of a lathe or a mill, takes contours from.
std::vector<RoutineName> contour_routines(const Cycle& cycle);

/// Contours that have been read travel in the words of the cycle, as plain numbers in mm; or the reason why there are
/// none.
void put_contours(HoleCycle& cycle, const std::vector<MillContour>& contours);
void put_contour_fault(HoleCycle& cycle, const std::string& why);
/// nullopt with a sentence in `error`.
std::optional<std::vector<MillContour>> contours_in(const HoleCycle& cycle, std::string* error);

/// The line at the distance `d` (mm, 0 or more) to the left or right of the way; corners that turn away are rounded.
/// nullopt with a sentence: an element is too small for it.
std::optional<std::vector<MillElement>> parallel(const std::vector<MillElement>& way, double d, bool left,
                                                 std::string* error);

/// Direction of travel at the start or the end of the element, of length 1.
struct Direction {
  double u = 0, v = 0;
  [[nodiscard]] Direction left() const { return {-v, u}; }
};
Direction direction_at(const MillElement& e, bool at_end);

}  // namespace cnctrans::ir::cycles
