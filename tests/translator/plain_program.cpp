#include "tests/translator/plain_program.h"

#include <array>
#include <cctype>
#include <random>
#include <vector>

namespace cnctrans::test {
namespace {

/// What of a language the generator has to know.
struct Language {
  std::string_view name;
  char comment_open, comment_close;  ///< close 0: to the end of the line
  bool centre_follows_distance;      ///< I J K are coordinates under G90
  std::string_view radius;
  std::string_view end;
  std::vector<std::string_view> heads, singles, settings, m_words, skips;
};

Language language(std::string_view name, bool lathe) {
  Language l;
  l.name = name;
  l.comment_open = ';';
  l.comment_close = 0;
  l.centre_follows_distance = false;
  l.radius = "R";
  l.end = "M30";
  l.skips = {"/"};
  l.m_words = {"M3", "M4", "M5", "M03", "M05", "M8", "M9", "M08", "M09", "M7", "M0", "M1", "M00", "M01", "M6", "M06"};
  if (name == "fagor") {
    l.heads = {"%PART ,MX,", "%000012,MX,", "% ,MX,", "%BOLT (2),M,"};
    l.singles = {"G54", "G55", "G56", "G57", "G53", "G04 K100", "G4 K50.5", "G04 K0"};
    l.settings = {"G17", "G18", "G19", "G40", "G41", "G42", "G90", "G91", "G5",
                  "G7",  "G05", "G07", "G70", "G71", "G94", "G95", "G96", "G97"};
    l.settings.push_back(lathe ? "G151" : "G43");
    l.settings.push_back(lathe ? "G152" : "G44");
    l.skips = {"/", "/1", "/2", "/3"};
    l.m_words.insert(l.m_words.end(), {"M10", "M41", "M19", "M45"});
  } else if (name == "num") {
    l.comment_open = '(';
    l.comment_close = ')';
    l.centre_follows_distance = true;
    l.end = "M02";
    l.heads = {"%12", "%12 (PART)", "%100(BOLT)"};
    l.singles = {"G53", "G54", "G04 F1.5", "G4 F2", "G9"};
    l.settings = {"G17", "G18", "G19", "G40", "G41", "G42", "G90", "G91", "G70",
                  "G71", "G94", "G95", "G97", "G93", "G00", "G01", "G09", "G80"};
    l.m_words.insert(l.m_words.end(), {"M12", "M48", "M49", "M61", "M64"});
  } else {
    l.radius = "CR=";
    l.heads = {"%_N_PART_MPF", "; part"};
    l.singles = {"G54", "G55", "G57", "G500", "G4 F1.5", "G04 S3", "G9", "G53"};
    l.settings = {"G17", "G18", "G19", "G40", "G41", "G42", "G90", "G91",  "G60",  "G64",  "G601",
                  "G70", "G71", "G94", "G95", "G97", "G93", "G96", "G700", "G710", "G642", "DIAMON"};
    l.skips = {"/", "/1", "/2"};
    l.m_words.insert(l.m_words.end(), {"M10", "M41", "M19", "M70"});
  }
  return l;
}

class Generator {
 public:
  Generator(std::string_view dialect, bool lathe, std::uint32_t seed)
      : language_(language(dialect, lathe)), lathe_(lathe), random_(seed * 2654435761U + 17U) {
    habits();
  }

  PlainProgram program() {
    if (comments_ && chance(10)) line(chance(50) ? comment() : "");
    if (chance(40)) line(std::string(pick(language_.heads)));
    prologue();
    const int count = number(1, chance(10) ? 120 : 25);
    for (int i = 0; i < count; ++i) body_line();
    epilogue();
    if (!last_eol_ && !out_.empty()) out_.resize(out_.size() - eol_.size());
    return {std::move(out_), lathe_};
  }

 private:
  // Each of these stays the same through a program.
  int rare_ = 0;  ///< percent of lines with something unusual
  bool lower_ = false, numbers_ = true, comments_ = false, skips_ = false, blanks_ = false, tight_ = false;
  bool settings_ = false, machine_ = false, incremental_ = false, planes_ = false, arcs_ = false, radius_arcs_ = false,
       rotary_ = false, latin_ = false, long_numbers_ = false, odd_numbers_ = false, comp_ = false, singles_ = false;
  bool last_eol_ = true, names_tools_ = false;
  std::string_view eol_ = "\n";

