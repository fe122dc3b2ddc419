// A long file that is translated by its folded text becomes what the whole text becomes, to the byte, with the same
// diagnostics. Random plain programs of every language to every other one, on mills and lathes, with heads that only
// the whole program can be read with: calls, conditions, repeats, jumps into the middle.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.h"
#include "translator/files/registry.h"
#include "translator/folding/folded_lines.h"
#include "translator/folding/unfolding.h"

namespace cnctrans::test {
namespace {

constexpr std::array<std::string_view, 4> languages{"fagor", "num", "sinumerik", "heidenhain"};
constexpr std::uint32_t programs = 60;  ///< of each pair and kind of machine

struct Pair {
  std::string from, to;
  bool lathe = false;
};

translator::TranslateOptions options_of(const Pair& pair, std::uint32_t seed) {
  translator::TranslateOptions o;
  o.from = pair.from;
  o.to = pair.to;
  o.machine = pair.from + (pair.lathe ? "-lathe" : "-mill");
  o.target_machine = pair.to + (pair.lathe ? "-lathe" : "-mill");
  o.single_output = true;
  if (seed % 8 == 1) o.numbering = backends::Numbering::none;
  if (seed % 16 == 4) o.eol = Eol::crlf;
  return o;
}

/// A program of a CAM system: a head, runs of plain lines with habits of their own, and what stands between them.
class Path {
 public:
  Path(std::string_view language, bool lathe, std::uint32_t seed) : language_(language), lathe_(lathe), random_(seed) {
    numbers_ = chance(60);
    tight_ = (language == "fagor" || language == "num") && chance(30);
    arcs_ = !lathe && chance(60);
    modal_ = !plain_text() && chance(50);
    every_ = chance(50) ? between(40, 200) : 0;
    places_ = between(1, 3);
    if (chance(40)) turning_ = lathe ? "C" : chance(50) ? "AC" : chance(50) ? "BC" : "A";
    plain_turns_ = chance(50);
  }

  std::string text() {
    head();
    const int lines = between(150, 500);
    for (int i = 0; i < lines; ++i) {
      if (every_ != 0 && i % every_ == every_ - 1) between_runs();
      line(i);
    }
    put({"G0", "Z50"});
    put({language_ == "num" ? "M02" : "M30"});
    if (plain_text()) put({"END PGM PART12 MM"});
    return out_;
  }

 private:
  bool chance(int percent) { return between(0, 99) < percent; }
  int between(int lo, int hi) { return lo + static_cast<int>(random_() % static_cast<std::uint32_t>(hi - lo + 1)); }
  /// Thousandths as the program writes them.
  std::string number(int thousandths) {
    std::string text = std::to_string(std::abs(thousandths) / 1000) + '.' +
                       std::to_string(1000 + std::abs(thousandths) % 1000).substr(1, 3);
    if (chance(10)) {  // as people write
      while (text.back() == '0') text.pop_back();
      if (text.back() == '.') text.pop_back();
    }
    return thousandths < 0 && text.find_first_not_of("0.") != std::string::npos ? '-' + text : text;
  }
  int place() {
    const int unit = places_ == 1 ? 100 : places_ == 2 ? 10 : 1;
    return between(-90000, 90000) / unit * unit;
  }

  /// Thousandths of a degree: the way there is short, or any; a NUM says the direction by the sign.
  int turn(char axis) {
    int& at = turned_[axis == 'A' ? 0 : 1];
    if (chance(10)) return at;
    const int to = std::clamp(plain_turns_ ? at + between(-900, 900) : between(-200, 400) * 1000, -199000, 359000);
    const bool by_sign = language_ == "num" && axis != 'A';
    const int from = std::exchange(at, to), place = (to + 360000) % 360000;
    return by_sign && place != 0 && to < from ? -place : by_sign ? place : to;
  }

  [[nodiscard]] bool plain_text() const { return language_ == "heidenhain"; }
  /// Words of a line with G codes, in plain text: L for G0 and G1, signs before the numbers.
  static void as_plain_text(std::vector<std::string>& words) {
    const bool rapid = words.front() == "G0";
    if (!rapid && words.front() != "G1") return;
    words.front() = "L";
    for (std::size_t i = 1; i < words.size(); ++i) {
      const std::size_t at = words[i][0] == 'I' ? 2 : 1;
      if (words[i][0] != 'F' && words[i][at] != '-') words[i].insert(at, "+");
    }
    if (rapid) words.insert(words.end(), {"R0", "FMAX"});
  }

