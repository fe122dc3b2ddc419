// Named options of a profile: policies where a manual is silent or leaves the choice to the machine. An option that is
// not in this table is an error, so a misspelt one cannot be ignored.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "machine/profile.h"

namespace cnctrans::machine {

struct OptionSpec {
  std::string_view name;
  std::string_view values;    ///< allowed values parted by '|'; "number": a decimal number; "text": anything
  std::string_view fallback;  ///< what holds when a profile does not say
  /// Puts the value, which is number `at` of `values`, into its field; null: an option that a language reads by name.
  void (*put)(Policies& out, std::string_view value, std::size_t at);
  std::string_view meaning;
};
std::span<const OptionSpec> option_specs();
const OptionSpec* find_option(std::string_view name);
/// False, and a sentence in `error`, when the option does not exist or does not take the value.
bool check_option(std::string_view name, std::string_view value, std::string* error);
/// Sets it, as text and as its field of Policies. False, with the profile as it was, where check_option says no.
bool set_option(Profile& profile, std::string_view name, std::string_view value, std::string* error);

}  // namespace cnctrans::machine
