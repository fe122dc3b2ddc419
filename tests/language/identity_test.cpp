// tests/identity/<dialect>/: read, write, same text; and reading the written text gives the same program.
#include <gtest/gtest.h>

#include "ir/text/text.h"
#include "tests/language/markdown.h"
#include "translator/pipeline.h"

namespace cnctrans {
namespace {

const std::string root = CNCTRANS_SOURCE_DIR "/tests/identity/";

struct Case {
  std::string path, dialect;
};
std::vector<Case> cases() {
  std::vector<Case> out;
  for (const auto& d : translator::dialects()) {
    for (const auto& p : testing::files_below(root + std::string(d.name), {""})) {
      if (p.find("README") == std::string::npos) out.push_back({p, std::string(d.name)});
    }
  }
  return out;
}

class Identity : public ::testing::TestWithParam<Case> {};

TEST_P(Identity, WritesWhatItRead) {
  const auto text = testing::read_file(GetParam().path);
  const auto first = translator::rewrite(SourceText::from_string(GetParam().path, text), GetParam().dialect, "");
  ASSERT_TRUE(first.error.empty()) << first.error;
  EXPECT_FALSE(first.diagnostics.has_errors()) << render_text(first.diagnostics, FileTable{});
  ASSERT_FALSE(first.files.empty());
  std::string written;
  for (const auto& f : first.files) written += f.text;
  EXPECT_EQ(written, text);
  const auto second = translator::rewrite(SourceText::from_string(GetParam().path, written), GetParam().dialect, "");
  std::string where;
  EXPECT_TRUE(ir::same_program(first.program, second.program, &where)) << where;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Identity);
INSTANTIATE_TEST_SUITE_P(Files, Identity, ::testing::ValuesIn(cases()),
                         [](const auto& test) { return testing::test_name(test.param.path, root); });

}  // namespace
}  // namespace cnctrans
