#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <new>
#include <vector>

#include "cli/command_line.h"
#include "cli/common.h"
#include "cli/completion.h"
#include "cli/languages.h"
#include "cli/man_page.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

/// A translation builds large programs and drops them again, pass by pass: memory is kept for the next one instead of
/// being handed back to the system and asked for anew (a fifth of the time of a program of 20,000 blocks).
void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
  mallopt(M_TOP_PAD, 4 << 20);
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
#endif
}

using namespace cnctrans::cli;

/// Asked of the words as they stand: the command line could not be taken.
bool wants_json(const std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--diagnostics=json") return true;
    if (words[i] == "--diagnostics" && i + 1 < words.size() && words[i + 1] == "json") return true;
  }
  return false;
}

/// The programs are there to be read, and their languages are known.
bool settle_programs(const Command& command, Arguments& a) {
  if (command.programs == Programs::none) return true;
  if (!read_standard_input(a)) return false;
  if (command.programs == Programs::dialect) return find_language(a, a.dialect, "--dialect", 0, a.inputs.size());
  if (command.programs == Programs::from) return find_language(a, a.from, "--from", 0, a.inputs.size());
  return find_language(a, a.from, "--from", 0, 1) && find_language(a, a.to, "--to", 1, a.inputs.size());
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory();
  const std::vector<std::string> words(argv + 1, argv + std::max(argc, 1));
  Arguments a;
  CLI::App app{
      "Translates CNC part programs between controls, keeps the program, and proves that the machine moves the same "
      "way.",
      "cnctrans"};
  const std::vector<Command> commands = declare(app, a);
  const bool json = wants_json(words);
  if (const std::string slip = slip_of_command(app, words); !slip.empty()) {
    Messages messages(json);
    messages.say(cnctrans::Severity::error, "CNC-USAGE", "cnctrans: " + slip);
    return usage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    Messages(json).say(cnctrans::Severity::error, "CNC-USAGE", e.what() + suggestion(app, words));
    if (!json) write_all(stderr, "Run with --help for more information.\n");
    return usage;
  }
  Messages messages(a.diagnostics == "json", coloured(a, stderr));
  a.messages = &messages;
  const auto named = [](const Command& c) { return c.app->parsed(); };
  const Command& command = *std::find_if(commands.begin(), commands.end() - 1, named);
  const auto carry_out = [&]() -> int {
    if (command.run == nullptr) {
      const std::string text = a.shell.empty() ? man_page(app) : completion(app, a.shell);
      write_all(stdout, text);
      return ok;
    }
    return settle_programs(command, a) ? command.run(a) : usage;
  };
  try {
    const int status = carry_out();
    std::string why;
    if (stdout_arrived(&why)) return status;
    messages.say(cnctrans::Severity::error, "CNC-OUTPUT", "cnctrans: the standard output can't be written" + why);
    return status != ok ? status : usage;  // a result that did not arrive is no success
  } catch (const std::bad_alloc&) {
    messages.say(cnctrans::Severity::error, "CNC-MEMORY", "cnctrans: not enough memory for this input");
    return refused;
  }
}
