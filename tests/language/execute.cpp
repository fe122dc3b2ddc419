#include "tests/language/execute.h"

#include <sys/wait.h>

#include <cstdlib>
#include <regex>
#include <sstream>

#include "tests/language/markdown.h"

namespace cnctrans::testing {

Outcome execute(const std::string& command, const std::filesystem::path& folder) {
  const std::string line = "cd '" + folder.string() + "' && ( PATH=" CNCTRANS_EXECUTABLE_DIR ":$PATH; export PATH; " +
                           command + " ) > .stdout 2> .stderr < /dev/null";
  const int raw = std::system(line.c_str());
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : 128, read_file((folder / ".stdout").string()),
          read_file((folder / ".stderr").string())};
}

std::string diagnostics_in(const std::string& text) {
  static const std::regex diagnostic("(\\S+:\\d+:\\d+: )?(error|warning|note) [A-Z]+-[A-Z0-9]+: .*|cnctrans: .*");
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, diagnostic)) out += line + '\n';
  }
  return out;
}

}  // namespace cnctrans::testing
