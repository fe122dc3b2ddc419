// Operators and functions of Sinumerik expressions (reference-language 4.1, 4.2, 5).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "ir/expr.h"

namespace cnctrans::sinumerik {

struct OperatorRow {
  std::string_view text;  ///< capitals
  ir::BinaryOp op;
  std::uint8_t priority;  ///< 1 binds tightest; left to right within a level
};
/// `NOT`, `B_NOT` and signs bind tighter than everything here (priority 1). Comparisons bind weakest.
inline constexpr std::array operators{
    OperatorRow{"*", ir::BinaryOp::multiply, 2},      OperatorRow{"/", ir::BinaryOp::divide, 2},
    OperatorRow{"DIV", ir::BinaryOp::int_divide, 2},  OperatorRow{"MOD", ir::BinaryOp::modulo, 2},
    OperatorRow{"+", ir::BinaryOp::add, 3},           OperatorRow{"-", ir::BinaryOp::subtract, 3},
    OperatorRow{"B_AND", ir::BinaryOp::bit_and, 4},   OperatorRow{"B_XOR", ir::BinaryOp::bit_xor, 5},
    OperatorRow{"B_OR", ir::BinaryOp::bit_or, 6},     OperatorRow{"AND", ir::BinaryOp::logical_and, 7},
    OperatorRow{"XOR", ir::BinaryOp::logical_xor, 8}, OperatorRow{"OR", ir::BinaryOp::logical_or, 9},
    OperatorRow{"<<", ir::BinaryOp::concat, 10},      OperatorRow{"==", ir::BinaryOp::eq, 11},
    OperatorRow{"<>", ir::BinaryOp::ne, 11},          OperatorRow{">", ir::BinaryOp::gt, 11},
    OperatorRow{"<", ir::BinaryOp::lt, 11},           OperatorRow{">=", ir::BinaryOp::ge, 11},
    OperatorRow{"<=", ir::BinaryOp::le, 11}};
inline constexpr std::uint8_t prefix_priority = 1;

inline constexpr const OperatorRow* binary_operator(std::string_view text) {
  for (const auto& r : operators) {
    if (r.text == text) return &r;
  }
  return nullptr;
}
inline constexpr const OperatorRow* binary_operator(ir::BinaryOp op) {
  for (const auto& r : operators) {
    if (r.op == op) return &r;
  }
  return nullptr;
}
inline constexpr bool is_word_operator(std::string_view text) {
  const bool letter = !text.empty() && text[0] >= 'A' && text[0] <= 'Z';
  if (!letter || text == "NOT" || text == "B_NOT") return letter;
  for (const auto& r : operators) {  // a pointer compared with nullptr is no constant to GCC 12's sanitizer
    if (r.text == text) return true;
  }
  return false;
}

struct FunctionRow {
  std::string_view name;
  ir::Function function;
  std::uint8_t arguments_min, arguments_max;
  ir::Type result;
};
inline constexpr std::array functions{
    FunctionRow{"SIN", ir::Function::sin, 1, 1, ir::Type::real},
    FunctionRow{"COS", ir::Function::cos, 1, 1, ir::Type::real},
    FunctionRow{"TAN", ir::Function::tan, 1, 1, ir::Type::real},
    FunctionRow{"ASIN", ir::Function::asin, 1, 1, ir::Type::real},
    FunctionRow{"ACOS", ir::Function::acos, 1, 1, ir::Type::real},
    FunctionRow{"ATAN2", ir::Function::atan2, 2, 2, ir::Type::real},  // ATAN2(y,x), degrees
    FunctionRow{"SQRT", ir::Function::sqrt, 1, 1, ir::Type::real},
    FunctionRow{"POT", ir::Function::square, 1, 1, ir::Type::real},
    FunctionRow{"ABS", ir::Function::abs, 1, 1, ir::Type::real},
    FunctionRow{"LN", ir::Function::ln, 1, 1, ir::Type::real},
    FunctionRow{"EXP", ir::Function::exp, 1, 1, ir::Type::real},
    FunctionRow{"TRUNC", ir::Function::trunc, 1, 1, ir::Type::real},
    FunctionRow{"ROUND", ir::Function::round, 1, 1, ir::Type::real},
    FunctionRow{"ROUNDUP", ir::Function::ceil, 1, 1, ir::Type::real},
    FunctionRow{"MINVAL", ir::Function::min, 2, 2, ir::Type::real},
    FunctionRow{"MAXVAL", ir::Function::max, 2, 2, ir::Type::real},
    FunctionRow{"BOUND", ir::Function::bound, 3, 3, ir::Type::real},
    FunctionRow{"TOUPPER", ir::Function::upper_case, 1, 1, ir::Type::string},
    FunctionRow{"TOLOWER", ir::Function::lower_case, 1, 1, ir::Type::string},
    FunctionRow{"STRLEN", ir::Function::string_length, 1, 1, ir::Type::integer},
    FunctionRow{"SUBSTR", ir::Function::substring, 2, 3, ir::Type::string},
    FunctionRow{"INDEX", ir::Function::index_of, 2, 2, ir::Type::integer},
    FunctionRow{"RINDEX", ir::Function::last_index_of, 2, 2, ir::Type::integer},
    FunctionRow{"MINDEX", ir::Function::index_of_any, 2, 2, ir::Type::integer},
    FunctionRow{"MATCH", ir::Function::index_of, 2, 2, ir::Type::integer},
    FunctionRow{"NUMBER", ir::Function::to_number, 1, 1, ir::Type::real},
    FunctionRow{"ISNUMBER", ir::Function::is_number, 1, 1, ir::Type::boolean}};

inline constexpr const FunctionRow* expression_function(std::string_view capitals) {
  for (const auto& r : functions) {
    if (r.name == capitals) return &r;
  }
  return nullptr;
}

}  // namespace cnctrans::sinumerik
