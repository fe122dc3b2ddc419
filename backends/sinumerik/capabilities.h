// What Sinumerik can say, for legalisation.
#pragma once

#include "legaliser/capabilities.h"
#include "legaliser/legalise.h"

namespace cnctrans::backends::sinumerik {

const ir::Capabilities& capabilities();

}  // namespace cnctrans::backends::sinumerik
