// The Fagor 8055 writer, lathe (T) and mill (M) model.
#pragma once

#include <memory>

#include "backends/common/backend.h"

namespace cnctrans::backends::fagor {

std::shared_ptr<const Backend> make_backend();

}  // namespace cnctrans::backends::fagor
