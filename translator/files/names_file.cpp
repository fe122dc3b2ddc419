#include "translator/files/names_file.h"

#include <nlohmann/json.hpp>

#include "base/source.h"
#include "base/text.h"

namespace cnctrans::translator {

namespace {

using Json = nlohmann::ordered_json;
constexpr std::string_view format = "cnctrans-names-1";

/// A part of the map: every value is a text. Names of routines and variables are the same in capitals.
bool read_part(const Json& file, const char* key, bool capitals, std::map<std::string, std::string>& out,
               std::string* error) {
  const auto part = file.find(key);
  if (part == file.end()) return true;
  if (!part->is_object()) {
    *error = std::string("\"") + key + "\" is no object";
    return false;
  }
  for (const auto& [from, to] : part->items()) {
    if (!to.is_string() || to.get_ref<const std::string&>().empty()) {
      *error = std::string("\"") + key + "\": the name given to \"" + from + "\" is no text";
      return false;
    }
    out[capitals ? to_upper_ascii(from) : from] = to.get<std::string>();
  }
  return true;
}

std::string text_at(const Json& file, const char* key) {
  const auto it = file.find(key);
  return it != file.end() && it->is_string() ? it->get<std::string>() : std::string();
}

}  // namespace

std::optional<ir::NameMap> parse_names(std::string_view text, std::string_view from, std::string_view to,
                                       std::string* error) {
  const Json file = Json::parse(text.begin(), text.end(), nullptr, false);
  if (!file.is_object() || text_at(file, "format") != format) {
    *error = "this is no file of names (\"format\": \"" + std::string(format) + "\" is missing)";
    return std::nullopt;
  }
  if (text_at(file, "from") != from || text_at(file, "to") != to) {
    *error = "its names are for --from " + text_at(file, "from") + " --to " + text_at(file, "to");
    return std::nullopt;
  }
  ir::NameMap names;
  if (!read_part(file, "programs", false, names.programs, error) ||
      !read_part(file, "routines", true, names.routines, error) ||
      !read_part(file, "variables", true, names.variables, error) || !read_part(file, "data", true, names.data, error))
    return std::nullopt;
  return names;
}

std::optional<ir::NameMap> read_names(const std::string& path, std::string_view from, std::string_view to,
                                      std::string* error) {
  const SourcePtr text = SourceText::open(path, error);
  auto found = text ? parse_names(text->text(), from, to, error) : std::nullopt;
  if (!found) *error = path + ": " + *error;
  return found;
}

std::string names_text(const ir::NameMap& names, std::string_view from, std::string_view to) {
  Json file{{"format", format},
            {"from", from},
            {"to", to},
            {"programs", Json(names.programs)},
            {"routines", Json(names.routines)},
            {"variables", Json(names.variables)}};
  if (!names.data.empty()) file["data"] = Json(names.data);
  return file.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void add_names(ir::NameMap& names, const ir::NameMap& more) {
  names.programs.insert(more.programs.begin(), more.programs.end());
  names.routines.insert(more.routines.begin(), more.routines.end());
  names.variables.insert(more.variables.begin(), more.variables.end());
  names.data.insert(more.data.begin(), more.data.end());
}

}  // namespace cnctrans::translator
