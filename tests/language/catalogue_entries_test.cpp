// tests/catalogue/heidenhain-entries.md: where each entry of the language's catalogue is tested, or why it is not.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "tests/language/markdown.h"

namespace cnctrans {
namespace {

const std::string tests = CNCTRANS_SOURCE_DIR "/tests/";

/// Entry -> what the table says of it.
std::map<std::string, std::string> table() {
  std::map<std::string, std::string> rows;
  for (const auto& section : testing::read_markdown(tests + "catalogue/heidenhain-entries.md")) {
    for (const auto& line : section.lines) {
      const auto middle = line.find(" | "), last = line.rfind(" |");
      if (line.rfind("| ", 0) != 0 || middle == std::string::npos || middle >= last) continue;
      rows[line.substr(2, middle - 2)] = line.substr(middle + 3, last - middle - 3);
    }
  }
  rows.erase("entry");
  return rows;
}
std::set<std::string> sections() {
  std::set<std::string> names;
  for (const auto& path : testing::files_below(tests + "catalogue/heidenhain", {".md"})) {
    for (const auto& s : testing::read_markdown(path)) {
      constexpr std::string_view dialect = "heidenhain.";
      const std::string name = s.heading.substr(0, s.heading.find(' '));
      if (s.level == 2 && name.rfind(dialect, 0) == 0) names.insert(name.substr(dialect.size()));
    }
  }
  return names;
}
/// The value of a key in a line of JSON, without quotes.
std::string value_of(const std::string& line, const std::string& key) {
  const auto at = line.find('"' + key + "\": ");
  if (at == std::string::npos) return {};
  std::string_view rest = std::string_view(line).substr(at + key.size() + 4);
  const bool quoted = rest.front() == '"';
  if (quoted) rest.remove_prefix(1);
  return std::string(rest.substr(0, rest.find_first_of(quoted ? "\"" : ",}")));
}

TEST(CatalogueEntries, HaveTheTestThatTheTableNames) {
  const auto names = sections();
  const auto rows = table();
  ASSERT_FALSE(rows.empty());
  for (const auto& [entry, where] : rows) {
    if (where.rfind("- ", 0) == 0) continue;
    const bool file = where.find('/') != std::string::npos;
    EXPECT_TRUE(file ? std::filesystem::exists(tests + where + ".md") : names.count(where) != 0)
        << entry << ": there is no test `" << where << '`';
  }
}

TEST(CatalogueEntries, AreAllInTheTable) {
  const char* given = std::getenv("CNCTRANS_SPEC");  // NOLINT(concurrency-mt-unsafe)
  const auto spec =
      given != nullptr ? std::filesystem::path(given) : std::filesystem::path(CNCTRANS_SOURCE_DIR) / "../shared/spec";
  const auto files = testing::files_below((spec / "heidenhain").string(), {".jsonl"});
  if (files.empty()) GTEST_SKIP() << "no catalogue below " << spec;
  const auto rows = table();
  for (const auto& path : files) {
    std::ifstream lines(path);
    for (std::string line; std::getline(lines, line);) {
      const std::string entry = value_of(line, "id"), tier = value_of(line, "tier");
      if (entry.empty() || (tier != "1" && tier != "2")) continue;
      EXPECT_EQ(rows.count(entry.substr(entry.find('.') + 1)), 1U) << entry << " has no row";
    }
  }
}

}  // namespace
}  // namespace cnctrans
