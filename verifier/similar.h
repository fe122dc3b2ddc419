// Two cycles of one family that make other passes: do they leave the same part, and go nowhere dangerous?
#pragma once

#include <string>
#include <vector>

#include "interpreter/trace/cycle_runs.h"
#include "interpreter/trace/trace.h"
#include "verifier/compare.h"

namespace cnctrans::verifier {

/// One side of the comparison: the cycle, and its events with the rapid moves that the translation puts around it.
struct CyclePasses {
  const interpreter::CycleRun* run = nullptr;
  interpreter::Position start;  ///< of the tool before the first event
  std::vector<const interpreter::Event*> events;
};

/// Empty when the translation's cycle leaves what the source's does; else what differs, in one sentence.
///
/// Stock removal: both come down to the same contour (allowance included) and finish the same one, within
/// `Tolerances::contour`; no pass of either goes below that contour; the translation leaves no more than the source,
/// and moves in rapid only where its own or the source's passes have cut; it uses no feed that the source does not.
/// Threads: the same lines at full depth, with the same pitch and start angles; nothing below them; rapid moves along
/// the thread are as far from it as those of the source.
/// `max_length`: grows to how far the contours are apart.
std::string similar_difference(const CyclePasses& source, const CyclePasses& target, const Tolerances& tolerances,
                               double& max_length);

}  // namespace cnctrans::verifier
