// The Fagor 8055 frontend: text to IR.
#pragma once

#include <memory>

#include "frontends/common/frontend.h"

namespace cnctrans::frontends::fagor {

std::unique_ptr<Frontend> make_frontend();

}  // namespace cnctrans::frontends::fagor
