// Cycle 14 (reference 17.1 to 17.3): the contours of its labels, and the pockets with their islands that they make.
#pragma once

#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

/// For every definition of a cycle that works on contours. Marks the items of the labels.
void read_areas(Lowering& lowering, const machine::Profile& profile);

}  // namespace cnctrans::frontends::heidenhain
