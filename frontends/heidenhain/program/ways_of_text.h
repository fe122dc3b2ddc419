// Lines whose meaning depends on what holds where they are read (a tilted plane, the contours of the SL cycles, FU):
// refused where a way brings something else than the text has above them.
#pragma once

#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

void check_ways_of_text(Lowering& lowering);

/// What depends on the way is kept as `text`; of a cycle its calls say nothing more.
void give_up(Flat& flat, Item& item, const char* text, std::string_view feature);

}  // namespace cnctrans::frontends::heidenhain
