// Dialects that are read: one without a frontend is written only (for a simulator, say).
#pragma once

#include <string>
#include <string_view>

#include "translator/files/registry.h"

namespace cnctrans::translator {

inline bool readable(const Dialect& d) {
  return d.frontend != nullptr;
}
/// What to say of a name that find_dialect() does not know.
std::string unknown_dialect(std::string_view name);
/// A dialect that programs can be read from; nullptr when it is unknown or written only, and the reason in `error`.
const Dialect* find_readable(std::string_view name, std::string* error);

}  // namespace cnctrans::translator
