#include "frontends/common/word_scanner.h"

#include <optional>

#include "base/text.h"

namespace cnctrans::frontends {

namespace {

constexpr bool digit(char c) {
  return c >= '0' && c <= '9';
}
constexpr bool blank(char c) {
  return c == ' ' || c == '\t';
}

// Powers of ten that a double holds exactly: mantissa / power is then correctly rounded for mantissas below 2^53.
constexpr std::array<double, 16> powers{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                        1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
constexpr int exact_digits = 15;

/// A cursor over one line.
struct Cursor {
  const char* begin;
  const char* at;
  const char* end;

  [[nodiscard]] bool done() const { return at == end; }
  [[nodiscard]] char peek() const { return at == end ? '\0' : *at; }
  void skip_blanks() {
    while (at != end && blank(*at)) ++at;
  }
  [[nodiscard]] std::uint32_t column() const { return static_cast<std::uint32_t>(at - begin) + 1; }
};

std::string_view text(const char* from, const char* to) {
  return {from, static_cast<std::size_t>(to - from)};
}
std::uint32_t distance(const char* from, const char* to) {
  return static_cast<std::uint32_t>(to - from);
}

/// Sign, digits, point, digits. False when there is no digit, or when the number is too long to be read exactly.
bool scan_number(Cursor& c, double& value) {
  const char* p = c.at;
  const bool negative = p != c.end && *p == '-';
  if (p != c.end && (*p == '-' || *p == '+')) ++p;
  std::uint64_t mantissa = 0;
  const char* digits_from = p;
  while (p != c.end && digit(*p)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
  int digits = static_cast<int>(p - digits_from);
  int places = 0;
  if (p != c.end && *p == '.') {
    const char* fraction = ++p;
    while (p != c.end && digit(*p)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
    places = static_cast<int>(p - fraction);
    digits += places;
  }
  if (digits == 0) return false;
  if (digits > exact_digits) {
    if (digits > 17) return false;
    const std::optional<double> slow = parse_decimal(text(c.at, p));
    if (!slow) return false;
    value = *slow;
  } else {
    const double magnitude = static_cast<double>(mantissa) / powers[static_cast<std::size_t>(places)];
    value = negative ? -magnitude : magnitude;
  }
  c.at = p;
  return true;
}

bool scan_skip(Cursor& c, const ScanTable& table, syntax::Block& out) {
  const char* from = c.at++;
  unsigned level = table.skip_first_level;
  if (table.skip_digits && digit(c.peek())) {
    const unsigned d = static_cast<unsigned>(*c.at++ - '0');
    if (d < table.skip_digit_offset) return false;
    level = d - table.skip_digit_offset;
  }
  if (digit(c.peek())) return false;
  out.skip_mask = static_cast<std::uint16_t>(1U << level);
  out.skip_pos = {distance(c.begin, from) + 1, distance(from, c.at)};
  return true;
}

bool scan_block_number(Cursor& c, const ScanTable& table, syntax::Block& out) {
  const char* from = c.at;
  out.number_mark = *c.at == table.main_block_mark && table.main_block_mark != 0 ? *c.at : 'N';
  ++c.at;
  if (table.blank_before_value) c.skip_blanks();
  const char* digits_from = c.at;
  while (!c.done() && digit(*c.at)) ++c.at;
  if (c.at == digits_from || c.peek() == '.') return false;
  out.number = text(digits_from, c.at);
  out.number_pos = {distance(c.begin, from) + 1, distance(from, c.at)};
  return true;
}

bool scan_word(Cursor& c, const ScanTable& table, syntax::Block& out) {
  const char* from = c.at++;
  const char* address_end = c.at;
  if (table.blank_before_value) c.skip_blanks();
  const char* value_from = c.at;
  double value = 0;
  const bool has_value = scan_number(c, value);
  if (!has_value) {
    // A bare word is plain only where what follows cannot be a value of another kind.
    if (!table.bare_words) return false;
    const char next = c.peek();
    if (next != '\0' && next != table.comment_open &&
        table.letters[static_cast<unsigned char>(next)] == LetterClass::none) {
      return false;
    }
    c.at = address_end;
  }
  auto& w = out.words.emplace_back();
  w.address = text(from, address_end);
  w.has_value = has_value;
  if (has_value) {
    w.number = value;
    w.number_text = text(value_from, c.at);
  }
  w.pos = {distance(c.begin, from) + 1, distance(from, c.at)};
  return true;
}

/// A comment at the cursor; false when something that is not a comment follows it.
bool scan_comment(Cursor& c, const ScanTable& table, syntax::Block& out) {
  const char* from = c.at++;
  if (table.comment_close == 0) {
    out.comments.push_back({text(c.at, c.end), {distance(c.begin, from) + 1, distance(from, c.end)}});
    c.at = c.end;
    return true;
  }
  const char* text_from = c.at;
  while (!c.done() && *c.at != table.comment_close) ++c.at;
  if (c.done()) return false;
  out.comments.push_back({text(text_from, c.at), {distance(c.begin, from) + 1, distance(from, c.at) + 1}});
  ++c.at;
  c.skip_blanks();
  return c.done() || c.peek() == table.comment_open || !table.comment_only_last;
}

}  // namespace

bool scan_plain(std::string_view line, const ScanTable& table, syntax::Block& out) {
  out.clear();
  Cursor c{line.data(), line.data(), line.data() + line.size()};
  c.skip_blanks();
  if (c.peek() == table.skip_mark && !c.done()) {
    if (!scan_skip(c, table, out)) return false;
    c.skip_blanks();
  }
  if (!c.done() && (table.letters[static_cast<unsigned char>(*c.at)] == LetterClass::number ||
                    (table.main_block_mark != 0 && *c.at == table.main_block_mark))) {
    if (!scan_block_number(c, table, out)) return false;
    c.skip_blanks();
  }
  while (!c.done()) {
    const char next = *c.at;
    if (table.letters[static_cast<unsigned char>(next)] == LetterClass::word) {
      if (!scan_word(c, table, out)) return false;
    } else if (next == table.comment_open) {
      if (!scan_comment(c, table, out)) return false;
    } else {
      return false;
    }
    c.skip_blanks();
  }
  out.plain = true;
  return true;
}

}  // namespace cnctrans::frontends
