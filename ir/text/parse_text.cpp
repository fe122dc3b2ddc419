// Reading of the textual IR: characters, simple values, the lines of the program.
#include <charconv>
#include <utility>

#include "base/text.h"
#include "ir/text/text.h"
#include "ir/text/text_reader.h"

namespace cnctrans::ir {
namespace detail {

void Reader::fail(const std::string& what) {
  if (failed_) return;
  failed_ = true;
  const auto column = static_cast<std::uint32_t>(at_ - line_start_ + 1);
  std::string message = what;
  if (const auto w = peek_word(); !w.empty()) message += " '" + std::string(w) + "'";
  diagnostics_.error("IR-001", Span{file_, line_, column, line_, column + 1},
                     message + "; the line is kept as opaque text", "docs/ir.md shows the form of each line");
}

void Reader::skip_blanks() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == ' ' || c == '\t' || c == '\r') {
      ++at_;
    } else if (c == '/' && peek_raw(1) == '/') {
      while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    } else {
      break;
    }
  }
}

bool Reader::accept(std::string_view punctuation) {
  if (failed_) return false;
  skip_blanks();
  if (text_.substr(at_, punctuation.size()) != punctuation) return false;
  at_ += punctuation.size();
  return true;
}

bool Reader::expect(std::string_view punctuation) {
  if (accept(punctuation)) return true;
  fail("'" + std::string(punctuation) + "' expected");
  return false;
}

std::string_view Reader::peek_word() {
  skip_blanks();
  std::size_t end = at_;
  if (end < text_.size() && is_word_start(text_[end])) {
    while (end < text_.size() && is_word_char(text_[end])) ++end;
  }
  return text_.substr(at_, end - at_);
}

std::string_view Reader::take_word() {
  const auto w = peek_word();
  at_ += w.size();
  return w;
}

bool Reader::accept_word(std::string_view text) {
  if (failed_ || peek_word() != text) return false;
  at_ += text.size();
  return true;
}

bool Reader::accept_adjacent(char c) {
  if (failed_ || peek_raw() != c) return false;
  ++at_;
  return true;
}

void Reader::word(std::string_view text) {
  if (text == "=" ? accept("=") : accept_word(text)) return;
  fail("'" + std::string(text) + "' expected before");
}

std::uint16_t Reader::blank_lines() {
  std::uint16_t count = 0;
  while (true) {
    const std::size_t before = at_;
    skip_blanks();
    if (at_end() || text_[at_] != '\n') return count;
    const std::string_view skipped = text_.substr(before, at_ - before);
    if (skipped.find('/') == std::string_view::npos) ++count;  // a line with only a remark is no blank line
    ++at_;
    ++line_;
    line_start_ = at_;
  }
}

bool Reader::finish_line(LineInfo* line) {
  if (line != nullptr) comments(*line);
  skip_blanks();
  if (ok() && !at_end() && text_[at_] != '\n') fail("this does not belong here");
  while (!at_end() && text_[at_] != '\n') ++at_;
  if (!at_end()) {
    ++at_;
    ++line_;
    line_start_ = at_;
  }
  return !std::exchange(failed_, false);
}

template <class Int>
void Reader::read_integer(Int& x) {
  skip_blanks();
  const char* first = text_.data() + at_;
  const auto result = std::from_chars(first, text_.data() + text_.size(), x);
  if (failed_ || result.ec != std::errc{}) {
    fail("a whole number is expected");
    return;
  }
  at_ += static_cast<std::size_t>(result.ptr - first);
}
template void Reader::read_integer(std::int64_t& x);
template void Reader::read_integer(std::int32_t& x);
template void Reader::read_integer(std::uint32_t& x);
template void Reader::read_integer(std::uint8_t& x);

void Reader::read(double& x) {
  skip_blanks();
  std::size_t length = peek_raw() == '-' || peek_raw() == '+' ? 1 : 0;
  for (const std::string_view name : {std::string_view("nan"), std::string_view("inf")}) {
    if (text_.substr(at_ + length, name.size()) != name) continue;
    x = name == "nan" ? std::numeric_limits<double>::quiet_NaN() : std::numeric_limits<double>::infinity();
    if (peek_raw() == '-') x = -x;
    at_ += length + name.size();
    return;
  }
  length += number_length(text_.substr(at_ + length));
  const auto parsed = parse_decimal(text_.substr(at_, length));
  if (failed_ || !parsed) {
    fail("a number is expected");
    return;
  }
  x = *parsed;
  at_ += length;
}

