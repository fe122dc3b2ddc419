#include "cli/completion.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

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

/// What an option takes where its words are listed: "{lf,crlf,cr}" stands in the name of its type.
std::string words_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  std::string words = type.substr(open + 1, close - open - 1);
  std::replace(words.begin(), words.end(), ',', ' ');
  return words;
}

/// "    --eol) words=... ;;" for each option with a list of words, once.
std::string value_cases(const CLI::App& app) {
  std::map<std::string, std::string> values;
  const auto add = [&values](const CLI::App& a) {
    for (const auto* o : a.get_options()) {
      for (const auto& n : o->get_lnames()) {
        if (const auto words = words_of(*o); !words.empty()) values["--" + n] = words;
      }
    }
  };
  add(app);
  for (const auto* sub : app.get_subcommands({})) {
    add(*sub);
    for (const auto* o : sub->get_options()) {
      if (o->get_positional() && !words_of(*o).empty()) values[sub->get_name()] = words_of(*o);
    }
  }
  const std::string dialects = "$(cnctrans dialects --quiet | cut -d' ' -f1)";
  const std::string machines = "$(cnctrans dialects | sed -n 's/^machines: //p')";
  for (const char* option : {"--from", "--to", "--dialect"}) values[option] = dialects;
  for (const char* option : {"--machine", "--target-machine", "init", "show", "options"}) values[option] = machines;
  std::string cases;
  for (const auto& [word, list] : values) cases += "    " + word + ") words=\"" + list + "\" ;;\n";
  return cases;
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
         "\" ;;\n  esac\n  case \"${COMP_WORDS[COMP_CWORD-1]}\" in\n" + value_cases(app) +
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
        const std::string words = words_of(*o);
        text += "complete -c cnctrans -n '" + condition + "' -l " + n + " -d '" + what + "'" +
                (words.empty() ? "" : " -x -a '" + words + "'") + "\n";
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
