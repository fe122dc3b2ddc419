// Formulas and FN functions (reference 12.2 to 12.4, 13). Angles are degrees.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "ir/expr.h"

namespace cnctrans::dialects::heidenhain {

/// Operators of a formula; a larger level binds stronger. Equal levels go from left to right, `^` too.
struct OperatorRow {
  std::string_view text;
  ir::BinaryOp op;
  int level;
};
inline constexpr std::array operators{
    OperatorRow{"+", ir::BinaryOp::add, 1},      OperatorRow{"-", ir::BinaryOp::subtract, 1},
    OperatorRow{"*", ir::BinaryOp::multiply, 2}, OperatorRow{"/", ir::BinaryOp::divide, 2},
    OperatorRow{"%", ir::BinaryOp::modulo, 2},   OperatorRow{"^", ir::BinaryOp::power, 3},
};
inline constexpr std::string_view concat_operator = "||";

/// Prefix functions of a formula: the operand is the next number, parameter or parenthesis.
struct FunctionRow {
  std::string_view word;
  ir::Function function;
};
inline constexpr std::array functions{
    FunctionRow{"SIN", ir::Function::sin},   FunctionRow{"COS", ir::Function::cos},
    FunctionRow{"TAN", ir::Function::tan},   FunctionRow{"ASIN", ir::Function::asin},
    FunctionRow{"ACOS", ir::Function::acos}, FunctionRow{"ATAN", ir::Function::atan},
    FunctionRow{"SQRT", ir::Function::sqrt}, FunctionRow{"SQ", ir::Function::square},
    FunctionRow{"LN", ir::Function::ln},     FunctionRow{"LOG", ir::Function::log10},
    FunctionRow{"EXP", ir::Function::exp},   FunctionRow{"ABS", ir::Function::abs},
    FunctionRow{"INT", ir::Function::trunc},
};
/// Prefix functions that the IR says with several nodes: -x; x - INT x; 1 for x >= 0, else -1.
inline constexpr std::string_view negate_word = "NEG", fraction_word = "FRAC", sign_word = "SGN", pi_word = "PI";
inline constexpr double pi = 3.14159265358979323846;

constexpr const OperatorRow* find_operator(std::string_view text) {
  for (const auto& o : operators) {
    if (o.text == text) return &o;
  }
  return nullptr;
}
constexpr const OperatorRow* find_operator(ir::BinaryOp op) {
  for (const auto& o : operators) {
    if (o.op == op) return &o;
  }
  return nullptr;
}
constexpr const FunctionRow* find_function(std::string_view word) {
  for (const auto& f : functions) {
    if (f.word == word) return &f;
  }
  return nullptr;
}
constexpr const FunctionRow* find_function(ir::Function function) {
  for (const auto& f : functions) {
    if (f.function == function) return &f;
  }
  return nullptr;
}

/// Functions of texts: `SUBSTR ( SRC_QS10 BEG2 LEN4 )`; the words in the order of the neutral function.
struct TextFunctionRow {
  std::string_view word;
  ir::Function function;
  std::string_view words;  ///< one blank between two
};
inline constexpr std::array text_functions{
    TextFunctionRow{"TOCHAR", ir::Function::to_string, "DAT DECIMALS"},
    TextFunctionRow{"TONUMB", ir::Function::to_number, "SRC_"},
    TextFunctionRow{"SUBSTR", ir::Function::substring, "SRC_ BEG LEN"},
    TextFunctionRow{"INSTR", ir::Function::index_of, "SRC_ SEA_ BEG"},
    TextFunctionRow{"STRLEN", ir::Function::string_length, "SRC_"},
};
/// STRCOMP ( SRC_QS12 SEA_QS14 ): 0 the same, -1 the first one comes before the second, 1 behind it.
inline constexpr std::string_view text_order_word = "STRCOMP";

constexpr const TextFunctionRow* find_text_function(std::string_view word) {
  for (const auto& f : text_functions) {
    if (f.word == word) return &f;
  }
  return nullptr;
}

/// FN n.
enum class FnUse : std::uint8_t {
  assign,   ///< Q = a
  binary,   ///< Q = a WORD b
  prefix,   ///< Q = WORD a
  length,   ///< Q = a LEN b: the hypotenuse
  angle,    ///< Q = a ANG b: of the side a (opposite) and b (adjacent), 0 to 360
  jump,     ///< IF a WORD b GOTO LBL
  error,    ///< ERROR = n: the program stops with a text
  sysread,  ///< Q = ID NR IDX
  wait,     ///< look-ahead waits
  circle,   ///< Q.. = CDATA Q..: circle through points
  kept      ///< no effect on the path: kept as text
};
struct FnRow {
  std::int8_t number;
  std::string_view word;
  FnUse use;
  ir::BinaryOp op = ir::BinaryOp::add;
  ir::Function function = ir::Function::sin;
};
inline constexpr std::array fn_rows{
    FnRow{0, "", FnUse::assign},
    FnRow{1, "+", FnUse::binary, ir::BinaryOp::add},
    FnRow{2, "-", FnUse::binary, ir::BinaryOp::subtract},
    FnRow{3, "*", FnUse::binary, ir::BinaryOp::multiply},
    FnRow{4, "DIV", FnUse::binary, ir::BinaryOp::divide},
    FnRow{5, "SQRT", FnUse::prefix, {}, ir::Function::sqrt},
    FnRow{6, "SIN", FnUse::prefix, {}, ir::Function::sin},
    FnRow{7, "COS", FnUse::prefix, {}, ir::Function::cos},
    FnRow{8, "LEN", FnUse::length},
    FnRow{9, "EQU", FnUse::jump, ir::BinaryOp::eq},
    FnRow{10, "NE", FnUse::jump, ir::BinaryOp::ne},
    FnRow{11, "GT", FnUse::jump, ir::BinaryOp::gt},
    FnRow{12, "LT", FnUse::jump, ir::BinaryOp::lt},
    FnRow{13, "ANG", FnUse::angle},
    FnRow{14, "ERROR", FnUse::error},
    FnRow{15, "PRINT", FnUse::kept},
    FnRow{16, "F-PRINT", FnUse::kept},
    FnRow{17, "SYSWRITE", FnUse::kept},
    FnRow{18, "SYSREAD", FnUse::sysread},
    FnRow{19, "PLC", FnUse::kept},
    FnRow{20, "WAIT FOR", FnUse::wait},
    FnRow{23, "CDATA", FnUse::circle},
    FnRow{24, "CDATA", FnUse::circle},
    FnRow{25, "PRESET", FnUse::kept},
    FnRow{26, "TABOPEN", FnUse::kept},
    FnRow{27, "TABWRITE", FnUse::kept},
    FnRow{28, "TABREAD", FnUse::kept},
    FnRow{29, "PLC", FnUse::kept},
    FnRow{37, "EXPORT", FnUse::kept},
    FnRow{38, "SEND", FnUse::kept},
};
constexpr const FnRow* fn_row(std::int64_t number) {
  for (const auto& f : fn_rows) {
    if (f.number == number) return &f;
  }
  return nullptr;
}
/// The jump with this comparison; nullptr: FN has none (LE, GE).
constexpr const FnRow* jump_row(ir::BinaryOp op) {
  for (const auto& f : fn_rows) {
    if (f.use == FnUse::jump && f.op == op) return &f;
  }
  return nullptr;
}

}  // namespace cnctrans::dialects::heidenhain
