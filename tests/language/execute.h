// Runs a command of the built executable in a folder.
#pragma once

#include <filesystem>
#include <string>

namespace cnctrans::testing {

struct Outcome {
  int status = -1;
  std::string out, err;
};
Outcome execute(const std::string& command, const std::filesystem::path& folder);

/// The diagnostics without what is shown below them, and what the command itself says.
std::string diagnostics_in(const std::string& text);

}  // namespace cnctrans::testing
