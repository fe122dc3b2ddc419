// tests/golden: whole programs and what they become, kept to be read by people. tests/golden/README.md says how to
// renew them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/language/markdown.h"
#include "translator/pipeline.h"

namespace cnctrans {
namespace {

namespace fs = std::filesystem;
const std::string root = CNCTRANS_SOURCE_DIR "/tests/golden/";

struct Golden {
  const char *from, *file;
  bool lathe;
  bool heidenhain = false;  ///< it can be said there: one plane, one unit
};
std::ostream& operator<<(std::ostream& out, const Golden& g) {
  return out << g.from << '/' << g.file;
}

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class GoldenPrograms : public ::testing::TestWithParam<Golden> {};

TEST_P(GoldenPrograms, BecomeWhatIsKept) {
  const Golden g = GetParam();
  const bool renew = std::getenv("CNCTRANS_RENEW_GOLDEN") != nullptr;
  const std::string source = root + g.from + '/' + g.file;
  ASSERT_TRUE(fs::exists(source));
  for (const std::string to : {"fagor", "num", "sinumerik", "heidenhain"}) {
    if (to == g.from || (to == "heidenhain" && !g.heidenhain)) continue;
    SCOPED_TRACE(std::string(g.from) + " -> " + to);
    translator::TranslateOptions options;
    options.from = g.from;
    options.to = to;
    options.machine = std::string(g.from) + (g.lathe ? "-lathe" : "-mill");
    options.target_machine = to + (g.lathe ? "-lathe" : "-mill");
    options.verify = true;
    options.origin = true;
    const auto result = translator::translate(source, options);
    ASSERT_TRUE(result.error.empty()) << result.error;
    ASSERT_FALSE(result.refused) << render_text(result.diagnostics, result.files);
    EXPECT_TRUE(result.verdict.good()) << verifier::describe(result.verdict, result.files, result.target_files);
    EXPECT_GE(result.verdict.coverage.blocks, 150U);  // without the lines that are only comments
    std::string text;
    for (const auto& o : result.outputs) text += "--- " + fs::path(o.name).filename().string() + '\n' + o.bytes;
    const fs::path kept = root + "become/" + fs::path(g.file).stem().string() + "-in-" + to + ".txt";
    if (renew) std::ofstream(kept, std::ios::binary) << text;
    EXPECT_EQ(text, content(kept)) << kept;
  }
}

INSTANTIATE_TEST_SUITE_P(All, GoldenPrograms,
                         ::testing::Values(Golden{"fagor", "000321.PIM", false}, Golden{"fagor", "000322.PIT", true},
                                           Golden{"num", "000330.xpi", false}, Golden{"num", "000340.xpi", true},
                                           Golden{"sinumerik", "cover.mpf", false},
                                           Golden{"sinumerik", "fixture.mpf", false, true},
                                           Golden{"sinumerik", "pinl.mpf", true},
                                           Golden{"heidenhain", "coverplt.H", false}));

}  // namespace
}  // namespace cnctrans
