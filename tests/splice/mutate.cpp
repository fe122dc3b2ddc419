#include "tests/splice/mutate.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace cnctrans::splice {

namespace {

using Lines = std::vector<std::string>;

struct Range {
  std::size_t first = 0, last = 0;  ///< inclusive
};

/// What the languages say differently.
struct Words {
  std::vector<std::string> skip_marks;
  std::vector<std::string> variables;
  std::string value_letters;  ///< letters whose value may be a variable
};
const Words& words_of(const std::string& dialect) {
  static const Words fagor{{"/", "/1", "/2"}, {"P150", "P151", "P15"}, "XYZIJKRFQABCHLEUVW"};
  static const Words num{{"/"}, {"L15", "L16", "L115"}, "XYZIJKRFABC"};
  static const Words sinumerik{{"/", "/1", "/3"}, {"R50", "R51"}, "XYZIJKFABC"};
  static const Words heidenhain{{"/"}, {"Q50", "Q51", "Q60"}, "XYZFABC="};
  return dialect == "fagor" ? fagor : dialect == "num" ? num : dialect == "heidenhain" ? heidenhain : sinumerik;
}

class Splicer {
 public:
  Splicer(Program program, const std::vector<Program>& programs, Chance& chance)
      : p_(std::move(program)), programs_(programs), chance_(chance), words_(words_of(p_.dialect)) {}

  void change() {
    using Change = void (Splicer::*)();
    static constexpr std::array<Change, 19> changes = {
        &Splicer::delete_line, &Splicer::delete_line, &Splicer::double_line, &Splicer::double_line,
        &Splicer::swap_lines,  &Splicer::swap_lines,  &Splicer::take_lines,  &Splicer::take_lines,
        &Splicer::take_lines,  &Splicer::mark_lines,  &Splicer::mark_lines,  &Splicer::mark_lines,
        &Splicer::variable,    &Splicer::variable,    &Splicer::subprogram,  &Splicer::repeat,
        &Splicer::loop,        &Splicer::branch,      &Splicer::modal_call};
    (this->*chance_.of(changes))();
  }
  Program take() { return std::move(p_); }

 private:
  Lines& lines() { return p_.lines; }
  [[nodiscard]] bool is(const char* dialect) const { return p_.dialect == dialect; }
  void insert(std::size_t at, std::string line) {
    lines().insert(lines().begin() + static_cast<std::ptrdiff_t>(at), std::move(line));
  }
  static std::size_t any_line(const Lines& list, Chance& chance) {
    for (int tries = 0; tries < 8; ++tries) {
      const std::size_t at = chance.below(list.size());
      if (!frames(list[at])) return at;
    }
    return 0;
  }
  std::size_t any() { return any_line(lines(), chance_); }
  /// Up to `most` lines in a row, none of them a frame.
  Range some(const Lines& list, std::size_t most) {
    Range r;
    r.first = r.last = any_line(list, chance_);
    for (std::size_t more = chance_.below(most); more > 0 && r.last + 1 < list.size() && !frames(list[r.last + 1]);
         --more)
      ++r.last;
    return r;
  }
  Range some(std::size_t most) { return some(lines(), most); }
  std::string number_of(std::size_t at) {
    LineParts parts = parts_of(lines()[at]);
    if (parts.number.empty()) {
      parts.number = "N" + std::to_string(next_number_++);
      lines()[at] = joined(parts);
    }
    return parts.number;
  }

  /// Puts a label before the line.
  std::string labelled(std::size_t at) {
    std::string label = std::to_string(next_label_++);
    insert(at, "LBL " + label);
    return label;
  }

  void delete_line() {
    const std::size_t at = any();
    if (!frames(lines()[at])) lines().erase(lines().begin() + static_cast<std::ptrdiff_t>(at));
  }
  void double_line() {
    const std::size_t at = any();
    if (frames(lines()[at])) return;
    const std::string copy = lines()[at];
    insert(chance_.one_in(2) ? at : std::max<std::size_t>(any(), 1), copy);
  }
  void swap_lines() {
    const std::size_t a = any();
    const std::size_t b = chance_.one_in(2) ? std::min(a + 1, lines().size() - 1) : any();
    if (!frames(lines()[a]) && !frames(lines()[b])) std::swap(lines()[a], lines()[b]);
  }
  void take_lines() {
    const Program* donor = nullptr;
    for (int tries = 0; tries < 8 && (donor == nullptr || donor->lathe != p_.lathe); ++tries)
      donor = &pick(programs_, chance_.draw());
    if (donor->lathe != p_.lathe) return;
    const Range r = some(donor->lines, 5);
    if (frames(donor->lines[r.first])) return;
    const std::size_t at = any() + 1;
    lines().insert(lines().begin() + static_cast<std::ptrdiff_t>(at),
                   donor->lines.begin() + static_cast<std::ptrdiff_t>(r.first),
                   donor->lines.begin() + static_cast<std::ptrdiff_t>(r.last) + 1);
  }
  void mark_lines() {
    const Range r = some(3);
    const std::string mark = chance_.of(words_.skip_marks);
    for (std::size_t i = r.first; i <= r.last; ++i) {
      LineParts parts = parts_of(lines()[i]);
      if (frames(lines()[i]) || !parts.skip.empty()) continue;
      parts.skip = mark;
      lines()[i] = joined(parts);
    }
  }

