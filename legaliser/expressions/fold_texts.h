// Expressions over texts and axes whose values are known, written as what they give.
#pragma once

#include <functional>
#include <string>

#include "ir/edit/rewrite.h"

namespace cnctrans::ir::passes {

struct KnownValues {
  std::function<ExprPtr(const VarRef&)> variable;  ///< the literal that it holds here; null: not known
  std::function<std::string(AxisId)> axis_name;    ///< as the source's machine calls it
};

/// Known variables of texts and axes become their values, numbers only inside of a text; functions of known texts
/// become what they give.
ExprPtr with_known_texts(const ExprPtr& e, const KnownValues& known);

/// What a statement names by a text or an axis that is known: the label of a jump, the subprogram of a call, the axis
/// of a word.
void say_known_names(Statement& s, const KnownValues& known, const Program& program, const Routine& routine);

/// A function that makes a number of a text.
bool is_text_function(const ExprPtr& e);

/// Axes that variables name, in the words of a block: no values, so that each_expression() does not see them.
void each_axis_expression(const Statement& s, const std::function<void(const ExprPtr&)>& visit);

}  // namespace cnctrans::ir::passes
