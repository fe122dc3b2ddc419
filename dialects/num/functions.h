// Operators and functions of expressions (reference 15). There is no precedence: a chain runs from left to right, a
// function binds the next primary. Angles are degrees.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "ir/expr.h"

namespace cnctrans::dialects::num {

struct FunctionRow {
  char letter;
  ir::Function function;
  std::string_view title;
};
inline constexpr std::array functions{
    FunctionRow{'S', ir::Function::sin, "sine"},
    FunctionRow{'C', ir::Function::cos, "cosine"},
    FunctionRow{'A', ir::Function::atan, "arc tangent, -90 to 90"},
    FunctionRow{'R', ir::Function::sqrt, "square root"},
    FunctionRow{'T', ir::Function::trunc, "truncation toward zero"},
};

struct OperatorRow {
  std::string_view text;
  ir::BinaryOp op;
};
inline constexpr std::array operators{
    OperatorRow{"+", ir::BinaryOp::add},
    OperatorRow{"-", ir::BinaryOp::subtract},
    OperatorRow{"*", ir::BinaryOp::multiply},
    OperatorRow{"/", ir::BinaryOp::divide},
    OperatorRow{"&", ir::BinaryOp::bit_and},
    OperatorRow{"!", ir::BinaryOp::bit_or},
    OperatorRow{"=", ir::BinaryOp::eq},
    OperatorRow{"<>", ir::BinaryOp::ne},
    OperatorRow{"<", ir::BinaryOp::lt},
    OperatorRow{"<=", ir::BinaryOp::le},
    OperatorRow{">", ir::BinaryOp::gt},
    OperatorRow{">=", ir::BinaryOp::ge},
    OperatorRow{"AND", ir::BinaryOp::logical_and},
    OperatorRow{"OR", ir::BinaryOp::logical_or},
};

constexpr std::optional<ir::Function> function_by_letter(char letter) {
  for (const auto& f : functions) {
    if (f.letter == letter) return f.function;
  }
  return std::nullopt;
}
constexpr std::optional<ir::BinaryOp> operator_by_text(std::string_view text) {
  for (const auto& o : operators) {
    if (o.text == text) return o.op;
  }
  return std::nullopt;
}

}  // namespace cnctrans::dialects::num
