// What was probably meant by a word that the command line does not know.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "base/nearest.h"
#include "cli/command_line.h"

namespace cnctrans::cli {

namespace {

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* o : app.get_options()) {
    for (const auto& n : o->get_lnames()) names.push_back("--" + n);
  }
  return names;
}

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* sub : app.get_subcommands({})) names.push_back(sub->get_name());
  return names;
}

}  // namespace

std::string suggestion(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  for (const auto* sub : app.get_subcommands({})) {
    if (!words.empty() && sub->get_name() == words.front()) command = sub;
  }
  const auto known = options_of(*command);
  for (const auto& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || std::find(known.begin(), known.end(), name) != known.end()) continue;
    return did_you_mean(name, known);
  }
  return {};
}

std::string slip_of_command(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.empty() || words.front().find_first_of("-./") != std::string::npos) return {};
  const auto commands = commands_of(app);
  std::error_code ignored;
  if (std::find(commands.begin(), commands.end(), words.front()) != commands.end() ||
      std::filesystem::exists(words.front(), ignored))
    return {};
  const std::string meant = did_you_mean(words.front(), commands);
  return meant.empty() ? meant : "there is no command " + words.front() + meant;
}

}  // namespace cnctrans::cli
