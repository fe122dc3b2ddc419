#include "frontends/heidenhain/syntax/scanner.h"

#include <algorithm>
#include <array>

#include "frontends/heidenhain/syntax/parse.h"

namespace cnctrans::frontends::heidenhain {

namespace {

constexpr bool blank(char c) {
  return c == ' ' || c == '\t';
}
constexpr bool digit(char c) {
  return c >= '0' && c <= '9';
}
constexpr bool capital(char c) {
  return c >= 'A' && c <= 'Z' && c != 'Q';
}

/// Words of a path function with a value, and without one. A line with another word is the grammar's.
constexpr std::array<std::string_view, 26> with_value{"X",  "Y",  "Z",  "A",  "B",  "C",   "U",   "V",  "W",
                                                      "IX", "IY", "IZ", "IA", "IB", "IC",  "IU",  "IV", "IW",
                                                      "PR", "PA", "F",  "M",  "R",  "IPR", "IPA", "CHF"};
constexpr std::array<std::string_view, 14> alone{"L",   "C",   "CC",  "CR", "CT",   "LP", "CP",
                                                 "CTP", "RND", "CHF", "RL", "FMAX", "RR", "DR"};

struct LineCursor {
  std::string_view line;
  std::size_t at = 0;
  void blanks() {
    while (at < line.size() && blank(line[at])) ++at;
  }
  [[nodiscard]] char peek() const { return at < line.size() ? line[at] : '\0'; }
};

constexpr std::array<double, 16> tens{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                      1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

/// A sign, digits, a point, digits; false: no number that is read exactly here.
bool value_at(LineCursor& c, syntax::Word& w) {
  const std::size_t from = c.at;
  const bool minus = c.peek() == '-';
  if (minus || c.peek() == '+') ++c.at;
  std::uint64_t mantissa = 0;
  std::size_t digits = 0, places = 0;
  const auto take = [&] {
    for (; digit(c.peek()); ++c.at, ++digits) mantissa = mantissa * 10 + static_cast<std::uint64_t>(c.peek() - '0');
  };
  take();
  if (c.peek() == '.') {
    ++c.at;
    const std::size_t whole = digits;
    take();
    places = digits - whole;
  }
  if (digits == 0 || digits > 15 || c.peek() == ',' || c.peek() == '.') return false;
  const double magnitude = static_cast<double>(mantissa) / tens[places];
  w.number = minus ? -magnitude : magnitude;
  w.has_value = true;
  w.number_text = c.line.substr(from, c.at - from);
  return true;
}

bool word_at(LineCursor& c, syntax::Block& out) {
  const std::size_t from = c.at;
  while (capital(c.peek())) ++c.at;
  if (c.at == from) return false;
  const auto among = [&](const auto& list, std::string_view text) {
    return std::find(list.begin(), list.end(), text) != list.end();
  };
  auto& w = out.words.emplace_back();
  w.address = c.line.substr(from, c.at - from);
  const char next = c.peek();
  if (digit(next) || next == '+' || next == '-' || next == '.') {
    const bool sign =
        w.address == "DR" && (next == '+' || next == '-') && !digit(c.at + 1 < c.line.size() ? c.line[c.at + 1] : ' ');
    if (sign) {
      w.number_text = c.line.substr(c.at++, 1);
    } else if (!among(with_value, w.address) || !value_at(c, w)) {
      return false;
    }
  } else if (!among(alone, w.address) || w.address == "DR") {
    return false;
  }
  w.pos = {static_cast<std::uint32_t>(from + 1), static_cast<std::uint32_t>(c.at - from)};
  // A value behind a blank, and what the grammar would join, are the grammar's.
  c.blanks();
  const char behind = c.peek();
  return behind == '\0' || behind == ';' || (capital(behind) && (c.at > from + w.pos.length || w.has_value));
}

}  // namespace

bool scan_path(std::string_view line, syntax::Block& out) {
  out.clear();
  LineCursor c{line};
  c.blanks();
  if (digit(c.peek())) {
    const std::size_t from = c.at;
    while (digit(c.peek())) ++c.at;
    out.number = line.substr(from, c.at - from);
    out.number_pos = {static_cast<std::uint32_t>(from + 1), static_cast<std::uint32_t>(c.at - from)};
    if (c.peek() != '\0' && !blank(c.peek()) && c.peek() != ';' && !capital(c.peek())) return false;
    c.blanks();
  }
  while (c.at < line.size() && c.peek() != ';') {
    if (!word_at(c, out)) return false;
  }
  if (!out.words.empty() &&
      !(out.words.front().address == "L" || out.words.front().address == "C" || out.words.front().address == "CC"))
    return false;
  if (c.peek() == ';') {
    std::string_view text = line.substr(c.at + 1);
    for (const char x : text) {
      if (static_cast<unsigned char>(x) < 0x20 && x != '\t') return false;
    }
    if (take_tilde(text)) return false;
    out.comments.push_back(
        {text, {static_cast<std::uint32_t>(c.at + 1), static_cast<std::uint32_t>(line.size() - c.at)}});
  }
  out.plain = true;
  return true;
}

}  // namespace cnctrans::frontends::heidenhain
