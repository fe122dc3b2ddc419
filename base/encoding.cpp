// UTF-8 and Windows-1252.
#include <array>
#include <cstdint>
#include <cstring>

#include "base/source.h"

namespace cnctrans {
namespace {

/// Code points of the bytes 80 to 9F; the bytes that Windows-1252 leaves undefined (81 8D 8F 90 9D) stand for
/// themselves.
constexpr std::array<char16_t, 32> upper_half = {0x20AC, 0x0081, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                                 0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0x008D, 0x017D, 0x008F,
                                                 0x0090, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                                 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x009D, 0x017E, 0x0178};

unsigned byte_at(std::string_view s, std::size_t i) {
  return static_cast<unsigned char>(s[i]);
}

void append_utf8(std::string& out, char32_t c) {
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xC0U | (c >> 6U));
    out += static_cast<char>(0x80U | (c & 0x3FU));
  } else {  // nothing here is above U+FFFF
    out += static_cast<char>(0xE0U | (c >> 12U));
    out += static_cast<char>(0x80U | ((c >> 6U) & 0x3FU));
    out += static_cast<char>(0x80U | (c & 0x3FU));
  }
}

/// Length of the run of ASCII at the front of `s`, in whole steps of eight bytes.
std::size_t ascii_prefix(std::string_view s) {
  constexpr std::uint64_t high = 0x8080808080808080U;
  const char* const p = s.data();
  std::size_t i = 0;
  for (; i + 32 <= s.size(); i += 32) {
    std::array<std::uint64_t, 4> w{};
    std::memcpy(w.data(), p + i, 32);
    if (((w[0] | w[1] | w[2] | w[3]) & high) != 0) break;
  }
  for (; i + 8 <= s.size(); i += 8) {
    std::uint64_t w = 0;
    std::memcpy(&w, p + i, 8);
    if ((w & high) != 0) break;
  }
  return i;
}

/// The Windows-1252 byte of a code point, or -1.
int windows1252_byte(char32_t c) {
  if (c < 0x80 || (c >= 0xA0 && c <= 0xFF)) return static_cast<int>(c);
  for (std::size_t i = 0; i < upper_half.size(); ++i) {
    if (upper_half[i] == c) return static_cast<int>(0x80 + i);
  }
  return -1;
}

}  // namespace

std::size_t utf8_length(std::string_view bytes, char32_t* code_point) {
  if (bytes.empty()) return 0;
  const unsigned first = byte_at(bytes, 0);
  if (first < 0x80) {
    if (code_point != nullptr) *code_point = first;
    return 1;
  }
  const std::size_t n = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || bytes.size() < n) return 0;
  char32_t c = first & (0xFFU >> (n + 1));
  for (std::size_t i = 1; i < n; ++i) {
    const unsigned next = byte_at(bytes, i);
    if ((next & 0xC0U) != 0x80) return 0;
    c = (c << 6U) | (next & 0x3FU);
  }
  const bool overlong = (n == 3 && c < 0x800) || (n == 4 && c < 0x10000);
  const bool surrogate = c >= 0xD800 && c <= 0xDFFF;
  if (overlong || surrogate || c > 0x10FFFF) return 0;
  if (code_point != nullptr) *code_point = c;
  return n;
}

bool valid_utf8(std::string_view bytes) {
  while (!bytes.empty()) {
    bytes.remove_prefix(ascii_prefix(bytes));
    // Through the characters of the next eight bytes one by one, then at speed again.
    for (std::size_t done = 0; done < 8 && !bytes.empty();) {
      const std::size_t n = utf8_length(bytes);
      if (n == 0) return false;
      bytes.remove_prefix(n);
      done += n;
    }
  }
  return true;
}

std::string windows1252_to_utf8(std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size() + bytes.size() / 8);
  for (const char ch : bytes) {
    const unsigned c = static_cast<unsigned char>(ch);
    append_utf8(out, c >= 0x80 && c < 0xA0 ? upper_half[c - 0x80] : static_cast<char32_t>(c));
  }
  return out;
}

std::optional<std::string> utf8_to_windows1252(std::string_view text, std::size_t* bad) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    char32_t c = 0;
    const std::size_t n = utf8_length(text.substr(i), &c);
    const int byte = n != 0 ? windows1252_byte(c) : -1;
    if (byte < 0) {
      if (bad != nullptr) *bad = i;
      return std::nullopt;
    }
    out += static_cast<char>(byte);
    i += n;
  }
  return out;
}

std::string to_utf8(std::string_view text) {
  return valid_utf8(text) ? std::string(text) : windows1252_to_utf8(text);
}

}  // namespace cnctrans
