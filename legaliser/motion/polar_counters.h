// Radius and angle of polar words as two variables that count on, for a target without polar words, or without words
// that are increments by themselves.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Increments of polar words that are carried out from another point in each pass of a loop: `r = r + step`, `q = q +
/// step`, and polar words of these. The variables begin behind the last other move before the loop.
void count_polar_steps(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
