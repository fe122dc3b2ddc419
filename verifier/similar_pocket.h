// Two pockets with other passes.
#pragma once

#include <string>

#include "verifier/similar.h"

namespace cnctrans::verifier {

/// See similar_difference().
std::string pocket_difference(const CyclePasses& source, const CyclePasses& target, const Tolerances& tolerances,
                              double& max_length);

}  // namespace cnctrans::verifier
