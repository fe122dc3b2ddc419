// Which structured statements stay on a target whose conditions are relations joined from left to right.
#pragma once

#include "legaliser/edit/editor.h"
#include "legaliser/expressions/expression_lowering.h"

namespace cnctrans::ir::passes {

/// Relations of a variable with a number or variable, joined by AND and OR from left to right.
bool is_relation_chain(const ExprPtr& e);
/// The same with the variable of each relation on its left, compared as the target does.
ExprPtr in_target_form(const ExprPtr& e, Compare compare);

/// Looked up before the routine is rewritten: its labels and who goes to them.
class Structures {
 public:
  Structures(const Program& program, const Routine& routine, const ExactNumbers& numbers);
  /// The condition needs nothing before it and compares without a tolerance, or exactly as the target does.
  [[nodiscard]] bool condition_fits(const ExprPtr& e, const Capabilities& target) const;
  /// One relation, of whatever the target can put into a variable before it.
  [[nodiscard]] bool relation_fits(const ExprPtr& e, const Capabilities& target) const;
  /// Without a rounding that changes nothing.
  [[nodiscard]] ExprPtr unrounded(const ExprPtr& e) const;
  /// A number or variable that the target can name.
  [[nodiscard]] bool operand_fits(const ExprPtr& e, const Capabilities& target) const;
  /// Nothing leaves the body but its exits, and nothing jumps or reaches into it.
  [[nodiscard]] bool closed(const Body& body) const;

 private:
  LabelUses uses_;
  const ExactNumbers& numbers_;
};

}  // namespace cnctrans::ir::passes
