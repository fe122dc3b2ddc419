#include "base/text.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace cnctrans {
namespace {

// The longest fixed text of a double is that of the smallest one: "-0." and 324 decimals.
constexpr std::size_t longest_number = 400;

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// Adds one unit in the last place of the digits in [first, end); true when a one must be put before them.
bool increment_digits(char* first, char* end) {
  for (char* p = end; p != first;) {
    --p;
    if (*p == '.' || *p == '-') continue;
    if (*p != '9') {
      ++*p;
      return false;
    }
    *p = '0';
  }
  return true;
}

}  // namespace

void append_shortest(std::string& out, double value) {
  if (value == 0) {  // also -0
    out += '0';
    return;
  }
  char buffer[longest_number];
  const auto r = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed);
  out.append(buffer, r.ptr);
}

std::string shortest(double value) {
  std::string out;
  append_shortest(out, value);
  return out;
}

void append_rounded(std::string& out, double value, int decimals) {
  if (value == 0 || !std::isfinite(value)) {
    append_shortest(out, value);
    return;
  }
  char buffer[longest_number];
  char* const end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed).ptr;
  char* const point = std::find(buffer, end, '.');
  const std::ptrdiff_t places = std::max(decimals, 0);
  if (point == end || end - point - 1 <= places) {  // already short enough
    out.append(buffer, end);
    return;
  }
  char* cut = point + 1 + places;
  const bool up = *cut >= '5';
  char* const digits = buffer + (*buffer == '-' ? 1 : 0);
  const bool carry = up && increment_digits(digits, cut);
  while (cut[-1] == '0' && cut > point) --cut;
  if (cut[-1] == '.') --cut;
  const bool zero = !carry && std::all_of(digits, cut, [](char c) { return c == '0' || c == '.'; });
  if (zero) {
    out += '0';
    return;
  }
  if (digits != buffer) out += '-';
  if (carry) out += '1';
  out.append(digits, cut);
}

std::string rounded(double value, int decimals) {
  std::string out;
  append_rounded(out, value, decimals);
  return out;
}

std::optional<double> parse_decimal(std::string_view text) {
  const char* p = text.data();
  const char* const end = p + text.size();
  bool negative = false;
  if (p != end && (*p == '+' || *p == '-')) negative = *p++ == '-';
  // fast_float would take "inf", "nan" and a second minus.
  if (p == end || !((*p >= '0' && *p <= '9') || *p == '.')) return std::nullopt;
  double value = 0;
  const auto r = fast_float::from_chars(p, end, value, fast_float::chars_format::fixed);
  if (r.ec != std::errc() || r.ptr != end || !std::isfinite(value)) return std::nullopt;
  return negative ? -value : value;
}

std::string to_upper_ascii(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), upper);
  return out;
}

std::string_view trim(std::string_view text) {
  const std::string_view blanks = " \t\r\n\v\f";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return text.substr(0, 0);
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool iequals_ascii(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return upper(x) == upper(y); });
}

}  // namespace cnctrans
