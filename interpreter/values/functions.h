// Functions of expressions on numbers.
#pragma once

#include <span>

#include "interpreter/trace/failure.h"
#include "ir/expr.h"

namespace cnctrans::interpreter {

/// The value, or 0 and a failure (wrong number of arguments, outside the domain).
double numeric_function(ir::Function f, ir::RoundHalf half, std::span<const double> args, Failure& failure);
/// Functions whose first argument is a text.
bool takes_text(ir::Function f);
/// The 32-bit integer that bit operations work on (toward zero); a failure outside their range.
std::int32_t to_int32(double x, Failure& failure);

}  // namespace cnctrans::interpreter
