#include "ir/text/texts.h"

#include <algorithm>
#include <cmath>

#include "base/saturate.h"
#include "base/text.h"

namespace cnctrans::ir {

std::string number_text(double value) {
  return rounded(value, 10);
}

std::optional<double> number_in(std::string_view text) {
  text = trim(text);
  const std::size_t at = text.find_first_of("Ee");
  if (at == std::string_view::npos || at + 1 >= text.size() || (text[at + 1] != 'X' && text[at + 1] != 'x'))
    return parse_decimal(text);
  const auto mantissa = parse_decimal(text.substr(0, at)), power = parse_decimal(text.substr(at + 2));
  if (!mantissa || !power || *power != std::trunc(*power) || std::abs(*power) > 300) return std::nullopt;
  return *mantissa * std::pow(10.0, *power);
}

std::optional<double> number_of_text(Function f, std::string_view text, std::string_view second) {
  text = text.substr(0, text.find('\0'));
  second = second.substr(0, second.find('\0'));
  const auto place = [](std::size_t at) { return at == std::string_view::npos ? -1 : static_cast<double>(at); };
  switch (f) {
    case Function::string_length: return static_cast<double>(text.size());
    case Function::index_of: return place(text.find(second));
    case Function::last_index_of: return place(text.rfind(second));
    case Function::index_of_any: return place(text.find_first_of(second));
    case Function::character_code:
      return text.empty() ? 0 : static_cast<double>(static_cast<unsigned char>(text.front()));
    case Function::is_number: return number_in(text) ? 1 : 0;
    case Function::to_number: return number_in(text);
    default: return std::nullopt;
  }
}

std::string part_of_text(std::string_view text, double start, double length) {
  if (start >= static_cast<double>(text.size())) return {};
  return std::string(text.substr(saturate<std::size_t>(start), saturate<std::size_t>(length)));
}

std::string lower_case_text(std::string text) {
  for (auto& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::optional<std::string> character_text(double code) {
  if (!(code >= 0 && code <= 255)) return std::nullopt;
  return std::string(1, static_cast<char>(saturate<unsigned char>(code)));
}

std::string ended_text(std::string text) {
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

std::string joined_text(std::string left, std::string_view right) {
  return ended_text(std::move(left += right));
}

namespace {

std::optional<std::string> constant_part(const Call& c) {
  const auto text = constant_text(c.args[0]);
  const auto start = c.args.size() > 1 ? constant_value(c.args[1]) : std::optional<double>(0);
  const auto length = c.args.size() > 2 ? constant_value(c.args[2]) : std::optional<double>(1e9);
  if (!text || !start || !length) return std::nullopt;
  const double from = std::round(*start), most = std::round(*length);
  if (from < 0 || most < 0) return std::nullopt;
  return part_of_text(*text, from, most);
}

std::optional<std::string> constant_text_call(const Call& c) {
  if (c.args.empty()) return std::nullopt;
  switch (c.function) {
    case Function::substring: return constant_part(c);
    case Function::character: {
      const auto code = constant_value(c.args[0]);
      return code ? character_text(std::round(*code)) : std::nullopt;
    }
    case Function::upper_case:
    case Function::lower_case:
    case Function::to_string: break;
    default: return std::nullopt;
  }
  const auto text = constant_text(c.args[0]);
  if (!text || c.function == Function::to_string) return text;
  return c.function == Function::upper_case ? to_upper_ascii(*text) : lower_case_text(*text);
}

}  // namespace

std::optional<std::string> constant_text(const ExprPtr& e) {
  if (!e) return std::nullopt;
  if (const auto* s = std::get_if<String>(&e->node)) return s->text;
  if (const auto* b = std::get_if<Binary>(&e->node); b != nullptr && b->op == BinaryOp::concat) {
    auto left = constant_text(b->left);
    const auto right = left ? constant_text(b->right) : std::nullopt;
    if (!right) return std::nullopt;
    return joined_text(std::move(*left), *right);
  }
  if (const auto* c = std::get_if<Call>(&e->node); c != nullptr && e->type == Type::string)
    return constant_text_call(*c);
  if (e->type == Type::string || e->type == Type::axis || e->type == Type::frame) return std::nullopt;
  const auto value = constant_value(e);
  if (!value) return std::nullopt;
  return number_text(*value);
}

std::optional<double> constant_of_texts(const ExprPtr& e) {
  if (const auto* c = std::get_if<Call>(&e->node)) {
    if (c->args.empty() || !number_of_text(c->function, "0", "0")) return std::nullopt;
    const auto text = constant_text(c->args[0]);
    const auto second = c->args.size() > 1 ? constant_text(c->args[1]) : std::optional<std::string>(std::string());
    if (!text || !second) return std::nullopt;
    return number_of_text(c->function, *text, *second);
  }
  const auto* b = std::get_if<Binary>(&e->node);
  if (b == nullptr) return std::nullopt;
  const bool order = b->op == BinaryOp::lt || b->op == BinaryOp::gt;
  if (b->op != BinaryOp::eq && b->op != BinaryOp::ne && !order) return std::nullopt;
  const auto* left_axis = std::get_if<AxisName>(&b->left->node);
  const auto* right_axis = std::get_if<AxisName>(&b->right->node);
  if (left_axis != nullptr && right_axis != nullptr && !order)
    return (left_axis->axis == right_axis->axis) == (b->op == BinaryOp::eq) ? 1 : 0;
  if (b->left->type != Type::string && b->right->type != Type::string) return std::nullopt;
  const auto left = constant_text(b->left), right = constant_text(b->right);
  if (!left || !right) return std::nullopt;
  if (order)
    return (b->op == BinaryOp::lt ? ended_text(*left) < ended_text(*right) : ended_text(*right) < ended_text(*left))
               ? 1
               : 0;
  return (ended_text(*left) == ended_text(*right)) == (b->op == BinaryOp::eq) ? 1 : 0;
}

}  // namespace cnctrans::ir
