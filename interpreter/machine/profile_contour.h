// The contour that blocks of a program describe, read by carrying them out on a machine beside the one that runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "interpreter/values/expressions.h"
#include "ir/cycles/milling/mill_contour.h"
#include "ir/cycles/profile_blocks.h"
#include "ir/statement.h"
#include "machine/profile.h"

namespace cnctrans::interpreter {

using ir::cycles::ContourStart;
/// Lines and arcs in mm (radius) of the work frame, corners included. nullopt with a sentence: the blocks are no
/// profile. `values` answers expressions; null: there may be none.
std::optional<ir::cycles::TurnProfile> contour_of(const machine::Profile& machine, const ContourStart& start,
                                                  const std::vector<const ir::Statement*>& blocks, ValueSource* values,
                                                  std::string* error);

/// The same for a milling cycle, in the plane that `modal` names; the first block says where the contour begins.
/// `several`: each block in rapid begins another contour, and the first one may name the height of the surface.
/// `in_space`: with the heights of its points, which the first block begins.
std::optional<std::vector<ir::cycles::MillContour>> mill_contours_of(const machine::Profile& machine,
                                                                     const ir::ModalState& modal,
                                                                     const std::vector<const ir::Statement*>& blocks,
                                                                     bool several, ValueSource* values,
                                                                     std::string* error, bool in_space = false);

}  // namespace cnctrans::interpreter
