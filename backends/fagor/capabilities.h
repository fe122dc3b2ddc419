// What the language can say, on a lathe and on a mill.
#pragma once

#include "legaliser/capabilities.h"
#include "legaliser/legalise.h"

namespace cnctrans::backends::fagor {

const ir::Capabilities& capabilities(bool lathe);

/// G functions of this action stand alone in their block (manual ch. 5).
bool stands_alone(const ir::Action& a);

}  // namespace cnctrans::backends::fagor
