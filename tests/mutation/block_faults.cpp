#include "tests/mutation/makers.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "base/text.h"
#include "tests/splice/programs.h"

namespace cnctrans::mutation {

namespace {

Maybe block(const Place& p, bool doubled) {
  for (int look = 0; look < most_looks; ++look) {
    std::size_t at = 0;
    const std::string& line = p.any(at);
    if (p.comment(line) || splice::frames(line)) continue;
    Fault f{{}, {line}, {}, at};
    if (doubled) {
      auto again = splice::parts_of(line);
      again.number.clear();
      f.after = {line, splice::joined(again)};
    } else if (at + 1 < p.lines.size()) {
      f.before.push_back(p.lines[at + 1]);
      f.after = {p.lines[at + 1]};
    }
    return f;
  }
  return std::nullopt;
}

/// Names of places in the program: numbers of blocks, labels.
std::vector<std::string> labels_of(const Place& p) {
  std::vector<std::string> labels;
  for (const auto& line : p.lines) {
    const auto parts = splice::parts_of(line);
    if (!parts.number.empty()) labels.push_back(parts.number);
    const auto colon = parts.rest.find(':');
    if (p.dialect == "sinumerik" && colon != std::string::npos && colon > 0 &&
        std::all_of(parts.rest.begin(), parts.rest.begin() + static_cast<std::ptrdiff_t>(colon),
                    [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; }))
      labels.push_back(parts.rest.substr(0, colon));
  }
  return labels;
}
bool jumps(const std::string& line) {
  for (const char* word : {"GOTO", "RPT", "REPEAT", "G79", "G77", "CALL", "IF ", "CASE"}) {
    if (line.find(word) != std::string::npos) return true;
  }
  return false;
}

bool is_cycle(const std::string& line) {
  for (const char* word : {"CYCLE", "POCKET", "SLOT", "HOLES", "LONGHOLE"}) {
    if (line.find(word) != std::string::npos) return true;
  }
  for (const auto& c : codes_of(line, "G")) {
    if ((c.number >= 81 && c.number <= 89) || (c.number >= 60 && c.number <= 69) || c.number == 31 || c.number == 33 ||
        c.number == 45 || c.number == 46)
      return true;
  }
  return false;
}
Maybe cycle(const Place& p, int how) {
  for (int look = 0; look < most_looks; ++look) {
    std::size_t at = 0;
    const std::string& line = p.any(at);
    if (p.comment(line) || !is_cycle(line)) continue;
    std::vector<Word> words;
    for (const auto& w : words_of(line)) {
      if (!among(w.name, "N G M") && w.name.rfind("CYCLE", 0) != 0 && w.name.rfind("POCKET", 0) != 0)
        words.push_back(w);
    }
    if (how == 0 && !words.empty()) {  // changed
      const Word& w = p.chance.of(words);
      const std::string old = line.substr(w.value, w.end - w.value);
      const auto made = changed(
          at, line,
          put(line, w.value, w.end, p.chance.one_in(3) ? other_sign(old, p.chance) : other_value(old, p.chance)));
      if (made) return made;
    }
    if (how == 1 && !words.empty()) {  // left out
      const Word& w = p.chance.of(words);
      return changed(at, line, put(line, w.from, w.end, ""));
    }
    if (how == 2) {  // given
      std::vector<std::size_t> gaps;
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        if ((line[k] == ',' || line[k] == '(') && (line[k + 1] == ',' || line[k + 1] == ')')) gaps.push_back(k + 1);
      }
      static const std::vector<std::string> given = {"0", "1", "2", "0.5", "5", "-1", "100"};
      if (!gaps.empty()) {
        const std::size_t gap = p.chance.of(gaps);
        return changed(at, line, put(line, gap, gap, p.chance.of(given)));
      }
      static const std::vector<std::string> letters = {"I", "J", "K", "B",  "D",  "H",  "C",
                                                       "L", "P", "R", "EF", "EH", "ER", "Q"};
      if (line.find('(') == std::string::npos)
        return changed(at, line, line + " " + p.chance.of(letters) + p.chance.of(given));
    }
  }
  return std::nullopt;
}

}  // namespace

