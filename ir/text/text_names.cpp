#include "ir/text/text_names.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/source.h"
#include "base/text.h"

namespace cnctrans::ir::detail {

bool all_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

bool is_capital_word(std::string_view text) {
  if (text.empty() || is_digit(text[0])) return false;
  return std::all_of(text.begin(), text.end(), [](char c) { return is_word_char(c) && !(c >= 'a' && c <= 'z'); });
}

std::size_t number_length(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size() && is_digit(text[i])) ++i;
  const std::size_t whole = i;
  if (i < text.size() && text[i] == '.') ++i;
  const std::size_t point = i;
  while (i < text.size() && is_digit(text[i])) ++i;
  return whole == 0 && i == point ? 0 : i;
}

bool says(std::string_view text, double value, bool sign) {
  if (text.empty()) return false;
  std::string_view digits = text;
  if (sign && (text[0] == '+' || text[0] == '-')) digits.remove_prefix(1);
  return number_length(digits) == digits.size() && parse_decimal(text) == value;
}

namespace {

std::string plain_handle(const Program& program, std::size_t i) {
  const std::string& prefix = program.spaces[i].prefix;
  if (!is_capital_word(prefix)) return prefix.empty() ? "v" : std::string{};
  const auto same = [&prefix](const VariableSpace& s) { return s.prefix == prefix; };
  return std::count_if(program.spaces.begin(), program.spaces.end(), same) == 1 ? prefix : std::string{};
}

}  // namespace

std::vector<std::string> space_handles(const Program& program) {
  std::vector<std::string> handles;
  for (std::size_t i = 0; i < program.spaces.size(); ++i) {
    std::string handle = plain_handle(program, i);
    if (handle.empty() || std::find(handles.begin(), handles.end(), handle) != handles.end()) {
      handle = "s" + std::to_string(i);
    }
    handles.push_back(std::move(handle));
  }
  return handles;
}

std::string axis_text(const Program& program, AxisId id) {
  if (id == axis::none) return "none";
  const std::string_view name = program.axis_name(id);
  if (id < axis::first_extra) return std::string(name);
  const bool fixed = name.size() == 1 && fixed_axis(name[0]) != axis::none;
  const bool unique = std::count(program.axis_names.begin(), program.axis_names.end(), name) == 1;
  return is_capital_word(name) && !fixed && unique ? std::string(name) : "axis" + std::to_string(id);
}

std::optional<AxisId> axis_from_text(const Program& program, std::string_view text) {
  if (text == "none") return axis::none;
  if (text.size() == 1 && fixed_axis(text[0]) != axis::none) return fixed_axis(text[0]);
  if (text.size() > 4 && text.size() < 8 && text.substr(0, 4) == "axis" && all_digits(text.substr(4))) {
    const int id = std::stoi(std::string(text.substr(4)));
    return id < axis::none ? std::optional(static_cast<AxisId>(id)) : std::nullopt;
  }
  if (!is_capital_word(text)) return std::nullopt;
  for (std::size_t i = 0; i < program.axis_names.size(); ++i) {
    if (program.axis_names[i] == text) return static_cast<AxisId>(axis::first_extra + i);
  }
  return std::nullopt;
}

bool natural_integer(double value) {
  return std::get<Number>(number(value)->node).integer;
}

Type natural_type(const Expr& e) {
  if (const auto* u = std::get_if<Unary>(&e.node)) {
    if (u->op == UnaryOp::negate) return u->operand ? u->operand->type : Type::real;
    return u->op == UnaryOp::logical_not ? Type::boolean : Type::integer;
  }
  if (const auto* b = std::get_if<Binary>(&e.node)) return binary(b->op, nullptr, nullptr)->type;
  if (const auto* c = std::get_if<Call>(&e.node)) return call(c->function, {})->type;
  if (std::holds_alternative<String>(e.node)) return Type::string;
  if (std::holds_alternative<AxisName>(e.node)) return Type::axis;
  return Type::real;
}

std::string quoted(std::string_view text) {
  static constexpr std::string_view hex = "0123456789ABCDEF";
  std::string out = "\"";
  while (!text.empty()) {
    const auto byte = static_cast<unsigned char>(text[0]);
    std::size_t length = utf8_length(text);
    if (byte < 0x20 || byte == 0x7f || length == 0) {
      out += "\\x";
      out += hex[byte >> 4U];
      out += hex[byte & 15U];
      length = 1;
    } else {
      if (byte == '"' || byte == '\\') out += '\\';
      out += text.substr(0, length);
    }
    text.remove_prefix(length);
  }
  out += '"';
  return out;
}

}  // namespace cnctrans::ir::detail
