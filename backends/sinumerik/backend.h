// The Sinumerik 840D sl / 828D writer.
#pragma once

#include <memory>

#include "backends/common/backend.h"

namespace cnctrans::backends::sinumerik {

std::shared_ptr<const Backend> make_backend();

}  // namespace cnctrans::backends::sinumerik
