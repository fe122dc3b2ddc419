// What LinuxCNC programs can say.
#pragma once

#include "legaliser/capabilities.h"
#include "legaliser/legalise.h"

namespace cnctrans::backends::linuxcnc {

const ir::Capabilities& capabilities(bool lathe);

}  // namespace cnctrans::backends::linuxcnc
