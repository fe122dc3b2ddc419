// What Sinumerik can say, for legalisation.
#pragma once

#include "ir/passes/capabilities.h"

namespace cnctrans::backends::sinumerik {

const ir::Capabilities& capabilities();

}  // namespace cnctrans::backends::sinumerik
