// profile: machine profiles made, shown and checked.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/nearest.h"
#include "base/text.h"
#include "cli/common.h"
#include "dialects/options.h"
#include "machine/profile.h"

namespace cnctrans::cli {

namespace {

bool is_builtin(const std::string& name) {
  const auto names = machine::builtin_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What load() says, with the built-in name that was probably meant.
std::optional<machine::Profile> loaded(const Arguments& a, const std::string& name) {
  std::string error;
  auto profile = dialects::load_profile(name, &error);
  if (profile) return profile;
  a.messages->say(Severity::error, "CNC-USAGE", "cnctrans: " + error + did_you_mean(name, machine::builtin_names()));
  return std::nullopt;
}

/// A profile to begin with: what nearly every machine has of its own, with the values of the built-in one.
std::string beginning(const machine::Profile& base) {
  std::string axes, first;
  for (const auto& axis : base.axes) {
    axes += fmt::format("{}    {{\"name\": \"{}\"{}{}, \"reference_point\": {}}}", axes.empty() ? "" : ",\n", axis.name,
                        axis.rotary ? ", \"rotary\": true" : "", axis.diameter ? ", \"diameter\": true" : "",
                        shortest(axis.reference_point));
    if (!axis.rotary) first += fmt::format("{}\"{}\": 0", first.empty() ? "" : ", ", axis.name);
  }
  return fmt::format(
      "{{\n  \"extends\": \"{}\",\n  \"name\": \"my-{}\",\n  \"axes\": [\n{}\n  ],\n"
      "  \"tools\": [\n    {{\"number\": 1, \"radius\": 5, \"length\": 0}}\n  ],\n"
      "  \"work_offsets\": {{\n    \"1\": {{{}}}\n  }},\n  \"options\": {{}}\n}}\n",
      base.name, base.name, axes, first);
}

int init(const Arguments& a) {
  if (!is_builtin(a.profile_name))
    return usage_error(a, "profile init takes a built-in machine, not " + a.profile_name +
                              did_you_mean(a.profile_name, machine::builtin_names()));
  const auto base = loaded(a, a.profile_name);
  if (!base) return usage;
  const std::string text = beginning(*base);
  if (a.output.empty() || a.output == "-") {
    write_all(stdout, text);
    return ok;
  }
  std::error_code ignored;
  if (std::filesystem::exists(a.output, ignored) && !a.force)
    return usage_error(a, a.output + " is there already; --force replaces it");
  AtomicFile file(a.output);
  std::string error;
  if (!file.open(&error) || !file.write(text, &error) || !file.commit(&error)) return usage_error(a, error);
  return ok;
}

int check_profile(const Arguments& a, const machine::Profile& p) {
  std::string axes;
  for (const auto& axis : p.axes) axes += (axes.empty() ? "" : " ") + axis.name;
  write_all(stdout, fmt::format("{}: {}, a {} for {}; axes {}; {} tools; {} work offsets; {} options\n", a.profile_name,
                                p.name, p.kind == machine::Kind::lathe ? "lathe" : "mill", p.dialect, axes,
                                p.tools.size(), p.work_offsets.size(), p.options.size()));
  return ok;
}

/// Every option with what it means, what it takes, and what it is on this machine.
int options_of(const machine::Profile& p) {
  for (const auto& o : dialects::options().rows()) {
    const auto set = p.options.find(o.name);
    const std::string value = set == p.options.end() ? std::string(o.fallback) : set->second;
    write_all(stdout,
              fmt::format("{} = {}{}\n    {}\n    takes: {}\n", o.name, value.empty() ? "(empty)" : value,
                          value == o.fallback ? "" : fmt::format("   (usual: {})", o.fallback), o.meaning, o.values));
  }
  return ok;
}

}  // namespace

int profile(const Arguments& a) {
  if (a.profile_action == "init") return init(a);
  const auto p = loaded(a, a.profile_name);
  if (!p) return a.profile_action == "check" ? refused : usage;
  if (a.profile_action == "check") return check_profile(a, *p);
  if (a.profile_action == "options") return options_of(*p);
  write_all(stdout, machine::to_json(*p));
  return ok;
}

}  // namespace cnctrans::cli
