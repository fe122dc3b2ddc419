#include "translator/folding/plain_line.h"

#include <algorithm>
#include <bit>
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

/// The first of eight bytes is the lowest one.
inline std::uint64_t eight_bytes(const char* p) {
  std::uint64_t value = 0;
  for (unsigned i = 0; i < 8; ++i) value |= std::uint64_t{static_cast<unsigned char>(p[i])} << 8 * i;
  return value;
}

std::uint32_t hash_of_words(const char* words, std::size_t size) {
  std::uint64_t hash = size;
  for (std::size_t i = 0; i < size; i += 8) {
    hash = (hash ^ eight_bytes(words + i)) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32U;
  }
  return static_cast<std::uint32_t>(hash);
}

/// Of so many digits; UINT32_MAX and more are one.
inline std::uint32_t value_of(const char* digits, std::size_t count) {
  if (count == 0) return 0;
  if (count <= 8) {  // pairs of digits, pairs of these, and once more
    constexpr std::uint64_t each = 0x0101010101010101U;
    std::uint64_t v = (eight_bytes(digits) ^ each * static_cast<std::uint64_t>('0')) << (64 - 8 * count);
    v = (v * 10 + (v >> 8U)) & 0x00FF00FF00FF00FFU;
    v = (v * 100 + (v >> 16U)) & 0x0000FFFF0000FFFFU;
    return static_cast<std::uint32_t>(v * 10000 + (v >> 32U));
  }
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count && value <= UINT32_MAX; ++i)
    value = value * 10 + static_cast<std::uint64_t>(digits[i] - '0');
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(value, UINT32_MAX));
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

/// A word of the line, as far as it has been read.
struct PlainLine::Cursor {
  const char *p, *end;    ///< in a copy of the line, with room behind it
  std::ptrdiff_t origin;  ///< of the line, from there
  std::size_t size = 0;   ///< of the key
  std::uint32_t letters = 0, still = 0;
  std::optional<std::uint32_t> block = {};
  bool odd = false, in_lead = false, has_radius = false, increments = false;
};

/// False: no number stands here.
[[gnu::always_inline]] inline bool PlainLine::take_number(Cursor& at, const frontends::FreeNumber& rule,
                                                          PlainNumber& number) {
  const bool minus = *at.p == '-', plus = *at.p == '+' && rule.plus;
  const char* const begin = at.p + (plus ? 1 : 0);
  const char* const first = begin + (minus ? 1 : 0);
  const char* end = first;
  char any = '0';
  while (is_digit(*end)) any = static_cast<char>(any | *end++);
  const auto whole = static_cast<std::size_t>(end - first);
  const bool point = *end == '.';
  std::size_t places = 0;
  if (point) {
    const char* const fraction = ++end;
    while (is_digit(*end)) any = static_cast<char>(any | *end++);
    places = static_cast<std::size_t>(end - fraction);
  }
  if (whole + places == 0) return false;
  const bool zero = any == '0';
  NumberForm form = 0;
  if (minus) form |= form_minus;
  if (plus) form |= form_plus;
  if (whole == 0) form |= form_no_whole;
  if (whole > 1 && *first == '0') form |= form_leading_zero;
  if (point) form |= places == 0 ? form_point : form_fraction;
  if (places != 0 && end[-1] == '0') form |= form_zero_last;
  number.form = form;
  at.odd = at.odd || whole > rule.whole || places > rule.places || (minus && (zero || !rule.minus)) ||
           (zero && !rule.zero) || (point && places == 0 && rule.places == 0);
  const auto size = static_cast<std::size_t>(end - begin);
  number.text = {begin + at.origin, size};
  if (rule.most != 0 || number.letter == 'N') {
    const std::uint32_t value = value_of(first, whole);
    at.odd = at.odd || (rule.most != 0 && value > rule.most);
    if (number.letter == 'N') at.block = value;
  }
  number.places = static_cast<std::uint8_t>(places);
  at.p = end;
  return true;
}

std::uint32_t PlainLine::hash_of(std::string_view key) {
  std::array<char, key_room> words{};
  std::copy(key.begin(), key.end(), words.begin());
  return hash_of_words(words.data(), key.size());
}

/// The code that begins at `at`, whole.
inline const frontends::PlainCode* PlainLine::code_at(const char* at, const char* end) const {
  const auto rest = static_cast<std::size_t>(end - at);
  for (const auto& code : codes_) {
    const std::size_t size = code.text.size();
    if (code.text.front() != *at || size > rest || !is_space(size == rest ? ' ' : at[size])) continue;
    std::size_t same = 1;
    while (same < size && code.text[same] == at[same]) ++same;
    if (same == size) return &code;
  }
  return nullptr;
}

std::string_view PlainLine::without_number(std::string_view line) const {
  if (!bare_block_number_) return line;
  std::size_t n = 0;
  while (n < line.size() && (is_digit(line[n]) || line[n] == ' ')) ++n;
  return line.substr(n);
}

bool PlainLine::is_lead(std::string_view line) const {
  line = without_number(line);
  return line.starts_with(lead_) && line.size() > lead_.size() && line[lead_.size()] == ' ';
}