  void put(std::vector<std::string> words) {
    std::string text;
    if (words.front().size() == 2 && words.front()[0] == 'G' && words.front()[1] < '4') {
      const std::string motion = words.front();
      if (modal_ && motion == motion_ && words.size() > 1) words.erase(words.begin());
      motion_ = motion;
    }
    if (plain_text()) {
      as_plain_text(words);
      if (numbers_) text = std::to_string(block_++) + ' ';
    } else if (numbers_) {
      text = "N" + std::to_string(block_);
      block_ += 10;
      if (!tight_) text += ' ';
    }
    for (std::size_t i = 0; i < words.size(); ++i) text += (i != 0 && !tight_ ? " " : "") + words[i];
    out_ += text + '\n';
  }

  void head() {
    if (plain_text()) {
      put({"BEGIN PGM PART12 MM"});
      if (chance(30)) put({"Q1 = 3"});
      tool(1);
      put({"M3"});
      if (chance(20)) put({"M126"});
      put({"G0", "X10", "Y20"});
      put({"G0", "Z5"});
      at_ = {10000, 20000};
      return;
    }
    if (language_ == "fagor") out_ += "%PART,MX,\n";
    if (language_ == "num") out_ += "%12\n";
    put({lathe_ ? "G18" : "G17"});
    put({"G90"});
    static const std::map<std::string_view, std::array<std::string_view, 5>> heads{
        {"fagor", {"", "", "(P1=3)\n", "(IF P5 EQ 1 GOTO N700)\n", "(RPT N500,N530)N2\n"}},
        {"num", {"", "", "L1=3\n", "G79 L5=1 N700\n", "G77 N500 N530 S2\n"}},
        {"sinumerik", {"", "", "R1=3\n", "IF R5==1 GOTOF N700\n", "REPEAT N500 N530 P=2\n"}}};
    const int kind = between(0, numbers_ ? 4 : 2);
    out_ += heads.at(language_)[static_cast<std::size_t>(kind)];
    put({"T1", "D1"});
    put({"S3000", "M3"});
    put({"G0", "X10", lathe_ ? "Z20" : "Y20"});
    if (!lathe_) put({"Z5"});
    at_ = {10000, 20000};
  }

  void tool(int number) {
    if (plain_text()) {
      put({"TOOL CALL " + std::to_string(number) + " Z S3000"});
    } else {
      put({"T" + std::to_string(number), "D1"});
    }
  }

  void between_runs() {
    const int kind = between(0, 6);
    if (kind == 0) out_ += language_ == "num" ? "(LEVEL)\n" : language_ == "fagor" ? ";LEVEL\n" : "; LEVEL\n";
    if (kind == 1) put({"M8"});
    if (kind == 2) {
      put({"G0", "Z50"});
      tool(between(2, 9));
    }
    if (kind == 3 && !lathe_) increments();
    if (kind == 4 && !plain_text()) put({"G4", language_ == "fagor" ? "K50" : "F1"});
    if (kind == 4 && plain_text()) put({"LBL " + std::to_string(label_++)});
    if (kind == 5) put({(plain_text() ? "TOOL CALL Z S" : "S") + std::to_string(between(5, 40) * 100)});
    if (kind == 6) put({chance(50) ? "M9" : "M1"});
  }

  /// A part of the path by increments, with arcs where the language has them in such lines.
  void increments() {
    if (!plain_text()) put({"G91"});
    const std::string sign = plain_text() ? "I" : "";
    const int lines = between(20, 150);
    for (int i = 0; i < lines; ++i) {
      std::vector<std::string> words{"G1"};
      for (const char axis : {'X', 'Y', 'Z'}) {
        if (chance(70) || words.size() == 1) words.push_back(sign + axis + number(between(-90, 90) * 10));
      }
      for (const char axis : turning_) {
        if (chance(50)) words.push_back(sign + axis + number(between(-90, 90)));
      }
      if (chance(5)) words.push_back("F" + std::to_string(between(1, 20) * 50));
      if (!plain_text() && arcs_ && chance(15)) {
        const int r = between(2, 40) * 100;
        const bool by_centre = chance(50);
        words = {chance(50) ? "G2" : "G3", "X" + number(2 * r), "Y0"};
        if (by_centre) words.insert(words.end(), {"I" + number(r), "J0"});
        if (!by_centre) words.push_back((language_ == "sinumerik" ? "CR=" : "R") + number(r));
      }
      put(words);
      if (plain_text() && chance(10)) put({"G1", "X" + number(place())});
    }
    if (!plain_text()) put({"G90"});
    turned_ = {};
    put({"G1", "X10", "Y20"});
    at_ = {10000, 20000};
  }

