// Expressions and parameters: syntax trees to IR trees.
#pragma once

#include "frontends/common/syntax.h"
#include "frontends/fagor/state/state.h"
#include "ir/expr.h"
#include "ir/statement.h"
#include "ir/value.h"

namespace cnctrans::fagor {

/// Never null: a part that can't be read is reported and stands as 0.
ir::ExprPtr lower_expr(const syntax::Expr& e, LowerState& state);
/// Target of an assignment; false: reported, no target.
bool lower_target(const syntax::Expr& e, LowerState& state, ir::Assign::Item& item);
/// Value of an ISO word: number, parameter, or 0 for a bare word.
inline ir::Value lower_value(const syntax::Word& w, const syntax::Block& block, LowerState& state) {
  if (w.expr < 0) return ir::Value(w.number, w.number_text);
  return ir::Value(lower_expr(block.exprs[static_cast<std::size_t>(w.expr)], state));
}
/// The letter of a local parameter name (`A`, `P3` = `D`), 0 when it is none.
char parameter_letter(const syntax::Expr& e);

}  // namespace cnctrans::fagor
