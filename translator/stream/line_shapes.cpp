#include "translator/stream/line_shapes.h"

#include <algorithm>
#include <cstring>

#include "base/short_copy.h"

namespace cnctrans::translator {

namespace {

constexpr bool digit(char c) {
  return c >= '0' && c <= '9';
}
constexpr bool letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

}  // namespace

LineShapes::LineShapes(const frontends::FreeNumbers& free, int places)
    : free_(free), places_(places), shapes_(buckets) {}

/// A number that means the same to everybody: few digits, a minus and a zero only where they change nothing.
inline bool LineShapes::scan_number(const char*& p, const char* end, frontends::FreeNumber rule) const {
  const char* at = p;
  if (at != end && *at == '-') {
    if (!rule.minus) return false;
    ++at;
  }
  const char* const whole = at;
  char any = '0';
  while (at != end && digit(*at)) any = static_cast<char>(any | *at++);
  auto digits = at - whole;
  if (digits > rule.whole) return false;
  if (at != end && *at == '.') {
    if (rule.places == 0) return false;
    const char* const fraction = ++at;
    while (at != end && digit(*at)) any = static_cast<char>(any | *at++);
    const auto places = at - fraction;
    if (places > rule.places || places > places_) return false;
    digits += places;
  }
  if (digits == 0 || (!rule.zero && any == '0')) return false;
  p = at;
  return true;
}

/// Words of letters and numbers, with blanks between them; anything else has no shape.
bool LineShapes::scan(std::string_view line, std::uint32_t state, Scan& s) const {
  const char* p = line.data();
  const char* const end = p + line.size();
  std::size_t n = 0, gaps = 0;
  std::uint32_t hash = state * 0x9E3779B1U;
  const auto add = [&](char c) {
    s.key[n++] = c;
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x01000193U;
  };
  while (p != end) {
    if (*p == ' ') {
      ++p;
      continue;
    }
    const char c = *p++;
    if (n == max_key || !letter(c)) return false;
    add(c);
    const frontends::FreeNumber rule = c <= 'Z' ? free_[static_cast<std::size_t>(c - 'A')] : frontends::FreeNumber{};
    if (rule.free) {
      const char* const from = p;
      if (gaps == max_gaps || !scan_number(p, end, rule)) return false;
      s.gaps[gaps++] = {from, static_cast<std::size_t>(p - from)};
      continue;
    }
    const char* const from = p;
    for (; p != end && !letter(*p) && *p != ' '; ++p) {
      if (n == max_key || (!digit(*p) && *p != '.' && *p != '-')) return false;
      add(*p);
    }
    if (p == from) return false;
  }
  s.key_size = n;
  s.gap_count = gaps;
  s.hash = hash ^ hash >> 15U;
  return n != 0;
}

bool LineShapes::matches(const Shape& shape, const Scan& s, std::uint32_t state) {
  return shape.key_size == s.key_size && shape.state == state &&
         std::memcmp(shape.key.data(), s.key.data(), s.key_size) == 0;
}

void LineShapes::fill(const Shape& shape, const Scan& s, std::string& out) {
  const std::size_t old = out.size();
  std::size_t size = shape.fixed_size;
  for (const Piece& piece : shape.pieces) size += s.gaps[piece.gap].size();
  out.resize(old + size);
  char* to = out.data() + old;
  for (const Piece& piece : shape.pieces) to = copy_short(copy_short(to, piece.before), s.gaps[piece.gap]);
  copy_short(to, shape.after);
}

bool LineShapes::write(std::string_view line, std::uint32_t state, std::string& out) {
  scanned_ = scan(line, state, scan_);
  if (!scanned_) return false;
  const Shape& shape = shapes_[scan_.hash % buckets];
  if (!matches(shape, scan_, state) || !shape.known) return false;
  fill(shape, scan_, out);
  return true;
}

/// Cuts a text at its marks, each of which must stand in it once.
bool LineShapes::cut(const std::string& text, const std::vector<std::string>& marks, Shape& shape) {
  std::vector<std::pair<std::size_t, std::size_t>> places;  // position, mark
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const std::size_t at = text.find(marks[i]);
    if (at == std::string::npos || text.find(marks[i], at + 1) != std::string::npos) return false;
    places.emplace_back(at, i);
  }
  std::sort(places.begin(), places.end());
  std::size_t from = 0;
  shape.fixed_size = text.size();
  for (const auto& [at, mark] : places) {
    if (at < from) return false;
    shape.pieces.push_back({text.substr(from, at - from), mark});
    shape.fixed_size -= marks[mark].size();
    from = at + marks[mark].size();
  }
  shape.after = text.substr(from);
  return true;
}

/// The line again with marks for its numbers shows where they go; its own numbers must then give its own text.
void LineShapes::learn(std::string_view line, std::uint32_t state, std::string_view text, const Trial& trial) {
  if (!scanned_) return;
  Shape& shape = shapes_[scan_.hash % buckets];
  if (shape.key_size != 0) return;  // tried before, or the place of another shape
  shape = Shape{};
  shape.state = state;
  shape.key_size = scan_.key_size;
  shape.key = scan_.key;
  std::vector<std::string> marks;
  std::string marked;
  const char* from = line.data();
  for (std::size_t i = 0; i < scan_.gap_count; ++i) {
    marked.append(from, scan_.gaps[i].data());
    marks.push_back(std::to_string(21379 + 4057 * i));
    marked += marks.back();
    from = scan_.gaps[i].data() + scan_.gaps[i].size();
  }
  marked.append(from, line.data() + line.size());
  const auto written = trial(marked);
  if (!written || !cut(*written, marks, shape)) return;
  std::string again;
  fill(shape, scan_, again);
  shape.known = again == text;
}

}  // namespace cnctrans::translator
