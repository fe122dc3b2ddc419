// examples/: every program to every other dialect, verified; and each translation back again, verified.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/language/markdown.h"
#include "translator/pipeline.h"

namespace cnctrans {
namespace {

namespace fs = std::filesystem;
const std::string root = CNCTRANS_SOURCE_DIR "/examples/";

struct Case {
  std::string path, from, to;
};

std::vector<Case> cases() {
  std::vector<Case> out;
  for (const auto& from : translator::dialects()) {
    for (const auto& path : testing::files_below(root + std::string(from.name), {".pim", ".pit", ".xpi", ".mpf"})) {
      for (const auto& to : translator::dialects()) {
        const bool replayed = to.frontend != nullptr;  // a dialect that is only written is tested in tests/oracle
        // The examples show arcs in every plane, which a Heidenhain program can't say (TRN-202); it has no lathe.
        if (to.name == "heidenhain") continue;
        if (to.name != from.name && replayed) out.push_back({path, std::string(from.name), std::string(to.name)});
      }
    }
  }
  return out;
}

translator::TranslateResult translate(const std::string& path, const std::string& from, const std::string& to,
                                      const std::string& machine) {
  translator::TranslateOptions options;
  options.from = from;
  options.to = to;
  options.machine = machine;
  options.verify = true;
  return translator::translate(path, options);
}

class Examples : public ::testing::TestWithParam<Case> {};

TEST_P(Examples, VerifyThereAndBack) {
  const auto& c = GetParam();
  const auto there = translate(c.path, c.from, c.to, "");
  ASSERT_TRUE(there.error.empty()) << there.error;
  EXPECT_FALSE(there.refused) << render_text(there.diagnostics, there.files);
  ASSERT_TRUE(there.verdict.good()) << verifier::describe(there.verdict, there.files, there.target_files);
  EXPECT_GT(there.verdict.moves, 30U);

  const auto folder = fs::temp_directory_path() / ("cnctrans-examples-" + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::string main;
  for (const auto& o : there.outputs) {
    const auto file = folder / o.name;
    std::ofstream(file, std::ios::binary) << o.bytes;
    if (o.main) main = file.string();
  }
  ASSERT_FALSE(main.empty());
  const bool lathe = c.path.find("lathe") != std::string::npos || c.path.ends_with(".pit");
  const auto back = translate(main, c.to, c.from, c.to + (lathe ? "-lathe" : "-mill"));
  ASSERT_TRUE(back.error.empty()) << back.error;
  EXPECT_FALSE(back.refused) << render_text(back.diagnostics, back.files);
  EXPECT_TRUE(back.verdict.good()) << verifier::describe(back.verdict, back.files, back.target_files);
  EXPECT_EQ(back.verdict.moves, there.verdict.moves);
  fs::remove_all(folder);
}

/// The fenced blocks of the README's example: the program, the command, what it becomes.
std::vector<std::string> readme_example() {
  const std::string text = testing::read_file(CNCTRANS_SOURCE_DIR "/README.md");
  const std::size_t begin = text.find("<!-- example:begin -->");
  const std::size_t end = text.find("<!-- example:end -->");
  std::vector<std::string> blocks;
  for (std::size_t at = text.find("```\n", begin); at < end; at = text.find("```\n", at)) {
    const std::size_t close = text.find("```\n", at + 4);
    blocks.push_back(text.substr(at + 4, close - at - 4));
    at = close + 4;
  }
  return blocks;
}

TEST(Readme, ItsExampleIsWhatIsWritten) {
  const auto blocks = readme_example();
  ASSERT_EQ(blocks.size(), 2U);
  const auto folder = fs::temp_directory_path() / ("cnctrans-readme-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "part.pim", std::ios::binary) << blocks[0];
  const auto result = translate((folder / "part.pim").string(), "fagor", "sinumerik", "");
  fs::remove_all(folder);
  EXPECT_TRUE(result.verdict.good()) << render_text(result.diagnostics, result.files);
  EXPECT_EQ(result.verdict.moves, 52U);
  std::string written;  // on standard output the programs follow each other as an archive
  for (const auto& o : result.outputs) {
    std::string name = o.name;
    std::replace(name.begin(), name.end(), '.', '_');
    written += "%_N_" + name + "\n" + o.bytes;
  }
  EXPECT_EQ(written, blocks[1]);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Examples);
INSTANTIATE_TEST_SUITE_P(Files, Examples, ::testing::ValuesIn(cases()), [](const auto& test) {
  return testing::test_name(test.param.path, root) + "_to_" + test.param.to;
});

}  // namespace
}  // namespace cnctrans
