// The profiles of machine/profiles/*.json, compiled in by the build.
#pragma once

#include "base/embedded.h"

namespace cnctrans::machine {

/// By name: "<dialect>-mill", "<dialect>-lathe".
extern const EmbeddedText builtin_profiles[];
extern const std::size_t builtin_profiles_count;

}  // namespace cnctrans::machine
