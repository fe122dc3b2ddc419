// Codes and looks of the LinuxCNC writer ("G-Codes" of the manual).
#pragma once

#include <array>
#include <string_view>

#include "backends/common/expression_printer.h"
#include "backends/common/style.h"

namespace cnctrans::backends::linuxcnc {

using ir::Setting;

inline constexpr std::array modal_codes{
    ModalCode{Setting::plane, code_value(ir::Plane::xy), "G17"},
    ModalCode{Setting::plane, code_value(ir::Plane::zx), "G18"},
    ModalCode{Setting::plane, code_value(ir::Plane::yz), "G19"},
    ModalCode{Setting::distance, code_value(ir::Distance::absolute), "G90"},
    ModalCode{Setting::distance, code_value(ir::Distance::incremental), "G91"},
    ModalCode{Setting::units, code_value(ir::Units::metric), "G21"},
    ModalCode{Setting::units, code_value(ir::Units::inch), "G20"},
    ModalCode{Setting::diameter, code_value(ir::DiameterMode::radius), "G8"},
    ModalCode{Setting::diameter, code_value(ir::DiameterMode::diameter), "G7"},
    ModalCode{Setting::feed_mode, code_value(ir::FeedMode::per_minute), "G94"},
    ModalCode{Setting::feed_mode, code_value(ir::FeedMode::per_rev), "G95"},
    ModalCode{Setting::path_mode, code_value(ir::PathMode::continuous), "G64"},
    ModalCode{Setting::path_mode, code_value(ir::PathMode::exact_stop), "G61.1"},
    ModalCode{Setting::comp, code_value(ir::CompSide::off), "G40"},
    ModalCode{Setting::comp, code_value(ir::CompSide::left), "G41"},
    ModalCode{Setting::comp, code_value(ir::CompSide::right), "G42"},
    ModalCode{Setting::feed_override, code_value(ir::OnOff::on), "M50 P1"},
    ModalCode{Setting::feed_override, code_value(ir::OnOff::off), "M50 P0"},
};

inline constexpr std::array motion_codes{
    MotionCode{ir::MotionKind::rapid, "G0"},         MotionCode{ir::MotionKind::linear, "G1"},
    MotionCode{ir::MotionKind::arc_cw, "G2"},        MotionCode{ir::MotionKind::arc_ccw, "G3"},
    MotionCode{ir::MotionKind::thread, "G33"},       MotionCode{ir::MotionKind::probe_toward, "G38.2"},
    MotionCode{ir::MotionKind::probe_away, "G38.4"},
};

inline constexpr std::array<std::string_view, 1> skip_marks{"/"};

inline constexpr Style style{
    .dialect = "linuxcnc",
    .comment = {.open = ";", .close = {}, .blank_after_open = true, .gap = 2},
    .modal_codes = modal_codes,
    .motion_codes = motion_codes,
    .kept_decimals = 12,
    .made_decimals = 6,
    .indent = 2,
    .code_waits_for_move = true,  // it stops at a G1 without a feed, with axes or without
    .skip_marks = skip_marks,
};

// "Binary Operators": ** first, then * / MOD, then + -, then comparisons, then AND OR XOR; left to right.
inline constexpr std::array binary_texts{
    BinaryText{ir::BinaryOp::power, "**", 6, false},     BinaryText{ir::BinaryOp::multiply, "*", 5, false},
    BinaryText{ir::BinaryOp::divide, "/", 5, false},     BinaryText{ir::BinaryOp::add, "+", 4, false},
    BinaryText{ir::BinaryOp::subtract, "-", 4, false},   BinaryText{ir::BinaryOp::eq, "EQ", 3, true},
    BinaryText{ir::BinaryOp::ne, "NE", 3, true},         BinaryText{ir::BinaryOp::lt, "LT", 3, true},
    BinaryText{ir::BinaryOp::le, "LE", 3, true},         BinaryText{ir::BinaryOp::gt, "GT", 3, true},
    BinaryText{ir::BinaryOp::ge, "GE", 3, true},         BinaryText{ir::BinaryOp::logical_and, "AND", 2, true},
    BinaryText{ir::BinaryOp::logical_or, "OR", 2, true}, BinaryText{ir::BinaryOp::logical_xor, "XOR", 2, true},
};
inline constexpr std::array unary_texts{UnaryText{ir::UnaryOp::negate, "-", primary_level}};
inline constexpr std::array function_texts{
    FunctionText{ir::Function::sin, "SIN"},   FunctionText{ir::Function::cos, "COS"},
    FunctionText{ir::Function::tan, "TAN"},   FunctionText{ir::Function::asin, "ASIN"},
    FunctionText{ir::Function::acos, "ACOS"}, FunctionText{ir::Function::sqrt, "SQRT"},
    FunctionText{ir::Function::exp, "EXP"},   FunctionText{ir::Function::ln, "LN"},
    FunctionText{ir::Function::abs, "ABS"},   FunctionText{ir::Function::ceil, "FUP"},
    FunctionText{ir::Function::floor, "FIX"},
};

inline constexpr ExpressionStyle expression_style{
    .binary = binary_texts,
    .unary = unary_texts,
    .functions = function_texts,
    .open = "[",
    .close = "]",
};

}  // namespace cnctrans::backends::linuxcnc
