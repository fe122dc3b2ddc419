// What a word of a block means under the modal state: absolute or incremental, radius or diameter.
#pragma once

#include <functional>

#include "ir/edit/rewrite.h"
#include "legaliser/analysis/facts.h"

namespace cnctrans::ir::passes {

/// True for an axis whose words follow the diameter setting on this machine.
inline bool is_diameter_axis(const machine::Profile& machine, AxisId axis) {
  const auto* spec = machine.axis(axis);
  return spec != nullptr && spec->diameter;
}

/// Distance mode of an end point word.
inline std::optional<Distance> distance_of(const CoordWord& c, const Block& b, const Facts& facts) {
  if (c.mode == WordMode::absolute) return Distance::absolute;
  if (c.mode == WordMode::incremental) return Distance::incremental;
  return setting_in<Distance>(b, facts, Setting::distance);
}

/// All words of the block are of axes that move by themselves and that the block waits for.
bool positions_alone(const Block& b);

/// 0.5 for a diameter, 1 for a radius: the word's value times this is the radius. nullopt: not known here.
std::optional<double> to_radius(AxisId axis, WordScale scale, std::optional<Distance> distance, const Block& b,
                                const Facts& facts, const machine::Profile& machine);

/// The end points of a plain move as absolute words: each increment added to the place `base(axis)` (radius) that it
/// counts from. nullopt where a place, the distance mode or the diameter mode is not known, or where other words of the
/// block depend on the distance mode.
std::optional<std::vector<CoordWord>> absolute_words(const Block& b, const Facts& facts,
                                                     const machine::Profile& machine,
                                                     const std::function<std::optional<double>(AxisId)>& base);

/// Words of a frame that the reader made from the code alone: the rows of a table, axis by axis. A language writes its
/// own code again.
bool table_row(const FrameChange& c);

/// mm that the ends of an arc by its radius may lie too far apart for it: such an arc is the half circle.
inline constexpr double long_chord = 0.02;

/// A coordinate of the tool that the target itself knows when it runs (`$P_EP[X]`); nullopt: it has no name for it.
std::optional<Value> at_run(const LegaliseContext& context, Datum datum, AxisId axis);

/// Two centre words name the plane.
std::optional<Plane> plane_of_words(const Motion& m);

}  // namespace cnctrans::ir::passes
