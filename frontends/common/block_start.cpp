#include "frontends/common/block_start.h"

#include <algorithm>
#include <cctype>

#include "base/text.h"

namespace cnctrans::frontends {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_name(char c) {
  return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0;
}

template <class Holds>
std::string_view take_while(std::string_view& text, const Holds& holds) {
  const auto end = std::find_if_not(text.begin(), text.end(), holds);
  const std::string_view taken = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(taken.size());
  return taken;
}

}  // namespace

BlockStart block_start(std::string_view text) {
  BlockStart start;
  text = trim(text);
  while (text.starts_with('/')) {
    text.remove_prefix(1);
    take_while(text, is_digit);
    text = trim(text);
  }
  if (text.size() > 1 && (text[0] == 'N' || text[0] == 'n') && is_digit(text[1])) {
    text.remove_prefix(1);
    start.number = take_while(text, is_digit);
    text = trim(text);
  }
  std::string_view behind = text;
  const std::string_view name = take_while(behind, is_name);
  if (!name.empty() && !is_digit(name[0]) && behind.starts_with(':') && !behind.starts_with(":=")) {
    start.label = name;
    text = trim(behind.substr(1));
  }
  start.rest = text;
  return start;
}

}  // namespace cnctrans::frontends
