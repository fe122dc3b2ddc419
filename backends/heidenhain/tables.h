// How Heidenhain programs look.
#pragma once

#include <array>

#include "backends/common/expression_printer.h"
#include "backends/common/style.h"
#include "dialects/heidenhain/limits.h"

namespace cnctrans::backends::heidenhain {

inline constexpr std::string_view dialect_name = "heidenhain";

namespace detail {
inline constexpr std::array<std::string_view, 1> skip_marks{"/"};
// Formulas (reference 13): the levels of dialects/heidenhain/functions.h.
inline constexpr std::array binary_texts{
    BinaryText{ir::BinaryOp::add, "+", 1, true},      BinaryText{ir::BinaryOp::subtract, "-", 1, true},
    BinaryText{ir::BinaryOp::multiply, "*", 2, true}, BinaryText{ir::BinaryOp::divide, "/", 2, true},
    BinaryText{ir::BinaryOp::modulo, "%", 2, true},   BinaryText{ir::BinaryOp::power, "^", 3, false},
};
inline constexpr std::array unary_texts{UnaryText{ir::UnaryOp::negate, "-", 4}};
}  // namespace detail

inline constexpr ExpressionStyle expression_style{
    detail::binary_texts, detail::unary_texts, {}, "(", ")", " ", "\"", true, false, true};

inline constexpr Style style = [] {
  Style s;
  s.dialect = dialect_name;
  // A comment that ends in ~ would draw the next line into its block.
  s.comment = {";", "", true, true, false, false, "~", "-", 1, false};
  s.kept_decimals = s.made_decimals = dialects::heidenhain::linear_decimals;
  s.order_by_rank = true;
  s.label_blocks = true;
  s.blank_lines = false;
  s.skip_marks = detail::skip_marks;
  return s;
}();

}  // namespace cnctrans::backends::heidenhain