  /// The places of numbers in a line that a variable can stand for.
  [[nodiscard]] std::vector<Range> numbers_in(const std::string& line) const {
    std::vector<Range> out;
    const bool parameters = is("sinumerik") && line.find('(') != std::string::npos;
    const bool signs = is("heidenhain");
    const auto comment =
        signs ? std::string::npos : std::min(line.find(';'), is("num") ? line.find('(') : std::string::npos);
    for (std::size_t i = 1; i < std::min(line.size(), comment); ++i) {
      if (signs && line[i] == ';')
        i = std::min(line.find('\n', i), line.size() - 1);  // on to the next line of the block
      const auto digit = [&](std::size_t at) {
        return at < line.size() && (std::isdigit(static_cast<unsigned char>(line[at])) != 0 || line[at] == '.');
      };
      const char before = line[i - 1];
      const bool word = words_.value_letters.find(before) != std::string::npos &&
                        (i < 2 || std::isalpha(static_cast<unsigned char>(line[i - 2])) == 0);
      const bool argument = parameters && (before == '(' || before == ',');
      if (!word && !argument) continue;
      const std::size_t sign = line[i] == '-' || (signs && line[i] == '+') ? 1 : 0;
      std::size_t end = i + sign;
      while (digit(end)) ++end;
      if (end == i + sign) continue;
      out.push_back({i, end - 1});
      i = end;
    }
    return out;
  }
  void variable() {
    const std::size_t at = any();
    if (frames(lines()[at])) return;
    std::string& line = lines()[at];
    const auto places = numbers_in(line);
    if (places.empty()) return;
    const Range r = chance_.of(places);
    const std::string value = line.substr(r.first, r.last - r.first + 1);
    const std::string name = chance_.of(words_.variables);
    const char before = line[r.first - 1];
    const bool argument = before == '(' || before == ',';
    line.replace(r.first, value.size(),
                 is("sinumerik") && !argument ? "=" + name
                 : is("num")                  ? " " + name
                 : is("heidenhain")           ? "+" + name
                                              : name);
    if (chance_.one_in(6)) return;  // nobody sets it
    const std::string set = is("fagor")        ? "(" + name + "=" + value + ")"
                            : is("heidenhain") ? "FN 0: " + name + " = " + value
                                               : name + "=" + value;
    insert(chance_.one_in(2) ? at : std::max<std::size_t>(std::min<std::size_t>(any(), at), 1), set);
  }