  void habits() {
    rare_ = chance(60) ? 0 : number(1, 6);
    lower_ = chance(6);
    numbers_ = chance(65);
    comments_ = chance(30);
    skips_ = chance(12);
    blanks_ = chance(20);
    tight_ = chance(25);
    settings_ = chance(20);
    machine_ = chance(30);
    incremental_ = chance(25);
    planes_ = chance(20);
    arcs_ = chance(60);
    radius_arcs_ = chance(35);
    rotary_ = chance(8);
    latin_ = chance(10);
    long_numbers_ = chance(10);
    odd_numbers_ = chance(25);
    comp_ = chance(15);
    singles_ = chance(20);
    last_eol_ = chance(90);
    if (chance(20)) eol_ = "\r\n";
    if (chance(3)) eol_ = "\r";
    if (chance(4)) out_ = "\xEF\xBB\xBF";
    names_tools_ = language_.name == "sinumerik" && chance(15);
  }
  /// "T5", or a name where the program calls its tools by names.
  std::string tool(int least) {
    if (names_tools_ && chance(70)) return "T=\"MILL" + std::to_string(number(1, 4)) + '"';
    return "T" + std::to_string(number(least, 12));
  }

  bool chance(int percent) { return number(0, 99) < percent; }
  int number(int lo, int hi) { return lo + static_cast<int>(random_() % static_cast<std::uint32_t>(hi - lo + 1)); }
  template <class List>
  std::string_view pick(const List& list) {
    return list[static_cast<std::size_t>(number(0, static_cast<int>(list.size()) - 1))];
  }

  /// Thousandths as a number, written as people write.
  std::string decimal(int thousandths) {
    const bool minus = thousandths < 0;
    const int t = minus ? -thousandths : thousandths;
    std::string whole = std::to_string(t / 1000), fraction = std::to_string(1000 + t % 1000).substr(1);
    if (!chance(30)) {
      while (!fraction.empty() && fraction.back() == '0') fraction.pop_back();
    }
    std::string text = minus ? "-" : "";
    if (odd_numbers_ && !minus && chance(8)) text = "+";
    if (odd_numbers_ && chance(8)) whole.insert(0, "0");
    if (odd_numbers_ && whole == "0" && !fraction.empty() && chance(40)) whole.clear();
    text += whole;
    if (!fraction.empty()) text += '.' + fraction;
    if (fraction.empty() && odd_numbers_ && chance(15)) text += '.';
    if (long_numbers_ && !fraction.empty() && chance(20)) {
      while (fraction.size() < 3) {
        fraction += '0';
        text += '0';
      }
      text += std::to_string(number(1, 99));
    }
    return text;
  }
  std::string decimal() { return decimal(chance(20) ? number(-200, 200) * 1000 : number(-150000, 150000)); }

  std::string comment() {
    static constexpr std::array<std::string_view, 7> texts{" pocket ",
                                                           "TOOL 3",
                                                           "",
                                                           "\xC3\xA9"
                                                           "bauche",
                                                           "a; b",
                                                           " D=10 L=20",
                                                           "cafe\xE9"};
    std::string text(texts[static_cast<std::size_t>(number(0, latin_ ? 6 : 5))]);
    return language_.comment_open + text +
           (language_.comment_close != 0 ? std::string(1, language_.comment_close) : "");
  }

  std::string joined(const std::vector<std::string>& words) {
    std::string text;
    const bool tight = tight_ && language_.name != "sinumerik";
    for (const std::string& w : words) {
      if (!text.empty() && !tight) text += blanks_ && chance(10) ? "  " : " ";
      text += w;
    }
    return text;
  }