  void line(int i) {
    const std::string second = lathe_ ? "Z" : "Y";
    if (arcs_ && i > 3 && chance(15)) {
      const int r = between(2, 40) * 500, side = at_[0] < 0 ? 1 : -1;
      const int x = at_[0] + 2 * side * r;
      if (plain_text()) {
        const bool by_radius = chance(50);
        if (!by_radius) put({"CC", "X" + number(at_[0] + side * r), "Y" + number(at_[1])});
        std::vector<std::string> arc{by_radius ? "CR" : "C", "X" + number(x), "Y" + number(at_[1])};
        if (by_radius) arc.push_back("R+" + number(r));
        arc.emplace_back(chance(50) ? "DR+" : "DR-");
        put(arc);
        at_[0] = x;
        return;
      }
      if (chance(40)) {
        put({chance(50) ? "G2" : "G3", "X" + number(x), "Y" + number(at_[1]),
             (language_ == "sinumerik" ? "CR=" : "R") + number(r)});
        at_[0] = x;
        return;
      }
      const bool place = language_ == "num";
      put({chance(50) ? "G2" : "G3", "X" + number(x), "Y" + number(at_[1]),
           "I" + number(place ? at_[0] + side * r : side * r), "J" + number(place ? at_[1] : 0)});
      at_[0] = x;
      return;
    }
    std::vector<std::string> words{chance(3) ? "G0" : "G1"};
    const int axes = between(0, 5);
    if (axes != 1) words.push_back("X" + number(at_[0] = place()));
    if (axes != 2) words.push_back(second + number(at_[1] = place()));
    if (axes > 3 && !lathe_) words.push_back("Z" + number(place()));
    for (const char axis : turning_) {
      if (chance(80)) words.push_back(axis + number(turn(axis)));
    }
    if (i == 0 || chance(5)) words.push_back("F" + std::to_string(between(1, 20) * 50));
    put(words);
  }

  std::string_view language_;
  bool lathe_, numbers_ = false, tight_ = false, arcs_ = false, modal_ = false;
  std::mt19937 random_;
  int every_ = 0, places_ = 3, block_ = 10, label_ = 1;
  std::array<int, 2> at_{}, turned_{};
  bool plain_turns_ = false;
  std::string turning_;  ///< letters of the rotary axes
  std::string motion_;   ///< that was said last
  std::string out_;
};

/// The codes that are said: a folded text says a thing of the lines it has only.
std::set<std::string> codes(const Diagnostics& said) {
  std::set<std::string> found;
  for (const auto& d : said.all()) found.insert(d.code);
  return found;
}

/// Lines that were left out; 0: the text was not folded.
std::uint64_t compare(const Pair& pair, std::uint32_t seed, const TemporaryFolder& folder) {
  const std::string program = Path(pair.from, pair.lathe, seed).text();
  const std::string path = folder.write("PART12.TXT", program);
  const auto options = options_of(pair, seed);
  const auto folded = translator::translate_folded(path, options, 0);
  if (!folded || folded->result.refused) return 0;
  const auto whole = translator::translate(path, options);
  SCOPED_TRACE(pair.from + " to " + pair.to + (pair.lathe ? " (lathe)" : "") + ", seed " + std::to_string(seed));
  EXPECT_EQ(whole.error, "");
  EXPECT_FALSE(whole.refused);
  EXPECT_EQ(codes(folded->result.diagnostics), codes(whole.diagnostics));
  EXPECT_EQ(folded->result.lines, whole.lines);
  EXPECT_EQ(whole.outputs.size(), folded->result.outputs.size());
  if (::testing::Test::HasFailure()) return 0;
  for (std::size_t i = 0; i < whole.outputs.size(); ++i) {
    std::string text;
    const auto& unfolding = *folded->unfolding;
    const std::size_t part = seed % 2 == 0 ? 1U << 19U : 2000;  // one part, or several of them
    EXPECT_TRUE(unfolding.write(
        i, folded->result.outputs[i].bytes, [&](std::string_view t) { return text += t, true; }, part));
    EXPECT_EQ(text, whole.outputs[i].bytes);
  }
  if (::testing::Test::HasFailure()) ADD_FAILURE() << program;
  return folded->text.lines_left_out();
}

/// The events as text, and how the run ended.
class EventTexts final : public interpreter::TraceSink {
 public:
  EventTexts(std::string& out, const FileTable& files, std::vector<std::string> axes)
      : out_(out), files_(files), axes_(std::move(axes)) {
    out_.clear();
  }
  void on_event(const interpreter::Event& e) override { out_ += interpreter::to_json(e, files_, axes_) + '\n'; }