Maybe order(const Place& p) {
  if (p.lines.size() < 3) return std::nullopt;
  for (int look = 0; look < most_looks; ++look) {
    const std::size_t at = p.chance.below(p.lines.size() - 1);
    const std::size_t count = 2 + p.chance.below(3);
    if (at + count > p.lines.size()) continue;
    Fault f{{}, {}, {}, at};
    bool movable = true;
    for (std::size_t k = at; k < at + count; ++k) {
      movable = movable && !splice::frames(p.lines[k]) && !p.comment(p.lines[k]);
      f.before.push_back(p.lines[k]);
    }
    if (!movable) continue;
    f.after = f.before;
    if (p.chance.one_in(2))
      std::rotate(f.after.begin(), f.after.begin() + 1, f.after.end());
    else
      std::rotate(f.after.begin(), f.after.end() - 1, f.after.end());
    if (f.after != f.before) return f;
  }
  return std::nullopt;
}

Maybe inserted_way(const Place& p) {
  std::size_t at = 0;
  for (int look = 0; look < most_looks; ++look) {
    if (const auto& line = p.any(at); !splice::frames(line)) break;
  }
  static const std::vector<std::string> lengths = {"0", "-300", "300", "-5", "0.5", "-0.02", "12.7"};
  const std::vector<std::string> axes =
      p.lathe ? std::vector<std::string>{"X", "Z"} : std::vector<std::string>{"X", "Y", "Z"};
  const auto word = [&] { return p.chance.of(axes) + p.chance.of(lengths); };
  switch (p.chance.below(6)) {
    case 0: return inserted(p, at, "G0 " + word());
    case 1: return inserted(p, at, "G1 " + word() + " F100");
    case 2: return inserted(p, at, "G1 " + word() + " F9999");
    case 3: return inserted(p, at, "G91 G1 " + word() + "\nG90");
    case 4: return inserted(p, at, "G91 G0 " + word() + "\n" + "G90");
    default: return inserted(p, at, "G0 " + word() + " " + word());
  }
}

Maybe label(const Place& p) {
  const auto labels = labels_of(p);
  if (labels.size() < 2) return std::nullopt;
  for (int look = 0; look < most_looks; ++look) {
    std::size_t at = 0;
    const std::string& line = p.any(at);
    const auto parts = splice::parts_of(line);
    if (jumps(line)) {
      const std::string& old = p.chance.of(labels);
      const auto from = parts.rest.find(old);
      if (from == std::string::npos) continue;
      auto now = parts;
      now.rest = put(parts.rest, from, from + old.size(), p.chance.of(labels));
      if (auto f = changed(at, line, splice::joined(now))) return f;
    } else if (!parts.number.empty() && at + 1 < p.lines.size() && !parts.rest.empty()) {  // one block later
      auto next = splice::parts_of(p.lines[at + 1]);
      if (!next.number.empty() || splice::frames(p.lines[at + 1])) continue;
      next.number = parts.number;
      auto now = parts;
      now.number.clear();
      return Fault{{}, {line, p.lines[at + 1]}, {splice::joined(now), splice::joined(next)}, at};
    }
  }
  return std::nullopt;
}

Maybe count(const Place& p) {
  for (int look = 0; look < most_looks; ++look) {
    std::size_t at = 0;
    const std::string& line = p.any(at);
    const bool repeats = line.find("RPT") != std::string::npos || line.find("REPEAT") != std::string::npos ||
                         line.find("G77") != std::string::npos || line.find(" P") != std::string::npos ||
                         line.find("FOR") != std::string::npos || line.find("CALL") != std::string::npos ||
                         line.find("WHILE") != std::string::npos;
    if (!repeats || p.comment(line)) continue;
    const auto words = words_of(line);
    if (words.empty()) continue;
    const Word& w = words[words.size() - 1 - p.chance.below(std::min<std::size_t>(2, words.size()))];
    const double old = number_of(line.substr(w.value, w.end - w.value));
    return changed(at, line, put(line, w.value, w.end, number(old + (p.chance.one_in(2) ? 1 : -1))));
  }
  return std::nullopt;
}

