#include "translator/project/config.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/source.h"
#include "machine/profile.h"

namespace cnctrans::translator {

namespace {

namespace fs = std::filesystem;
using ConfigJson = nlohmann::json;
constexpr std::string_view project_format = "cnctrans-project-1";

/// Reads the members of one object; a member that nobody has asked for is a slip.
class Members {
 public:
  Members(const ConfigJson& object, std::string where, std::string& error)
      : object_(object), where_(std::move(where)), error_(error) {}

  void text(const char* key, std::string& to) {
    take(key, [&](const ConfigJson& j) {
      if (!j.is_string()) return "is no text";
      to = j.get<std::string>();
      return "";
    });
  }
  void truth(const char* key, bool& to) {
    take(key, [&](const ConfigJson& j) {
      if (!j.is_boolean()) return "is true or false";
      to = j.get<bool>();
      return "";
    });
  }
  void texts(const char* key, std::vector<std::string>& to) {
    take(key, [&](const ConfigJson& j) {
      if (!j.is_array()) return "is a list of texts";
      for (const auto& x : j) {
        if (!x.is_string()) return "is a list of texts";
        to.push_back(x.get<std::string>());
      }
      return "";
    });
  }
  template <class Take>
  void take(const char* key, const Take& read) {
    known_.push_back(key);
    const auto it = object_.find(key);
    if (it == object_.end() || !error_.empty()) return;
    const std::string why = read(*it);
    if (!why.empty()) error_ = where_ + "\"" + key + "\" " + why;
  }
  void done() {
    for (const auto& [key, value] : object_.items()) {
      if (error_.empty() && std::find(known_.begin(), known_.end(), key) == known_.end())
        error_ = where_ + "\"" + key + "\" is not known";
    }
  }

 private:
  const ConfigJson& object_;
  std::string where_;
  std::string& error_;
  std::vector<std::string> known_;
};

std::string below(const std::string& folder, const std::string& path) {
  return path.empty() || fs::path(path).is_absolute() ? path : (fs::path(folder) / path).string();
}

/// A profile is a built-in name or a file.
std::string machine_below(const std::string& folder, const std::string& machine) {
  const auto names = machine::builtin_names();
  return std::find(names.begin(), names.end(), machine) != names.end() ? machine : below(folder, machine);
}

}  // namespace

std::optional<ProjectConfig> parse_project(std::string_view text, std::string* error) {
  const ConfigJson file = ConfigJson::parse(text.begin(), text.end(), nullptr, false);
  ProjectConfig config;
  std::string kind;
  error->clear();
  if (!file.is_object()) {
    *error = "this is no JSON object";
    return std::nullopt;
  }
  Members members(file, "", *error);
  std::string schema;
  members.text("$schema", schema);
  members.text("format", kind);
  members.text("from", config.from);
  members.text("to", config.to);
  members.text("programs", config.programs);
  members.text("output", config.output);
  members.text("names", config.names);
  members.text("archive", config.archive);
  members.text("machine", config.machine);
  members.text("target_machine", config.target_machine);
  members.text("tools", config.tools);
  members.texts("libraries", config.libraries);
  members.truth("draft", config.draft);
  members.take("folders", [&](const ConfigJson& list) -> std::string {
    if (!list.is_array()) return "is a list";
    for (const auto& item : list) {
      if (!item.is_object()) return "is a list of objects";
      std::string why;
      ProjectFolder folder;
      Members of(item, "in \"folders\": ", why);
      of.text("path", folder.path);
      of.text("machine", folder.machine);
      of.text("target_machine", folder.target_machine);
      of.truth("skip", folder.skip);
      of.done();
      if (why.empty() && folder.path.empty()) why = "a folder has no \"path\"";
      if (!why.empty()) return "has a fault: " + why;
      while (folder.path.ends_with('/')) folder.path.pop_back();
      config.folders.push_back(std::move(folder));
    }
    return {};
  });
  members.done();
  if (error->empty() && kind != project_format)
    *error = "\"format\": \"" + std::string(project_format) + "\" is missing";
  if (error->empty() && (config.from.empty() || config.to.empty())) *error = "\"from\" and \"to\" are needed";
  if (!error->empty()) return std::nullopt;
  return config;
}

std::optional<ProjectConfig> read_project(const std::string& folder, std::string* error) {
  const std::string path = (fs::path(folder) / "cnctrans.json").string();
  const SourcePtr text = SourceText::open(path, error);
  if (!text) return std::nullopt;
  auto config = parse_project(text->text(), error);
  if (!config) {
    *error = path + ": " + *error;
    return std::nullopt;
  }
  for (auto* p : {&config->programs, &config->output, &config->names, &config->tools}) *p = below(folder, *p);
  for (auto& l : config->libraries) l = below(folder, l);
  for (auto* m : {&config->machine, &config->target_machine}) *m = machine_below(folder, *m);
  for (auto& f : config->folders) {
    f.machine = machine_below(folder, f.machine);
    f.target_machine = machine_below(folder, f.target_machine);
  }
  return config;
}

}  // namespace cnctrans::translator
