// Expressions whose value is whole by what they are.
#pragma once

#include "ir/expr.h"

namespace cnctrans::ir {

/// Works on the bits of whole numbers; of a fraction it takes the whole part.
bool works_on_bits(BinaryOp op);
/// The value has no fraction whatever its variables hold: integers and truth values, and what rounds.
bool is_whole(const ExprPtr& e);

}  // namespace cnctrans::ir
