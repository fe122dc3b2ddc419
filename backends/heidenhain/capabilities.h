// What a Heidenhain program can say.
#pragma once

#include "legaliser/capabilities.h"

namespace cnctrans::backends::heidenhain {

const ir::Capabilities& capabilities();

}  // namespace cnctrans::backends::heidenhain
