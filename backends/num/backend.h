// NUM 760/1060: IR to text.
#pragma once

#include <memory>

#include "backends/common/backend.h"

namespace cnctrans::backends::num {

std::shared_ptr<const Backend> make_backend();

}  // namespace cnctrans::backends::num
