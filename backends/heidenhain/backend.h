// The writer of Heidenhain iTNC 530 programs.
#pragma once

#include <memory>

#include "backends/common/backend.h"

namespace cnctrans::backends::heidenhain {

std::shared_ptr<const Backend> make_backend();

}  // namespace cnctrans::backends::heidenhain
