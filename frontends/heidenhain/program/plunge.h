// M103 (reference 9): a smaller feed for moves that go into the material.
#pragma once

#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

/// Lines that go down along the tool axis get a feed of their own, by which its part along that axis is the share of F.
void limit_plunges(Lowering& lowering);

}  // namespace cnctrans::frontends::heidenhain
