#include "tests/language/markdown.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace cnctrans::testing {

namespace fs = std::filesystem;

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<Section> read_markdown(const std::string& path) {
  std::istringstream in(read_file(path));
  std::vector<Section> sections;
  std::string line;
  bool in_fence = false;
  bool keep = false;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.rfind("```", 0) == 0) {
      in_fence = !in_fence;
      if (in_fence && !sections.empty()) {
        keep = !sections.back().has_fence;
        if (keep) {
          sections.back().has_fence = true;
          sections.back().fence_language = line.substr(3);
        }
      }
      continue;
    }
    if (in_fence) {
      if (keep && !sections.empty()) sections.back().fence += line + "\n";
      continue;
    }
    const auto text = line.find_first_not_of('#');
    if (!line.empty() && line[0] == '#' && text != std::string::npos && line[text] == ' ') {
      Section s;
      s.level = static_cast<int>(text);
      s.heading = line.substr(text + 1);
      s.line = number;
      sections.push_back(std::move(s));
    } else if (!line.empty() && !sections.empty()) {
      sections.back().lines.push_back(line);
    }
  }
  return sections;
}

std::vector<std::string> files_below(const std::string& folder, const std::vector<std::string>& endings) {
  std::vector<std::string> out;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored)) {
    const std::string name = entry.path().string();
    const auto ends = [&name](const std::string& e) {
      return name.size() >= e.size() && name.compare(name.size() - e.size(), e.size(), e) == 0;
    };
    if (entry.is_regular_file() && std::any_of(endings.begin(), endings.end(), ends)) out.push_back(name);
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::string test_name(const std::string& path, const std::string& root) {
  std::string name = path.rfind(root, 0) == 0 ? path.substr(root.size()) : path;
  std::string out;
  for (const char c : name) {
    const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (good) {
      out += c;
    } else if (!out.empty() && out.back() != '_') {
      out += '_';
    }
  }
  return out;
}

}  // namespace cnctrans::testing
