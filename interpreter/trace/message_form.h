// A message with marks around its values, so that who compares two of them knows what is text.
#pragma once

#include <string>
#include <string_view>

namespace cnctrans::interpreter {

/// Around a value; alone in `Event::state` of a message, in the place of one.
inline constexpr char value_mark = '\x1';

inline std::string marked_value(std::string_view shown) {
  return value_mark + std::string(shown) + value_mark;
}
/// The text as it is shown.
inline std::string shown_message(std::string_view marked) {
  std::string out(marked);
  std::erase(out, value_mark);
  return out;
}
/// Without the values: one mark for each.
inline std::string message_form(std::string_view marked) {
  std::string out;
  bool inside = false;
  for (const char c : marked) {
    if (c == value_mark) inside = !inside;
    if (c == value_mark ? inside : !inside) out += c;
  }
  return out;
}

}  // namespace cnctrans::interpreter
