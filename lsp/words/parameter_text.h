// What a parameter of a cycle means, with its unit: from the tables of ir/cycles.
#pragma once

#include <string>
#include <string_view>

namespace cnctrans::lsp {

enum class ParameterUnit : std::uint8_t { none, length, feed, degrees, seconds, speed };
ParameterUnit unit_of(std::string_view parameter);
std::string_view unit_text(ParameterUnit unit, bool inch, bool per_rev);
/// "plunge feed" of "plunge_feed"; what milling cycles say of it where they know it.
std::string parameter_meaning(std::string_view parameter);
/// The same with its unit behind it: "plunge feed (mm/min)".
std::string parameter_with_unit(std::string_view parameter);

}  // namespace cnctrans::lsp
