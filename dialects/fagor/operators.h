// Operators and functions of the high-level language (§11.4, §11.5.1).
#pragma once

#include <array>
#include <string_view>

#include "ir/expr.h"

namespace cnctrans::dialects::fagor {

/// Level 1 binds strongest. Binary operators group from the left. Prefix: NOT, functions and the sign, level 1.
struct OperatorInfo {
  std::string_view word;
  ir::BinaryOp op;
  int level;
};
/// AND, OR, XOR are logical between conditions and bitwise (32 bits) between numbers: the logical form is listed.
inline constexpr std::array<OperatorInfo, 15> operators = {{
    {"EXP", ir::BinaryOp::power, 2},
    {"MOD", ir::BinaryOp::modulo, 2},
    {"*", ir::BinaryOp::multiply, 3},
    {"/", ir::BinaryOp::divide, 3},
    {"+", ir::BinaryOp::add, 4},
    {"-", ir::BinaryOp::subtract, 4},
    {"EQ", ir::BinaryOp::eq, 5},
    {"NE", ir::BinaryOp::ne, 5},
    {"GT", ir::BinaryOp::gt, 5},
    {"GE", ir::BinaryOp::ge, 5},
    {"LT", ir::BinaryOp::lt, 5},
    {"LE", ir::BinaryOp::le, 5},
    {"AND", ir::BinaryOp::logical_and, 6},
    {"XOR", ir::BinaryOp::logical_xor, 6},
    {"OR", ir::BinaryOp::logical_or, 7},
}};
inline constexpr int prefix_level = 1;

struct FunctionInfo {
  std::string_view word;
  ir::Function function;
};
/// ROUND takes halves away from zero, FIX cuts toward zero (both assumed: the manual shows positive numbers only).
inline constexpr std::array<FunctionInfo, 15> functions = {{
    {"SIN", ir::Function::sin},
    {"COS", ir::Function::cos},
    {"TAN", ir::Function::tan},
    {"ASIN", ir::Function::asin},
    {"ACOS", ir::Function::acos},
    {"ATAN", ir::Function::atan},
    {"ARG", ir::Function::arg},
    {"ABS", ir::Function::abs},
    {"LOG", ir::Function::log10},
    {"SQRT", ir::Function::sqrt},
    {"ROUND", ir::Function::round},
    {"FIX", ir::Function::trunc},
    {"FUP", ir::Function::ceil},
    {"BCD", ir::Function::to_bcd},
    {"BIN", ir::Function::from_bcd},
}};
inline constexpr double pi = 3.14159265358979323846;  ///< the constant PI

inline constexpr const OperatorInfo* find_operator(std::string_view word) {
  for (const auto& o : operators) {
    if (o.word == word) return &o;
  }
  return nullptr;
}
inline constexpr const OperatorInfo* find_operator(ir::BinaryOp op) {
  for (const auto& o : operators) {
    if (o.op == op) return &o;
  }
  return nullptr;
}
inline constexpr const FunctionInfo* find_function(std::string_view word) {
  for (const auto& f : functions) {
    if (f.word == word) return &f;
  }
  return nullptr;
}
inline constexpr const FunctionInfo* find_function(ir::Function function) {
  for (const auto& f : functions) {
    if (f.function == function) return &f;
  }
  return nullptr;
}

}  // namespace cnctrans::dialects::fagor
