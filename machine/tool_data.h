// Machine data of the tool in use, by the names an option of the profile lists.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machine/profile.h"

namespace cnctrans::machine {

/// The names that an option lists (tool.radius_data, tool.width_data), separated by |, with the number of the tool for
/// #T and of its offset or edge for #D; a number that is not known becomes `*`.
std::vector<std::string> tool_data_names(std::string_view list, std::optional<std::int32_t> tool,
                                         std::optional<std::int32_t> offset);

}  // namespace cnctrans::machine
