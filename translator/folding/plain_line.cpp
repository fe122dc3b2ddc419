#include "translator/folding/plain_line.h"

#include <charconv>

namespace cnctrans::translator {

namespace {

constexpr bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

constexpr std::uint32_t hash_seed = 0x811C9DC5U;
constexpr std::uint32_t hashed(std::uint32_t hash, char c) {
  return (hash ^ static_cast<unsigned char>(c)) * 0x01000193U;
}

std::uint32_t whole_number(std::string_view digits) {
  std::uint32_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

/// Parts of a NumberForm.
constexpr NumberForm form_minus = 1, form_no_whole = 2, form_leading_zero = 4, form_point = 8, form_fraction = 16,
                     form_zero_last = 32;

}  // namespace

PlainLine::PlainLine(const frontends::PlainWords& words)
    : rules_(words.numbers), other_blocks_(words.other_blocks), comments_(words.comments) {
  if (words.radius_word) radius_ = {true, false, false, 5, 4};
}

/// False: no number stands here. `odd`: one that is not like others.
inline bool PlainLine::take_number(const char*& p, const char* end, const frontends::FreeNumber& rule,
                                   PlainNumber& number, bool& odd) {
  const char* at = p;
  NumberForm form = 0;
  if (at != end && *at == '-') {
    form |= form_minus;
    ++at;
  }
  const char* const whole = at;
  char any = '0';
  while (at != end && is_digit(*at)) any = static_cast<char>(any | *at++);
  const auto digits = at - whole;
  if (digits == 0) form |= form_no_whole;
  if (digits > 1 && *whole == '0') form |= form_leading_zero;
  std::ptrdiff_t places = 0;
  if (at != end && *at == '.') {
    const char* const fraction = ++at;
    while (at != end && is_digit(*at)) any = static_cast<char>(any | *at++);
    places = at - fraction;
    form |= places == 0 ? form_point : form_fraction;
    if (places != 0 && at[-1] == '0') form |= form_zero_last;
  }
  if (digits + places == 0) return false;
  const bool zero = any == '0', minus = (form & form_minus) != 0;
  odd = odd || digits > rule.whole || places > rule.places || (minus && (zero || !rule.minus)) ||
        (zero && !rule.zero) || ((form & form_point) != 0 && rule.places == 0);
  odd = odd || (rule.most != 0 && whole_number({whole, static_cast<std::size_t>(at - whole)}) > rule.most);
  number.text = {p, static_cast<std::size_t>(at - p)};
  number.form = form;
  number.places = static_cast<std::uint8_t>(places);
  p = at;
  return true;
}

std::uint32_t PlainLine::hash_of(std::string_view key) {
  std::uint32_t hash = hash_seed;
  for (const char c : key) hash = hashed(hash, c);
  return hash ^ hash >> 15U;
}

PlainLine::Kind PlainLine::scan(std::string_view line, std::int8_t motion_before) {
  comment_ = !line.empty() && comments_.first != 0 && line.front() == comments_.first &&
             (comments_.last == 0 || line.find(comments_.last) == line.size() - 1);
  const char* p = line.data();
  const char* const end = p + line.size();
  std::size_t n = 0;
  std::uint32_t hash = hash_seed, letters = 0;
  const auto add = [&](char c) {
    key_[n++] = c;
    hash = hashed(hash, c);
  };
  add(static_cast<char>('0' + motion_before));
  count_ = 0;
  motion_ = motion_before;
  bool odd = false;
  while (p != end) {
    const char c = *p++;
    if (c == ' ') continue;
    if (!is_capital(c) || n + 3 > max_key) return Kind::other;
    add(c);
    letters |= 1U << static_cast<unsigned>(c - 'A');
    if (c == 'G') {
      const char* const from = p;
      while (p != end && is_digit(*p)) ++p;
      const auto size = p - from;
      if (size == 0 || size > 2 || (size == 2 && *from != '0') || p[-1] > '3') return Kind::other;
      if (p != end && *p != ' ' && !is_capital(*p)) return Kind::other;
      motion_ = static_cast<std::int8_t>(p[-1] - '0');
      for (const char* d = from; d != p; ++d) add(*d);
      continue;
    }
    const bool radius = c == 'C' && radius_.free && end - p > 2 && p[0] == 'R' && p[1] == '=';
    const frontends::FreeNumber& rule = radius ? radius_ : rules_[static_cast<std::size_t>(c - 'A')];
    if (radius) {
      add('=');
      p += 2;
    }
    if (!rule.free) return Kind::other;
    if (count_ == max_numbers) return Kind::other;
    PlainNumber& number = numbers_[count_++];
    number.letter = radius ? 'R' : c;
    if (!take_number(p, end, rule, number, odd)) return Kind::other;
    if (c == 'N' && other_blocks_ != 0 && whole_number(number.text) > other_blocks_) add('!');
    if (p != end && *p != ' ' && !is_capital(*p)) return Kind::other;
  }
  if (n == 1) return Kind::other;
  key_size_ = n;
  hash_ = hash ^ hash >> 15U;
  letters_ = letters;
  return odd ? Kind::odd : Kind::plain;
}

}  // namespace cnctrans::translator
