// Items -> routines: the main program, and the subprograms LBL n ... LBL 0.
#pragma once

#include <vector>

#include "frontends/heidenhain/state/lowering.h"
#include "frontends/heidenhain/ways/flow.h"

namespace cnctrans::frontends::heidenhain {

/// `statements`: of every item. `main` is the routine of the main program, without its body.
void build_routines(Lowering& lowering, const Flow& flow, std::vector<std::vector<ir::Statement>> statements,
                    ir::Routine main, ir::Program& program);

}  // namespace cnctrans::frontends::heidenhain
