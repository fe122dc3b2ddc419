#include "cli/completion.h"

#include <CLI/CLI.hpp>

namespace cnctrans::cli {

namespace {

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* o : app.get_options()) {
    for (const auto& n : o->get_lnames()) names.push_back("--" + n);
    for (const auto& n : o->get_snames()) names.push_back("-" + n);
  }
  return names;
}

std::string joined(const std::vector<std::string>& list) {
  std::string text;
  for (const auto& s : list) text += (text.empty() ? "" : " ") + s;
  return text;
}

std::string bash(const CLI::App& app) {
  std::string commands;
  std::string cases;
  for (const auto* sub : app.get_subcommands({})) {
    commands += (commands.empty() ? "" : " ") + sub->get_name();
    cases += "    " + sub->get_name() + ") words=\"" + joined(option_names(*sub)) + "\" ;;\n";
  }
  return "_cnctrans() {\n  local cur=\"${COMP_WORDS[COMP_CWORD]}\" words\n  case \"${COMP_WORDS[1]}\" in\n" + cases +
         "    *) words=\"" + commands + " " + joined(option_names(app)) +
         "\" ;;\n  esac\n  case \"${COMP_WORDS[COMP_CWORD-1]}\" in\n    --from|--to|--dialect) words=\"$(cnctrans "
         "dialects --quiet | cut -d' ' -f1)\" ;;\n"
         "  esac\n  COMPREPLY=( $(compgen -W \"$words\" -- \"$cur\") $(compgen -f -- \"$cur\") )\n}\ncomplete -F "
         "_cnctrans cnctrans\n";
}

std::string fish(const CLI::App& app) {
  std::string text;
  const auto add = [&text](const CLI::App& a, const std::string& condition) {
    for (const auto* o : a.get_options()) {
      for (const auto& n : o->get_lnames()) {
        std::string what = o->get_description();
        for (auto& c : what) {
          if (c == '\'') c = ' ';
        }
        text += "complete -c cnctrans -n '" + condition + "' -l " + n + " -d '" + what + "'\n";
      }
    }
  };
  add(app, "__fish_use_subcommand");
  for (const auto* sub : app.get_subcommands({})) {
    text += "complete -c cnctrans -n '__fish_use_subcommand' -a " + sub->get_name() + " -d '" + sub->get_description() +
            "'\n";
    add(*sub, "__fish_seen_subcommand_from " + sub->get_name());
  }
  return text;
}

}  // namespace

std::string completion(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash(app);
  if (shell == "zsh") return "#compdef cnctrans\nautoload -U +X bashcompinit && bashcompinit\n" + bash(app);
  if (shell == "fish") return fish(app);
  return {};
}

}  // namespace cnctrans::cli
