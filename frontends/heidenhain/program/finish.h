// What only the ways through the program can complete: centres of arcs, calls of cycles.
#pragma once

#include <set>

#include "frontends/heidenhain/state/lowering.h"
#include "frontends/heidenhain/ways/flow.h"

namespace cnctrans::frontends::heidenhain {

/// Completes the items; those that stay are in `flat` behind it, with the same order.
void finish_items(Lowering& lowering, const Flow& flow, std::vector<std::vector<ir::Statement>>& statements);

}  // namespace cnctrans::frontends::heidenhain
