// Every option of a machine profile, the languages' own among them, and profiles with them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "machine/options.h"
#include "machine/profile.h"

namespace cnctrans::dialects {

const machine::OptionTable& options();
/// A built-in machine, or a path to a JSON file. nullopt and a message in `error` otherwise.
std::optional<machine::Profile> load_profile(const std::string& name_or_path, std::string* error);
std::optional<machine::Profile> profile_of(std::string_view json, std::string* error);

}  // namespace cnctrans::dialects