void Reader::read(std::string& x) {
  if (!expect("\"")) return;
  x.clear();
  const auto hex = [](char c) { return is_digit(c) ? c - '0' : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1; };
  while (!at_end() && peek_raw() != '"' && peek_raw() != '\n') {
    char c = text_[at_++];
    if (c == '\\' && peek_raw() == 'x') {
      const int high = hex(peek_raw(1));
      const int low = hex(peek_raw(2));
      if (high < 0 || low < 0) return fail("\\x needs two hexadecimal digits");
      c = static_cast<char>(high * 16 + low);
      at_ += 3;
    } else if (c == '\\' && !at_end()) {
      c = text_[at_++];
    }
    x += c;
  }
  if (!accept_adjacent('"')) fail("the text has no closing quote");
}

void Reader::read(std::string_view& x) {
  std::string text;
  read(text);
  x = text.empty() ? std::string_view{} : program_.keep(std::move(text));
}

void Reader::axis(std::string_view, AxisId& id) {
  const auto found = axis_from_text(program_, peek_word());
  if (!found) return fail("an axis is expected");
  id = *found;
  take_word();
}

void Reader::pos(WordPos& p) {
  if (!accept("@")) return;
  read(p.column);
  expect("+");
  read(p.length);
}

void Reader::code(bool& is_explicit, std::string_view& text) {
  if (accept_word("coded")) {
    is_explicit = true;
    return;
  }
  is_explicit = !accept_word("implied") && peek_word() == "as";
  quoted("code", text);
}

void Reader::pairs(std::string_view, std::vector<std::pair<std::string, Value>>& list) {
  if (!expect("(") || accept(")")) return;
  do {
    auto& p = list.emplace_back();
    read(p.first);
    read(p.second);
  } while (accept(","));
  expect(")");
}

void Reader::routine_name(std::string_view, RoutineName& n) {
  if (accept_word("unnamed")) return;
  const bool has_number = is_digit(peek());
  if (has_number) read(n.number);
  if (peek() == '"') {
    read(n.text);
  } else if (!has_number) {
    fail("the name of a routine is expected");
  }
}

void Reader::space(std::string_view, SpaceId& id) {
  const std::string_view name = peek_word();
  for (std::size_t i = 0; i < handles_.size(); ++i) {
    if (handles_[i] != name) continue;
    take_word();
    id = static_cast<SpaceId>(i);
    return;
  }
  if (name.size() > 1 && name.size() < 6 && name[0] == 's' && all_digits(name.substr(1))) {
    id = static_cast<SpaceId>(std::stoul(std::string(name.substr(1))));
    take_word();
    return;
  }
  fail("a space of variables is expected");
}

void Reader::read_routine(LineInfo&& header) {
  Routine r;
  fields(*this, r);
  r.header = std::move(header);
  LineInfo closing;
  if (open_body(r.header)) read_body(r.body, closing);
  finish_line(nullptr);
  program_.routines.push_back(std::move(r));
}

void Reader::read_space() {
  VariableSpace s;
  const std::string_view handle = take_word();
  fields(*this, s);
  if (handle.empty()) fail("the name of the space is expected");
  program_.spaces.push_back(std::move(s));
  handles_.emplace_back(handle);
}

void Reader::top_line() {
  LineInfo line;
  line.blank_lines_before = blank_lines();
  if (at_end()) return;
  line_prefix(line);
  if (accept_word("routine")) return read_routine(std::move(line));
  if (accept_word("program")) {
    fields(*this, program_);
    has_places_ = accept_word("places");
  } else if (accept_word("axis")) {
    read(program_.axis_names.emplace_back());
  } else if (accept_word("space")) {
    read_space();
  } else if (accept_word("file")) {
    read(program_.files.emplace_back());
  } else {
    fail("a line of the program is expected: program, axis, space, file or routine, but here stands");
  }
  finish_line(nullptr);
}

Program Reader::read_program() {
  while (!at_end()) top_line();
  return std::move(program_);
}

}  // namespace detail

Program from_text(std::string_view text, FileId file, Diagnostics& diagnostics) {
  return detail::Reader(text, file, diagnostics).read_program();
}

}  // namespace cnctrans::ir
