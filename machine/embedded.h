// The profiles of machine/profiles/*.json, compiled in by the build.
#pragma once

#include <cstddef>
#include <string_view>

namespace cnctrans::machine {

struct EmbeddedText {
  std::string_view name;  ///< file name without extension: "<dialect>-mill", "<dialect>-lathe"
  std::string_view text;
};
extern const EmbeddedText builtin_profiles[];
extern const std::size_t builtin_profiles_count;

}  // namespace cnctrans::machine
