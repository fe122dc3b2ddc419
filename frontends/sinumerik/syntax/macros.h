// Macros (DEFINE ... AS ...): their texts take the place of their names before a line is read.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace cnctrans::sinumerik {

/// The line with every macro name replaced; nothing when it has none. Names count without case and only as whole words,
/// outside of texts and comments; what a macro stands for is not searched again. A line that defines a macro stays.
std::optional<std::string> expand_macros(std::string_view line,
                                         const std::map<std::string, std::string, std::less<>>& macros);

}  // namespace cnctrans::sinumerik
