// Values of type frame whose parts are numbers, in the canonical form of PlanarFrame.
#pragma once

#include <functional>
#include <optional>

#include "legaliser/frames/planar_frame.h"

namespace cnctrans::ir::passes {

/// The frame that a variable or a machine datum holds here; nullopt: not known.
using FrameLookup = std::function<std::optional<PlanarFrame>(const Expr&)>;

/// The value of an expression of type frame; nullopt: a part is computed, or it turns in space or scales single axes.
std::optional<PlanarFrame> constant_frame(const ExprPtr& e, const FrameLookup& held);
/// One component as the control reads it; a fine shift is part of the shift and reads 0. nullopt: not known, or the
/// control could take the frame apart in several ways (mirrors beside a turn).
std::optional<double> component_of(const PlanarFrame& f, AxisId axis, FramePart part);
/// The number that frame_part(frame, axis, part) gives.
std::optional<double> constant_component(const ExprPtr& e, const FrameLookup& held);
/// It only shifts.
bool only_shifts(const PlanarFrame& f);

}  // namespace cnctrans::ir::passes
