// tests/passes/<concern>/<pass>.md: a program in the textual IR, and what one pass makes of it. See
// tests/passes/README.md.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "tests/language/execute.h"
#include "tests/language/markdown.h"

namespace cnctrans {
namespace {

namespace fs = std::filesystem;
const std::string root = CNCTRANS_SOURCE_DIR "/tests/passes/";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) out.push_back(line);
  return out;
}

/// Variables, then routines, or the body of the main program alone.
struct Written {
  std::string text;
  bool body = false;
  std::size_t above = 0;  ///< lines that the test does not write
};
Written whole(const std::string& language, const std::string& kind, const std::string& in) {
  Written w;
  w.text = "program \"" + language + "\"" + (kind == "lathe" ? " lathe\n" : "\n");
  const auto lines = lines_of(in);
  auto it = lines.begin();
  for (; it != lines.end() && it->rfind("space", 0) == 0; ++it) w.text += *it + '\n';
  w.body = it == lines.end() || it->rfind("routine", 0) != 0;
  w.above = w.body ? 2 : 1;
  if (w.body) w.text += "routine main 1 {\n";
  for (; it != lines.end(); ++it) w.text += *it + '\n';
  if (w.body) w.text += "}\n";
  return w;
}

/// The routines, or the body of the main program.
std::string shown(const std::string& printed, bool body) {
  const auto lines = lines_of(printed);
  const auto first =
      std::find_if(lines.begin(), lines.end(), [](const std::string& l) { return l.rfind("routine", 0) == 0; });
  std::string out;
  for (auto it = first; it != lines.end(); ++it) {
    if (!body)
      out += *it + '\n';
    else if (it != first && it + 1 != lines.end())
      out += (it->rfind("  ", 0) == 0 ? it->substr(2) : *it) + '\n';
  }
  return out;
}

/// `// error TRN-301` behind the lines of the program: "line severity code".
std::multiset<std::string> wanted(const std::string& in) {
  static const std::regex remark("(error|warning|note) ([A-Z]+-[0-9]+)");
  std::multiset<std::string> out;
  std::size_t n = 0;
  for (const auto& line : lines_of(in)) {
    ++n;
    const auto at = line.find("//");
    if (at == std::string::npos) continue;
    for (std::sregex_iterator it(line.begin() + static_cast<std::ptrdiff_t>(at), line.end(), remark), end; it != end;
         ++it)
      out.insert(std::to_string(n) + ' ' + it->str());
  }
  return out;
}
std::multiset<std::string> said(const std::string& err, std::size_t above) {
  static const std::regex diagnostic("(\\S+:(\\d+):\\d+: )?((error|warning|note) [A-Z]+-[0-9]+): .*");
  std::multiset<std::string> out;
  for (const auto& line : lines_of(err)) {
    std::smatch m;
    if (!std::regex_match(line, m, diagnostic)) continue;
    const std::size_t n = m[2].matched ? std::stoul(m[2].str()) - above : 0;
    out.insert(std::to_string(n) + ' ' + m[3].str());
  }
  return out;
}

class Passes : public ::testing::TestWithParam<std::string> {};

TEST_P(Passes, WritesWhatItSays) {
  const fs::path folder = fs::temp_directory_path() / ("cnctrans-passes-" + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string pass = fs::path(GetParam()).stem().string();
  static const std::regex machines("(\\w+)-(mill|lathe) -> ((\\w+)(-mill|-lathe)?)( .*)?");
  std::string in, out;
  bool checked = false;
  for (const auto& s : testing::read_markdown(GetParam())) {
    SCOPED_TRACE(s.heading + " (line " + std::to_string(s.line) + ")");
    std::smatch m;
    if (std::regex_match(s.heading, m, machines)) {
      const Written w = whole(m[1].str(), m[2].str(), s.fence);
      std::ofstream(folder / "in.ir") << w.text;
      std::string command =
          "cnctrans ir -q --dialect " + m[1].str() + " --to " + m[4].str() + " --pass " + pass + m[6].str() + " in.ir";
      if (m[5].matched) command += " --target-machine " + m[3].str();
      const auto done = testing::execute(command, folder);
      in = s.fence;
      out = shown(done.out, w.body);
      auto expected = wanted(in);
      for (const auto& line : s.lines) {  // without a place: a line of the text
        if (line.rfind("error ", 0) == 0 || line.rfind("warning ", 0) == 0 || line.rfind("note ", 0) == 0)
          expected.insert("0 " + line);
      }
      EXPECT_EQ(said(done.err, w.above), expected) << done.err;
    } else if (s.heading == "becomes") {
      EXPECT_EQ(out, s.fence);
      checked = true;
    } else if (s.heading == "stays") {
      std::string same;
      for (auto line : lines_of(in)) {
        if (line.rfind("space", 0) == 0) continue;
        if (const auto at = line.find("//"); at != std::string::npos)
          line.resize(line.find_last_not_of(' ', at - 1) + 1);
        same += line + '\n';
      }
      EXPECT_EQ(out, same);
      checked = true;
    } else if (s.level > 1) {
      ADD_FAILURE() << "unknown section: " << s.heading;
    }
  }
  EXPECT_TRUE(checked) << "a test of a pass says what becomes of a program";
  fs::remove_all(folder);
}

std::vector<std::string> pass_files() {
  auto files = testing::files_below(root, {".md"});
  std::erase_if(files, [](const std::string& f) { return f.find("README") != std::string::npos; });
  return files;
}
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Passes);
INSTANTIATE_TEST_SUITE_P(Files, Passes, ::testing::ValuesIn(pass_files()),
                         [](const auto& test) { return testing::test_name(test.param, root); });

}  // namespace
}  // namespace cnctrans
