#include "frontends/sinumerik/syntax/executed_text.h"

#include <algorithm>
#include <cctype>

#include "base/text.h"

namespace cnctrans::sinumerik {

namespace {

bool digit(char c) {
  return c >= '0' && c <= '9';
}
bool of_name(char c) {
  return digit(c) || c == '_' || std::isalpha(static_cast<unsigned char>(c)) != 0;
}

/// The parts of a join at its outermost `<<`; nothing when brackets or quotes do not close.
std::optional<std::vector<std::string_view>> parts_of(std::string_view text) {
  std::vector<std::string_view> out;
  int depth = 0;
  bool quoted = false;
  std::size_t from = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '(' || c == '[') ++depth;
    if (c == ')' || c == ']') --depth;
    if (depth == 0 && c == '<' && i + 1 < text.size() && text[i + 1] == '<') {
      out.push_back(trim(text.substr(from, i - from)));
      from = i + 2;
      ++i;
    }
  }
  out.push_back(trim(text.substr(from)));
  if (depth != 0 || quoted) return std::nullopt;
  return out;
}

/// R1, R[2] or a variable of type INT or REAL: its text is a number.
bool is_number(std::string_view part, const FileContext& context) {
  const std::string name = to_upper_ascii(part);
  if (name.empty() || !std::all_of(name.begin(), name.end(), of_name)) return false;
  const bool parameter = name.size() > 1 && name[0] == 'R' && std::all_of(name.begin() + 1, name.end(), digit);
  if (parameter) return true;
  const Symbol* symbol = context.symbol(name);
  return symbol != nullptr && symbol->dimensions == 0 && !symbol->character &&
         (symbol->type == ir::Type::real || symbol->type == ir::Type::integer);
}

/// A number behind this text is the value of an address (`.. X`) or of an assignment (`.. R1=`).
bool takes_value(std::string_view text) {
  if (text.empty()) return false;
  if (text.back() == '=') return true;
  constexpr std::string_view addresses = "XYZABCUVWIJKF";
  const char last = to_upper_ascii(text.substr(text.size() - 1))[0];
  return addresses.find(last) != std::string_view::npos && (text.size() == 1 || !of_name(text[text.size() - 2]));
}

bool plain_number(std::string_view part) {
  return !part.empty() && part.find_first_not_of("0123456789.") == std::string_view::npos && digit(part.back());
}

}  // namespace

std::optional<ExecutedText> executed_text(std::string_view line, const FileContext& context) {
  const std::string upper = to_upper_ascii(line);
  const std::size_t at = upper.find("EXECSTRING");
  if (at == std::string::npos || upper.find_first_of(";\"") < at) return std::nullopt;
  const std::size_t open = upper.find_first_not_of(" \t", at + 10);
  if (open == std::string::npos || upper[open] != '(') return std::nullopt;
  int depth = 0;
  bool quoted = false;
  std::size_t close = open;
  for (; close < line.size(); ++close) {
    if (line[close] == '"') quoted = !quoted;
    if (quoted) continue;
    if (line[close] == '(') ++depth;
    if (line[close] == ')' && --depth == 0) break;
  }
  if (close == line.size()) return std::nullopt;
  const auto parts = parts_of(line.substr(open + 1, close - open - 1));
  if (!parts) return std::nullopt;
  std::string text;
  bool joined = false, behind_number = false;
  for (const std::string_view part : *parts) {
    const bool literal = part.size() > 1 && part.front() == '"' && part.find('"', 1) == part.size() - 1;
    if (literal) {
      const std::string_view inside = part.substr(1, part.size() - 2);
      if (behind_number && !inside.empty()) {  // what goes on with the number would make another one of it
        const char next = to_upper_ascii(inside.substr(0, 1))[0];
        if (next != ' ' && (next == 'E' || next < 'A' || next > 'Z')) return std::nullopt;
        if (next != ' ') text += ' ';
      }
      text += inside;
      behind_number = behind_number && inside.empty();
    } else if (plain_number(part) && !behind_number) {
      text += part;
      behind_number = true;
    } else if (is_number(part, context) && takes_value(text) && !behind_number) {
      if (text.back() != '=') text += '=';
      text += part;
      joined = behind_number = true;
    } else {
      return std::nullopt;
    }
  }
  ExecutedText out;
  out.line = std::string(line.substr(0, at)) + text + std::string(line.substr(close + 1));
  out.joined = joined;
  return out;
}

}  // namespace cnctrans::sinumerik