  void block(const std::vector<std::string>& words) {
    std::string text;
    if (blanks_ && chance(5)) text += ' ';
    if (skips_ && chance(15)) {
      text += pick(language_.skips);
      if (chance(50)) text += ' ';
    }
    if (numbers_ && !chance(3)) {
      text += 'N' + std::string(chance(4) ? "0" : "") + std::to_string(block_number_);
      block_number_ += block_number_ < 30000 ? 10 : -29990;
      if (!tight_ || chance(50)) text += ' ';
    }
    text += joined(words);
    if (comments_ && chance(20)) text += (chance(80) ? " " : "") + comment();
    if (blanks_ && chance(4)) text += "  ";
    line(text);
  }
  void line(std::string text) {
    if (lower_ && chance(50)) {
      for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    out_ += text;
    out_ += eol_;
  }

  // --- the parts of a program -----------------------------------------------------------------------------------

  void prologue() {
    if (comments_) line(comment());
    if (chance(70)) block({lathe_ ? "G18" : "G17", "G40", "G90"});
    if (chance(35)) block({chance(50) ? "G71" : "G94"});
    if (chance(25)) block({"G54"});
    if (chance(50)) block({tool(1), "D" + std::to_string(number(1, 9))});
    if (machine_ && chance(60)) block({"M6"});
    if (chance(60)) block({"S" + std::to_string(number(1, 40) * 100), "M3"});
    plane_ = lathe_ ? 1 : 0;
    if (chance(90)) {
      kind_ = chance(85) ? 0 : 1;
      block({kind_ == 0 ? "G0" : "G1", "X10", lathe_ ? "Z20" : "Y20", "F" + std::to_string(number(1, 9) * 100)});
      at_[0] = 10000;
      at_[lathe_ ? 2 : 1] = 20000;
    }
  }

  void epilogue() {
    if (chance(60)) block({"G0", "Z" + decimal(100000)});
    if (chance(88)) {
      std::vector<std::string> end;
      if (chance(10)) end.push_back("M5");
      end.push_back(std::string(chance(93) ? language_.end : "M2"));
      block(end);
    }
    if (chance(3)) line("");
    if (chance(2)) line("G1 X5");
    if (comments_ && chance(10)) line(comment());
  }

  void body_line() {
    if (chance(rare_)) return rare();
    if (comments_ && chance(8)) return line(comment());
    if (blanks_ && chance(4)) return line("");
    if (settings_ && chance(10)) return block({std::string(pick(language_.settings))});
    if (singles_ && chance(10)) return block({std::string(pick(language_.singles))});
    if (machine_ && chance(10)) return block({std::string(pick(language_.m_words))});
    if (machine_ && chance(6))
      return block({"S" + std::to_string(number(0, 60) * 100), std::string(chance(50) ? "M3" : "M4")});
    if (machine_ && chance(5)) {
      const std::string t = tool(0);
      if (!chance(40)) return block({t, "D1"});
      return chance(80) ? block({t, "D2", "M6"}) : block({t, "M6"});  // a tool without a D gets a warning
    }
    if (planes_ && chance(8)) {
      plane_ = number(0, 2);
      return block({"G" + std::to_string(17 + plane_)});
    }
    if (incremental_ && chance(8)) {
      absolute_ = !absolute_;
      if (chance(50)) return block({absolute_ ? "G90" : "G91"});
      return straight(absolute_ ? "G90" : "G91");
    }
    if (comp_ && chance(8)) return straight(std::string(chance(40) ? "G40" : chance(50) ? "G41" : "G42"));
    if (arcs_ && chance(25)) return arc();
    straight({});
  }

  void add_code(std::vector<std::string>& words, int kind) {
    if (kind == kind_ && !chance(15)) return;
    words.push_back((chance(20) ? "G0" : "G") + std::to_string(kind));
    kind_ = kind;
  }

  void straight(const std::string& setting) {
    std::vector<std::string> words;
    if (!setting.empty()) words.push_back(setting);
    add_code(words, chance(70) ? 1 : chance(50) ? 0 : kind_ > 1 ? 1 : kind_);
    const int axes = lathe_ ? 0b101 : 0b111;
    int wanted = number(1, 7) & axes;
    if (wanted == 0) wanted = 1;
    for (int i = 0; i < 3; ++i) {
      if ((wanted >> i & 1) == 0) continue;
      const int value = chance(20) ? number(-99, 99) * 1000 : number(-99999, 99999);
      at_[static_cast<std::size_t>(i)] = absolute_ ? value : at_[static_cast<std::size_t>(i)] + value;
      words.push_back("XYZ"[i] + decimal(value));
    }
    if (odd_numbers_ && words.size() > 1 && chance(3)) std::swap(words.back(), words[words.size() - 2]);
    if (rotary_ && chance(30)) words.push_back((chance(70) ? "C" : "A") + decimal());
    tail_words(words);
    block(words);
  }

  void tail_words(std::vector<std::string>& words) {
    if (chance(12)) words.push_back("F" + (chance(85) ? std::to_string(number(1, 30) * 50) : decimal(number(0, 3000))));
    if (machine_ && chance(4)) words.push_back("S" + std::to_string(number(1, 50) * 100));
    if (machine_ && chance(8)) words.push_back(std::string(pick(language_.m_words)));
  }

  /// Half a circle, a quarter or a full one, in thousandths that are whole.
  void arc() {
    static constexpr std::array<std::array<std::size_t, 2>, 3> axes{{{0, 1}, {2, 0}, {1, 2}}};
    const std::size_t u = axes[static_cast<std::size_t>(plane_)][0], v = axes[static_cast<std::size_t>(plane_)][1];
    if (lathe_ && plane_ != 1) return straight({});
    std::vector<std::string> words;
    const int code = chance(50) ? 2 : 3;
    add_code(words, code);
    const int r = number(1, 40) * (chance(50) ? 1000 : 250);
    const int kind = number(0, 9);
    int du = 0, dv = 0, cu = r, cv = 0;
    if (kind < 5) {
      du = 2 * r;
    } else if (kind < 8) {  // a quarter
      du = r;
      dv = code == 2 ? r : -r;
    }
    if (chance(4)) du += number(1, 30);  // not quite an arc
    const bool by_radius = radius_arcs_ && kind < 8 && chance(50);
    const std::string_view letters = "XYZ", centres = "IJK";
    const auto coordinate = [&](std::size_t axis, int step) {
      words.push_back(letters[axis] + decimal(absolute_ ? at_[axis] + step : step));
    };
    const bool first_u = u < v;
    const auto both = [&](auto&& one, int a, int b) {
      if (first_u) one(u, a);
      one(v, b);
      if (!first_u) one(u, a);
    };
    if (kind < 8 || chance(60)) {
      both(
          [&](std::size_t axis, int step) {
            if (step != 0 || !chance(25)) coordinate(axis, step);
          },
          du, dv);
    }
    if (!lathe_ && chance(6)) words.push_back(std::string(1, letters[3 - u - v]) + decimal());
    if (by_radius) {
      words.push_back(std::string(language_.radius) + (chance(10) ? "-" : "") + decimal(r));
    } else {
      const bool absolute = language_.centre_follows_distance && absolute_;
      both(
          [&](std::size_t axis, int step) {
            if (step != 0 || !chance(30)) words.push_back(centres[axis] + decimal(absolute ? at_[axis] + step : step));
          },
          cu, cv);
    }
    at_[u] += du;
    at_[v] += dv;
    tail_words(words);
    block(words);
  }

  /// What seldom stands in such a program: refused, left to the whole-program path, or taken all the same.
  void rare() {
    switch (number(0, 9)) {
      case 0: return block({"G1", "X99999.9999"});
      case 1: return block({"X", "Y5"});
      case 2: return block({"G2", "X5"});
      case 3: return line(" ");
      case 4: return block({"G1", "X1.23456789"});
      case 5: return block({"F0"});
      case 6: return block({"G1", "Y5", "X5", "F100"});
      case 7: return block({"M99"});
      case 8: return block({std::string(pick(language_.settings)), "G1", "X7", std::string(pick(language_.m_words))});
      default: return block({});
    }
  }

  const Language language_;
  const bool lathe_;
  std::mt19937 random_;
  std::string out_;
  std::array<int, 3> at_{};
  int kind_ = -1;
  int plane_ = 0;
  int block_number_ = 10;
  bool absolute_ = true;
};

}  // namespace

PlainProgram plain_program(std::string_view dialect, bool lathe, std::uint32_t seed) {
  return Generator(dialect, lathe, seed).program();
}

}  // namespace cnctrans::test
