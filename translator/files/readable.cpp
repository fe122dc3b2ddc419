#include "translator/files/readable.h"

#include "base/nearest.h"

namespace cnctrans::translator {

std::string unknown_dialect(std::string_view name) {
  std::string text = "unknown dialect '" + std::string(name) + "'; known:";
  std::vector<std::string> names;
  for (const auto& d : dialects()) {
    names.emplace_back(d.name);
    text += " " + names.back();
  }
  return text + did_you_mean(name, names);
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
