// tests/command/*.md: command line, standard output, standard error, exit status. See tests/command/README.md.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/language/execute.h"
#include "tests/language/markdown.h"

namespace cnctrans {
namespace {

namespace fs = std::filesystem;
const std::string root = CNCTRANS_SOURCE_DIR "/tests/command/";

class Command : public ::testing::TestWithParam<std::string> {};

/// `contains` blocks: every line must occur somewhere.
void expect_lines(const std::string& text, const std::string& wanted, const std::string& what) {
  std::istringstream lines(wanted);
  for (std::string line; std::getline(lines, line);)
    EXPECT_NE(text.find(line), std::string::npos) << what << " lacks: " << line << "\n" << text;
}

void write_file(const fs::path& path, const std::string& content, const std::string& encoding) {
  fs::create_directories(path.parent_path());
  std::string bytes;
  if (encoding == "hex") {
    std::string digits;
    for (const char c : content) {
      if (std::isxdigit(static_cast<unsigned char>(c)) != 0) digits += c;
    }
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
      bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  } else if (encoding == "crlf") {
    for (const char c : content) bytes += c == '\n' ? std::string("\r\n") : std::string(1, c);
  } else {
    bytes = content;
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST_P(Command, DoesWhatItSays) {
  const fs::path folder = fs::temp_directory_path() / ("cnctrans-command-" + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  testing::Outcome last;
  bool ran = false;
  bool checked = false;
  for (const auto& s : testing::read_markdown(GetParam())) {
    SCOPED_TRACE(s.heading + " (line " + std::to_string(s.line) + ")");
    if (s.heading.rfind("file ", 0) == 0) {
      write_file(folder / s.heading.substr(5), s.fence, s.fence_language);
    } else if (s.heading == "run") {
      last = testing::execute(s.fence, folder);
      ran = true;
    } else if (s.heading == "stdout") {
      EXPECT_EQ(last.out, s.fence);
      checked = true;
    } else if (s.heading == "stderr") {
      EXPECT_EQ(last.err, s.fence);
      checked = true;
    } else if (s.heading == "stdout contains") {
      expect_lines(last.out, s.fence, "stdout");
      checked = true;
    } else if (s.heading == "stderr contains") {
      expect_lines(last.err, s.fence, "stderr");
      checked = true;
    } else if (s.heading == "diagnostics") {
      EXPECT_EQ(testing::diagnostics_in(last.err), s.fence);
      checked = true;
    } else if (s.heading.rfind("status ", 0) == 0) {
      EXPECT_EQ(last.status, std::stoi(s.heading.substr(7))) << last.err << last.out;
      checked = true;
    } else if (s.heading.rfind("content ", 0) == 0) {
      EXPECT_EQ(testing::read_file((folder / s.heading.substr(8)).string()), s.fence);
      checked = true;
    } else if (s.heading.rfind("absent ", 0) == 0) {
      EXPECT_FALSE(fs::exists(folder / s.heading.substr(7)));
      checked = true;
    } else if (s.level > 1) {
      ADD_FAILURE() << "unknown section: " << s.heading;
    }
  }
  EXPECT_TRUE(ran && checked) << "a command test runs a command and checks what it did";
  fs::remove_all(folder);
}

std::vector<std::string> command_files() {
  auto files = testing::files_below(root, {".md"});
  std::erase_if(files, [](const std::string& f) { return f.find("README") != std::string::npos; });
  return files;
}
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Command);
INSTANTIATE_TEST_SUITE_P(Files, Command, ::testing::ValuesIn(command_files()),
                         [](const auto& test) { return testing::test_name(test.param, root); });

}  // namespace
}  // namespace cnctrans
