#include "translator/folding/plain_line.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace cnctrans::translator {

namespace {

constexpr bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

/// Between words; in a unit of two lines also their ends.
constexpr bool is_space(char c) {
  return c == ' ' || c == '\n' || c == '\r';
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

constexpr std::uint32_t feed_word = 1U << static_cast<unsigned>('F' - 'A');

/// Parts of a NumberForm.
constexpr NumberForm form_minus = 1, form_no_whole = 2, form_leading_zero = 4, form_point = 8, form_fraction = 16,
                     form_zero_last = 32, form_plus = 64;

}  // namespace

std::int64_t scaled(std::string_view number) {
  std::int64_t value = 0, unit = place_scale;
  bool minus = false, fraction = false;
  for (const char c : number) {
    if (c == '-') {
      minus = true;
    } else if (c == '.') {
      fraction = true;
    } else {
      value = value * 10 + (c - '0');
      if (fraction) unit /= 10;
    }
  }
  return (minus ? -value : value) * unit;
}

std::string spelt(std::int64_t value) {
  const bool minus = value < 0;
  std::string digits = std::to_string(minus ? -value : value);
  if (digits.size() < 5) digits.insert(0, 5 - digits.size(), '0');
  digits.insert(digits.size() - 4, 1, '.');
  while (digits.back() == '0') digits.pop_back();
  if (digits.back() == '.') digits.pop_back();
  return minus ? '-' + digits : digits;
}

std::int64_t signed_value(const PlainNumber& number) {
  return number.minus ? -scaled(number.text) : scaled(number.text);
}

void PlainPlace::follow(const PlainLine& line) {
  for (std::size_t i = 0; i < line.count(); ++i) {
    const PlainNumber& n = line.number(i);
    const int axis = index_of(n.letter);
    if (axis < 0) continue;
    const auto own = static_cast<std::size_t>(axis);
    at[own] = signed_value(n) + (n.increment ? at[own] : 0);
    known[own] = n.places <= 4 && (known[own] || !n.increment);
  }
}

PlainLine::PlainLine(const frontends::PlainWords& words)
    : rules_(words.numbers),
      codes_(words.codes),
      bare_block_number_(words.bare_block_number),
      lead_(words.lead),
      increments_(words.increments),
      places_(words.places),
      increment_(words.increment),
      other_blocks_(words.other_blocks),
      comments_(words.comments) {
  for (const auto& code : codes_) code_letters_ |= 1U << static_cast<unsigned>(code.text.front() - 'A');
  for (std::size_t i = 0; i < rules_.size(); ++i) by_way_ |= std::uint32_t{rules_[i].by_way} << i;
  if (words.assignments) radius_ = std::exchange(rules_['R' - 'A'], {});
}

/// False: no number stands here. `odd`: one that is not like others.
inline bool PlainLine::take_number(const char*& p, const char* end, const frontends::FreeNumber& rule,
                                   PlainNumber& number, bool& odd) {
  const char* at = p;
  NumberForm form = 0;
  if (at != end && *at == '-') {
    form |= form_minus;
    ++at;
  } else if (at != end && *at == '+' && rule.plus) {
    form |= form_plus;
    p = ++at;
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

/// The code that begins at `at`, whole.
const frontends::PlainCode* PlainLine::code_at(const char* at, const char* end) const {
  const std::string_view rest(at, static_cast<std::size_t>(end - at));
  for (const auto& code : codes_) {
    if (rest.starts_with(code.text) && (rest.size() == code.text.size() || is_space(rest[code.text.size()])))
      return &code;
  }
  return nullptr;
}

std::string_view PlainLine::without_number(std::string_view line) const {
  if (bare_block_number_) line.remove_prefix(std::min(line.find_first_not_of("0123456789 "), line.size()));
  return line;
}

bool PlainLine::is_lead(std::string_view line) const {
  line = without_number(line);
  return line.starts_with(lead_) && line.size() > lead_.size() && line[lead_.size()] == ' ';
}

bool PlainLine::take(std::string_view& text, SourceLine& line, PlainUnit& unit) const {
  if (!take_line(text, line)) return false;
  unit = {line.text, line.number, line.number};
  if (lead_.empty() || text.empty() || !is_lead(line.text)) return true;
  take_line(text, line);
  unit.text = {unit.text.data(), static_cast<std::size_t>(line.text.data() + line.text.size() - unit.text.data())};
  unit.last = line.number;
  return true;
}

std::string_view PlainLine::whole_units(std::string_view text) const {
  for (;;) {
    const auto end = text.rfind('\n');
    if (end == std::string_view::npos) return {};
    text = text.substr(0, end + 1);
    const auto before = end == 0 ? std::string_view::npos : text.rfind('\n', end - 1);
    const std::string_view last = text.substr(before == std::string_view::npos ? 0 : before + 1);
    if (lead_.empty() || !is_lead(last)) return text;
    text = text.substr(0, text.size() - last.size());
  }
}

bool PlainLine::is_comment(std::string_view line) const {
  line = without_number(line);
  return !line.empty() && comments_.first != 0 && line.front() == comments_.first &&
         (comments_.last == 0 || line.find(comments_.last) == line.size() - 1);
}

bool PlainLine::increments_after(std::string_view line, bool before) const {
  const auto last = [line](std::string_view word) {
    auto at = word.empty() ? std::string_view::npos : line.rfind(word);
    while (at != std::string_view::npos && at + word.size() < line.size() && is_digit(line[at + word.size()]))
      at = at == 0 ? std::string_view::npos : line.rfind(word, at - 1);
    return at + 1;  // 0: nowhere
  };
  const auto increments = last(increments_), places = last(places_);
  return increments == places ? before : increments > places;
}

char PlainLine::way_to(const PlainNumber& number, const PlainPlace& before) {
  const auto axis = static_cast<std::size_t>(PlainPlace::index_of(number.letter));
  const std::int64_t way = signed_value(number) - before.at[axis];
  if (!before.known[axis] || way >= full_turn / 2 || way <= -full_turn / 2) return 0;
  return way < 0 ? '<' : way > 0 ? '>' : '~';
}

PlainLine::Kind PlainLine::scan(std::string_view line, std::int8_t motion_before, const PlainPlace& before) {
  comment_ = is_comment(line);
  const char* p = line.data();
  const char* const end = p + line.size();
  std::size_t n = 0;
  std::uint32_t hash = hash_seed, letters = 0, still = 0;
  const auto add = [&](char c) {
    key_[n++] = c;
    hash = hashed(hash, c);
  };
  add(static_cast<char>('0' + motion_before));
  if (before.increments) add('i');
  count_ = 0;
  motion_ = motion_before;
  bool odd = false, begins = bare_block_number_, in_lead = false, has_radius = false, increments = false;
  while (p != end) {
    char c = *p++;
    if (is_space(c)) {
      begins = begins || (c == '\n' && bare_block_number_);
      in_lead = in_lead && c != '\n';
      continue;
    }
    if (std::exchange(begins, false) && is_digit(c)) {
      c = 'N';
      --p;
    }
    if (!is_capital(c) || n + max_code > max_key) return Kind::other;
    const bool may_be_code = (code_letters_ >> static_cast<unsigned>(c - 'A') & 1U) != 0;
    if (const frontends::PlainCode* code = may_be_code ? code_at(p - 1, end) : nullptr) {
      for (const char k : code->text) add(k);
      p += code->text.size() - 1;
      in_lead = code->text == lead_;
      if (code->motion != motion_unknown) motion_ = code->motion;
      if (code->group != 0) letters |= 1U << static_cast<unsigned>(code->group - 'A');
      continue;
    }
    const bool by_word = c == increment_ && p != end && PlainPlace::index_of(*p) >= 0;
    if (by_word) {
      if (in_lead) return Kind::other;
      add(c);
      c = *p++;
    }
    add(c);
    const bool place = in_lead && c >= 'X';  // of the centre
    const bool radius = c == 'C' && radius_.free && end - p > 2 && p[0] == 'R' && p[1] == '=';
    const auto meant = static_cast<char>(radius ? 'R' : place ? c - 'X' + 'I' : c);
    const int axis = by_word || before.increments ? PlainPlace::index_of(meant) : -1;
    letters |= 1U << static_cast<unsigned>(axis >= 0 ? increment_bits + axis : meant - 'A');
    increments = increments || axis >= 0;
    if (c == 'G' && codes_.empty()) {
      const char* const from = p;
      while (p != end && is_digit(*p)) ++p;
      const auto size = p - from;
      if (size == 0 || size > 2 || (size == 2 && *from != '0') || p[-1] > '3') return Kind::other;
      if (p != end && !is_space(*p) && !is_capital(*p)) return Kind::other;
      motion_ = static_cast<std::int8_t>(p[-1] - '0');
      for (const char* d = from; d != p; ++d) add(*d);
      continue;
    }
    const frontends::FreeNumber& rule = radius ? radius_ : rules_[static_cast<std::size_t>(c - 'A')];
    if (radius) ++p;
    if (radius || (radius_.free && p != end && *p == '=' && c != 'N')) {
      add('=');
      ++p;
    }
    if (!rule.free) return Kind::other;
    if (count_ == max_numbers) return Kind::other;
    PlainNumber& number = numbers_[count_++];
    number.letter = meant;
    number.increment = axis >= 0;
    has_radius = has_radius || number.letter == 'R';
    if (!take_number(p, end, rule, number, odd)) return Kind::other;
    number.minus = rule.sign_told && number.text.front() == '-';
    if (number.minus) {
      add('-');
      number.text.remove_prefix(1);
    }
    if (rule.by_way && !number.increment) {
      const char way = way_to(number, before);
      odd = odd || way == 0;
      add(way);
      if (way == '~') {
        still |= 1U << static_cast<unsigned>(c - 'A');
        --count_;
      }
    }
    if (c == 'N' && other_blocks_ != 0 && whole_number(number.text) > other_blocks_) add('!');
    if (p != end && !is_space(*p) && !is_capital(*p)) return Kind::other;
  }
  odd = odd || (increments && !lead_.empty() && (motion_ == 2 || motion_ == 3));
  if (n == 1 || (has_radius && motion_ != 2 && motion_ != 3)) return Kind::other;
  if (motion_ == 0 && (motion_before == rapid_with_feed || (letters & feed_word) != 0)) motion_ = rapid_with_feed;
  key_size_ = n;
  hash_ = hash ^ hash >> 15U;
  letters_ = letters;
  still_ = still;
  return odd ? Kind::odd : Kind::plain;
}

}  // namespace cnctrans::translator