Maybe message(const Place& p) {
  for (int look = 0; look < most_looks; ++look) {
    std::size_t at = 0;
    const std::string& line = p.any(at);
    std::size_t from = std::string::npos;
    for (const char* word : {"MSG", "$", "ERROR", "DGWZ", "SETAL"}) {
      if (from == std::string::npos) from = line.find(word);
    }
    if (from == std::string::npos || p.comment(line)) continue;
    std::vector<std::size_t> letters;
    for (std::size_t k = from + 3; k < line.size(); ++k) {
      if (std::isalnum(static_cast<unsigned char>(line[k])) != 0) letters.push_back(k);
    }
    if (letters.empty()) continue;
    const std::size_t k = p.chance.of(letters);
    std::string now = line;
    if (p.chance.one_in(4))
      now.erase(k, 1);
    else
      now[k] = now[k] == 'A' ? 'B' : (now[k] == '?' ? '7' : (p.chance.one_in(4) ? '?' : 'A'));
    return changed(at, line, now);
  }
  return std::nullopt;
}

Maybe dwell(const Place& p) {
  for (int look = 0; look < most_looks; ++look) {
    std::size_t at = 0;
    const std::string& line = p.any(at);
    if (p.comment(line) || splice::frames(line)) continue;
    if (look + 1 == most_looks) return inserted(p, at, p.dialect == "fagor" ? "G4 K50" : "G4 F2");
    const auto codes = codes_of(line, "G");
    if (std::none_of(codes.begin(), codes.end(), [](const Code& c) { return c.number == 4; })) continue;
    std::vector<Word> words;
    for (const auto& w : words_of(line)) {
      if (among(w.name, "F K S")) words.push_back(w);
    }
    if (words.empty()) continue;
    const Word& w = p.chance.of(words);
    const double old = number_of(line.substr(w.value, w.end - w.value));
    return changed(at, line, put(line, w.value, w.end, number(p.chance.one_in(2) ? old * 2 : old / 10)));
  }
  return std::nullopt;
}

/// An operator of an expression or of a condition becomes another one.
Maybe expression(const Place& p) {
  static const std::vector<std::string> signs = {"+", "-", "*", "/"};
  static const std::vector<std::pair<std::string, std::string>> words = {
      {"SIN", "COS"},   {"COS", "SIN"},   {" GT ", " GE "}, {" LT ", " LE "}, {" LE ", " LT "}, {" GE ", " GT "},
      {" EQ ", " NE "}, {" NE ", " EQ "}, {"==", "<>"},     {"<=", "<"},      {">=", ">"},      {"<>", "=="},
      {"<", "<="},      {">", ">="},      {"ROUND", "FIX"}, {"ABS", ""},      {" S ", " C "},   {" AND ", " OR "}};
  for (int look = 0; look < most_looks; ++look) {
    std::size_t at = 0;
    const std::string& line = p.any(at);
    if (p.comment(line)) continue;
    for (const auto& [old, now] : words) {
      const auto from = line.find(old);
      if (from != std::string::npos && p.chance.one_in(2))
        return changed(at, line, put(line, from, from + old.size(), now));
    }
    if (line.find('=') == std::string::npos) continue;
    for (std::size_t k = line.find('=') + 2; k < line.size(); ++k) {
      const std::string sign(1, line[k]);
      if (std::find(signs.begin(), signs.end(), sign) == signs.end() || p.chance.one_in(2)) continue;
      return changed(at, line, put(line, k, k + 1, p.chance.of(signs)));
    }
  }
  return std::nullopt;
}

Maybe skip_mark(const Place& p) {
  std::size_t at = 0;
  const std::string& line = p.any(at);
  if (p.comment(line) || splice::frames(line)) return std::nullopt;
  auto parts = splice::parts_of(line);
  parts.skip = parts.skip.empty() ? "/" : "";
  return changed(at, line, splice::joined(parts));
}

Maybe missing_block(const Place& p) {
  return block(p, false);
}
Maybe doubled_block(const Place& p) {
  return block(p, true);
}
Maybe cycle_value(const Place& p) {
  return cycle(p, 0);
}
Maybe cycle_without(const Place& p) {
  return cycle(p, 1);
}
Maybe cycle_with(const Place& p) {
  return cycle(p, 2);
}

}  // namespace cnctrans::mutation
