// tests/catalogue/<dialect>/*.md: every construct of a language's catalogue as a program and what it must do: the
// events of its run, the variables it leaves, or the code it is refused with. See README.md there.
#include <gtest/gtest.h>

#include <set>

#include "base/text.h"
#include "dialects/options.h"
#include "tests/interpreter/run_ir.h"
#include "tests/language/markdown.h"
#include "translator/files/registry.h"

namespace cnctrans {
namespace {

const std::string root = CNCTRANS_SOURCE_DIR "/tests/catalogue/";

struct Entry {
  std::string path, dialect;
  testing::Section section;
};

std::vector<Entry> entries() {
  std::vector<Entry> list;
  for (const auto& d : translator::dialects()) {
    for (const auto& p : testing::files_below(root + std::string(d.name), {".md"})) {
      for (auto& s : testing::read_markdown(p)) {
        if (s.level == 2) list.push_back({p, std::string(d.name), std::move(s)});
      }
    }
  }
  return list;
}

std::vector<std::string> values_of(const testing::Section& s, const std::string& key) {
  std::vector<std::string> found;
  for (const auto& line : s.lines) {
    if (line.rfind(key + ":", 0) == 0) found.emplace_back(trim(line.substr(key.size() + 1)));
  }
  return found;
}
std::string joined(const std::vector<std::string>& lines) {
  std::string s;
  for (const auto& l : lines) s += (s.empty() ? "" : "; ") + l;
  return s;
}

class Catalogue : public ::testing::TestWithParam<Entry> {};

TEST_P(Catalogue, DoesWhatItSays) {
  const Entry& entry = GetParam();
  const testing::Section& s = entry.section;
  const auto machines = values_of(s, "machine");
  std::string error;
  auto profile = dialects::load_profile(machines.empty() ? entry.dialect + "-mill" : machines[0], &error);
  ASSERT_TRUE(profile) << error;
  for (const auto& o : values_of(s, "option")) {
    const auto at = o.find('=');
    ASSERT_TRUE(dialects::options().set(*profile, trim(o.substr(0, at)), trim(o.substr(at + 1)), &error)) << error;
  }
  for (const auto& o : values_of(s, "data")) {
    const auto at = o.find('=');
    const auto value = parse_decimal(trim(o.substr(at + 1)));
    ASSERT_TRUE(value) << o;
    profile->data[std::string(trim(o.substr(0, at)))] = *value;
  }
  FileTable files;
  const SourcePtr source = SourceText::from_string("7.txt", s.fence);
  const FileId file = files.add(source);
  Diagnostics d;
  auto program = translator::find_dialect(entry.dialect)->frontend->read(source, file, {{}, &*profile}, d, nullptr);
  ir::number_statements(program);
  std::set<std::string> reported;
  for (const auto& x : d.all()) {
    if (x.severity != Severity::note) reported.insert(x.code);
  }
  const auto refused = values_of(s, "refuses"), warned = values_of(s, "warns");
  std::set<std::string> expected(refused.begin(), refused.end());
  expected.insert(warned.begin(), warned.end());
  EXPECT_EQ(reported, expected) << entry.path << ":" << s.line << "\n" << render_text(d, files);
  if (!refused.empty()) {
    EXPECT_TRUE(d.has_errors());
    return;
  }
  const auto traces = values_of(s, "trace");
  const auto variables = values_of(s, "vars");
  ASSERT_TRUE(!traces.empty() || !variables.empty()) << "nothing is expected: " << entry.path << ":" << s.line;
  const auto run = interpreter::run_program(program, *profile);
  if (!traces.empty()) {
    EXPECT_EQ(joined(run.lines), joined(traces)) << entry.path << ":" << s.line;
  }
  for (const auto& v : variables) {
    const auto at = v.find('=');
    const auto it = run.variables.find(std::string(trim(v.substr(0, at))));
    ASSERT_NE(it, run.variables.end()) << v;
    const auto is = parse_decimal(it->second), wanted = parse_decimal(trim(v.substr(at + 1)));
    ASSERT_TRUE(is && wanted) << it->second;
    EXPECT_NEAR(*is, *wanted, 5e-7) << v << " in " << entry.path << ":" << s.line;
  }
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Catalogue);
INSTANTIATE_TEST_SUITE_P(Files, Catalogue, ::testing::ValuesIn(entries()), [](const auto& test) {
  std::string name = test.param.dialect + "_" + test.param.section.heading;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
});

}  // namespace
}  // namespace cnctrans
