// The iTNC 530 frontend: text of part programs in, IR out.
#pragma once

#include <memory>

#include "frontends/common/frontend.h"

namespace cnctrans::frontends::heidenhain {

std::unique_ptr<const Frontend> make_frontend();

}  // namespace cnctrans::frontends::heidenhain
