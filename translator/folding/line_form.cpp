#include <algorithm>

#include "base/short_copy.h"
#include "translator/folding/unfolding.h"

namespace cnctrans::translator {

namespace {

/// Codes, not measures: their numbers are part of the fixed text.
constexpr bool is_code(char letter) {
  return std::string_view("GMTDSH%").find(letter) != std::string_view::npos;
}

/// A place of an axis in a line that says nothing but the centre of the arc behind it: `CC X+5 Y+3`.
bool of_centre(std::string_view written, std::size_t at, char letter, std::string_view lead) {
  if (letter < 'X' || letter > 'Z' || lead.empty()) return false;
  const auto end = written.rfind('\n', at);
  const std::string_view line = written.substr(end == std::string_view::npos ? 0 : end + 1);
  return line.starts_with(lead) && line.substr(lead.size()).starts_with(' ');
}

/// A word of the target that has no number of its own: R0.
bool is_word(std::string_view text, const frontends::PlainWords& target) {
  return std::any_of(target.codes.begin(), target.codes.end(), [text](const auto& code) { return code.text == text; });
}

}  // namespace

std::optional<LineForm::Piece> LineForm::find(const PlainLine& line, const PlainPlace& before, char letter,
                                              bool of_centre, std::string_view token) {
  Piece piece;
  std::string_view bare = token;
  if (!bare.empty() && bare.front() == '+') {
    piece.plus = true;
    bare.remove_prefix(1);
  }
  if (of_centre) letter = static_cast<char>(letter - 'X' + 'I');
  for (std::size_t i = 0; i < line.count(); ++i) {
    piece.number = i;
    if (line.number(i).letter == letter && line.number(i).text == bare) return piece;
  }
  for (std::size_t i = 0; i < line.count(); ++i) {  // spelt anew, and a centre or an increment as a place
    const PlainNumber& n = line.number(i);
    if (n.letter != letter) continue;
    if (spelt(scaled(n.text)) == bare) {
      piece.number = i;
      piece.anew = true;
      return piece;
    }
    if (letter >= 'A' && letter <= 'C' && spelt(full_turn - scaled(n.text)) == bare) {
      piece.number = i;
      piece.turn = true;
      return piece;
    }
    const bool centre = letter >= 'I' && letter <= 'K';
    if (!centre && !n.increment) continue;
    const auto axis = static_cast<std::size_t>(centre ? n.letter - 'I' : PlainPlace::index_of(n.letter));
    if (!before.known[axis] || spelt(signed_value(n) + before.at[axis]) != bare) continue;
    piece.number = i;
    piece.axis = static_cast<std::int8_t>(axis);
    return piece;
  }
  std::size_t alike = 0;
  for (std::size_t i = 0; i < line.count(); ++i) {
    if (line.number(i).text != bare) continue;
    ++alike;
    piece.number = i;
  }
  if (alike == 1) return piece;
  return std::nullopt;
}

std::optional<LineForm> LineForm::of(const PlainLine& line, const PlainPlace& before, std::string_view written,
                                     const frontends::PlainWords& target) {
  LineForm form;
  std::vector<bool> used(line.count());
  std::string fixed;
  for (std::size_t at = 0; at < written.size();) {
    const char c = written[at];
    const bool begins =
        is_digit(c) || c == '.' ||
        ((c == '-' || c == '+') && at + 1 < written.size() && (is_digit(written[at + 1]) || written[at + 1] == '.'));
    if (!begins) {
      fixed += c;
      ++at;
      continue;
    }
    std::size_t end = at + 1;
    while (end < written.size() && (is_digit(written[end]) || written[end] == '.')) ++end;
    const std::string_view token = written.substr(at, end - at);
    char letter = at > 0 ? written[at - 1] : 'N';
    if (letter == '(') {  // I=AC(5)
      const auto equals = written.rfind('=', at);
      if (equals != std::string_view::npos && equals > 0) letter = written[equals - 1];
    }
    if (letter == '=') letter = at > 1 ? written[at - 2] : 'R';
    const bool centre = of_centre(written, at, letter, target.lead);
    const bool word = at > 0 && is_word(written.substr(at - 1, token.size() + 1), target);
    at = end;
    if (is_code(letter) || word) {
      fixed += token;
      continue;
    }
    const bool known_letter = letter >= 'A' && letter <= 'Z';
    const bool still = known_letter && (line.still() >> static_cast<unsigned>(letter - 'A') & 1U) != 0;
    if (still && token == "0") {  // no way to go
      fixed += token;
      continue;
    }
    auto piece = find(line, before, letter, centre, token);
    if (piece && token.front() == '-') {
      piece->plus = known_letter && target.numbers[static_cast<std::size_t>(letter - 'A')].plus;
    }
    std::string_view bare = token;
    if (!piece && token.front() == '-') {
      bare.remove_prefix(1);
      piece = find(line, before, letter, centre, bare);
      fixed += '-';
    }
    if (!piece) return std::nullopt;
    const PlainNumber& number = line.number(piece->number);
    if (number.minus != (bare.size() != token.size()) && spelt(scaled(number.text)) == bare) piece->anew = true;
    piece->before = std::move(fixed);
    fixed.clear();
    used[piece->number] = true;
    form.fixed_size_ += piece->before.size();
    form.uses_place_ = form.uses_place_ || piece->axis >= 0;
    form.pieces_.push_back(*std::move(piece));
  }
  for (std::size_t i = 0; i < line.count(); ++i) {
    if (!used[i] && line.number(i).letter != 'N') return std::nullopt;
  }
  form.after_ = std::move(fixed);
  form.fixed_size_ += form.after_.size();
  return form;
}

void LineForm::write(const PlainLine& line, const PlainPlace& before, std::string& out) const {
  const std::size_t old = out.size();
  std::size_t size = fixed_size_;
  for (const Piece& p : pieces_) size += line.number(p.number).text.size() + 12;
  out.resize(old + size);
  char* to = out.data() + old;
  std::string sum;
  for (const Piece& p : pieces_) {
    to = copy_short(to, p.before);
    std::string_view number = line.number(p.number).text;
    if (p.anew || p.turn || p.axis >= 0) {
      const std::int64_t own = p.axis >= 0 ? signed_value(line.number(p.number)) : scaled(number);
      const std::int64_t value = p.turn ? full_turn - own : own;
      sum = spelt(value + (p.axis >= 0 ? before.at[static_cast<std::size_t>(p.axis)] : 0));
      number = sum;
    }
    if (p.plus && number.front() != '-') *to++ = '+';
    to = copy_short(to, number);
  }
  to = copy_short(to, after_);
  out.resize(static_cast<std::size_t>(to - out.data()));
}

}  // namespace cnctrans::translator
