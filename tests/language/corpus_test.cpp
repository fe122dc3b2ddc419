// Real programs, kept outside of the repository: what is written of a program that was read reads as the same program,
// and writing that gives the same text. Folder: $CNCTRANS_CORPUS, else ../shared/corpus; skipped where there is none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "ir/text/text.h"
#include "tests/language/markdown.h"
#include "translator/pipeline.h"

namespace cnctrans {
namespace {

std::filesystem::path corpus() {
  const char* given = std::getenv("CNCTRANS_CORPUS");
  return given != nullptr ? std::filesystem::path(given)
                          : std::filesystem::path(CNCTRANS_SOURCE_DIR) / "../shared/corpus";
}

std::string written(const translator::RewriteResult& r) {
  std::string text;
  for (const auto& f : r.files) text += f.text;
  return text;
}

/// Programs one behind the other in a file become an archive, which has headers.
bool becomes_archive(const translator::RewriteResult& r) {
  const auto& all = r.diagnostics.all();
  return std::any_of(all.begin(), all.end(), [](const Diagnostic& d) { return d.code == "SIN-040"; });
}

/// Why `path` does not come back as it was read; empty: it does.
std::string not_the_same(const std::string& path, const std::string& dialect) {
  std::string message;
  const SourcePtr source = SourceText::open(path, &message);
  if (!source) return message;
  auto first = translator::rewrite(source, dialect, "");
  if (!first.error.empty()) return first.error;
  if (becomes_archive(first)) first = translator::rewrite(SourceText::from_string(path, written(first)), dialect, "");
  const std::string text = written(first);
  const auto second = translator::rewrite(SourceText::from_string(path, text), dialect, "");
  std::string where;
  if (!ir::same_program(first.program, second.program, &where)) return "another program: " + where;
  if (written(second) != text) return "another text when it is written again";
  return {};
}

class Corpus : public ::testing::TestWithParam<std::string> {};

TEST_P(Corpus, ComesBackAsItWasRead) {
  const auto folder = corpus() / GetParam();
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no corpus at " << folder;
  std::size_t files = 0;
  for (const auto& path : testing::files_below(folder.string(), {""})) {
    ++files;
    EXPECT_EQ(not_the_same(path, GetParam()), "") << path;
  }
  EXPECT_GT(files, 0U);
}

INSTANTIATE_TEST_SUITE_P(Dialects, Corpus, ::testing::Values("sinumerik"), [](const auto& test) { return test.param; });

}  // namespace
}  // namespace cnctrans
