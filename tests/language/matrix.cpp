#include "tests/language/matrix.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "dialects/options.h"
#include "tests/language/markdown.h"

namespace cnctrans {

void expect_support_matrix(const std::string& page, const std::string& made) {
  const std::string path = CNCTRANS_SOURCE_DIR "/docs/dialects/" + page;
  const std::string text = testing::read_file(path);
  const std::string begin = "<!-- begin of the support matrix -->\n", end = "<!-- end of the support matrix -->\n";
  const auto from = text.find(begin), to = text.find(end);
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos && from < to);
  const std::string whole = text.substr(0, from + begin.size()) + made + text.substr(to);
  if (std::getenv("CNCTRANS_WRITE_DOCS") != nullptr) {  // NOLINT(concurrency-mt-unsafe)
    std::ofstream(path, std::ios::binary) << whole;
    return;
  }
  EXPECT_EQ(text.substr(from + begin.size(), to - from - begin.size()), made)
      << "run this test with CNCTRANS_WRITE_DOCS=1 to write the matrix";
}

std::string option_table(std::string_view begin) {
  std::string s = "| Option | Values | Default | Meaning |\n|---|---|---|---|\n";
  for (const auto& o : dialects::options().rows()) {
    if (!o.name.starts_with(begin)) continue;
    std::string values(o.values);
    for (char& c : values) c = c == '|' ? ' ' : c;
    s += "| `" + std::string(o.name) + "` | " + values + " | " + std::string(o.fallback) + " | " +
         std::string(o.meaning) + " |\n";
  }
  return s;
}

}  // namespace cnctrans
