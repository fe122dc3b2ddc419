// The parts of the cycle pass.
#pragma once

#include "ir/cycles/hole.h"
#include "ir/passes/facts.h"
#include "ir/passes/rewrite.h"

namespace cnctrans::ir::passes {

/// The tool axis of a cycle: its own, or the normal of the plane in force.
std::optional<AxisId> cycle_axis(const HoleCycle& c, const Block& b, const Facts& facts);
/// The cycle with absolute levels as far as the circumstances are known; what is not known stays as it is.
HoleCycle with_absolute_levels(const HoleCycle& c, const Block& b, const Facts& facts);
/// The form of the cycle that the target writes natively; nullopt: none. `height`: of the tool when it is defined.
std::optional<CyclePtr> native_form(const CyclePtr& cycle, const Block& b, const Facts& facts,
                                    const LegaliseContext& context);

/// The moves of one hole as blocks, from `height` (mm); empty and a text in `error`: it can't be expanded.
struct Explosion {
  Body blocks;
  double end_height = 0;  ///< mm
};
std::optional<Explosion> explode(const HoleCycle& c, const LineInfo& like, const Block& b, const Facts& facts,
                                 double height, double defined_at, std::string* error);
/// Moves along the tool axis beside those in the plane.
bool has_plane_word(const Block& b, AxisId tool_axis);

}  // namespace cnctrans::ir::passes
