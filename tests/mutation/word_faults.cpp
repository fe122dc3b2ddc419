#include "tests/mutation/makers.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "base/text.h"
#include "tests/splice/programs.h"

namespace cnctrans::mutation {

namespace {

/// Behind the skip mark and the number of a block.
std::string with_word(const std::string& line, const std::string& word, Chance& chance) {
  auto parts = splice::parts_of(line);
  if (chance.one_in(2)) {
    parts.rest = word + " " + parts.rest;
  } else {
    const auto comment = parts.rest.find(';');
    const std::size_t end = comment == std::string::npos ? parts.rest.size() : comment;
    parts.rest = parts.rest.substr(0, end) + " " + word + " " + parts.rest.substr(end);
  }
  return std::string(trim(splice::joined(parts)));
}

}  // namespace

std::string put(const std::string& line, std::size_t from, std::size_t end, const std::string& text) {
  return line.substr(0, from) + text + line.substr(end);
}
Maybe changed(std::size_t at, const std::string& line, std::string now) {
  if (now == line) return std::nullopt;
  return Fault{{}, {line}, {std::move(now)}, at};
}
Maybe inserted(const Place& p, std::size_t at, std::string line) {
  return Fault{{}, {p.lines[at]}, {p.lines[at], std::move(line)}, at};
}

bool among(const std::string& name, std::string_view names) {
  return !name.empty() && (" " + std::string(names) + " ").find(" " + name + " ") != std::string::npos;
}
bool geometric(const Word& w) {
  return !among(w.name, "G M N T D S F L O H RPT GOTO CYCLE POCKET SLOT HOLES LONGHOLE P=");
}
bool any_word(const Word& w) {
  return !among(w.name, "N O");
}

std::string number(double v) {
  return shortest(v);
}
double number_of(const std::string& text) {
  return std::strtod(text.c_str(), nullptr);
}
std::string other_value(const std::string& text, Chance& chance) {
  const double v = number_of(text);
  switch (chance.below(10)) {
    case 0: return number(v * 10);
    case 1: return number(v / 10);
    case 2: return number(v + 1);
    case 3: return number(v - 1);
    case 4: return number(v + 0.01);
    case 5: return number(v - 0.1);
    case 6: return number(v * 2);
    case 7: return number(v * 1.01);
    case 8: return number(v + 25.4);
    default: {
      std::string turned = text;  // two digits change places
      for (std::size_t i = 0; i + 1 < turned.size(); ++i) {
        if (std::isdigit(static_cast<unsigned char>(turned[i])) != 0 &&
            std::isdigit(static_cast<unsigned char>(turned[i + 1])) != 0 && turned[i] != turned[i + 1]) {
          std::swap(turned[i], turned[i + 1]);
          break;
        }
      }
      return turned;
    }
  }
}
std::string other_sign(const std::string& text, Chance&) {
  if (number_of(text) == 0) return text;
  return text.front() == '-' ? text.substr(1) : "-" + (text.front() == '+' ? text.substr(1) : text);
}

Maybe value(const Place& p, const Fits& fits, const std::function<std::string(const std::string&, Chance&)>& other) {
  for (int look = 0; look < most_looks; ++look) {
    std::size_t at = 0;
    const std::string& line = p.any(at);
    if (p.comment(line) || splice::frames(line)) continue;
    std::vector<Word> words;
    for (const auto& w : words_of(line)) {
      if (fits(w)) words.push_back(w);
    }
    if (words.empty()) continue;
    const Word& w = p.chance.of(words);
    if (auto made =
            changed(at, line, put(line, w.value, w.end, other(line.substr(w.value, w.end - w.value), p.chance))))
      return made;
  }
  return std::nullopt;
}

Maybe code(const Place& p, const char* letter, const std::vector<int>& codes) {
  const auto said = [&](int n, const std::string& old) {
    std::string digits = std::to_string(n);
    if (old.size() > 1 && old.front() == '0' && digits.size() < 2) digits = "0" + digits;
    return digits;
  };
  const auto other = [&](int n) {
    int found = n;
    while (found == n) found = p.chance.of(codes);
    return found;
  };
  for (int look = 0; look < most_looks; ++look) {
    std::size_t at = 0;
    const std::string& line = p.any(at);
    if (p.comment(line) || splice::frames(line)) continue;
    if (look + 1 == most_looks)
      return changed(at, line, with_word(line, letter + said(p.chance.of(codes), ""), p.chance));
    std::vector<Code> there;
    for (const auto& c : codes_of(line, letter)) {
      if (std::find(codes.begin(), codes.end(), c.number) != codes.end()) there.push_back(c);
    }
    if (there.empty()) continue;
    const Code& c = p.chance.of(there);
    if (p.chance.one_in(4)) return changed(at, line, std::string(trim(put(line, c.word.from, c.word.end, ""))));
    const std::string old = line.substr(c.word.value, c.word.end - c.word.value);
    return changed(at, line, put(line, c.word.value, c.word.end, said(other(c.number), old)));
  }
  return std::nullopt;
}

Maybe without_word(const Place& p, const Fits& fits) {
  for (int look = 0; look < most_looks; ++look) {
    std::size_t at = 0;
    const std::string& line = p.any(at);
    if (p.comment(line) || splice::frames(line)) continue;
    std::vector<Word> words;
    for (const auto& w : words_of(line)) {
      if (fits(w) && !w.name.empty()) words.push_back(w);
    }
    if (words.empty()) continue;
    const Word& w = p.chance.of(words);
    return changed(at, line, std::string(trim(put(line, w.from, w.end, ""))));
  }
  return std::nullopt;
}

}  // namespace cnctrans::mutation
