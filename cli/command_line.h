// The command line: every command with its options, and what is said of one that can't be taken.
#pragma once

#include <string>
#include <vector>

#include "cli/commands.h"

namespace CLI {
class App;
}

namespace cnctrans::cli {

/// Which option names the language of a command's programs.
enum class Programs : std::uint8_t { none, dialect, from, from_and_to };

struct Command {
  CLI::App* app = nullptr;
  int (*run)(const Arguments&) = nullptr;  ///< null: it prints what the command line itself says
  Programs programs = Programs::none;
};
/// All commands; the last one is carried out where none is named.
std::vector<Command> declare(CLI::App& app, Arguments& a);

/// "; did you mean --numbering?" of the first word that is no option or command here, or empty.
std::string suggestion(const CLI::App& app, const std::vector<std::string>& words);
/// The first word is no command, no file, and nearly a command: what to say. Else empty.
std::string slip_of_command(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace cnctrans::cli