 private:
  std::string& out_;
  const FileTable& files_;
  std::vector<std::string> axes_;
};

/// True: the program was run by its folded text, and as the whole one.
bool compare_runs(const std::string& language, bool lathe, std::uint32_t seed, const TemporaryFolder& folder) {
  const std::string path = folder.write("PART12.TXT", Path(language, lathe, seed).text());
  translator::RunOptions options;
  options.dialect = language;
  options.machine = language + (lathe ? "-lathe" : "-mill");
  std::string folded_events, events;
  const auto into = [](std::string& text) {
    return [&text](const FileTable& files, const std::vector<std::string>& axes) {
      return std::make_unique<EventTexts>(text, files, axes);
    };
  };
  const auto folded =
      translator::run_folded(path, *translator::find_dialect(language), options, into(folded_events), 0);
  if (!folded) return false;
  const auto whole = translator::run(path, options, into(events));
  SCOPED_TRACE(language + ", seed " + std::to_string(seed));
  EXPECT_EQ(folded_events, events);
  EXPECT_EQ(folded->result.reason, whole.result.reason);
  EXPECT_EQ(folded->result.steps, whole.result.steps);
  EXPECT_EQ(folded->result.blocks, whole.result.blocks);
  EXPECT_EQ(codes(folded->diagnostics), codes(whole.diagnostics));
  return true;
}

class FoldingOfRun : public ::testing::TestWithParam<std::string_view> {};

TEST_P(FoldingOfRun, IsThatOfTheWholeText) {
  const TemporaryFolder folder;
  const auto first = static_cast<std::uint32_t>(GTEST_FLAG_GET(random_seed)) * 100000U;
  std::uint32_t folded = 0;
  for (std::uint32_t i = 0; i < programs && !::testing::Test::HasFailure(); ++i) {
    if (compare_runs(std::string(GetParam()), i % 4 == 0 && GetParam() != "heidenhain", first + i, folder)) ++folded;
  }
  EXPECT_GT(folded, programs / 3);
}
INSTANTIATE_TEST_SUITE_P(Languages, FoldingOfRun, ::testing::ValuesIn(languages),
                         [](const auto& p) { return std::string(p.param); });

void PrintTo(const Pair& p, std::ostream* out) {
  *out << p.from << " to " << p.to << (p.lathe ? ", lathe" : ", mill");
}

class FoldingOfPair : public ::testing::TestWithParam<Pair> {};

TEST_P(FoldingOfPair, IsTheWholeText) {
  const Pair& pair = GetParam();
  const TemporaryFolder folder;
  const auto first = static_cast<std::uint32_t>(GTEST_FLAG_GET(random_seed)) * 100000U;
  std::uint64_t left_out = 0;
  std::uint32_t folded = 0;
  for (std::uint32_t i = 0; i < programs && !::testing::Test::HasFailure(); ++i) {
    const auto lines = compare(pair, first + i, folder);
    left_out += lines;
    if (lines != 0) ++folded;
  }
  // The comparison is not an empty one. Lathes: X may be a radius on one side, every number another.
  if (!pair.lathe) {
    EXPECT_GT(folded, programs / 3) << left_out;
  }
  RecordProperty("folded", static_cast<int>(folded));
}

std::vector<Pair> pairs() {
  std::vector<Pair> all;
  for (const auto from : languages) {
    for (const auto to : languages) {
      const bool mill_only = from == "heidenhain" || to == "heidenhain";
      for (const bool lathe : {false, true}) {
        if (lathe && mill_only) continue;
        all.push_back({std::string(from), std::string(to), lathe});
      }
    }
  }
  return all;
}
INSTANTIATE_TEST_SUITE_P(Languages, FoldingOfPair, ::testing::ValuesIn(pairs()), [](const auto& p) {
  return p.param.from + "_" + p.param.to + (p.param.lathe ? "_lathe" : "_mill");
});

}  // namespace
}  // namespace cnctrans::test
