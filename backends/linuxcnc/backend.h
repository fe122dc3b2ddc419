// The writer of LinuxCNC programs.
#pragma once

#include <memory>

#include "backends/common/backend.h"

namespace cnctrans::backends::linuxcnc {

std::shared_ptr<const Backend> make_backend();

}  // namespace cnctrans::backends::linuxcnc
