// Expressions in the target's form: what one expression can't say goes into assignments before it.
#pragma once

#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

/// True when the target writes the expression as it stands: all operators and functions are there.
bool expression_fits(const ExprPtr& e, const Capabilities& target);
/// The opposite condition; relations are turned round, NOT disappears.
ExprPtr negated_condition(const ExprPtr& e);
/// A relation with the number on its right side.
ExprPtr variable_first(const ExprPtr& relation);
bool is_condition(const ExprPtr& e);

/// Lowers the expressions of one statement. Temporaries are free again when it goes out of scope.
class ExpressionLowering {
 public:
  /// `like`: the line of the statement, for places and skip levels.
  ExpressionLowering(Editor& editor, const LineInfo& like) : editor_(editor), like_(like) {}
  ~ExpressionLowering();
  ExpressionLowering(const ExpressionLowering&) = delete;
  ExpressionLowering& operator=(const ExpressionLowering&) = delete;

  /// Statements that must come before; the caller takes them.
  Body pre;

  /// A variable that may hold intermediate values because it is written next and not read.
  void set_scratch(const VarRef& v) { scratch_ = v; }
  void clear_scratch() { scratch_.reset(); }

  /// An expression that the target can write.
  ExprPtr lower(const ExprPtr& e);
  /// A number, a variable or a machine datum.
  ExprPtr primary(const ExprPtr& e);
  /// What brackets behind the name of an array take.
  ExprPtr element_index(const ExprPtr& e);
  /// As the value of a word.
  Value word(const Value& v);
  /// Appends to `pre`: go to `target` when the condition holds.
  void jump_if(const ExprPtr& condition, const LabelRef& target);
  /// A condition that the target can write in one expression.
  ExprPtr condition(const ExprPtr& e);

 private:
  using Args = std::vector<ExprPtr>;
  // expression_lowering.cpp
  ExprPtr node(const ExprPtr& e);
  ExprPtr chain(const ExprPtr& e);
  ExprPtr chain_binary(const Binary& b);
  ExprPtr operand(const ExprPtr& e);
  ExprPtr into_temporary(const ExprPtr& e);
  std::optional<VarRef> temporary();
  void assign(const VarRef& v, const ExprPtr& e);
  void assign_if(const ExprPtr& relation, const VarRef& v, const ExprPtr& e);
  void label_here(const LabelRef& l);
  ExprPtr constant(const ExprPtr& e);
  ExprPtr fail(const ExprPtr& e, std::string_view what);
  [[nodiscard]] bool has(Function f) const { return editor_.target().functions.count(f) != 0; }
  [[nodiscard]] bool has(BinaryOp op) const { return editor_.target().binary.count(op) != 0; }
  // expression_rules.cpp
  ExprPtr binary_rule(const Binary& b, const ExprPtr& e);
  ExprPtr unary_rule(const Unary& u, const ExprPtr& e);
  ExprPtr call_rule(const Call& c, const ExprPtr& e);
  ExprPtr power(const Binary& b, const ExprPtr& e);
  ExprPtr truth_value(const ExprPtr& e);
  ExprPtr bcd(const Call& c, const ExprPtr& e);
  ExprPtr trigonometric(const Call& c, const ExprPtr& e);
  ExprPtr full_angle(const Call& c, const ExprPtr& e);
  ExprPtr quadrants(const ExprPtr& y, const ExprPtr& x, bool positive);
  ExprPtr rounding(const Call& c, const ExprPtr& e);
  ExprPtr selection(const Call& c, const ExprPtr& e);
  ExprPtr logarithm(const Call& c, const ExprPtr& e);
  // conditions.cpp
  void jump_if_relation(const ExprPtr& relation, const LabelRef& target);
  ExprPtr exact_comparison(const ExprPtr& e);

  Editor& editor_;
  LineInfo like_;
  std::vector<VarRef> taken_;
  std::optional<VarRef> scratch_;
  bool scratch_used_ = false;
  int depth_ = 0;
};

/// Variables that are multiples of 1/grid whatever happens: every value assigned to them is one. Sums, differences and
/// comparisons of such numbers have no rounding errors.
class IntegerVariables {
 public:
  IntegerVariables(const Program& program, double grid);
  [[nodiscard]] bool exact(const ExprPtr& e) const;
  /// A variable that the program never writes.
  [[nodiscard]] bool untouched(const ExprPtr& e) const;

 private:
  static std::string key(const VarRef& v);
  double grid_;
  std::set<std::string> not_whole_, assigned_;
};

/// What compares exactly whatever tolerance a control has: whole numbers, and multiples of 1/1024.
struct ExactNumbers {
  explicit ExactNumbers(const Program& program) : whole(program, 1), parts(program, 1024) {}
  [[nodiscard]] bool has(const ExprPtr& e) const { return whole.exact(e) || parts.exact(e); }
  IntegerVariables whole, parts;
};

}  // namespace cnctrans::ir::passes
