// Reads the test files written as Markdown: headings, text lines, fenced blocks.
#pragma once

#include <string>
#include <vector>

namespace cnctrans::testing {

/// A heading with the text below it, up to the next heading.
struct Section {
  std::string heading;  ///< without the marks
  int level = 1;
  std::vector<std::string> lines;  ///< outside fences, not empty
  std::string fence;               ///< content of the first fenced block, line ends kept
  std::string fence_language;
  bool has_fence = false;
  int line = 0;  ///< of the heading, for messages
};
std::vector<Section> read_markdown(const std::string& path);
std::string read_file(const std::string& path);
/// Files below `folder` (recursively) with one of the endings, sorted; empty when the folder is missing.
std::vector<std::string> files_below(const std::string& folder, const std::vector<std::string>& endings);
/// A path as a test name: letters, digits and underscores.
std::string test_name(const std::string& path, const std::string& root);

}  // namespace cnctrans::testing
