// The Sinumerik 840D sl / 828D frontend: text of part programs in, IR out.
#pragma once

#include <memory>

#include "frontends/common/frontend.h"

namespace cnctrans::frontends::sinumerik {

std::unique_ptr<const Frontend> make_frontend();

}  // namespace cnctrans::frontends::sinumerik
