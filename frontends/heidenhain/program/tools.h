// F AUTO, FU and the radius of the tool: those of the TOOL CALL from which the way comes, which the text may have
// elsewhere (a subprogram behind the program end).
#pragma once

#include "frontends/heidenhain/state/lowering.h"
#include "frontends/heidenhain/ways/flow.h"

namespace cnctrans::frontends::heidenhain {

/// The item takes something from the last TOOL CALL.
bool asks_tool(const Flat& flat, const Item& item, const Arrival& arrival);

/// `all`: where several tools come together it is an error; else such items are left for later.
void take_tools(Lowering& lowering, bool all);

}  // namespace cnctrans::frontends::heidenhain
