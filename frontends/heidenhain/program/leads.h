// APPR and DEP (reference 6): the way onto a contour and off it becomes the lines and arcs that it is.
#pragma once

#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

void write_leads(Lowering& lowering);

}  // namespace cnctrans::frontends::heidenhain
