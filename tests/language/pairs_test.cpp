// tests/pairs/*.md: one construct, every dialect's form side by side. See tests/pairs/README.md for the form.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "tests/language/markdown.h"
#include "translator/pipeline.h"

namespace cnctrans {
namespace {

namespace fs = std::filesystem;
const std::string root = CNCTRANS_SOURCE_DIR "/tests/pairs/";
constexpr const char* mark = "PAIR STARTS HERE";

/// The frame around a snippet: a header, a full safe start and a gear range, so that nothing is inserted, and a mark.
/// Definitions of variables at the start of a snippet stand between the title and the safe start.
struct Frame {
  std::string extension, title, open, close;
  std::string last = {};  ///< behind the subprograms too
};
Frame frame(const std::string& dialect, bool lathe) {
  const std::string m = mark;
  if (dialect == "fagor") {
    return {lathe ? "pit" : "pim", "%PAIR ,MX,\n",
            std::string(lathe ? "G18 G40 G05 G71 G90 G95 G151 G97" : "G17 G40 G05 G71 G90 G94") + " M41\n;" + m + "\n",
            "M30\n"};
  }
  if (dialect == "num")
    return {"xpi", "%100 (PAIR)\n",
            std::string(lathe ? "G18 G40 G71 G90 G95 G97" : "G17 G40 G71 G80 G90 G94") + " M41\n(" + m + ")\n",
            "M02\n"};
  if (dialect == "heidenhain") return {"h", "BEGIN PGM PAIR MM\n", "; " + m + "\n", "M30\n", "END PGM "};
  return {"mpf", "; PAIR\n",
          std::string(lathe ? "G18 G40 G64 G710 G90 G95 DIAMON" : "G17 G40 G64 G710 G90 G94") + " M41\n; " + m + "\n",
          "M30\n"};
}

struct Form {
  std::string text;                  ///< the snippet; subprograms may follow a line `---`
  std::vector<std::string> refuses;  ///< codes, when the construct is refused for this target
  bool source = false;
  bool unverified = false;
  bool own_words = false;  ///< what it becomes is verified, not compared with the other forms letter by letter
};
struct Pair {
  std::string path;
  bool lathe = false;
  std::map<std::string, Form> forms;
};

Pair read_pair(const std::string& path) {
  Pair pair;
  pair.path = path;
  for (const auto& s : testing::read_markdown(path)) {
    if (s.level == 1) {
      pair.lathe =
          std::any_of(s.lines.begin(), s.lines.end(), [](const std::string& l) { return l == "machine: lathe"; });
      continue;
    }
    Form f;
    f.text = s.fence;
    for (const auto& line : s.lines) {
      if (line.rfind("refuses: ", 0) == 0) f.refuses.push_back(line.substr(9));
      if (line == "target only") f.source = false;
      if (line == "not verified") f.unverified = true;
      if (line == "own words") f.own_words = true;
    }
    f.source = f.refuses.empty() && std::find(s.lines.begin(), s.lines.end(), "target only") == s.lines.end();
    pair.forms[s.heading] = std::move(f);
  }
  return pair;
}

bool is_definition(const std::string& line) {
  return line.rfind("DEF ", 0) == 0;
}

/// The definitions among the lines of a text, each with its line end.
std::string definitions(const std::string& text) {
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    if (is_definition(line)) out += line + "\n";
  }
  return out;
}

/// Text of a whole program: the part before `---`, the end word, the part after it.
std::string program_text(const Form& form, const Frame& f) {
  const auto split = form.text.find("---\n");
  std::string main = form.text.substr(0, split);
  std::string defined;
  while (is_definition(main)) {
    const auto end = main.find('\n') + 1;
    defined += main.substr(0, end);
    main.erase(0, end);
  }
  const std::string rest = split == std::string::npos ? std::string() : form.text.substr(split + 4);
  const std::string last = f.last.empty() ? std::string() : f.last + "PAIR MM\n";
  return f.title + defined + f.open + main + f.close + rest + last;
}

/// What the translation says after the mark, in the notation of the snippets.
std::string snippet_of(const std::vector<translator::OutputText>& outputs, const Frame& f) {
  std::string text;
  for (const auto& o : outputs) text += o.bytes;
  const auto at = text.find(mark);
  if (at == std::string::npos) return "(no mark in the output)\n" + text;
  const std::string defined = definitions(text.substr(0, at));
  text.erase(0, text.find('\n', at) + 1);
  if (!f.last.empty()) text.erase(std::min(text.size(), text.rfind(f.last)));
  const auto end = text.find(f.close);
  if (end != std::string::npos) {
    const bool more = end + f.close.size() < text.size();
    text.replace(end, f.close.size(), more ? "---\n" : "");
  }
  return defined + text;
}

class Pairs : public ::testing::TestWithParam<std::string> {};

TEST_P(Pairs, EveryFormBecomesEveryOther) {
  const Pair pair = read_pair(GetParam());
  ASSERT_GE(pair.forms.size(), 2U);
  int directions = 0;
  for (const auto& [from, source] : pair.forms) {
    if (!source.source) continue;
    const Frame source_frame = frame(from, pair.lathe);
    const auto folder = fs::temp_directory_path() / ("cnctrans-pairs-" + std::to_string(getpid()));
    fs::create_directories(folder);
    const std::string file = (folder / ("000100." + source_frame.extension)).string();
    std::ofstream(file, std::ios::binary) << program_text(source, source_frame);
    for (const auto& [to, wanted] : pair.forms) {
      if (to == from) continue;
      SCOPED_TRACE(from + " -> " + to);
      translator::TranslateOptions options;
      options.from = from;
      options.to = to;
      options.machine = from + (pair.lathe ? "-lathe" : "-mill");
      options.verify = true;
      options.single_output = true;
      // The control numbers the blocks itself: a snippet has no numbers there.
      if (to == "heidenhain") options.numbering = backends::Numbering::none;
      const auto result = translator::translate(file, options);
      ++directions;
      ASSERT_TRUE(result.error.empty()) << result.error;
      if (!wanted.refuses.empty()) {
        EXPECT_TRUE(result.refused);
        for (const auto& code : wanted.refuses) {
          const auto& all = result.diagnostics.all();
          EXPECT_TRUE(
              std::any_of(all.begin(), all.end(),
                          [&code](const Diagnostic& d) { return d.code == code && d.severity == Severity::error; }))
              << "expected " << code << "\n"
              << render_text(result.diagnostics, result.files);
        }
        continue;
      }
      EXPECT_FALSE(result.refused) << render_text(result.diagnostics, result.files);
      if (!source.own_words) {
        EXPECT_EQ(snippet_of(result.outputs, frame(to, pair.lathe)), wanted.text);
      }
      if (!source.unverified && !wanted.unverified) {
        EXPECT_TRUE(result.verdict.good()) << verifier::describe(result.verdict, result.files, result.target_files);
      }
    }
    fs::remove_all(folder);
  }
  EXPECT_GT(directions, 0) << "a pair file without a source form tests nothing";
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Pairs);
std::vector<std::string> pair_files() {
  auto files = testing::files_below(root, {".md"});
  std::erase_if(files, [](const std::string& f) { return f.find("README") != std::string::npos; });
  return files;
}
INSTANTIATE_TEST_SUITE_P(Files, Pairs, ::testing::ValuesIn(pair_files()),
                         [](const auto& test) { return testing::test_name(test.param, root); });

}  // namespace
}  // namespace cnctrans
