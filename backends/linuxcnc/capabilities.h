// What LinuxCNC programs can say.
#pragma once

#include "ir/passes/capabilities.h"

namespace cnctrans::backends::linuxcnc {

const ir::Capabilities& capabilities(bool lathe);

}  // namespace cnctrans::backends::linuxcnc
