// What cnctrans.json says of an archive.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cnctrans::translator {

/// A folder of the programs with a machine of its own, or that is left out. The longest path that fits counts.
struct ProjectFolder {
  std::string path;  ///< below the programs
  std::string machine, target_machine;
  bool skip = false;
};

struct ProjectConfig {
  std::string from, to;
  std::string programs = "programs", output = "translated", names = "names.json";
  std::string machine, target_machine, tools;
  std::string archive;  ///< of all outputs, below the output folder; empty: none
  std::vector<std::string> libraries;
  std::vector<ProjectFolder> folders;
  bool draft = false;
};

/// All paths are below the project's folder, or absolute. nullopt, and why in `*error`.
std::optional<ProjectConfig> parse_project(std::string_view text, std::string* error);
/// The file cnctrans.json of the folder, with the paths made whole.
std::optional<ProjectConfig> read_project(const std::string& folder, std::string* error);

}  // namespace cnctrans::translator
