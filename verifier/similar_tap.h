// Two taps with other strokes.
#pragma once

#include <string>

#include "verifier/similar.h"

namespace cnctrans::verifier {

/// See similar_difference(). The same hole, depth, pitch and hand; strokes on the way down and dwells are not compared.
std::string tap_difference(const CyclePasses& source, const CyclePasses& target, const Tolerances& tolerances);

}  // namespace cnctrans::verifier