  /// Moves the lines to the end of the text, as a subprogram; where they stood is `at`.
  std::string move_out(Range r) {
    const std::string number = std::to_string(90 + next_sub_++);
    Lines part(lines().begin() + static_cast<std::ptrdiff_t>(r.first),
               lines().begin() + static_cast<std::ptrdiff_t>(r.last) + 1);
    lines().erase(lines().begin() + static_cast<std::ptrdiff_t>(r.first),
                  lines().begin() + static_cast<std::ptrdiff_t>(r.last) + 1);
    if (is("heidenhain")) {
      part.insert(part.begin(), "LBL " + number);
      part.emplace_back("LBL 0");
      const auto ends = [](const std::string& line) { return line.rfind("END PGM", 0) == 0; };
      const auto stops = [](const std::string& line) { return line == "M30" || line == "M2" || line == "M02"; };
      if (std::none_of(lines().begin(), lines().end(), stops))
        part.insert(part.begin(), "M30");  // the program does not run into it
      const auto end = std::find_if(lines().begin(), lines().end(), ends);
      lines().insert(end, part.begin(), part.end());
      return number;
    }
    if (is("fagor")) lines().push_back("(SUB " + number + ")");
    if (is("num")) lines().push_back("%" + number);
    if (is("sinumerik")) lines().push_back("%_N_L" + number + "_SPF");
    if (is("sinumerik") && chance_.one_in(4)) lines().push_back("PROC L" + number + " SAVE");
    lines().insert(lines().end(), part.begin(), part.end());
    if (is("fagor")) lines().emplace_back("(RET)");
    if (is("sinumerik")) lines().emplace_back("M17");
    return number;
  }
  /// The texts of an archive have names.
  void name_archive(std::size_t& at) {
    if (!is("sinumerik") || lines().front().rfind("%_N_", 0) == 0) return;
    insert(0, "%_N_MAIN_MPF");
    ++at;
  }
  void subprogram() {
    const Range r = some(6);
    if (frames(lines()[r.first])) return;
    std::size_t at = r.first;
    const std::string number = move_out(r);
    const std::string times = chance_.one_in(3) ? "2" : "";
    std::string call;
    if (is("fagor")) call = "(CALL " + number + ")";
    if (is("num")) call = "G77 H" + number + (times.empty() ? "" : " S" + times);
    if (is("sinumerik")) call = "L" + number + (times.empty() ? "" : " P" + times);
    if (is("heidenhain")) call = "CALL LBL " + number;
    insert(at, call);
    if ((is("fagor") || is("heidenhain")) && !times.empty()) insert(at, call);
    if (chance_.one_in(3)) insert(std::max<std::size_t>(any(), at), call);
    name_archive(at);
  }
  void modal_call() {
    if (is("num") || is("heidenhain")) return subprogram();
    const Range r = some(3);
    if (frames(lines()[r.first])) return;
    std::size_t at = r.first;
    const std::string number = move_out(r);
    insert(at, is("fagor") ? "(MCALL " + number + ")" : "MCALL L" + number);
    std::size_t end = at + 1;
    for (std::size_t more = 1 + chance_.below(3); more > 0 && end < lines().size() && !frames(lines()[end]); --more)
      ++end;
    insert(end, is("fagor") ? "(MDOFF)" : "MCALL");
    name_archive(at);
  }
  void repeat() {
    const Range r = some(5);
    if (frames(lines()[r.first])) return;
    std::size_t at = r.last + 1;
    std::string call;
    if (is("sinumerik")) {
      const std::string n = std::to_string(next_number_++);
      insert(at, "E" + n + ":");
      insert(r.first, "B" + n + ":");
      call = "REPEAT B" + n + " E" + n + (chance_.one_in(2) ? " P=2" : "");
      at += 2;
    } else if (is("heidenhain")) {
      call = "CALL LBL " + labelled(r.first) + (chance_.one_in(2) ? " REP 2" : " REP 1");
      ++at;
    } else {
      const std::string first = number_of(r.first), last = number_of(r.last);
      if (is("fagor")) call = "(RPT " + first + "," + last + ")" + (chance_.one_in(2) ? " N2" : "");
      if (is("num")) call = "G77 " + first + " " + last + (chance_.one_in(2) ? " S2" : "");
    }
    insert(chance_.one_in(3) ? std::max(any(), at) : at, call);
  }
  void loop() {
    const Range r = some(5);
    if (frames(lines()[r.first])) return;
    if (is("sinumerik")) {
      const bool counted = chance_.one_in(2);
      insert(r.last + 1, counted ? "ENDFOR" : "ENDWHILE");
      if (!counted) insert(r.last + 1, "R59=R59+1");
      insert(r.first, counted ? "FOR R59=1 TO 2" : "WHILE R59<2");
      if (!counted) insert(r.first, "R59=0");
      return;
    }
    if (is("heidenhain")) {
      insert(r.last + 1, "FN 1: Q59 = +Q59 + +1");
      const std::string label = labelled(r.first);
      insert(r.last + 3, "FN 12: IF +Q59 LT +2 GOTO LBL " + label);
      insert(r.first, "FN 0: Q59 = +0");
      return;
    }
    const std::string number = number_of(r.first);
    if (is("fagor")) {
      insert(r.last + 1, "(IF P159 LT 2 GOTO " + number + ")");
      insert(r.last + 1, "(P159=P159+1)");
      insert(r.first, "(P159=0)");
    } else {
      insert(r.last + 1, "G79 L119<2 " + number);
      insert(r.last + 1, "L119=L119+1");
      insert(r.first, "L119=0");
    }
  }
  void branch() {
    const Range r = some(4);
    if (frames(lines()[r.first]) || r.last + 1 >= lines().size() || frames(lines()[r.last + 1])) return;
    if (is("sinumerik")) {
      insert(r.last + 1, "ENDIF");
      insert(r.first, "IF R58==0");
      return;
    }
    if (is("heidenhain")) {
      insert(r.first, "FN 9: IF +Q58 EQU +1 GOTO LBL " + labelled(r.last + 1));
      return;
    }
    const std::string number = number_of(r.last + 1);
    insert(r.first, is("fagor") ? "(IF P158 EQ 1 GOTO " + number + ")" : "G79 L118=1 " + number);
  }

  Program p_;
  const std::vector<Program>& programs_;
  Chance& chance_;
  const Words& words_;
  int next_number_ = 9001;
  int next_sub_ = 1, next_label_ = 501;
};

}  // namespace

Program spliced(const std::vector<Program>& programs, Chance& chance) {
  Splicer splicer(pick(programs, chance.draw()), programs, chance);
  for (std::size_t n = 1 + chance.below(3); n > 0; --n) splicer.change();
  return splicer.take();
}

}  // namespace cnctrans::splice
