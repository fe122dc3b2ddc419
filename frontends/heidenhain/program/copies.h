// A subprogram that is called under one cycle and under another (`CALL LBL 1` behind each CYCL DEF, its points with
// M99) has a copy for each.
#pragma once

#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

void copy_for_cycles(Lowering& lowering);

}  // namespace cnctrans::frontends::heidenhain