bool PlainLine::take(std::string_view& text, SourceLine& line, PlainUnit& unit) const {
  if (!take_line(text, line)) return false;
  unit = {line.text, line.number, line.number, text.size() >= 8};
  if (lead_.empty() || text.empty() || !is_lead(line.text)) return true;
  take_line(text, line);
  unit.room = text.size() >= 8;
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

bool PlainLine::comment() const {
  const std::string_view line = without_number(line_);
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

/// Where there is no room behind it, of a copy.
inline PlainLine::Cursor PlainLine::begin(std::string_view line, bool room) {
  line_ = line;
  if (room) return {.p = line.data(), .end = line.data() + line.size(), .origin = 0};
  if (copy_.size() < line.size() + 8) copy_.resize(2 * line.size() + 64);
  char* const to = copy_.data();
  std::copy(line.begin(), line.end(), to);
  std::fill_n(to + line.size(), 8, '\0');
  return {.p = to, .end = to + line.size(), .origin = line.data() - to};
}

inline void PlainLine::add(Cursor& at, char c) {
  key_[at.size++] = c;
}

/// A word without a number, or the code of a motion in a language of such words.
[[gnu::always_inline]] inline bool PlainLine::take_code(Cursor& at) {
  const frontends::PlainCode* code = code_at(at.p - 1, at.end);
  if (code == nullptr) return false;
  for (const char k : code->text) add(at, k);
  at.p += code->text.size() - 1;
  at.in_lead = code->text == lead_;
  if (code->motion != motion_unknown) motion_ = code->motion;
  if (code->group != 0) at.letters |= 1U << static_cast<unsigned>(code->group - 'A');
  return true;
}

/// G0 to G3, from behind the G on.
[[gnu::always_inline]] inline bool PlainLine::take_motion(Cursor& at) {
  const char* const from = at.p;
  while (is_digit(*at.p)) ++at.p;
  const auto size = at.p - from;
  if (size == 0 || size > 2 || (size == 2 && *from != '0') || at.p[-1] > '3') return false;
  motion_ = static_cast<std::int8_t>(at.p[-1] - '0');
  for (const char* d = from; d != at.p; ++d) add(at, *d);
  return true;
}

/// A word with its number, from behind its letter `c` on. False: it says something else.
[[gnu::always_inline]] inline bool PlainLine::take_word(char c, const PlainPlace& before, Cursor& at) {
  const bool by_word = c == increment_ && PlainPlace::index_of(*at.p) >= 0;
  if (by_word) {
    if (at.in_lead) return false;
    add(at, c);
    c = *at.p++;
  }
  add(at, c);
  const bool place = at.in_lead && c >= 'X';  // of the centre
  const bool radius = c == 'C' && radius_.free && at.p[0] == 'R' && at.p[1] == '=';
  const auto meant = static_cast<char>(radius ? 'R' : place ? c - 'X' + 'I' : c);
  const int axis = by_word || before.increments ? PlainPlace::index_of(meant) : -1;
  at.letters |= 1U << static_cast<unsigned>(axis >= 0 ? increment_bits + axis : meant - 'A');
  at.increments = at.increments || axis >= 0;
  if (c == 'G' && codes_.empty()) return take_motion(at);
  const frontends::FreeNumber& rule = radius ? radius_ : rules_[static_cast<std::size_t>(c - 'A')];
  if (radius) ++at.p;
  if (radius || (radius_.free && *at.p == '=' && c != 'N')) {
    add(at, '=');
    ++at.p;
  }
  if (!rule.free || count_ == max_numbers) return false;
  PlainNumber& number = numbers_[count_++];
  number.letter = meant;
  number.increment = axis >= 0;
  at.has_radius = at.has_radius || meant == 'R';
  if (!take_number(at, rule, number)) return false;
  number.minus = rule.sign_told && number.text.front() == '-';
  if (number.minus) {
    add(at, '-');
    number.text.remove_prefix(1);
  }
  if (rule.by_way && !number.increment) {
    const char way = way_to(number, before);
    at.odd = at.odd || way == 0;
    add(at, way);
    if (way == '~') {
      at.still |= 1U << static_cast<unsigned>(c - 'A');
      --count_;
    }
  }
  if (c == 'N' && other_blocks_ != 0 && *at.block > other_blocks_) add(at, '!');
  return true;
}

PlainLine::Kind PlainLine::scan(std::string_view line, std::int8_t motion_before, const PlainPlace& before, bool room) {
  Cursor at = begin(line, room);
  add(at, static_cast<char>('0' + motion_before));
  if (before.increments) add(at, 'i');
  count_ = 0;
  motion_ = motion_before;
  bool begins = bare_block_number_;
  while (at.p != at.end) {
    char c = *at.p++;
    if (is_space(c)) {
      begins = begins || (c == '\n' && bare_block_number_);
      at.in_lead = at.in_lead && c != '\n';
      continue;
    }
    if (std::exchange(begins, false) && is_digit(c)) {
      c = 'N';
      --at.p;
    }
    if (!is_capital(c) || at.size + max_code > max_key) return Kind::other;
    if ((code_letters_ >> static_cast<unsigned>(c - 'A') & 1U) != 0 && take_code(at)) continue;
    if (!take_word(c, before, at)) return Kind::other;
    if (at.p != at.end && !is_space(*at.p) && !is_capital(*at.p)) return Kind::other;
  }
  const bool odd = at.odd || (at.increments && !lead_.empty() && (motion_ == 2 || motion_ == 3));
  if (at.size == 1 || (at.has_radius && motion_ != 2 && motion_ != 3)) return Kind::other;
  if (motion_ == 0 && (motion_before == rapid_with_feed || (at.letters & feed_word) != 0)) motion_ = rapid_with_feed;
  key_size_ = at.size;
  std::fill_n(key_.data() + at.size, 8, '\0');
  hash_ = hash_of_words(key_.data(), at.size);
  letters_ = at.letters;
  still_ = at.still;
  block_ = at.block;
  return odd ? Kind::odd : Kind::plain;
}

}  // namespace cnctrans::translator
