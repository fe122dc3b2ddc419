// Named options of a profile: policies where a manual is silent or leaves the choice to the machine. An option that is
// not in this table is an error, so a misspelt one cannot be ignored.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace cnctrans::machine {

struct OptionSpec {
  std::string_view name;
  std::string_view values;    ///< allowed values parted by '|'; "number": a decimal number; "text": anything
  std::string_view fallback;  ///< what holds when a profile does not say
  std::string_view meaning;
};
std::span<const OptionSpec> option_specs();
const OptionSpec* find_option(std::string_view name);
/// False, and a sentence in `error`, when the option does not exist or does not take the value.
bool check_option(std::string_view name, std::string_view value, std::string* error);

}  // namespace cnctrans::machine
