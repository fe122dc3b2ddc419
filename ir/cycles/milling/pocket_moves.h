// Machining of a pocket with islands. The makers' manuals state what is cleared, not in which order: rings from the
// middle of the area to its walls, or parallel passes, are the choice of this house.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ir/cycles/milling/milling.h"
#include "ir/cycles/milling/pocket_area.h"

namespace cnctrans::ir::cycles {

/// A hole cycle whose `mill` has this shape runs at the places where the roughing of a pocket enters the material.
inline constexpr std::string_view pocket_entries_shape = "pocket.entries";

/// Where roughing goes into the material, mm in the plane: one place for each part of the pocket that the tool can't
/// leave. `mill`: words of the shape pocket.contour. Empty with a sentence in `error`.
std::vector<PocketPoint> pocket_entries(const MillNumbers& mill, const MillContext& context, std::string* error);

}  // namespace cnctrans::ir::cycles
