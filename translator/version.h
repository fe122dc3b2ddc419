// The version of the program and of the library.
#pragma once

#include <string_view>

namespace cnctrans::translator {

inline constexpr std::string_view version = "0.2.0";

}  // namespace cnctrans::translator
