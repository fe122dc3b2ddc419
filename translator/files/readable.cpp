#include "translator/files/readable.h"

namespace cnctrans::translator {

std::string unknown_dialect(std::string_view name) {
  std::string text = "unknown dialect '" + std::string(name) + "'; known:";
  for (const auto& d : dialects()) text += " " + std::string(d.name);
  return text;
}

const Dialect* find_readable(std::string_view name, std::string* error) {
  const Dialect* found = find_dialect(name);
  if (found == nullptr) {
    *error = unknown_dialect(name);
  } else if (!readable(*found)) {
    *error = "'" + std::string(name) + "' is written only: nothing here reads it";
    found = nullptr;
  }
  return found;
}

}  // namespace cnctrans::translator
